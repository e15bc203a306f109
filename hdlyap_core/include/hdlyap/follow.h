/** Ranks that have no program of their own: rank 0 makes the calls of a run (run.h, checkpoint.h),
 * the others make the same ones, as they are told. */
#ifndef HDLYAP_FOLLOW_H
#define HDLYAP_FOLLOW_H

#include "hdlyap/communicator.h"
#include "hdlyap/scene.h"

HD_API_BEGIN

/** On rank 0: from now on each call of a run with this communicator is told to the others. */
void hd_run_lead(hd_communicator *communicator);
/** On rank 0: they may go. Once. */
void hd_run_dismiss(hd_communicator *communicator);
/** On the others: makes the calls of rank 0, one run at a time, until they may go. What fails there
 * fails here alike; rank 0 says so. Runs are of hd_particles, or of one of the dynamics own[count].
 */
void hd_run_follow(hd_communicator *communicator, const hd_dynamics *const *own, int count);

HD_API_END
#endif
