/** What a run of a scene will take on this machine, and how much it will tell: from a short trial
 * of it. Its memory is hd_room_needed's. */
#ifndef HDLYAP_ESTIMATE_H
#define HDLYAP_ESTIMATE_H

#include "hdlyap/run.h"

HD_API_BEGIN

/** Of a checked scene, whose run it is; or of which it is a smaller one, with the same waves. */
hd_extent hd_extent_of(const hd_scene_def *def, const hd_run *run);

typedef struct hd_estimate {
    unsigned untried; /**< HD_OBSERVE_* of the scene that the trial leaves out: they take longer */
    int disks;        /**< of the trial: fewer than the scene's where that would take too long */
    double seconds;   /**< wall seconds per time unit of the averaging */
    double interval;  /**< mean time between orthonormalisations; NaN without exponents */
    double before;    /**< time units before the averaging */
    double errors_after; /**< averaged time until errors are first stated; those of exponents of
                              steps are below 1 % then. 0 without exponents, as the next */
    double target_after; /**< averaged time until the target is reached, errors_after or more, as
                            the errors of the trial say; NaN if they are not known by its end, or
                              there is no target; INFINITY if it never is */
    double slopes_after; /**< averaged time until c_T and c_L are known to about 1 % of sampling */
    hd_extent extent;
} hd_estimate;

/** Tries a checked scene for a second or two, once it is as fast as it becomes: the scene itself,
 * or one of fewer disks in a box of the same shape, whose time is enlarged by the cube of N.
 * Covariant vectors are not tried: a window of them is longer; what their room refuses is.
 * fields_every as of hd_run_fields_every. Fails as hd_run_create and hd_run_advance, HD_REFUSED
 * with its line in `message`. */
HD_MUST_CHECK hd_status hd_estimate_run(hd_estimate *out, const hd_scene_def *def,
                                        double fields_every, char *message, size_t size);

/** errors_after alone, without a trial, of all disks. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_estimate_errors(double *after, const hd_scene_def *def);

HD_API_END
#endif
