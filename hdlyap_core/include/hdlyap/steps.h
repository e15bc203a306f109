/** The steps of the spectrum, and the dispersion relation fitted to them [T12]. A step is a set of
 * equal exponents whose vectors are waves of one kind and one wave vector. All functions, those
 * that read too, use one workspace: one thread at a time. */
#ifndef HDLYAP_STEPS_H
#define HDLYAP_STEPS_H

#include "hdlyap/modes.h"
#include "hdlyap/spectrum.h"

HD_API_BEGIN

/** Whether the exponents of several steps that share one set of vectors coincide, or differ
 * although their vectors are mixed. */
typedef enum hd_sharing {
    HD_SHARING_ALONE,   /**< the step has a set of its own, or is not resolved */
    HD_SHARING_UNKNOWN, /**< standard errors are unknown, or too large to tell */
    HD_SHARING_MIXING,  /**< exponents differ, but the vectors have not yet separated */
    HD_SHARING_BLENDED, /**< exponents differ, but their fluctuations exceed the gap, so the vectors
                             stay mixed */
    HD_SHARING_COINCIDENT /**< exponents are equal within three standard errors, at most 3 % */
} hd_sharing;

/** The fields of one kind at one wave vector, and the exponents that belong to them; or the zero
 * modes. */
typedef struct hd_step {
    hd_mode_kind kind; /**< HD_MODE_T, HD_MODE_LP or HD_MODE_ZERO */
    hd_wave wave;      /**< all 0 for the zero modes */
    int subspace;      /**< number of its fields in hd_fields; -1 for the zero modes */
    int expected;      /**< number of equal exponents that the boundaries imply */
    bool conjugate;    /**< true in the negative half of the spectrum */
    bool resolved;  /**< true if its vectors were found; otherwise all below is 0, col and set -1 */
    int col, count; /**< its set of vectors: columns [col, col + count) */
    int set, members;    /**< number of the set, and how many steps share it */
    double multiplicity; /**< sum of the weights of the set's vectors in the step's fields, 0 ..
                            expected */
    double exponent;  /**< mean over the set, weighted by each vector's share in this step [1/time
                         unit] */
    double std_error; /**< standard error of exponent; negative if not yet known */
    /* Ordered by exponent, each step that shares the set has columns of its own in it. */
    hd_sharing sharing; /**< do the steps of the set coincide? */
    double set_time;    /**< averaged time since when the same steps share the set [time units] */
    double own_part;    /**< fraction of the step's weight in the set that is in the step's own
                           columns: 1 without mixing */
    double gap; /**< difference between the mean exponents of the step's own columns and of the
                   nearest step's; 0 if it is alone [1/time unit] */
    double gap_error; /**< standard error of gap; negative if not yet known, 0 if it is alone */
} hd_step;

/** What long boxes have shown about lambda(k) = c k + c2 k^2 + c3 k^3 at the density of a scene
 * [T12]. All NaN if steps follow no such relation: LP in a circle. */
typedef struct hd_relation {
    double c2, c2_error; /**< c2 / c and its standard error [sigma] */
    double c3, c3_error; /**< c3 / c and its standard error [sigma^2] */
    double box_error;    /**< relative error of c due to narrow edges and walls of this box */
    double scatter;      /**< relative model error of the exponent of a well resolved step */
} hd_relation;
/** Relative error of c that remains in the scene's box at any averaged time, from its longest wave
 * of a kind; INFINITY if the scene has no such wave, or steps follow no relation. */
double hd_relation_open(const hd_scene_def *def, hd_mode_kind kind);

/** Smallest number of exponents in a scene that can reach a step of its waves; 0 if it asks for no
 * waves. Each field in the box with a smaller exponent is a vector below that step. */
int hd_steps_exponents_least(const hd_scene_def *def);

/** A fitted coefficient. Its error contains what the form of the relation leaves open, and is
 * multiplied by the misfit if that is above 1; negative if not yet known. */
typedef struct hd_coefficient {
    double value, error;
} hd_coefficient;

/** The fit lambda = c k + c2 k^2 + c3 k^3 to the resolved steps of one kind by least squares, with
 * c2 / c and c3 / c of long boxes as two more observations. The weight of a step follows from its
 * standard error and its scatter. c is the slope of infinitely long waves. */
typedef struct hd_dispersion {
    int points;          /**< distinct wave numbers; 0: no fit, all below is 0 or unknown */
    double k_min, k_max; /**< smallest and largest wave number; 0 without a fit [1/sigma] */
    double prior_share;  /**< share of c2 and c3 that comes from long boxes instead of this run: 1
                            for a single wave number, near 0 if the steps determine them */
    hd_coefficient c;    /**< [sigma/time unit] */
    double c_sampling_error; /**< part of the error of c by which another run of this box may
                                differ; negative if not yet known */
    hd_coefficient c2;       /**< [sigma^2/time unit] */
    hd_coefficient c3;       /**< [sigma^3/time unit] */
    const hd_relation *in_long_boxes; /**< c2 / c and c3 / c of long boxes */
    double misfit; /**< sqrt(chi^2 / degrees of freedom): far above 1 if the steps do not follow the
                      relation; negative for a single step or without errors */
} hd_dispersion;

typedef struct hd_steps hd_steps;
/** A step is resolved if this fraction of its expected multiplicity is found, beyond that of random
 * vectors. */
#define HD_STEPS_THRESHOLD 0.5

/** Number of steps, resolved or not, which is constant: first one for each subspace of hd_fields,
 * then the zero modes, then, if all exponents are computed, the conjugate steps. */
int hd_steps_count(const hd_steps *steps);
const hd_step *hd_steps_step(const hd_steps *steps, int index);

/** The step to which a vector belongs: of those that share its set, the one in which its mean
 * weight is largest. -1 if it is in no set, or its weight there is below the threshold. */
int hd_steps_of_vector(const hd_steps *steps, int col);
/** A column that represents a resolved step: the first one of its set that belongs to the step, or
 * the first one. */
int hd_steps_example(const hd_steps *steps, int index);
/** True for the resolved T and LP steps of positive exponents; if several share a set, for the
 * first of them only. Their examples together show every set. */
bool hd_steps_is_shown(const hd_steps *steps, int index);
/** The resolved step of a kind with the smallest positive exponent; -1 if there is none. */
int hd_steps_lowest(const hd_steps *steps, hd_mode_kind kind);
/** Relative model error of the exponent of a resolved T or LP step: it grows if multiplicity is
 * missing, or weight is in columns of other steps. NaN if steps follow no relation. */
double hd_steps_scatter(const hd_steps *steps, const hd_step *step);

/** Fits the steps of a kind, HD_MODE_T or HD_MODE_LP; they must have been found with this spectrum.
 */
hd_dispersion hd_steps_dispersion(const hd_steps *steps, const hd_spectrum *spectrum,
                                  hd_mode_kind kind);

HD_API_END
#endif
