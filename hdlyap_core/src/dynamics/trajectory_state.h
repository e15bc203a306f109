/** The members of a trajectory. */
#ifndef HD_TRAJECTORY_STATE_H
#define HD_TRAJECTORY_STATE_H

#include "dynamics/dynamics.h"
#include "dynamics/trajectory.h"

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
