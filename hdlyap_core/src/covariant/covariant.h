/** How a run computes covariant vectors, window by window. */
#ifndef HD_COVARIANT_H
#define HD_COVARIANT_H

#include "base/archive.h"
#include "hdlyap/covariant.h"
#include "hdlyap/trajectory.h"
#include "tangent/ortho.h"

/** Makes it, without windows. spectrum: the averages of the run, by which spaces are counted if
 * maps are not symplectic; else not read. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_covariant_create(hd_covariant **out, const hd_scene_def *def,
                                            const hd_spectrum *spectrum, int threads);
void hd_covariant_free(hd_covariant *covariant);

/** Empties all averages; the first window does not begin before the time `now`. */
void hd_covariant_clear(hd_covariant *covariant, double now);

/** Begins a window at this time and forgets any window before. The frame is orthonormal now, and
 * about every `interval` time units from now on. Takes the memory for the window, at most
 * covariant_memory: a window that turns out to need more is left out, and the next one begins
 * there. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_covariant_begin(hd_covariant *covariant, double time, double interval);

/** Adds an interval of the record, from t_begin to t_end, after the frame was replayed through it
 * and orthonormalised. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_covariant_add(hd_covariant *covariant, const hd_ortho *ortho,
                                         const hd_frame *frame, const hd_record *record,
                                         double t_begin, double t_end);

/** Keeps the frame and the particles after the last interval, if hd_covariant_wants_state. */
HD_MUST_CHECK hd_status hd_covariant_state(hd_covariant *covariant, hd_columns frame,
                                           const hd_trajectory *trajectory);
bool hd_covariant_wants_state(const hd_covariant *covariant);
double
hd_covariant_due(const hd_covariant *covariant); /**< simulated time of the next such state */

/** True once a window and its transient are complete. Then hd_covariant_step goes back through
 * them, an interval at a time; until that has ended nothing may be added. */
bool hd_covariant_is_going_back(const hd_covariant *covariant);
HD_MUST_CHECK hd_status hd_covariant_step(hd_covariant *covariant);
/** Bytes that the window takes; 0 before the first window. */
double hd_covariant_bytes(const hd_covariant *covariant);

void hd_covariant_archive(hd_covariant *covariant, hd_archive *archive);

#endif
