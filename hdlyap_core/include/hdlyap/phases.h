/** How the vectors of a step move within pairs of its fields [T13]: those of an LP step rotate
 * between the L and the P field of each modulation; those of a T step stay, but for diffusion,
 * between the T fields of a cosine and of a sine. Several threads may read one at once while its
 * run is not called. */
#ifndef HDLYAP_PHASES_H
#define HDLYAP_PHASES_H

#include "hdlyap/steps.h"

HD_API_BEGIN

typedef enum hd_phase_state {
    HD_PHASE_UNRESOLVED, /**< the step is not resolved: nothing else is known */
    HD_PHASE_WEAK,       /**< a^2 + b^2 too small for a phase at this time */
    HD_PHASE_COARSE,     /**< the sample came too late to unwrap the phase: it begins anew */
    HD_PHASE_TRACKED     /**< all is known */
} hd_phase_state;

/** One pair of fields, and one vector of their step. */
typedef struct hd_phase {
    int step;                 /**< of hd_steps */
    unsigned char modulation; /**< HD_SIN_X | HD_SIN_Y: of both L and P; of T the first field's, the
                                 other one's has a sine for a cosine, along the first direction that
                                 is periodic and has nodes; of spheres both may have HD_SECOND */
    int col; /**< the vector followed; it changes where vectors change places; -1 */
    hd_phase_state state;
    double a, b;  /**< least-squares coefficients on the normalised fields: L and P, T and T */
    double phase; /**< atan2(b, a), unwrapped since the tracking began [rad] */
    double omega; /**< its slope by regression, of this one alone [rad/time unit] */
    double omega_error; /**< standard error; negative if not yet known */
    double time;        /**< tracked for so long [time units] */
} hd_phase;

typedef struct hd_phases hd_phases;

/** 2 d^2 for each subspace of the kind with d pairs, in the order of the steps: vectors outside,
 * pairs inside. A single field (of T behind walls) is no pair. Constant. */
int hd_phases_count(const hd_phases *phases);
const hd_phase *hd_phases_phase(const hd_phases *phases, int index);

/** D of a phase with the mean square 2 D t about omega t, from its blocks [rad^2/time unit], and
 * its standard error; negative if not yet known. A phase that also trembles needs blocks that are
 * longer than that takes: before, it is too large. */
double hd_phases_diffusion(const hd_phases *phases, int index, double *error);

/** Mean rate of the tracked phases of a step [rad/time unit], and its standard error, negative if
 * not yet known. False, and nothing is said, while none has turned. */
HD_MUST_CHECK bool hd_phases_rate(const hd_phases *phases, int step, double *omega, double *error);

/** |omega| / k of the steps, by their mean rates, weighted with the errors [sigma/time unit]. */
typedef struct hd_velocity {
    int phases; /**< tracked phases that went into it; 0: nothing known */
    double k_min,
        k_max;         /**< smallest and largest wave number of their steps; 0 without [1/sigma] */
    double v, v_error; /**< error negative if not yet known; times the misfit if that is above 1 */
    double v_sampling_error; /**< what another run of the same box may differ by; it knows how the
                                steps turn together. Negative if not yet known */
    double misfit; /**< root mean square deviation of the steps from v, per degree of freedom, in
                      their standard errors; negative if there is one step. Far above 1: they have
                      not the same velocity, and v_error has grown with it */
} hd_velocity;
hd_velocity hd_phases_velocity(const hd_phases *phases);

HD_API_END
#endif
