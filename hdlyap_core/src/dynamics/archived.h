/** The particles in a checkpoint. */
#ifndef HD_DYNAMICS_ARCHIVED_H
#define HD_DYNAMICS_ARCHIVED_H

#include "base/archive.h"
#include "dynamics/trajectory.h"

void hd_trajectory_archive(hd_trajectory *trajectory, hd_archive *archive);
/** A checksum of positions and momenta to the last bit. */
uint32_t hd_trajectory_fingerprint(const hd_trajectory *trajectory);

#endif
