/** Ranks that follow rank 0: it makes the calls of a run (run.h, checkpoint.h), and the other
 * ranks, which have no program of their own, repeat them. */
#ifndef HDLYAP_FOLLOW_H
#define HDLYAP_FOLLOW_H

#include "hdlyap/communicator.h"
#include "hdlyap/scene.h"

HD_API_BEGIN

/** To be called on rank 0: from now on the others repeat its calls of runs with this communicator.
 */
void hd_run_lead(hd_communicator *communicator);
/** To be called on rank 0, once: hd_run_follow returns on the others. */
void hd_run_dismiss(hd_communicator *communicator);
/** To be called on the others: repeats the calls of rank 0, one run at a time, until they are
 * dismissed. A call that fails on rank 0 also fails here; rank 0 reports it. Runs are of
 * hd_particles, or of one of the dynamics own[count]. */
void hd_run_follow(hd_communicator *communicator, const hd_dynamics *const *own, int count);

HD_API_END
#endif
