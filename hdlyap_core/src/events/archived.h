/** What a checkpoint holds of disks and events. */
#ifndef HD_EVENTS_ARCHIVED_H
#define HD_EVENTS_ARCHIVED_H

#include "base/archive.h"
#include "hdlyap/gas.h"

void hd_trajectory_archive(hd_trajectory *trajectory, hd_archive *archive);
/** now: simulated time. */
void hd_gas_archive(hd_gas *gas, hd_archive *archive, double now, uint64_t collisions);
void hd_event_log_archive(hd_event_log *log, hd_archive *archive, int disks);

#endif
