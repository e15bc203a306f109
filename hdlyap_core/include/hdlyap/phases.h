/** How the vectors of a step move within pairs of its fields [T13]. Vectors of an LP step rotate
 * between the L and the P field of each modulation. Vectors of a T step only diffuse between the T
 * field of a cosine and that of a sine. Several threads may read one hd_phases at once while none
 * calls its run. */
#ifndef HDLYAP_PHASES_H
#define HDLYAP_PHASES_H

#include "hdlyap/steps.h"

HD_API_BEGIN

typedef enum hd_phase_state {
    HD_PHASE_UNRESOLVED, /**< the step is not resolved: nothing else is known */
    HD_PHASE_WEAK,       /**< a^2 + b^2 is too small for a phase in this sample */
    HD_PHASE_COARSE,     /**< samples are too far apart to continue the phase; the tracking begins
                              again */
    HD_PHASE_TRACKED     /**< everything is known */
} hd_phase_state;

/** The phase of one vector of a step in one pair of fields. */
typedef struct hd_phase {
    int step;                 /**< index in hd_steps */
    unsigned char modulation; /**< modulation (hdlyap/wave.h) of both L and P; for T of the first
                                 field, and the second has a sine for its cosine along the first
                                 periodic direction with a mode number */
    int col;                  /**< column of the vector now, which may change; -1 if unresolved */
    hd_phase_state state;
    double a, b;  /**< least-squares coefficients on the normalised fields: L and P, or T and T */
    double phase; /**< atan2(b, a), continued beyond pi since the tracking began [rad] */
    double omega; /**< slope of this phase over time, by regression [rad/time unit] */
    double omega_error; /**< standard error of omega; negative if not yet known */
    double time;        /**< length of the tracking [time units] */
} hd_phase;

typedef struct hd_phases hd_phases;

/** Number of phases, which is constant: for each subspace of the kind with d pairs 2 d^2, in the
 * order of the steps: of each of its 2 d vectors d pairs. A single T field, between walls, is no
 * pair. */
int hd_phases_count(const hd_phases *phases);
const hd_phase *hd_phases_phase(const hd_phases *phases, int index);

/** Diffusion constant D of a phase, whose mean square about omega t is 2 D t [rad^2/time unit], and
 * its standard error; negative if not yet known. D comes from blocks of time, and is too large
 * while these are shorter than the time in which the phase forgets its fluctuations. */
double hd_phases_diffusion(const hd_phases *phases, int index, double *error);

/** Mean rate of the tracked phases of a step [rad/time unit], and its standard error, negative if
 * not yet known. Returns false, and writes nothing, while no phase is tracked. */
HD_MUST_CHECK bool hd_phases_rate(const hd_phases *phases, int step, double *omega, double *error);

/** |omega| / k of the steps: a mean weighted with the errors of their rates [sigma/time unit]. */
typedef struct hd_velocity {
    int phases; /**< number of tracked phases in it; 0: nothing is known */
    double k_min,
        k_max;         /**< smallest and largest wave number of their steps; 0 without [1/sigma] */
    double v, v_error; /**< velocity, and its standard error, times misfit if that is above 1;
                            negative if not yet known */
    double v_sampling_error; /**< part of v_error by which another run of the same box may differ,
                                with the correlation of the steps; negative if not yet known */
    double misfit; /**< sqrt(chi^2 / degrees of freedom): far above 1 if steps differ in velocity;
                      negative for a single step */
} hd_velocity;
hd_velocity hd_phases_velocity(const hd_phases *phases);

HD_API_END
#endif
