/** Topics in: one typed subscribe function for each message, answered by a C callback. */
#ifndef HDLYAP_ROS_SUBSCRIBER_H
#define HDLYAP_ROS_SUBSCRIBER_H

#include "hdlyap_ros/messages.h"
#include "hdlyap_ros/standard_messages.h"

#ifdef __cplusplus
extern "C" {
#endif

/** One callback on one topic. */
typedef struct hdr_subscriber hdr_subscriber;

/** For each message, for type = hdr_steps:
 *
 *      typedef void (*hdr_steps_callback)(void *context, const hdr_steps *message);
 *      hdr_status hdr_steps_subscribe(hdr_subscriber **out, hdr_node *node, const char *topic,
 *                                     int queue, hdr_steps_callback callback, void *context);
 *
 * Topic names as in publisher.h. The message and all that it points into is valid until the
 * callback returns; an array without elements may be NULL. Callbacks run one after the other on the
 * node's one callback thread, which they share with services, possibly before this returns: what
 * they share with other threads needs a lock. Messages that arrive meanwhile wait; beyond queue >=
 * 1 of them the oldest are dropped (see hdr_header.seq). A publisher of another type under the
 * topic is not connected, and an ERROR line says so; a message that is damaged is dropped with an
 * ERROR line. Fails with HDR_FAULT (also where this node itself publishes the topic with another
 * type) or HDR_NO_MEMORY. */
#define HDR_SUBSCRIBER(type)                                                                       \
    typedef void (*type##_callback)(void *context, const type *message);                           \
    HDR_MUST_CHECK hdr_status type##_subscribe(hdr_subscriber **out, hdr_node *node,               \
                                               const char *topic, int queue,                       \
                                               type##_callback callback, void *context);
HDR_MESSAGES(HDR_SUBSCRIBER)
HDR_STANDARD_MESSAGES(HDR_SUBSCRIBER)
#undef HDR_SUBSCRIBER

/** Waits for a callback that is running; when it has returned none is running and none will: what
 * context points to may go, and what has not been handed over is dropped. So hold no lock that the
 * callback waits for. May also be called by the callback itself. NULL is allowed. hdr_node_free
 * frees those that are left. */
void hdr_subscriber_free(hdr_subscriber *subscriber);

/** Number of publishers connected now. */
int hdr_subscriber_publishers(const hdr_subscriber *subscriber);

#ifdef __cplusplus
}
#endif
#endif
