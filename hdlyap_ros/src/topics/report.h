/** What is published of a run: its numbers -> messages. Owns the topics and the buffers that the
 * messages are written from; nothing is computed for a topic without a subscriber. */
#ifndef HDLYAP_REPORT_H
#define HDLYAP_REPORT_H

#include "hdlyap/run.h"
#include "hdlyap_ros/publisher.h"
#include "node/changes.h"
#include "node/settings.h"
#include "topics/progress.h"

typedef struct report report;

/** Advertises the topics that the settings ask for. Both live longer than the report.
 * HDR_NO_MEMORY, or HDR_FAULT if ROS refuses. */
HDR_MUST_CHECK hdr_status report_create(report **out, hdr_node *ros, const settings *set,
                                        const hd_run *run);
void report_free(report *rep);

const char *report_run_id(const report *rep);

/** Of the run's topics; any thread. */
hdr_lag report_lag(const report *rep);

/** True once those are connected whom the settings say to wait for; may ask the master. */
bool report_awaited_here(report *rep);

/** Publishes everything needed to repeat the run; latched. HD_NOT_FINITE. */
HD_MUST_CHECK hd_status report_run_info(report *rep, const hd_run *run, const changes *all);

/** Stages of the core (HD_OBSERVE_*) that somebody listens to now: of the modes, what the next step
 * does not measure is not published after it. */
unsigned report_demand(report *rep);

/** Tells the run which vectors the next step is to end with, for slow_vectors. */
void report_demand_slow(report *rep, hd_run *run);

/** Publishes slow_vectors after a step, if somebody listens and it is time to; `at_rest`: the run
 * will stand still, and who comes while it does gets this one. HD_NOT_FINITE. */
HD_MUST_CHECK hd_status report_slow(report *rep, const hd_run *run, bool at_rest);

/** Publishes what has a subscriber of a run that has a report due.
 * HD_NOT_FINITE, and nothing of the message concerned is published, if a number of it is not. */
HD_MUST_CHECK hd_status report_publish(report *rep, const hd_run *run);

/** Publishes the covariant vectors, if somebody listens, once a window of them has ended: after a
 * step or a checkpoint. HD_NOT_FINITE as above. */
HD_MUST_CHECK hd_status report_window(report *rep, const hd_run *run);

/** Publishes the run's last messages: the cost, and the status with stage FINISHED. */
HD_MUST_CHECK hd_status report_finish(report *rep, const progress *last);

#endif
