/** Ranks that follow rank 0. Only rank 0 has a program that calls the functions of runs (run.h,
 * checkpoint.h); the other ranks repeat these calls. */
#ifndef HDLYAP_FOLLOW_H
#define HDLYAP_FOLLOW_H

#include "hdlyap/communicator.h"
#include "hdlyap/scene.h"

HD_API_BEGIN

/** Call this on rank 0: from now on the other ranks repeat its calls of runs that are made with
 * this communicator. */
void hd_run_lead(hd_communicator *communicator);
/** Call this on rank 0, once, at the end: hd_run_follow returns on the other ranks. */
void hd_run_dismiss(hd_communicator *communicator);
/** Call this on all ranks but 0. It repeats the calls of rank 0, which must free a run before it
 * makes the next one, and returns after hd_run_dismiss. A call that fails on rank 0 fails here as
 * well; only rank 0 reports it. Particles are those of hd_particles or of one of the dynamics
 * own[count]. */
void hd_run_follow(hd_communicator *communicator, const hd_dynamics *const *own, int count);

HD_API_END
#endif
