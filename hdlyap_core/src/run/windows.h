/** A run's covariant vectors: what the forward pass leaves to them, and the way back in between.
 * Nothing if nobody asks. */
#ifndef HD_WINDOWS_H
#define HD_WINDOWS_H

#include "run/run_state.h"

/** HD_REFUSED with a line in message where no interval that can be expected makes the windows fit.
 */
HD_MUST_CHECK hd_status hd_windows_create(hd_run *run, char *message, size_t size);

/** True while covariant vectors are wanted of what is carried. */
bool hd_windows_is_watched(const hd_run *run);

/** The averages begin anew with the next interval. */
void hd_windows_clear(hd_run *run);
/** Nothing is known of the time before the next interval. */
void hd_windows_interrupt(hd_run *run);

/** An orthonormalisation of the averaging, and the part of the log before it. Before the first of
 * an interval: the frame is still that of its start. */
HD_MUST_CHECK hd_status hd_windows_start(hd_run *run);
HD_MUST_CHECK hd_status hd_windows_add(hd_run *run, double t_begin, double t_end);
/** The whole interval is done. */
HD_MUST_CHECK hd_status hd_windows_end(hd_run *run);

/** True while there is a way back to go. */
bool hd_windows_is_going(const hd_run *run);
/** Goes on with it for a fraction of a second, or to its end. */
HD_MUST_CHECK hd_status hd_windows_go(hd_run *run, bool to_its_end);

#endif
