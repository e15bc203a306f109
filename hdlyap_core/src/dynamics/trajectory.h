/** Functions on the particles that only the core calls. */
#ifndef HD_TRAJECTORY_H
#define HD_TRAJECTORY_H

#include "base/archive.h"
#include "dynamics/record.h"
#include "hdlyap/trajectory.h"

/** Makes a trajectory of the scene *def from a state that its row has made, which then belongs to
 * the trajectory; if that fails, with HD_NO_MEMORY, the state is freed. */
HD_MUST_CHECK hd_status hd_trajectory_create_with(hd_trajectory **out, const hd_scene_def *def,
                                                  void *state);
/** Positions in the box and momenta along its directions, without other coordinates, as angles; q
 * and p have room for hd_trajectory_state. */
void hd_trajectory_places(const hd_trajectory *trajectory, double *q, double *p);

int hd_trajectory_particles(const hd_trajectory *trajectory); /**< N */

void hd_trajectory_archive(hd_trajectory *trajectory, hd_archive *archive);
/** A checksum of positions and momenta to the last bit. */
uint32_t hd_trajectory_fingerprint(const hd_trajectory *trajectory);

/** Only trajectory.c changes the members; benchmarks and tests look at `state`. */
struct hd_trajectory {
    const hd_dynamics *of;
    void *state; /**< only the dynamics knows what it holds */
    int particles;
    double rate; /**< expected pair collisions per time unit */
    hd_energy energy;
    /** [2][particles][coordinates]: q and p of now, for what the row leaves out; NULL if it leaves
     * nothing out that follows from them. */
    double *now;
};

#endif
