/** What is needed to repeat a run -> the latched message run_info. */
#ifndef HDLYAP_RUN_INFO_H
#define HDLYAP_RUN_INFO_H

#include "hdlyap/run.h"
#include "node/changes.h"
#include "topics/publishers.h"

/** Sent once and after a change of parameters. HDR_NO_MEMORY, or HDR_FAULT if ROS refuses. */
HDR_MUST_CHECK hdr_status run_info_publish(const publishers *out, const settings *set,
                                           const hd_run *run, const changes *all);

#endif
