/** Memory that a window of covariant vectors takes. */
#ifndef HD_WINDOW_ROOM_H
#define HD_WINDOW_ROOM_H

#include "covariant/history.h"
#include "hdlyap/scene.h"

/** What the history of a window keeps if intervals have this length [time units] and the record has
 * `rate` entries per time unit. */
hd_history_def hd_window_history(const hd_scene_def *def, double interval, double rate,
                                 int threads);

/** What of this fits into covariant_memory: all of it, or fewer intervals and events, but two. */
hd_history_def hd_window_that_fits(const hd_scene_def *def, const hd_history_def *wanted);

/** Returns HD_REFUSED, with a line that says why, if a window takes more than covariant_memory with
 * intervals of this length. */
HD_MUST_CHECK hd_status hd_window_check_room(const hd_scene_def *def, double interval,
                                             char *message, size_t size);

#endif
