/** The disks: exact event-driven motion, and the record of its events that everything else is built
 * on. Several threads may read one at once while none moves it, and each may move one of its own.
 */
#ifndef HDLYAP_TRAJECTORY_H
#define HDLYAP_TRAJECTORY_H

#include <stddef.h>
#include <stdint.h>

#include "hdlyap/dynamics.h"
#include "hdlyap/record.h"

HD_API_BEGIN

typedef struct hd_trajectory hd_trajectory;

/** Lattice start, seeded momenta (zero total along periodic directions, kinetic energy N), time 0.
 * Fails with HD_REFUSED, of what hd_scene_check says why, and HD_NO_MEMORY. Cost O(N log N). */
HD_MUST_CHECK hd_status hd_trajectory_create(hd_trajectory **out, const hd_scene_def *def);
void hd_trajectory_free(hd_trajectory *trajectory);

/** Moves the disks to simulated time t_end (>= now) and adds the events on the way to the record,
 * which ends at the present time; `record` may be NULL. The events
 * do not depend on where the intervals are cut. Fails with HD_OVERLAP, HD_NOT_FINITE, HD_NO_MEMORY.
 * Cost O(1) per event, and O(N) in the time of tens of collisions of a disk of energy 1, unless all
 * disks are at rest. */
HD_MUST_CHECK hd_status hd_trajectory_extend(hd_trajectory *trajectory, hd_record *record,
                                             double t_end);

double hd_trajectory_time(const hd_trajectory *trajectory); /**< simulated time */

/** What has happened so far. */
hd_told hd_trajectory_told(const hd_trajectory *trajectory);

/** State now: positions q inside the box, x0 y0 .. x1 y1 .., and momenta p. Either may be NULL.
 * Cost O(N). */
void hd_trajectory_state(const hd_trajectory *trajectory, double *q, double *p);

double hd_trajectory_kinetic_energy(const hd_trajectory *trajectory); /**< sum p^2 / 2, = N */

/** How exact the present state is. Cost O(N). */
hd_examined hd_trajectory_examined(const hd_trajectory *trajectory);

HD_API_END
#endif
