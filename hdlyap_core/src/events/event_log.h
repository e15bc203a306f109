/** An event log's room, and what it is not, whoever wrote it. */
#ifndef HD_EVENT_LOG_H
#define HD_EVENT_LOG_H

#include "hdlyap/trajectory.h"

/** Events that the first room is for. */
enum { HD_EVENTS_FIRST = 4096 };

/** Room for so many events in all, at least; it at least doubles. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_event_log_reserve(hd_event_log *log, size_t count);

/** NULL, or what is wrong: a time outside the interval or before the one before it, a disk or a
 * wall that there is not, a normal of another length than it should have, disks that part. */
const char *hd_event_log_fault(const hd_event_log *log, const hd_scene_def *scene);

#endif
