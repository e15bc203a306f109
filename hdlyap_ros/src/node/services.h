/** Services in: ~pause, ~reset_average, ~checkpoint and ~set -> requests to the worker. */
#ifndef HDLYAP_SERVICES_H
#define HDLYAP_SERVICES_H

#include "hdlyap_ros/service.h"
#include "worker.h"

/** The worker must live as long as the node serves callbacks. Fails with HDR_NO_MEMORY, or
 * HDR_FAULT if ROS refuses. */
HDR_MUST_CHECK hdr_status services_advertise(hdr_node *ros, worker *w);

#endif
