/** What a checkpoint holds of disks, and bytes that they take. */
#ifndef HD_EVENTS_ARCHIVED_H
#define HD_EVENTS_ARCHIVED_H

#include "base/archive.h"
#include "events/trajectory.h"

void hd_trajectory_archive(hd_trajectory *trajectory, hd_archive *archive);
/** Of positions and momenta to the last bit. */
uint32_t hd_trajectory_fingerprint(const hd_trajectory *trajectory);
double hd_trajectory_bytes(double disks);

#endif
