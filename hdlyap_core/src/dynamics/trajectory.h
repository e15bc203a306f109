/** Functions on the particles that only the core calls. */
#ifndef HD_TRAJECTORY_H
#define HD_TRAJECTORY_H

#include "base/archive.h"
#include "dynamics/record.h"
#include "hdlyap/trajectory.h"

/** Makes a trajectory of the scene *def from a state that its row has made, which then belongs to
 * the trajectory; if that fails, with HD_NO_MEMORY or HD_NOT_FINITE, the state is freed. */
HD_MUST_CHECK hd_status hd_trajectory_create_with(hd_trajectory **out, const hd_scene_def *def,
                                                  void *state);

/** As hd_trajectory_create, but without a start: for who reads the particles from an archive. */
HD_MUST_CHECK hd_status hd_trajectory_create_empty(hd_trajectory **out, const hd_scene_def *def);

/** Positions in the box and momenta along its directions, without other coordinates, as angles; q
 * and p have room for hd_trajectory_state. */
void hd_trajectory_places(const hd_trajectory *trajectory, double *q, double *p);

/** Refuses a row of a program's own that knows more null vectors of the present state than there
 * are exponents that vanish. Fails with HD_NO_MEMORY, too. */
HD_MUST_CHECK hd_status hd_trajectory_check_null(const hd_trajectory *trajectory,
                                                 const hd_scene_def *scene, char *message,
                                                 size_t size);

/** Writes the numbers that the row tells of the present state (hd_dynamics.average) to
 * value[averages]. `scene`, which asks for HD_OBSERVE_AVERAGES, is that of the trajectory. Fails
 * with HD_DYNAMICS_FAULT if one is none (HD_AVERAGE_MOST), see hd_trajectory_fault. */
HD_MUST_CHECK hd_status hd_trajectory_measure(hd_trajectory *trajectory, double *value,
                                              const hd_scene_def *scene);

int hd_trajectory_particles(const hd_trajectory *trajectory); /**< N */

void hd_trajectory_archive(hd_trajectory *trajectory, hd_archive *archive);
/** A checksum of positions and momenta to the last bit. */
uint32_t hd_trajectory_fingerprint(const hd_trajectory *trajectory);

/** A run whose energy is off by more than this part of it fails with HD_ENERGY_LOST: exponents go
 * as the root of the energy, so they are then off by 1 %, as much as the errors that short runs
 * state.
 */
#define HD_ENERGY_LOST_FROM 0.02

/** Largest size of a number that a row tells: sums of their squares are finite. */
#define HD_AVERAGE_MOST 1e100

/** Bytes of the line that hd_trajectory_fault returns. */
enum { HD_FAULT_LINE = 160 };

/** Only trajectory.c changes the members; benchmarks and tests look at `state`. */
struct hd_trajectory {
    const hd_dynamics *of;
    void *state; /**< only the dynamics knows what it holds */
    int particles;
    double rate;   /**< expected pair collisions per time unit */
    bool diverges; /**< see hd_scene_diverges */
    hd_energy energy;
    /** [2][particles][coordinates]: q and p of now, for averages, and for what the row leaves out;
     * NULL without averages, if it leaves nothing out that follows from them. */
    double *now;
    char fault[HD_FAULT_LINE]; /**< what the row's functions did wrong; "": nothing */
};

#endif
