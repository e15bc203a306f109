/** Memory: what a run will need, and what there is. */
#ifndef HDLYAP_ROOM_H
#define HDLYAP_ROOM_H

#include "hdlyap/scene.h"

HD_API_BEGIN

/** Bytes that the core asks for on each of some ranks (1: a single one) in a run of a checked
 * scene, within some percent, with so many threads. Not in it: libraries, what the caller makes of
 * the run, and windows of covariant vectors, which have a limit of their own (covariant_memory).
 * O(wave vectors). */
double hd_room_needed(const hd_scene_def *def, int threads, int ranks);

/** Why there is not more. */
typedef struct hd_room {
    double bytes;      /**< that this process may still take */
    const char *limit; /**< "machine", "cgroup" or "ulimit" */
    int ranks;         /**< that carry the run, each with so much; 0 is 1 */
} hd_room;

/** Linux; INFINITY elsewhere. Swap is no room. */
hd_room hd_room_available(void);

/** HD_NO_MEMORY if a checked scene needs more than there is, with a line in `message` unless that
 * is NULL: what needs how much, how much there is, and what would fit. */
HD_MUST_CHECK hd_status hd_room_check(const hd_scene_def *def, hd_room room, char *message,
                                      size_t size);

HD_API_END
#endif
