/** Memory: how much a run needs, and how much there is. */
#ifndef HDLYAP_ROOM_H
#define HDLYAP_ROOM_H

#include "hdlyap/scene.h"

HD_API_BEGIN

/** Bytes that the core needs on each rank for a run of a checked scene, to some percent. Libraries,
 * memory of the caller and windows of covariant vectors, which covariant_memory limits, are not in
 * it. O(wave vectors). */
double hd_room_needed(const hd_scene_def *def, int threads, int ranks);

/** Available memory. */
typedef struct hd_room {
    double bytes;      /**< bytes that this process may still take */
    const char *limit; /**< what limits them: "machine", "cgroup" or "ulimit" */
    int ranks;         /**< ranks that carry the run, each with so many bytes; 0 means 1 */
} hd_room;

/** Available memory without swap on Linux; INFINITY elsewhere. */
hd_room hd_room_available(void);

/** HD_NO_MEMORY if a checked scene needs more than `room`. `message`, unless NULL, then says what
 * needs how much, how much there is, and what would fit. */
HD_MUST_CHECK hd_status hd_room_check(const hd_scene_def *def, hd_room room, char *message,
                                      size_t size);

HD_API_END
#endif
