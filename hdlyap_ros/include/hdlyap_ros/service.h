/** Services std_srvs/SetBool, std_srvs/Trigger and hdlyap/Set, which C callbacks answer. */
#ifndef HDLYAP_ROS_SERVICE_H
#define HDLYAP_ROS_SERVICE_H

#include <stddef.h>

#include "hdlyap_ros/node.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Answers a call: returns `success` and writes `message`, which has `size` bytes and is "" at
 * first. It runs on the node's callback thread, so it should be short. */
typedef bool (*hdr_set_bool_callback)(void *context, bool value, char *message, size_t size);
typedef bool (*hdr_trigger_callback)(void *context, char *message, size_t size);
/** As above; assignment should be NAME=VALUE, but the caller may have sent anything. */
typedef bool (*hdr_set_callback)(void *context, const char *assignment, char *message, size_t size);

/* These advertise a service, which lives as long as the node; context must do so, too. A name "~x"
 * is private to the node. HDR_FAULT or HDR_NO_MEMORY. */

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
