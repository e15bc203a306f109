/** ROS services of this node, answered by C callbacks: std_srvs/SetBool, std_srvs/Trigger and
 * hdlyap/Set. */
#ifndef HDLYAP_ROS_SERVICE_H
#define HDLYAP_ROS_SERVICE_H

#include <stddef.h>

#include "hdlyap_ros/node.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Answers a call of a service: returns its success, and writes a text for the caller to
 * message[size], which is "" at first. `context` is that of hdr_service_set_bool and its like. It
 * runs on the node's callback thread, as all callbacks do, so it should be short. */
typedef bool (*hdr_set_bool_callback)(void *context, bool value, char *message, size_t size);
typedef bool (*hdr_trigger_callback)(void *context, char *message, size_t size);
/** As above. `assignment` should be NAME=VALUE, but the caller may have sent any text. */
typedef bool (*hdr_set_callback)(void *context, const char *assignment, char *message, size_t size);

/* Each of these functions offers a service with the name `name`, where "~x" is private to the node.
 * The service lives as long as the node, and so must `context`. Returns HDR_OK, HDR_FAULT or
 * HDR_NO_MEMORY. */

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
