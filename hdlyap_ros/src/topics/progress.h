/** How far a run is. */
#ifndef HDLYAP_PROGRESS_H
#define HDLYAP_PROGRESS_H

#include "hdlyap/run.h"

/** What other threads may know of the run: a copy as of its last finished step. */
typedef struct progress {
    hd_stage stage;
    double time;         /**< simulated time since the start */
    uint64_t collisions; /**< pairs, since the start */
    hd_cost cost;
    double averaged;    /**< time; 0 without exponents */
    int resolved_steps; /**< -1 while nobody looks at them */
    bool caged;         /**< see hd_run_is_caged */
} progress;

/** pace: simulated time per wall second at most, which is waited for; 0: none. */
progress progress_of(const hd_run *run, double pace);

#endif
