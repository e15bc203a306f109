/** What the core asks of the disks. */
#ifndef HD_TRAJECTORY_H
#define HD_TRAJECTORY_H

#include "events/record.h"
#include "hdlyap/trajectory.h"

/** A prepared state: q[HD_DIM N] inside the box (x0 y0 x1 y1 ..), p[HD_DIM N];
 * nothing is rescaled.
 * HD_REFUSED for a box that hd_scene_check refuses, positions outside it, |p| above 1e6;
 * HD_OVERLAP for disks deeper than hd_trajectory_overlap_max. */
HD_MUST_CHECK hd_status hd_trajectory_create_from(hd_trajectory **out, const hd_scene_def *def,
                                                  const double *q, const double *p);
void hd_trajectory_box(const hd_trajectory *trajectory, double box[HD_DIM]);
uint64_t hd_trajectory_wall_events(const hd_trajectory *trajectory);
/** Of all disks together. */
void hd_trajectory_momentum(const hd_trajectory *trajectory, double sum[HD_DIM]);
/** The same about the middle of the box, about z; a circle conserves it. */
double hd_trajectory_angular_momentum(const hd_trajectory *trajectory);
/** Deeper than this [sigma] is a fault, HD_OVERLAP: 1e-9, or hd_trajectory_overlap_rounding where
 * that is more: in boxes longer than some 3e5 sigma, 4e-6 in the longest of 1e9. */
double hd_trajectory_overlap_max(const hd_trajectory *trajectory);
int hd_trajectory_disks(const hd_trajectory *trajectory); /**< N */

#endif
