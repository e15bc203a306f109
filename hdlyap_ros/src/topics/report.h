/** Publishes a run: its numbers -> messages. Owns the topics and the buffers for messages. Nothing
 * is computed for a topic without a subscriber. */
#ifndef HDLYAP_REPORT_H
#define HDLYAP_REPORT_H

#include "hdlyap/run.h"
#include "hdlyap_ros/publisher.h"
#include "node/changes.h"
#include "node/settings.h"
#include "topics/progress.h"

typedef struct report report;

/** Advertises the topics that the settings ask for. ros and set have to outlive the report. Fails
 * with HDR_NO_MEMORY, or HDR_FAULT if ROS refuses. */
HDR_MUST_CHECK hdr_status report_create(report **out, hdr_node *ros, const settings *set,
                                        const hd_run *run);
void report_free(report *rep);

const char *report_run_id(const report *rep);

/** See publishers_lag. Any thread may call. */
hdr_lag report_lag(const report *rep);

/** Whether the subscribers are connected for which the settings say to wait. May ask the master. */
bool report_awaited_here(report *rep);

/** Publishes run_info, which is latched. Fails with HD_NOT_FINITE. */
HD_MUST_CHECK hd_status report_run_info(report *rep, const hd_run *run, const changes *all);

/** The stages of the core (HD_OBSERVE_*) behind topics that have a subscriber now. Stages that the
 * next step does not measure are not published after it. */
unsigned report_demand(report *rep);

/** Tells the run how long the next step may be, for slow_vectors. */
void report_demand_slow(report *rep, hd_run *run);

/** After a step: has the vectors measured that fields and slow_vectors publish now, if any. Fails
 * as hd_run_measure. */
HD_MUST_CHECK hd_status report_vectors(report *rep, hd_run *run);

/** Publishes slow_vectors after a step, if somebody listens and a message is due. at_rest: the run
 * stands still then, and subscribers that come meanwhile get this message. HD_NOT_FINITE. */
HD_MUST_CHECK hd_status report_slow(report *rep, const hd_run *run, bool at_rest);

/** Publishes a report: all observables that have a subscriber, cost and status, all with one stamp.
 * Fails with HD_NOT_FINITE if a number of a message is not finite; that message is not published.
 */
HD_MUST_CHECK hd_status report_publish(report *rep, const hd_run *run);

/** Publishes covariant, if somebody listens and a window has ended. Is called after a step or a
 * checkpoint. Fails with HD_NOT_FINITE, likewise. */
HD_MUST_CHECK hd_status report_window(report *rep, const hd_run *run);

/** Publishes the run's last messages: the cost, and the status with stage FINISHED. They belong to
 * the last report if the run went to its end. */
HD_MUST_CHECK hd_status report_finish(report *rep, const progress *last);

#endif
