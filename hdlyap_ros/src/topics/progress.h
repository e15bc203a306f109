/** How far a run has got. */
#ifndef HDLYAP_PROGRESS_H
#define HDLYAP_PROGRESS_H

#include "hdlyap/run.h"

/** Whether a time step splits the zero exponents: the largest is above ln t / t, to which the shear
 * of conserved quantities would bring it, by more than the accuracy of the scene. */
typedef struct split_zeros {
    bool are;
    double exponent, expected; /**< the largest zero exponent; the value expected without a split,
                                  ln t / t or the accuracy, whichever is larger [1/time unit] */
    double step, power;        /**< the time step [time units]; the exponent falls with it to this
                                  power */
} split_zeros;

/** What other threads may know of the run: a copy made after its last step. */
typedef struct progress {
    hd_stage stage;
    double time;         /**< simulated time since the start */
    bool collides;       /**< whether the particles have collisions */
    uint64_t collisions; /**< collisions of pairs since the start */
    hd_cost cost;
    double averaged;    /**< averaged time; 0 without exponents */
    int resolved_steps; /**< number of resolved steps; -1 while they are not computed */
    bool caged;         /**< see hd_run_is_caged */
    hd_energy energy;   /**< what time steps have done to it */
    split_zeros split;
} progress;

/** The progress of a run. pace: most simulated time per wall second, 0: no limit. */
progress progress_of(const hd_run *run, double pace);

#endif
