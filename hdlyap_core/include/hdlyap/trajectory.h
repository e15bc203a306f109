/** The trajectory: the particles of a scene, which move and write a record. Several threads may
 * read one trajectory at once while no thread moves it; several trajectories may be moved at once.
 */
#ifndef HDLYAP_TRAJECTORY_H
#define HDLYAP_TRAJECTORY_H

#include <stddef.h>
#include <stdint.h>

#include "hdlyap/dynamics.h"
#include "hdlyap/record.h"

HD_API_BEGIN

/** A trajectory. That of a run belongs to the run; hd_trajectory_create makes one alone. */
typedef struct hd_trajectory hd_trajectory;

/** Makes a trajectory of the scene *def, which the caller frees with hd_trajectory_free. Its
 * particles are at time 0: positions on a lattice (those of a mixture have left it), random momenta
 * from the seed, with total momentum 0 along periodic directions and the energy of the scene.
 * Returns HD_OK; HD_REFUSED for a scene that hd_scene_check refuses, or of which no start is found;
 * HD_NO_MEMORY; or another status that hd_dynamics.create returns, HD_NOT_FINITE if its start is no
 * numbers. O(N log N). */
HD_MUST_CHECK hd_status hd_trajectory_create(hd_trajectory **out, const hd_scene_def *def);
/** Frees a trajectory, unless the pointer is NULL. */
void hd_trajectory_free(hd_trajectory *trajectory);

/** Moves the particles to the simulated time t_end, not before the present one. Unless `record` is
 * NULL, it adds what happens to the record, which then ends at the present time. What happens does
 * not depend on how the time is cut into calls. Returns HD_OK, HD_OVERLAP, HD_NOT_FINITE,
 * HD_ENERGY_LOST, HD_NO_MEMORY, HD_DYNAMICS_FAULT (see hd_trajectory_fault), or another status that
 * hd_dynamics.advance returns. For hard particles it costs O(1) for each collision, and O(N)
 * every some tens of collisions of a particle. */
HD_MUST_CHECK hd_status hd_trajectory_extend(hd_trajectory *trajectory, hd_record *record,
                                             double t_end);

/** One line that says what the row's functions did wrong, if hd_trajectory_extend has returned
 * HD_DYNAMICS_FAULT; otherwise "". */
const char *hd_trajectory_fault(const hd_trajectory *trajectory);

/** Present simulated time [time units]. */
double hd_trajectory_time(const hd_trajectory *trajectory);

/** What has added up from time 0 to now. */
hd_totals hd_trajectory_totals(const hd_trajectory *trajectory);

/** Integral over time of the divergence of the flow, from time 0 to now (hd_dynamics.divergence);
 * NaN if the row does not tell it. */
double hd_trajectory_divergence(const hd_trajectory *trajectory);

/** Writes the present positions, inside the box, to q, and the momenta to p, both
 * [particle][coordinates]; momenta are weighted if masses differ (hd_scene_root_mass). Either may
 * be NULL. O(N). */
void hd_trajectory_state(const hd_trajectory *trajectory, double *q, double *p);

/** What is conserved, as it is now. O(N). */
hd_invariants hd_trajectory_examined(const hd_trajectory *trajectory);

/** What time steps have done to the energy. */
typedef struct hd_energy {
    double error; /**< relative error of the energy now; NaN for rows without `examine`, and for
                     particles that collide unless their row has `step` or `energy_asked` */
    double most;  /**< largest |error| since time 0, looked at after each hd_trajectory_extend; NaN
                     as `error` */
    double asked; /**< most that the scene asks for, hd_dynamics.energy_asked; NaN if it is left out
                   */
} hd_energy;

/** Reads what time steps have done to the energy. */
hd_energy hd_trajectory_energy(const hd_trajectory *trajectory);

HD_API_END
#endif
