/** Memory: how much a run needs, and how much there is. */
#ifndef HDLYAP_MEMORY_LIMIT_H
#define HDLYAP_MEMORY_LIMIT_H

#include "hdlyap/scene.h"

HD_API_BEGIN

/** Bytes of memory that the core needs on each of `ranks` ranks for a run of a checked scene, to
 * some percent. Not in it are libraries, memory of the caller, and windows of covariant vectors,
 * which covariant_memory limits. O(number of waves). */
double hd_memory_needed(const hd_scene_def *def, int threads, int ranks);

/** Memory that is available. */
typedef struct hd_memory_limit {
    double bytes;      /**< bytes that this process may still take */
    const char *limit; /**< what limits them: "machine", "cgroup" or "ulimit" */
    int ranks; /**< number of ranks that carry the run, each with so many bytes; 0 means 1 */
} hd_memory_limit;

/** Returns the memory that this process may still take, without swap, with ranks = 1. Systems other
 * than Linux do not tell: hd_memory_limit.bytes is then INFINITY. */
hd_memory_limit hd_memory_available(void);

/** Returns HD_OK if a checked scene needs at most `room`, otherwise HD_NO_MEMORY. Then
 * message[size], unless NULL, gets a line with what is needed, what there is, and a smaller scene
 * that would fit. */
HD_MUST_CHECK hd_status hd_memory_check(const hd_scene_def *def, hd_memory_limit room,
                                        char *message, size_t size);

/** Returns HD_OK if a window of covariant vectors fits into the covariant_memory of a checked scene
 * with as few orthonormalisations as its interval, its report_interval and the observables that it
 * asks for leave; otherwise HD_REFUSED, with one line in message[size] unless it is NULL.
 * hd_run_create makes this check. */
HD_MUST_CHECK hd_status hd_memory_check_windows(const hd_scene_def *def, char *message,
                                                size_t size);

HD_API_END
#endif
