/** Functions that advertise topics and publish messages, for each type of message. */
#ifndef HDLYAP_ROS_PUBLISHER_H
#define HDLYAP_ROS_PUBLISHER_H

#include "hdlyap_ros/messages.h"
#include "hdlyap_ros/standard_messages.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A topic of one type. One thread at a time may use it. */
typedef struct hdr_publisher hdr_publisher;

/** Each message has these functions, here with type = hdr_steps:
 *
 *      hdr_status hdr_steps_advertise(hdr_publisher **out, hdr_node *node, const char *topic,
 *                                     int queue);
 *      hdr_status hdr_steps_advertise_latched(...);   with the same arguments
 *      hdr_status hdr_steps_publish(hdr_publisher *publisher, const hdr_steps *message);
 *
 * A topic "~x" is private to the node. `queue`, at least 1, is the number of messages that are kept
 * for a slow subscriber; the oldest are dropped first. A latched topic sends its last message to
 * each new subscriber. Publishers belong to the node and live as long as it does. _advertise fails
 * with HDR_FAULT or HDR_NO_MEMORY.
 *
 * _publish serialises the message and returns without waiting until it is sent, unless
 * hdr_publisher_wait was called. A field that is unknown by the rule in its comment is sent as NaN
 * or -1, whatever the struct has. If any other number is not finite, it sends nothing and returns
 * HDR_NOT_FINITE. It does nothing without a subscriber, unless the topic is latched. HDR_FAULT if
 * the publisher is of another type; HDR_NO_MEMORY. */
#define HDR_PUBLISHER(type)                                                                        \
    HDR_MUST_CHECK hdr_status type##_advertise(hdr_publisher **out, hdr_node *node,                \
                                               const char *topic, int queue);                      \
    HDR_MUST_CHECK hdr_status type##_advertise_latched(hdr_publisher **out, hdr_node *node,        \
                                                       const char *topic, int queue);              \
    HDR_MUST_CHECK hdr_status type##_publish(hdr_publisher *publisher, const type *message);
HDR_MESSAGES(HDR_PUBLISHER)
HDR_STANDARD_MESSAGES(HDR_PUBLISHER)
#undef HDR_PUBLISHER

/** Number of subscribers that are connected now. */
int hdr_publisher_subscribers(const hdr_publisher *publisher);

/** Asks the master how many nodes have subscribed to each topic, connected or not: registered[k] is
 * the number for publishers[k], 0 if that is NULL. Waits at most `seconds`, or until a stop is
 * requested. HDR_FAULT if the master has not answered by then; HDR_NO_MEMORY. */
HDR_MUST_CHECK hdr_status hdr_publishers_registered(int registered[],
                                                    hdr_publisher *const publishers[], int count,
                                                    double seconds);

/** From now on _publish waits instead of losing a message: while a roscpp subscriber is 96 messages
 * behind (as many as fit into the queue of rosbag's recorder, judged 0.1 s late), and while the
 * queue of any other subscriber is full. It waits at most 5 s for a subscriber that reads nothing,
 * then goes on with a warning and counts lost messages. It does not wait once a stop is requested.
 * HDR_NO_MEMORY. */
HDR_MUST_CHECK hdr_status hdr_publisher_wait(hdr_publisher *publisher);

/** How far the slowest subscriber of a topic is behind, without messages in buffers of the kernel.
 */
typedef struct hdr_lag {
    const char *topic; /**< resolved name; valid as long as the publisher lives */
    double seconds;    /**< how long the oldest message has waited; 0 if none waits */
    int messages;      /**< number of messages that wait */
    int64_t lost; /**< lost messages so far, in queues here and of subscribers that report theirs */
} hdr_lag;

/** Returns the lag without waiting. Any thread may call it; frequent calls make it more exact. */
hdr_lag hdr_publisher_lag(hdr_publisher *publisher);

#ifdef __cplusplus
}
#endif
#endif
