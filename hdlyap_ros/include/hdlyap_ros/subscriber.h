/** Functions that subscribe to topics with a C callback, for each type of message in
 * hdlyap_ros/messages.h and hdlyap_ros/standard_messages.h. */
#ifndef HDLYAP_ROS_SUBSCRIBER_H
#define HDLYAP_ROS_SUBSCRIBER_H

#include "hdlyap_ros/messages.h"
#include "hdlyap_ros/standard_messages.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The subscription of one callback to a topic. */
typedef struct hdr_subscriber hdr_subscriber;

/** Each type of message has this type of callback and this function, shown here for hdr_steps:
 *
 *      typedef void (*hdr_steps_callback)(void *context, const hdr_steps *message);
 *      hdr_status hdr_steps_subscribe(hdr_subscriber **out, hdr_node *node, const char *topic,
 *                                     int queue, hdr_steps_callback callback, void *context);
 *
 * A topic "~x" is private to the node. The message, and what it points to, is valid until the
 * callback returns; an array without elements may be NULL. All callbacks and services of the node
 * run one after another on its callback thread, maybe before subscribing returns; so data that they
 * share with other threads need a lock. At most `queue` messages, at least 1, wait for the
 * callback; if there are more, the oldest is dropped (see hdr_header.seq). A publisher of another
 * type is not connected, and a damaged message is dropped; a line in the log with level ERROR says
 * so. Subscribing returns HDR_OK; HDR_FAULT, also if this node publishes the topic with another
 * type; or HDR_NO_MEMORY. */
#define HDR_SUBSCRIBER(type)                                                                       \
    typedef void (*type##_callback)(void *context, const type *message);                           \
    HDR_MUST_CHECK hdr_status type##_subscribe(hdr_subscriber **out, hdr_node *node,               \
                                               const char *topic, int queue,                       \
                                               type##_callback callback, void *context);
HDR_MESSAGES(HDR_SUBSCRIBER)
HDR_STANDARD_MESSAGES(HDR_SUBSCRIBER)
#undef HDR_SUBSCRIBER

/** Ends a subscription. It waits for a callback that is running, so the caller must hold no lock
 * for which the callback waits. After the call the callback does not run any more, and its context
 * may be freed. Messages that wait for it are dropped. The callback itself may call this.
 * subscriber may be NULL. hdr_node_free frees the subscribers that are left. */
void hdr_subscriber_free(hdr_subscriber *subscriber);

/** Number of publishers of the topic that are connected to this subscriber now. */
int hdr_subscriber_publishers(const hdr_subscriber *subscriber);

#ifdef __cplusplus
}
#endif
#endif
