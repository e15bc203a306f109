/** The stages of a run in words. */
#ifndef HDLYAP_ROS_STAGE_H
#define HDLYAP_ROS_STAGE_H

#include "hdlyap_ros/messages.h"

/** Of hdr_cost.phase. */
static inline const char *hdr_phase_name(unsigned phase)
{
    static const char *const names[] = {"equilibrating", "warming up", "averaging", "finished"};
    return phase <= HDR_COST_FINISHED ? names[phase] : "unknown";
}

#endif
