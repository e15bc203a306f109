/** How far a run is. */
#ifndef HDLYAP_PROGRESS_H
#define HDLYAP_PROGRESS_H

#include "hdlyap/run.h"

/** Zero exponents that a step splits: they stand above ln t / t, where the shear of what is
 * conserved would have them, by more than the accuracy asked for. */
typedef struct split_zeros {
    bool are;
    double exponent, expected; /**< the largest; ln t / t, or the accuracy [1/time unit] */
    double step, step_wanted;  /**< by which they would stand there, about [time units] */
} split_zeros;

/** What other threads may know of the run: a copy as of its last finished step. */
typedef struct progress {
    hd_stage stage;
    double time;         /**< simulated time since the start */
    bool collides;       /**< or what moves tells of none */
    uint64_t collisions; /**< pairs, since the start */
    hd_cost cost;
    double averaged;    /**< time; 0 without exponents */
    int resolved_steps; /**< -1 while nobody looks at them */
    bool caged;         /**< see hd_run_is_caged */
    split_zeros split;
} progress;

/** pace: simulated time per wall second at most, which is waited for; 0: none. */
progress progress_of(const hd_run *run, double pace);

#endif
