/** How the vectors of a step move between the fields of the step, pair by pair [T13]. In an LP
 * step, a vector rotates between the L field and the P field of each modulation with angular
 * velocity omega. In a T step, a vector only diffuses between the T field with a cosine and the one
 * with a sine. The phase of a vector in a pair of fields is its angle there. Several threads may
 * read one hd_phases at once while no thread calls its run. [T13] is the tag of an equation in
 * THEORY.md. */
#ifndef HDLYAP_PHASES_H
#define HDLYAP_PHASES_H

#include "hdlyap/steps.h"

HD_API_BEGIN

/** What is known of a phase now. */
typedef enum hd_phase_state {
    HD_PHASE_UNRESOLVED, /**< the step is not resolved: of hd_phase only step and modulation mean
                            something */
    HD_PHASE_WEAK,       /**< a^2 + b^2 is too small in this sample to define an angle */
    HD_PHASE_COARSE,     /**< the last two samples are too far apart to continue the phase; tracking
                            begins again */
    HD_PHASE_TRACKED     /**< the phase is known, and omega once time is above 0 */
} hd_phase_state;

/** The phase of one vector of a step in one pair of fields, at the last sample of phases. */
typedef struct hd_phase {
    int step; /**< index of the step in hd_steps */
    /** For LP: modulation A (hdlyap/wave.h) of both the L and the P field. For T: modulation of the
     * first field, with a cosine along the first periodic direction that has a mode number; the
     * second field has a sine in its place. */
    unsigned char modulation;
    int col; /**< column of the vector now, which may change from sample to sample; -1 if the step
                is not resolved */
    hd_phase_state state;
    /** Least-squares coefficients of the vector's dq half, scaled to length 1, on the two fields of
     * length 1: L and P, or the two T fields. */
    double a, b;
    /** atan2(b, a), continued beyond pi from sample to sample since tracking began [rad]. */
    double phase;
    double omega; /**< slope of the phase over time since tracking began, by regression, 0 while
                     time is 0 [rad/time unit] */
    double omega_error; /**< standard error of omega; negative if not yet known */
    double time;        /**< time since tracking began [time units] */
} hd_phase;

/** The phases of all LP steps, or of all T steps, of a run; owned by the run. */
typedef struct hd_phases hd_phases;

/** Number of phases, which is constant. In the order of the steps, a step with d pairs of fields
 * has 2 d^2 of them: each of its 2 d vectors has d phases, one for each pair. Between walls a T
 * field may have no partner; it then has no phase. */
int hd_phases_count(const hd_phases *phases);
/** Phase `index`, 0 .. hd_phases_count - 1. */
const hd_phase *hd_phases_phase(const hd_phases *phases, int index);

/** Returns the diffusion constant D of phase `index`: about omega t, its mean square deviation
 * after a time t is 2 D t [rad^2/time unit]. Writes the standard error to *error. Both are negative
 * while they are not known. D comes from blocks of time; it is too large while blocks are shorter
 * than the time after which the phase has forgotten its fluctuations. */
double hd_phases_diffusion(const hd_phases *phases, int index, double *error);

/** Writes the mean rate of the phases of a step [rad/time unit] to *omega, with its sign, so that
 * phases which turn in opposite senses cancel; and its standard error to *error, which is negative
 * while it is not known. Returns false, and writes nothing, if no phase of the step has been
 * tracked. */
HD_MUST_CHECK bool hd_phases_rate(const hd_phases *phases, int step, double *omega, double *error);

/** Phase velocity |omega| / k of LP steps: the mean over the steps, weighted with the errors of
 * their rates [sigma/time unit]. */
typedef struct hd_velocity {
    int phases; /**< number of phases of these steps that are tracked now; 0 if no velocity is known
                 */
    /** Smallest and largest wave number of these steps [1/sigma]; 0 if no velocity is known. */
    double k_min, k_max;
    /** The velocity, 0 while it is not known; its standard error, negative while it is not known:
     * v_sampling_error, multiplied by misfit if that is above 1, and in quadrature the part
     * hd_relation.box_error of v, that of LP, if steps follow a relation. */
    double v, v_error;
    /** By how much another run of the same box may differ, with the correlation of the steps taken
     * into account; negative while it is not known. */
    double v_sampling_error;
    /** sqrt(chi^2 / degrees of freedom) of the steps about their mean: far above 1 if steps differ
     * in velocity. Negative if there is only one step, or none. */
    double misfit;
} hd_velocity;
/** Computes the mean velocity of all steps whose rate and error are known. */
hd_velocity hd_phases_velocity(const hd_phases *phases);

HD_API_END
#endif
