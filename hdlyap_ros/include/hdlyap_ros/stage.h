/** The stages of a run in words. */
#ifndef HDLYAP_ROS_STAGE_H
#define HDLYAP_ROS_STAGE_H

#include "hdlyap_ros/messages.h"

/** Of hdr_run_status.stage. */
static inline const char *hdr_stage_name(unsigned stage)
{
    static const char *const names[] = {"equilibrating", "warming up", "averaging", "finished"};
    return stage <= HDR_RUN_STATUS_FINISHED ? names[stage] : "unknown";
}

#endif
