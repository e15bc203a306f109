/** How long a run of a scene will take on this machine, and which errors it will reach, from a
 * short trial run. For the memory that it needs see hd_memory_needed. */
#ifndef HDLYAP_ESTIMATE_H
#define HDLYAP_ESTIMATE_H

#include "hdlyap/run.h"

HD_API_BEGIN

/** Returns the numbers of results that a run of a checked scene has. `run` is a run of this scene,
 * or of a smaller one with the same waves. */
hd_result_counts hd_result_counts_of(const hd_scene_def *def, const hd_run *run);

/** What a trial run says about the run of a scene. "Averaged time" is simulated time since the
 * averaging began [time units]. */
typedef struct hd_estimate {
    /** Observables of the scene that the trial leaves out (a set of HD_OBSERVE_*). The run takes
     * longer with them. */
    unsigned untried;
    int particles; /**< number of particles in the trial: that of the scene, or fewer if these would
                      take too long */
    double seconds;      /**< wall seconds that the averaging takes per simulated time unit */
    double extrapolated; /**< simulated time of the trial from which `seconds` and `interval` are
                            extrapolated, as its warm-up was cut short; 0: they were measured */
    /** Mean simulated time between two orthonormalisations [time units]; NaN without exponents. */
    double interval;
    double before;       /**< simulated time before the averaging begins [time units] */
    double errors_after; /**< averaged time until a report states standard errors of exponents;
                            those of steps are then below 1 %. 0 without exponents */
    /** Averaged time until the scene's target is reached, as errors of the trial predict; at least
     * errors_after. NaN if the trial gives no errors or there is no target; INFINITY if the target
     * is never reached. */
    double target_after;
    /** Averaged time until the standard errors of c_T and c_L (hd_dispersion.c) are about 1 %,
     * apart from the part that no averaging reduces. 0 without exponents. */
    double slopes_after;
    /** Numbers of results of the run. */
    hd_result_counts extent;
} hd_estimate;

/** Runs a checked scene for a second of wall time, after a warm-up in which intervals between
 * orthonormalisations reach their full length. A warm-up that takes longer than a second ends then,
 * with its present interval, and the rest is extrapolated. The trial has fewer particles in a box
 * of the same shape if the scene's would take too long; its wall times are then multiplied by the
 * cube of the ratio of N. Covariant vectors are not tried, because their windows are longer than
 * the trial; but the call returns HD_REFUSED if covariant_memory is too small for them. Other
 * failures are those of hd_run_create, with one line in message[size], and of hd_run_advance. */
HD_MUST_CHECK hd_status hd_estimate_run(hd_estimate *out, const hd_scene_def *def, char *message,
                                        size_t size);

/** Writes hd_estimate.errors_after of the scene to *after, without a trial. Returns HD_OK or
 * HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_estimate_errors(double *after, const hd_scene_def *def);

HD_API_END
#endif
