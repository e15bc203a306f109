/** How windows of covariant vectors are taken. */
#ifndef HD_COVARIANT_H
#define HD_COVARIANT_H

#include "hdlyap/covariant.h"
#include "hdlyap/trajectory.h"
#include "tangent/ortho.h"

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
/** What may wait for the way back; 0 before the first window */
double hd_covariant_bytes(const hd_covariant *covariant);

#endif
