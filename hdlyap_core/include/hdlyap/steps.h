/** Degenerate sets of exponents with the waves that they belong to, and the dispersion relation
 * [T12]. One thread at a time, to read as well: there is a workspace in it. */
#ifndef HDLYAP_STEPS_H
#define HDLYAP_STEPS_H

#include "hdlyap/modes.h"
#include "hdlyap/spectrum.h"

HD_API_BEGIN

/** Of a step with others in one set: do their exponents coincide, or do vectors mix that differ? */
typedef enum hd_sharing {
    HD_SHARING_ALONE,   /**< it has its set for itself, or is not resolved */
    HD_SHARING_UNKNOWN, /**< standard errors are not yet known, or too large to tell */
    HD_SHARING_MIXING,  /**< exponents differ, vectors have not had the time to part */
    HD_SHARING_BLENDED, /**< exponents differ, vectors have had the time and mix all the same: their
                             growth fluctuates by more than it differs */
    /** An exponent next to it is the same within three standard errors, at most 3 % of it */
    HD_SHARING_COINCIDENT
} hd_sharing;

/** One kind of field at one wave vector, with the vectors that were found for it; or the zero
 * modes. */
typedef struct hd_step {
    hd_mode_kind kind; /**< HD_MODE_T, HD_MODE_LP or HD_MODE_ZERO */
    hd_wave wave;      /**< zero for the zero modes */
    int subspace;      /**< of hd_fields; -1 for the zero modes */
    int expected;      /**< multiplicity that the boundaries prescribe */
    bool conjugate;    /**< of the negative half of the spectrum */
    bool resolved;     /**< what follows is zero (col -1) unless it is true */
    int col, count;    /**< the vectors of its set: columns [col, col + count) */
    int set, members; /**< number of the set, and of the steps that share it: 1, or more where steps
                               coincide and only the common subspace has a meaning */
    double multiplicity; /**< measured: trace of the projection onto its fields over its set */
    double exponent;  /**< mean over the set, each vector by its share in this step [1/time unit] */
    double std_error; /**< of it; negative if not yet known */
    /** Of the set: its steps, in the order of their exponents, each have columns of their own. */
    hd_sharing sharing;
    double set_time; /**< averaged time since the set has had these members [time units] */
    double own_part; /**< of the step's weight in its set, in its own columns: 1 if alone, its part
                        of the set's columns if all are mixed */
    double gap; /**< of the mean exponents of its own columns and those next to them; 0 if alone */
    double gap_error; /**< of it; negative if not yet known, 0 if alone */
} hd_step;

/** What long boxes at all densities say of lambda(k) = c k + c2 k^2 + c3 k^3 in any box [T12]. All
 * NaN where steps follow no relation: LP in a circle. */
typedef struct hd_relation {
    double c2, c2_error; /**< of c2 / c, its standard error as an estimate [sigma] */
    double c3, c3_error; /**< of c3 / c [sigma^2] */
    double box_error;    /**< by which narrow edges and walls may move c, as a part of it */
    double scatter; /**< of a well resolved step about the relation, as a part of its exponent */
} hd_relation;
/** What c of such a box is left open by, however long it is averaged, as a part of it: from its
 * longest wave of this kind, well resolved; INFINITY if the scene asks for none, or they follow no
 * relation. */
double hd_relation_open(const hd_scene_def *def, hd_mode_kind kind);

/** Fewest exponents of which one may belong to a step of the waves that the scene asks for, 0 if it
 * asks for none: each field of a wave in the box that can have a smaller exponent is a vector below
 * it. All of them are within hd_counts.positive. */
int hd_steps_exponents_least(const hd_scene_def *def);

/** The error is a standard error with all that the form of the relation leaves open, times the
 * misfit if that is above 1; negative if not yet known. */
typedef struct hd_coefficient {
    double value, error;
} hd_coefficient;

/** lambda = c k + c2 k^2 + c3 k^3, least squares over the resolved steps, with c2 / c and c3 / c of
 * long boxes as two more observations: one formula for one wave number and for many. Each step
 * weighs by its standard error and its scatter. c is that of waves longer than the box. */
typedef struct hd_dispersion {
    int points;          /**< distinct wave numbers; 0: no fit, all below is 0 or unknown. None
                            where steps follow no relation */
    double k_min, k_max; /**< smallest and largest wave number; 0 without one [1/sigma] */
    double prior_share;  /**< of c2 and c3, the part that long boxes say: 1 from one wave number,
                            towards 0 where the steps tell them by themselves */
    hd_coefficient c;    /**< [sigma/time unit] */
    double c_sampling_error; /**< of its error, what another run of the same box may differ by */
    hd_coefficient c2;       /**< [sigma^2/time unit] */
    hd_coefficient c3;       /**< [sigma^3/time unit] */
    const hd_relation *in_long_boxes; /**< what it stands on beside the steps */
    double misfit; /**< root mean square deviation of the steps from the relation, per degree of
                      freedom, in units of error and scatter of a step; negative of a single step or
                      if errors are not known. Far above 1: the relation does not hold so far, and
                      the errors of c, c2 and c3 have grown with it */
} hd_dispersion;

typedef struct hd_steps hd_steps;
/** A step is resolved if at least this part of its expected multiplicity is found, beyond what
 * random vectors would show. */
#define HD_STEPS_THRESHOLD 0.5

/** Steps of all subspaces in their order, the zero modes, and with all 4N vectors the conjugate
 * steps in the same order; resolved or not: the number is constant. */
int hd_steps_count(const hd_steps *steps);
const hd_step *hd_steps_step(const hd_steps *steps, int index);

/** Step to which a vector belongs: the one of its set with the largest average weight; -1 if none:
 * outside all sets, or with less than that part of it in its set. */
int hd_steps_of_vector(const hd_steps *steps, int col);
/** Column that stands for a resolved step: the first of its set that belongs to the step itself,
 * else the first one. */
int hd_steps_example(const hd_steps *steps, int index);
/** True of resolved steps of the positive half without the zero modes, and of those that share a
 * set of the first alone: whose examples show all that was found. */
bool hd_steps_is_shown(const hd_steps *steps, int index);
/** The resolved step of the positive half with the smallest exponent of a kind; -1 if there is
 * none.
 */
int hd_steps_lowest(const hd_steps *steps, hd_mode_kind kind);
/** By which a resolved T or LP step may stray from the relation, as a part of its exponent: more if
 * multiplicity is missing, or weight lies in the columns of other steps. NaN without a relation. */
double hd_steps_scatter(const hd_steps *steps, const hd_step *step);

/** Of the steps found with this spectrum. kind: HD_MODE_T or HD_MODE_LP. */
hd_dispersion hd_steps_dispersion(const hd_steps *steps, const hd_spectrum *spectrum,
                                  hd_mode_kind kind);

HD_API_END
#endif
