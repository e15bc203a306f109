/** Services in: ~pause, ~reset_average, ~checkpoint and ~set -> requests to the worker. */
#ifndef HDLYAP_SERVICES_H
#define HDLYAP_SERVICES_H

#include "hdlyap_ros/service.h"
#include "worker.h"

/** What services need. */
typedef struct services {
    hdr_node *ros;
    worker *worker;
} services;

/** Fills *out, which must live as long as the node serves callbacks, and so must the worker. Fails
 * with HDR_NO_MEMORY, or HDR_FAULT if ROS refuses. */
HDR_MUST_CHECK hdr_status services_advertise(services *out, hdr_node *ros, worker *w);

#endif
