/** Functions that subscribe to topics with a C callback, for each type of message. */
#ifndef HDLYAP_ROS_SUBSCRIBER_H
#define HDLYAP_ROS_SUBSCRIBER_H

#include "hdlyap_ros/messages.h"
#include "hdlyap_ros/standard_messages.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A callback that is subscribed to a topic. */
typedef struct hdr_subscriber hdr_subscriber;

/** Each message has this type and function, here with type = hdr_steps:
 *
 *      typedef void (*hdr_steps_callback)(void *context, const hdr_steps *message);
 *      hdr_status hdr_steps_subscribe(hdr_subscriber **out, hdr_node *node, const char *topic,
 *                                     int queue, hdr_steps_callback callback, void *context);
 *
 * A topic "~x" is private to the node. The message, and what it points to, is valid until the
 * callback returns; an array without elements may be NULL. All callbacks and services of the node
 * run one after another on its callback thread, maybe before _subscribe returns, so data that they
 * share with other threads need a lock. At most `queue` messages, at least 1, wait for a callback;
 * then the oldest are dropped (see hdr_header.seq). A publisher of another type is not connected,
 * and a damaged message is dropped; an ERROR line says so. HDR_FAULT, also if this node publishes
 * the topic with another type; HDR_NO_MEMORY. */
#define HDR_SUBSCRIBER(type)                                                                       \
    typedef void (*type##_callback)(void *context, const type *message);                           \
    HDR_MUST_CHECK hdr_status type##_subscribe(hdr_subscriber **out, hdr_node *node,               \
                                               const char *topic, int queue,                       \
                                               type##_callback callback, void *context);
HDR_MESSAGES(HDR_SUBSCRIBER)
HDR_STANDARD_MESSAGES(HDR_SUBSCRIBER)
#undef HDR_SUBSCRIBER

/** Ends the subscription. It waits for a running callback, so the caller must hold no lock that the
 * callback waits for; afterwards no callback runs any more, and context may be freed. Waiting
 * messages are dropped. The callback itself may call it. subscriber may be NULL. hdr_node_free
 * frees subscribers that are left. */
void hdr_subscriber_free(hdr_subscriber *subscriber);

/** Number of publishers that are connected now. */
int hdr_subscriber_publishers(const hdr_subscriber *subscriber);

#ifdef __cplusplus
}
#endif
#endif
