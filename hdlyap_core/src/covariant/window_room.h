/** Memory that a window of covariant vectors takes. */
#ifndef HD_WINDOW_ROOM_H
#define HD_WINDOW_ROOM_H

#include "covariant/history.h"
#include "hdlyap/scene.h"

/** What the history of a window keeps if intervals have this length [time units]: all of it, or as
 * many intervals as fit into covariant_memory, but at least two. */
hd_history_def hd_window_that_fits(const hd_scene_def *def, double interval, int threads);

/** Returns HD_REFUSED, with a line that says why and how long a window may be, if a window takes
 * more than covariant_memory with intervals of this length. */
HD_MUST_CHECK hd_status hd_window_check_memory(const hd_scene_def *def, double interval,
                                               char *message, size_t size);

#endif
