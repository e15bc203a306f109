/** The steps of the spectrum, and the dispersion relation lambda(k) fitted to them [T12]. A
 * step is made of equal exponents whose vectors are waves of one kind and one wave vector. Its
 * neighbouring columns are its set; steps whose vectors mix share a set. n is the number of
 * vectors, which are columns 0 .. n - 1, largest exponent first. The functions of one run share
 * a workspace: only one thread at a time may call them for the same run. [T12] is the tag of an
 * equation in THEORY.md. */
#ifndef HDLYAP_STEPS_H
#define HDLYAP_STEPS_H

#include "hdlyap/modes.h"
#include "hdlyap/spectrum.h"

HD_API_BEGIN

/** Several steps can be found in one set of neighbouring columns, because their vectors are
 * mixtures. This says whether the exponents of these steps are equal, or differ although their
 * vectors are mixed. */
typedef enum hd_sharing {
    HD_SHARING_ALONE,   /**< the step is the only one of its set, or it is not resolved */
    HD_SHARING_UNKNOWN, /**< standard errors of the exponents are not known, or too large to tell */
    HD_SHARING_MIXING,  /**< exponents differ, but the vectors have not had the time to separate */
    HD_SHARING_BLENDED, /**< exponents differ, but by less than they fluctuate, so that the vectors
                           stay mixed */
    /** Exponents differ by at most three standard errors of their difference, and three of these
     * errors are at most 3 % of the exponent. */
    HD_SHARING_COINCIDENT
} hd_sharing;

/** A step: the fields of one kind at one wave vector, and the exponents that were found to belong
 * to them; or the zero modes with their exponents. */
typedef struct hd_step {
    hd_mode_kind kind; /**< HD_MODE_T, HD_MODE_LP or HD_MODE_ZERO */
    hd_wave wave;      /**< its wave vector; all 0 for the zero modes */
    int subspace;      /**< index of its subspace in hd_fields; -1 for the zero modes */
    int expected;      /**< number of equal exponents that theory expects for these boundaries */
    bool conjugate;    /**< true for a step of negative exponents, the opposite of one of positive
                          exponents */
    /** True if its vectors were found. Otherwise col and set are -1, std_error is negative, and all
     * other members below are 0. */
    bool resolved;
    /** The set of columns in which its vectors are: col .. col + count - 1. Other steps may share
     * the set. */
    int col, count;
    /** Number of the set, 0 or above; number of steps in this set. */
    int set, members;
    double multiplicity; /**< measured multiplicity: sum of the weights of the set's vectors in the
                            step's fields, 0 .. expected */
    /** Mean exponent of the set's vectors, each weighted by the share that this step has in its
     * weight [1/time unit]. */
    double exponent;
    /** Standard error of exponent, with what mixing with vectors of near exponents may do; negative
     * while it is not known. */
    double std_error;
    double mixing; /**< that part of std_error, which no longer run reduces [1/time unit] */
    /** Whether the exponents of the steps of this set are equal. For this and for what follows,
     * each step of the set has as many columns of its own as it expects, in the order of the steps'
     * exponents. */
    hd_sharing sharing;
    double set_time; /**< averaged time since which the set has had these same steps [time units] */
    double own_part; /**< fraction of the step's weight in the set that is in its own columns: 1
                        without mixing */
    /** How far the mean exponent of the step's own columns is from that of the nearest other step
     * of the set, 0 or above; 0 if there is none [1/time unit]. */
    double gap;
    double gap_error; /**< standard error of gap; negative while it is not known, 0 if the step is
                         alone */
} hd_step;

/** What long boxes have shown about lambda(k) = c k + c2 k^2 + c3 k^3, at the density of a scene
 * [T12]. All members are NaN if the steps of a kind follow no relation, as LP in a circle. */
typedef struct hd_relation {
    double c2, c2_error; /**< c2 / c and its standard error [sigma] */
    double c3, c3_error; /**< c3 / c and its standard error [sigma^2] */
    double box_error;    /**< relative error of c, that of LP also of the velocity of LP waves,
                            because of narrow edges and walls of the box */
    double scatter;      /**< relative deviation of the exponent of a well resolved step from the
                            relation */
} hd_relation;
/** Relative error of c that remains in a scene's box however long a run averages, from the longest
 * wave with fields of this kind, HD_MODE_T or HD_MODE_LP. INFINITY if the scene has no such wave,
 * or its steps follow no relation. */
double hd_relation_open(const hd_scene_def *def, hd_mode_kind kind);

/** Smallest number of exponents with which a scene can show a step of its waves: so many that the
 * vectors of one step are among them. 0 if the scene asks for no waves. */
int hd_steps_exponents_least(const hd_scene_def *def);

/** A fitted coefficient and its error. The error contains what the form of the relation leaves
 * open, and is multiplied by hd_dispersion.misfit if that is above 1; it is negative while it is
 * not known. */
typedef struct hd_coefficient {
    double value, error;
} hd_coefficient;

/** The least-squares fit lambda = c k + c2 k^2 + c3 k^3 to the resolved steps of one kind, with the
 * values of c2 / c and c3 / c from long boxes as two more observations. The weight of a step
 * follows from its standard error and from hd_steps_scatter. c is the slope lambda / k of
 * infinitely long waves. */
typedef struct hd_dispersion {
    int points; /**< number of different wave numbers in the fit; 0 means no fit: all members below
                   are then 0 or unknown */
    double k_min, k_max; /**< smallest and largest wave number in the fit [1/sigma] */
    double prior_share;  /**< share of c2 and c3 that comes from long boxes instead of this run: 1
                            with a single wave number, near 0 if the steps determine c2 and c3 */
    hd_coefficient c;    /**< [sigma/time unit] */
    /** Part of the error of c by which another run of this box may differ; negative while it is not
     * known. */
    double c_sampling_error;
    double c_mixing;   /**< part of c_sampling_error that comes from mixing: longer runs keep it */
    hd_coefficient c2; /**< [sigma^2/time unit] */
    hd_coefficient c3; /**< [sigma^3/time unit] */
    const hd_relation *in_long_boxes; /**< c2 / c and c3 / c of long boxes */
    double misfit; /**< sqrt(chi^2 / degrees of freedom): far above 1 if the steps do not follow the
                      relation; negative for a single step, or while errors are not known */
} hd_dispersion;

/** The steps of a run; owned by the run. */
typedef struct hd_steps hd_steps;
/** A step is resolved if at least this part of its expected multiplicity is found, beyond the
 * multiplicity that random vectors would have. */
#define HD_STEPS_THRESHOLD 0.5

/** Number of steps, resolved or not, which is constant. First comes one step for each subspace of
 * hd_fields, in the same order; then the zero modes; then, if all exponents are computed, the
 * conjugate steps. */
int hd_steps_count(const hd_steps *steps);
/** Step `index`, 0 .. hd_steps_count - 1. It changes when the run goes on. */
const hd_step *hd_steps_step(const hd_steps *steps, int index);

/** Index of the step to which vector col belongs: among the steps that share its set, the one in
 * which its mean weight is largest. -1 if col is in no set, or if its weights in the set's steps
 * are too small. */
int hd_steps_of_vector(const hd_steps *steps, int col);
/** A column that stands for a resolved step: the first one of its set that belongs to the step
 * (hd_steps_of_vector), or, if none does, the first one of the set. */
int hd_steps_example(const hd_steps *steps, int index);
/** True for a resolved T or LP step of positive exponents, unless such a step of lower index shares
 * its set. So the columns of hd_steps_example of these steps show each set once. */
bool hd_steps_is_shown(const hd_steps *steps, int index);
/** Index of the resolved step of a kind, HD_MODE_T or HD_MODE_LP, with the smallest positive
 * exponent; -1 if there is none. */
int hd_steps_lowest(const hd_steps *steps, hd_mode_kind kind);
/** Relative deviation from lambda(k) that the exponent of a resolved T or LP step may have by
 * itself. It grows with the part of its multiplicity that is missing, and with the part of its
 * weight that is in columns of other steps. NaN if steps follow no relation. */
double hd_steps_scatter(const hd_steps *steps, const hd_step *step);

/** Fits lambda(k) to the steps of a kind, HD_MODE_T or HD_MODE_LP. `spectrum` is that of the same
 * run, from which the steps were found. */
hd_dispersion hd_steps_dispersion(const hd_steps *steps, const hd_spectrum *spectrum,
                                  hd_mode_kind kind);

HD_API_END
#endif
