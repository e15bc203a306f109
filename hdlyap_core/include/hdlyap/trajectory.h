/** The trajectory: the particles, which move and write a record. Several threads may read one
 * trajectory at once while none moves it; each may move one of its own. */
#ifndef HDLYAP_TRAJECTORY_H
#define HDLYAP_TRAJECTORY_H

#include <stddef.h>
#include <stdint.h>

#include "hdlyap/dynamics.h"
#include "hdlyap/record.h"

HD_API_BEGIN

typedef struct hd_trajectory hd_trajectory;

/** Places the particles of a scene at time 0: positions on a lattice and random momenta from the
 * seed, with total momentum 0 along periodic directions and the scene's energy. HD_REFUSED if
 * hd_scene_check refuses the scene; HD_NO_MEMORY. O(N log N). */
HD_MUST_CHECK hd_status hd_trajectory_create(hd_trajectory **out, const hd_scene_def *def);
void hd_trajectory_free(hd_trajectory *trajectory);

/** Moves the particles to simulated time t_end, not before the present one, and adds what happens
 * to the record, which ends at the present time; `record` may be NULL. The record does not depend
 * on how the time is cut into calls. HD_OVERLAP, HD_NOT_FINITE, HD_ENERGY_LOST, HD_NO_MEMORY. Costs
 * O(1) per event of hard particles, and O(N) every some tens of collisions of a particle. */
HD_MUST_CHECK hd_status hd_trajectory_extend(hd_trajectory *trajectory, hd_record *record,
                                             double t_end);

double hd_trajectory_time(const hd_trajectory *trajectory); /**< simulated time [time units] */

/** Numbers of collisions and the virial so far. */
hd_told hd_trajectory_told(const hd_trajectory *trajectory);

/** Writes positions q inside the box and momenta p, both [particle][coordinates]. Either may be
 * NULL. O(N). */
void hd_trajectory_state(const hd_trajectory *trajectory, double *q, double *p);

/** Sum of p^2 / 2 over the particles: always N for hard ones. */
double hd_trajectory_kinetic_energy(const hd_trajectory *trajectory);

/** How accurate the present state is. O(N). */
hd_examined hd_trajectory_examined(const hd_trajectory *trajectory);

HD_API_END
#endif
