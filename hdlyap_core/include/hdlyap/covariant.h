/** Covariant Lyapunov vectors over windows of a run [T16] (Ginelli et al., Phys. Rev. Lett. 99,
 * 130601 (2007)).
 *
 * A window begins where the one before it ended. The forward pass goes on beyond its end by the
 * transient; from there two random starts are carried backwards: where the window ends they should
 * have met, and how far they have is measured. Through the window itself the vectors of the first
 * start are covariant. */
#ifndef HDLYAP_COVARIANT_H
#define HDLYAP_COVARIANT_H

#include <stdbool.h>

#include "hdlyap/modes.h"
#include "hdlyap/ortho.h"
#include "hdlyap/spectrum.h"
#include "hdlyap/splitting.h"

HD_API_BEGIN

typedef struct hd_covariant hd_covariant;

/** Whether what a window needs fits the scene's room, orthonormalised every `interval` time units:
 * HD_REFUSED with a line in `message`. */
HD_MUST_CHECK hd_status hd_covariant_check_room(const hd_scene_def *def, double interval,
                                                char *message, size_t size);

HD_MUST_CHECK hd_status hd_covariant_create(hd_covariant **out, const hd_scene_def *def,
                                            int threads);
void hd_covariant_free(hd_covariant *covariant);

/** Empties all averages. */
void hd_covariant_clear(hd_covariant *covariant);

/** Begins with a window at this time, whatever was before; the frame is orthonormal, and will be
 * every `interval` time units or so. Takes the room for it: HD_NO_ROOM, HD_NO_MEMORY, HD_FILE_FAULT
 * (errno). */
HD_MUST_CHECK hd_status hd_covariant_begin(hd_covariant *covariant, hd_columns frame, double time,
                                           double interval);

/** After an orthonormalisation: the interval from t_begin to t_end of the record, through which the
 * frame was replayed; with its vectors, of all ranks, if they are wanted. HD_NO_MEMORY,
 * HD_FILE_FAULT. */
HD_MUST_CHECK hd_status hd_covariant_add(hd_covariant *covariant, const hd_ortho *ortho,
                                         const hd_frame *frame, hd_columns vectors,
                                         const hd_record *record, double t_begin, double t_end);
bool hd_covariant_wants_vectors(const hd_covariant *covariant);

/** Keeps frame and disks after the last of them, if they are due (hd_covariant_wants_state). */
HD_MUST_CHECK hd_status hd_covariant_state(hd_covariant *covariant, hd_columns frame,
                                           const hd_trajectory *trajectory);
bool hd_covariant_wants_state(const hd_covariant *covariant);
double
hd_covariant_due(const hd_covariant *covariant); /**< simulated time of the next such state */

/** True once a window and its transient are complete: until hd_covariant_step has gone back through
 * them, an interval at a time, nothing is to be added. */
bool hd_covariant_is_going_back(const hd_covariant *covariant);
HD_MUST_CHECK hd_status hd_covariant_step(hd_covariant *covariant);

/* ---- results ------------------------------------------------------------------------------- */

int hd_covariant_vectors(const hd_covariant *covariant);  /**< n */
long hd_covariant_windows(const hd_covariant *covariant); /**< whole ones in the averages */
/** Windows that were lost because intervals had become too short for them to fit covariant_memory
 */
long hd_covariant_lost(const hd_covariant *covariant);
/** What may wait for the way back; 0 before the first window */
double hd_covariant_bytes(const hd_covariant *covariant);
/** Simulated time, of the last one */
double hd_covariant_window_end(const hd_covariant *covariant);

/** Growth rates of the covariant vectors; their means are the exponents of the frame. Local:
 * between two looks. */
const hd_spectrum *hd_covariant_spectrum(const hd_covariant *covariant);
/** Angles, order: from every look. */
const hd_splitting *hd_covariant_splitting(const hd_covariant *covariant);

/** How far two starts were apart where windows ended, after the transient. */
typedef struct hd_covariant_mismatch {
    /** Last window: largest sine of single vectors; those of equal exponents never meet */
    double most;
    /** Any window: largest angle between the spaces of vanishing exponents [radians]; negative if
     * not carried */
    double centre;
    double stable; /**< the same of negative exponents */
} hd_covariant_mismatch;
hd_covariant_mismatch hd_covariant_start_mismatch(const hd_covariant *covariant);
/** Sine of each vector, [n], at the end of the last window. A lower bound of what the start still
 * matters, as both starts lean towards the frame. */
const double *hd_covariant_start_mismatch_each(const hd_covariant *covariant);

/** Largest angle between the covariant centre and the exact null space [T9] at the last look, and
 * of all; negative if not carried. */
double hd_covariant_null(const hd_covariant *covariant);
double hd_covariant_null_most(const hd_covariant *covariant);

/** Weights [T11] of the dq half (0) and of the dp half (1), each normalised by itself; running
 * averages of all looks. */
const hd_modes *hd_covariant_half(const hd_covariant *covariant, int half);
/** Weights [T11] of the dq halves of the frame, the Gram-Schmidt vectors; running averages of the
 * same looks. */
const hd_modes *hd_covariant_of_frame(const hd_covariant *covariant);
/** Localisation widths, [n], 1 / N .. 1, and mean |cos| of the angle between both halves. */
const double *hd_covariant_widths(const hd_covariant *covariant);
const double *hd_covariant_cosines(const hd_covariant *covariant);

HD_API_END
#endif
