/** What is needed to repeat a run -> the latched message run_info. */
#ifndef HDLYAP_RUN_INFO_H
#define HDLYAP_RUN_INFO_H

#include "changes.h"
#include "hdlyap/run.h"
#include "publishers.h"
#include "settings.h"

/** Allocates, as it is sent once and after a change of parameters. HDR_NO_MEMORY, or HDR_FAULT if
 * ROS refuses. */
HDR_MUST_CHECK hdr_status run_info_publish(const publishers *out, const settings *set,
                                           const hd_run *run, const changes *all);

#endif
