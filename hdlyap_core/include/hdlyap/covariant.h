/** Covariant Lyapunov vectors over windows of a run [T16] (Ginelli et al., Phys. Rev. Lett. 99,
 * 130601 (2007)).
 *
 * A window begins where the one before it ended. The forward pass goes on beyond its end by the
 * transient; from there two random starts are carried backwards: where the window ends they should
 * have met, and how far they have is measured. Through the window itself the vectors of the first
 * start are covariant. One thread at a time, to read as well: widths are made
 * where they are kept. */
#ifndef HDLYAP_COVARIANT_H
#define HDLYAP_COVARIANT_H

#include <stdbool.h>

#include "hdlyap/modes.h"
#include "hdlyap/spectrum.h"
#include "hdlyap/splitting.h"

HD_API_BEGIN

typedef struct hd_covariant hd_covariant;

/** Whether what a window needs fits the scene's room, orthonormalised every `interval` time units:
 * HD_REFUSED with a line in `message`. */
HD_MUST_CHECK hd_status hd_covariant_check_room(const hd_scene_def *def, double interval,
                                                char *message, size_t size);

/** How far two starts were apart where windows ended, after the transient. */
typedef struct hd_covariant_mismatch {
    /** Last window: largest sine of single vectors; those of equal exponents never meet */
    double most;
    /** Any window: largest angle between the spaces of vanishing exponents [radians]; negative if
     * not carried */
    double centre;
    double stable; /**< the same of negative exponents */
} hd_covariant_mismatch;

/** What windows have shown so far. What is pointed to changes with the run. */
typedef struct hd_covariant_results {
    int vectors;  /**< n */
    long windows; /**< whole ones in the averages */
    long lost;    /**< because intervals had become too short for them to fit covariant_memory */
    double window_end; /**< simulated time, of the last one */
    /** Growth rates of the covariant vectors; their means are the exponents of the frame. Local:
     * between two looks. */
    const hd_spectrum *spectrum;
    hd_splitting_results splitting; /**< angles, order: from every look */
    hd_covariant_mismatch start_mismatch;
    /** Sine of each vector, [n], at the end of the last window. A lower bound of what the start
     * still matters, as both starts lean towards the frame. */
    const double *start_mismatch_each;
    /** Largest angle between the covariant centre and the null space [T9], as far as it is known
     * exactly, at the last look, and of all; negative if not carried. */
    double null, null_most;
    /** Weights [T11] of the dq half and of the dp half, each normalised by itself; running averages
     * of all looks. NULL of what has no positions in a box, as the next. */
    const hd_modes *half[2];
    /** Weights [T11] of the dq halves of the frame, the Gram-Schmidt vectors; of the same looks. */
    const hd_modes *of_frame;
    /** Localisation widths, [n], 1 / N .. 1, and mean |cos| of the angle between both halves. */
    const double *widths, *cosines;
} hd_covariant_results;
hd_covariant_results hd_covariant_read(const hd_covariant *covariant); /**< O(n) */

HD_API_END
#endif
