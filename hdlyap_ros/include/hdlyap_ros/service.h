/** Services in: std_srvs/SetBool, std_srvs/Trigger and hdlyap/Set answered by C callbacks. */
#ifndef HDLYAP_ROS_SERVICE_H
#define HDLYAP_ROS_SERVICE_H

#include <stddef.h>

#include "hdlyap_ros/node.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Answers a call: returns `success` and writes `message` (size bytes, begins as ""). Runs on the
 * node's callback thread, so it should be short. */
typedef bool (*hdr_set_bool_callback)(void *context, bool value, char *message, size_t size);
typedef bool (*hdr_trigger_callback)(void *context, char *message, size_t size);
/** assignment: NAME=VALUE, if the caller has kept to it. */
typedef bool (*hdr_set_callback)(void *context, const char *assignment, char *message, size_t size);

/* The service lives as long as the node; context must too. Names as for topics. HDR_FAULT or
 * HDR_NO_MEMORY on failure. */

HDR_MUST_CHECK hdr_status hdr_service_set_bool(hdr_node *node, const char *name,
                                               hdr_set_bool_callback callback, void *context);
HDR_MUST_CHECK hdr_status hdr_service_trigger(hdr_node *node, const char *name,
                                              hdr_trigger_callback callback, void *context);
HDR_MUST_CHECK hdr_status hdr_service_set(hdr_node *node, const char *name,
                                          hdr_set_callback callback, void *context);

#ifdef __cplusplus
}
#endif
#endif
