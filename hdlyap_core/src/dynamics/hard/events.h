/** The events of a record of hard bodies: what they are not, whoever wrote them, and their file. */
#ifndef HD_EVENTS_H
#define HD_EVENTS_H

#include "base/archive.h"
#include "dynamics/hard/event.h"
#include "dynamics/record.h"
#include "dynamics/trajectory.h"

/** [hd_record_count] */
const hd_event *hd_events(const hd_record *record);

/** NULL, or what is wrong: a time outside the record or before the one before it, a disk or a wall
 * that there is not, a normal of another length than it should have, disks that part. */
const char *hd_events_fault(const hd_record *record, const hd_scene_def *scene);

void hd_events_archive(hd_record *record, hd_archive *archive, const hd_scene_def *scene);
/** Bytes of so many: in the record, which doubles when it is full, and as tangent maps. */
double hd_events_bytes(double events);

#endif
