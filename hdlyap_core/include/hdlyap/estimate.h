/** How long a run of a scene will take on this machine, and how much it will give, from a short
 * trial. For its memory see hd_room_needed. */
#ifndef HDLYAP_ESTIMATE_H
#define HDLYAP_ESTIMATE_H

#include "hdlyap/run.h"

HD_API_BEGIN

/** Numbers of results of a checked scene. `run` is a run of it, or of a smaller scene with the same
 * waves. */
hd_extent hd_extent_of(const hd_scene_def *def, const hd_run *run);

typedef struct hd_estimate {
    unsigned untried; /**< HD_OBSERVE_* of the scene that the trial leaves out; the run takes longer
                         with them */
    int particles; /**< particles of the trial: fewer than the scene's if that would take too long */
    double seconds;      /**< wall seconds per simulated time unit of the averaging */
    double interval;     /**< mean time between orthonormalisations; NaN without exponents */
    double before;       /**< simulated time before the averaging [time units] */
    double errors_after; /**< averaged time until standard errors are known; those of steps are
                            below 1 % then. 0 without exponents */
    double target_after; /**< averaged time until the target is reached, at least errors_after, from
                              the errors in the trial; NaN if these are not known, or there is no
                              target; INFINITY if it is never reached; 0 without exponents */
    /** Averaged time until the sampling errors of c_T and c_L are about 1 %. */
    double slopes_after;
    hd_extent extent;
} hd_estimate;

/** Runs a checked scene for a second or two, after its intervals have reached their full length:
 * the scene itself, or one with fewer particles in a box of the same shape, whose times are then
 * scaled by the cube of N. It does not try covariant vectors, whose windows are longer, but refuses
 * what their memory refuses. fields_every is that of hd_run_fields_every. It fails as
 * hd_run_create, with a line in `message`, and as hd_run_advance. */
HD_MUST_CHECK hd_status hd_estimate_run(hd_estimate *out, const hd_scene_def *def,
                                        double fields_every, char *message, size_t size);

/** Only errors_after of the whole scene, without a trial. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_estimate_errors(double *after, const hd_scene_def *def);

HD_API_END
#endif
