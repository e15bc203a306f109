/** Functions that advertise topics and publish messages, for each type of message in
 * hdlyap_ros/messages.h and hdlyap_ros/standard_messages.h. */
#ifndef HDLYAP_ROS_PUBLISHER_H
#define HDLYAP_ROS_PUBLISHER_H

#include "hdlyap_ros/messages.h"
#include "hdlyap_ros/standard_messages.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A topic on which this node publishes messages of one type. Only one thread at a time may use it,
 * except for hdr_publisher_lag. */
typedef struct hdr_publisher hdr_publisher;

/** Each type of message has these functions, shown here for hdr_steps:
 *
 *      hdr_status hdr_steps_advertise(hdr_publisher **out, hdr_node *node, const char *topic,
 *                                     int queue);
 *      hdr_status hdr_steps_advertise_latched(...);   with the same arguments
 *      hdr_status hdr_steps_publish(hdr_publisher *publisher, const hdr_steps *message);
 *
 * A topic "~x" is private to the node. `queue`, at least 1, is the number of messages that are kept
 * for a slow subscriber; if there are more, the oldest is dropped. A latched topic sends its last
 * message to each new subscriber. The publisher in *out belongs to the node and lives as long as it
 * does. Advertising returns HDR_OK, HDR_FAULT or HDR_NO_MEMORY.
 *
 * Publishing serialises the message and returns without waiting until it is sent, unless
 * hdr_publisher_wait was called for the topic. A field of which the comment (that of the .msg file)
 * says that it is NaN or -1 in some case is sent so in that case, whatever the struct holds. If any
 * other number is not finite, nothing is sent and HDR_NOT_FINITE is returned. Without a subscriber
 * publishing does nothing, unless the topic is latched. It returns HDR_FAULT if the publisher is of
 * another type of message, and HDR_NO_MEMORY. */
#define HDR_PUBLISHER(type)                                                                        \
    HDR_MUST_CHECK hdr_status type##_advertise(hdr_publisher **out, hdr_node *node,                \
                                               const char *topic, int queue);                      \
    HDR_MUST_CHECK hdr_status type##_advertise_latched(hdr_publisher **out, hdr_node *node,        \
                                                       const char *topic, int queue);              \
    HDR_MUST_CHECK hdr_status type##_publish(hdr_publisher *publisher, const type *message);
HDR_MESSAGES(HDR_PUBLISHER)
HDR_STANDARD_MESSAGES(HDR_PUBLISHER)
#undef HDR_PUBLISHER

/** Number of subscribers that are connected to the topic now. */
int hdr_publisher_subscribers(const hdr_publisher *publisher);

/** Asks the master how many nodes have subscribed to each of publishers[count], connected or not:
 * registered[k] becomes the number for publishers[k], 0 if that is NULL. It waits for the answer at
 * most `seconds`, or until a stop is requested. Returns HDR_OK; HDR_FAULT if the master has not
 * answered by then; or HDR_NO_MEMORY. */
HDR_MUST_CHECK hdr_status hdr_publishers_registered(int registered[],
                                                    hdr_publisher *const publishers[], int count,
                                                    double seconds);

/** From now on the messages that subscribers of this topic lose are counted and, when the node
 * ends, told in the log. Returns HDR_OK or HDR_NO_MEMORY. */
HDR_MUST_CHECK hdr_status hdr_publisher_watch(hdr_publisher *publisher);

/** As hdr_publisher_watch, and from now on publishing on this topic waits where it would lose a
 * message: while a subscriber that uses roscpp is 96 messages behind (as many as fit into the queue
 * of rosbag's recorder; this is known 0.1 s late), and while the queue for any other subscriber is
 * full. A warning names a subscriber for which it has waited 3 s, 6 s, 12 s and so on. It waits
 * at most 5 s for a subscriber that reads nothing, however slowly others read; then a warning says
 * so, and it loses messages until it reads again. Publishing does not wait once a stop has been
 * requested. Returns HDR_OK or HDR_NO_MEMORY. */
HDR_MUST_CHECK hdr_status hdr_publisher_wait(hdr_publisher *publisher);

/** How long publishing on this topic has waited for subscribers so far [s]. */
double hdr_publisher_waited(const hdr_publisher *publisher);

/** How far the slowest subscriber of a topic is behind. Messages in buffers of the operating system
 * are not counted. */
typedef struct hdr_lag {
    const char *topic; /**< resolved name; valid as long as the publisher lives */
    double seconds;    /**< for how long the oldest message has waited; 0 if none waits */
    int messages;      /**< number of messages that wait for it */
    int64_t lost; /**< number of messages lost so far, in the queues of this node, and in those of
                     subscribers that report their losses */
} hdr_lag;

/** Returns the lag without waiting. Any thread may call it. The times are the more exact the more
 * often it is called. */
hdr_lag hdr_publisher_lag(hdr_publisher *publisher);

#ifdef __cplusplus
}
#endif
#endif
