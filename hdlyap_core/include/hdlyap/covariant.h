/** Covariant Lyapunov vectors over windows of a run [T16] (Ginelli et al., Phys. Rev. Lett. 99,
 * 130601 (2007)).
 *
 * A window begins where the window before it ended. The forward pass goes on beyond its end by the
 * transient. There two random starts begin, and are carried back. How far they still differ at the
 * end of the window is measured; within the window the vectors of the first start are the covariant
 * ones. All functions, those that read too, use one workspace: one thread at a time. */
#ifndef HDLYAP_COVARIANT_H
#define HDLYAP_COVARIANT_H

#include <stdbool.h>

#include "hdlyap/modes.h"
#include "hdlyap/spectrum.h"
#include "hdlyap/splitting.h"

HD_API_BEGIN

typedef struct hd_covariant hd_covariant;

/** HD_OK if a window fits into the scene's covariant_memory with an orthonormalisation every
 * `interval` time units; otherwise HD_REFUSED with a line in `message`. */
HD_MUST_CHECK hd_status hd_covariant_check_room(const hd_scene_def *def, double interval,
                                                char *message, size_t size);

/** How far the two random starts still differ at the ends of windows, after the transient. */
typedef struct hd_covariant_mismatch {
    /** Last window: largest sine of the angle between vectors of the same index. Vectors of equal
     * exponents never agree. */
    double most;
    /** All windows: largest angle between the two spaces of vanishing exponents [rad]; negative if
     * these vectors are not computed. */
    double centre;
    double stable; /**< all windows: largest angle between the spaces of negative exponents [rad] */
} hd_covariant_mismatch;

/** Results of all windows so far. What pointers point to changes when the run goes on. */
typedef struct hd_covariant_results {
    int vectors;       /**< n */
    long windows;      /**< complete windows in the averages */
    long lost;         /**< windows left out because they did not fit into covariant_memory */
    double window_end; /**< simulated time at which the last window ends */
    /** Growth rates of the covariant vectors, whose means are the exponents of the frame; local
     * ones are between two samples. */
    const hd_spectrum *spectrum;
    hd_splitting_results splitting; /**< angles, from all samples */
    /** Order of the vectors' growth over the time between two samples, over twice that time, and so
     * on within a window. */
    int times;
    hd_order_over order[HD_TIMES_MAX];
    hd_covariant_mismatch start_mismatch;
    /** Sine of the angle between the two starts, of each vector, [n], at the end of the last
     * window: a lower bound of the error, as both starts lean towards the frame. */
    const double *start_mismatch_each;
    /** Largest angle between the space of vanishing exponents and the exactly known null space
     * [T9]: in the last sample, and in all; negative if these vectors are not computed [rad]. */
    double null, null_most;
    /** Mean weights [T11] of the dq half and of the dp half, each normalised. NULL if particles
     * have no positions in a box. */
    const hd_modes *half[2];
    /** Mean weights [T11] of the dq halves of the Gram-Schmidt vectors in the same samples; NULL as
     * half. */
    const hd_modes *of_frame;
    /** Localisation widths, [n], 1 / N .. 1; and mean |cos| of the angle between both halves, [n].
     */
    const double *widths, *cosines;
} hd_covariant_results;
hd_covariant_results hd_covariant_read(const hd_covariant *covariant); /**< O(n) */

HD_API_END
#endif
