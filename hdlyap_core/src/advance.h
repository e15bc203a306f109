/** How far the disks of a run go at a time. */
#ifndef HD_ADVANCE_H
#define HD_ADVANCE_H

#include "run_state.h"

/** For the first step, when hardly anything is known of the rate of events. */
void hd_advance_first(hd_run *run, double collisions_per_disk);

/** By less, simulated time would not move. */
double hd_advance_shortest(const hd_run *run);
/** As far as the rate of events is known. */
double hd_advance_longest(const hd_run *run);

/** Plans the step from now to at most `stop`. */
void hd_advance_plan(hd_run *run, double stop);

/** Moves the disks on to the end of the planned step, or as far as a watcher lets it; the log may
 * be NULL. Fails as hd_trajectory_extend. */
HD_MUST_CHECK hd_status hd_advance(hd_run *run, hd_event_log *log);

#endif
