/** Functions on the particles that only the core calls. */
#ifndef HD_TRAJECTORY_H
#define HD_TRAJECTORY_H

#include "dynamics/record.h"
#include "hdlyap/trajectory.h"

/** Starts from a given state: positions q inside the box (x0 y0 .. x1 y1 ..) and momenta p; nothing
 * is rescaled. Fails with HD_REFUSED for a box that hd_scene_check refuses, positions outside it,
 * or |p| above 1e6; with HD_OVERLAP if particles overlap deeper than hd_examined.overlap_max. */
HD_MUST_CHECK hd_status hd_trajectory_create_from(hd_trajectory **out, const hd_scene_def *def,
                                                  const double *q, const double *p);
/** Positions in the box and momenta along its directions, without other coordinates, as angles; q
 * and p have room for hd_trajectory_state. */
void hd_trajectory_places(const hd_trajectory *trajectory, double *q, double *p);
/* See hd_told. */
uint64_t hd_trajectory_collisions(const hd_trajectory *trajectory);
uint64_t hd_trajectory_wall_events(const hd_trajectory *trajectory);
void hd_trajectory_virial(const hd_trajectory *trajectory, double *virial);
/** See hd_summed; all 0 if the row has no `sum`. */
hd_summed hd_trajectory_summed(const hd_trajectory *trajectory);
double hd_trajectory_collision_rate(const hd_trajectory *trajectory);

int hd_trajectory_particles(const hd_trajectory *trajectory); /**< N */

#endif
