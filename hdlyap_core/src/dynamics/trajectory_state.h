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
};

#endif
