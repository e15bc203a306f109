/** The events of a record of hard particles: checks that they are valid, and keeps them in a
 * checkpoint. */
#ifndef HD_EVENTS_H
#define HD_EVENTS_H

#include "base/archive.h"
#include "dynamics/hard/event.h"
#include "dynamics/record.h"
#include "dynamics/trajectory.h"

/** [hd_record_count] */
const hd_event *hd_events(const hd_record *record);

/** Returns NULL, or what is wrong with the record: a time outside it or earlier than the time of
 * the event before, a disk or a wall that does not exist, a normal of the wrong length, or disks
 * that do not approach. */
const char *hd_events_fault(const hd_record *record, const hd_scene_def *scene);

void hd_events_archive(hd_record *record, hd_archive *archive, const hd_scene_def *scene);
/** Bytes of this many events: in the record, which doubles when it is full, and as tangent maps. */
double hd_events_bytes(double events);

#endif
