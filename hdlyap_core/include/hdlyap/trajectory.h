/** The disks: exact event-driven motion, and the record of its events that everything else is built
 * on. */
#ifndef HDLYAP_TRAJECTORY_H
#define HDLYAP_TRAJECTORY_H

#include <stddef.h>
#include <stdint.h>

#include "hdlyap/record.h"
#include "hdlyap/scene.h"

HD_API_BEGIN

typedef struct hd_trajectory hd_trajectory;

/** Lattice start, seeded momenta (zero total along periodic directions, kinetic energy N), time 0.
 * Fails with HD_REFUSED, of what hd_scene_check says why, and HD_NO_MEMORY. Cost O(N log N). */
HD_MUST_CHECK hd_status hd_trajectory_create(hd_trajectory **out, const hd_scene_def *def);

/** A prepared state: q[HD_DIM N] inside the box (x0 y0 x1 y1 ..), p[HD_DIM N];
 * nothing is rescaled.
 * HD_REFUSED for a box that hd_scene_check refuses, positions outside it, |p| above 1e6;
 * HD_OVERLAP for disks deeper than hd_trajectory_overlap_max. */
HD_MUST_CHECK hd_status hd_trajectory_create_from(hd_trajectory **out, const hd_scene_def *def,
                                                  const double *q, const double *p);
void hd_trajectory_free(hd_trajectory *trajectory);

/** Moves the disks to simulated time t_end (>= now) and adds the events on the way to the record,
 * which ends at the present time (hd_record_clear begins it anew) and may be NULL. The events
 * do not depend on where the intervals are cut. Fails with HD_OVERLAP, HD_NOT_FINITE, HD_NO_MEMORY.
 * Cost O(1) per event, and O(N) in the time of tens of collisions of a disk of energy 1, unless all
 * disks are at rest. */
HD_MUST_CHECK hd_status hd_trajectory_extend(hd_trajectory *trajectory, hd_record *record,
                                             double t_end);

double hd_trajectory_time(const hd_trajectory *trajectory); /**< simulated time */
int hd_trajectory_disks(const hd_trajectory *trajectory);   /**< N */
void hd_trajectory_box(const hd_trajectory *trajectory, double box[HD_DIM]);
uint64_t hd_trajectory_collisions(const hd_trajectory *trajectory); /**< pair events so far */
uint64_t hd_trajectory_wall_events(const hd_trajectory *trajectory);
/** Virial of the pair events so far, by direction: sum of |p.n| n_d^2 [sigma momentum] [T19]. */
void hd_trajectory_virial(const hd_trajectory *trajectory, double virial[HD_DIM]);
/** Estimate of the pair events per time unit, by Enskog's theory [T2]. */
double hd_trajectory_collision_rate(const hd_trajectory *trajectory);

/** State now: q[HD_DIM N] inside the box, p[HD_DIM N]. Either may be NULL. Cost O(N). */
void hd_trajectory_state(const hd_trajectory *trajectory, double *q, double *p);

double hd_trajectory_kinetic_energy(const hd_trajectory *trajectory); /**< sum p^2 / 2, = N */
/** Of all disks together. */
void hd_trajectory_momentum(const hd_trajectory *trajectory, double sum[HD_DIM]);
/** The same about the middle of the box, about z; a circle conserves it. */
double hd_trajectory_angular_momentum(const hd_trajectory *trajectory);
/** More than rounding makes of its relative error: each event so far rounds the energy of its disks
 * by some eps, and the roundings add up as a random walk. Seen: 0.01 of this. */
double hd_trajectory_energy_rounding(const hd_trajectory *trajectory);
/** More than rounding makes of an overlap: of some roundings in positions, of the order of the box,
 * and in times, as long as they are counted from one moment. */
double hd_trajectory_overlap_rounding(const hd_trajectory *trajectory);
/** Deeper than this [sigma] is a fault, HD_OVERLAP: 1e-9, or hd_trajectory_overlap_rounding where
 * that is more: in boxes longer than some 3e5 sigma, 4e-6 in the longest of 1e9. */
double hd_trajectory_overlap_max(const hd_trajectory *trajectory);
/** Deepest overlap of any pair now: max(0, 1 - distance) over all pairs and images. Cost O(N). */
double hd_trajectory_overlap(const hd_trajectory *trajectory);

HD_API_END
#endif
