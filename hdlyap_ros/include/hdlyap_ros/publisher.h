/** Topics out: typed functions that advertise and publish, for each message. */
#ifndef HDLYAP_ROS_PUBLISHER_H
#define HDLYAP_ROS_PUBLISHER_H

#include "hdlyap_ros/messages.h"
#include "hdlyap_ros/standard_messages.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A topic of one type. Used by one thread at a time. */
typedef struct hdr_publisher hdr_publisher;

/** For each message, for type = hdr_steps:
 *
 *      hdr_status hdr_steps_advertise(hdr_publisher **out, hdr_node *node, const char *topic,
 *                                     int queue);
 *      hdr_status hdr_steps_advertise_latched(the same);
 *      hdr_status hdr_steps_publish(hdr_publisher *publisher, const hdr_steps *message);
 *
 * Topic names: "~x" is private to the node. queue >= 1 is the number of messages kept for each
 * subscriber that is behind; the oldest are dropped first. Latched: who comes late gets the last
 * message. The publishers belong to the node and live as long as it does. Advertising fails with
 * HDR_FAULT or HDR_NO_MEMORY.
 *
 * The message is serialised before _publish returns and not waited for, but for hdr_publisher_wait.
 * What is not known, by the rules in the comments of its fields (HDR messages alone), goes out as
 * NaN or -1 whatever the struct has; if another number is not finite, HDR_NOT_FINITE and nothing is
 * sent. Without a subscriber and without latching it does nothing. HDR_FAULT if the publisher is of
 * another type; HDR_NO_MEMORY.
 */
#define HDR_PUBLISHER(type)                                                                        \
    HDR_MUST_CHECK hdr_status type##_advertise(hdr_publisher **out, hdr_node *node,                \
                                               const char *topic, int queue);                      \
    HDR_MUST_CHECK hdr_status type##_advertise_latched(hdr_publisher **out, hdr_node *node,        \
                                                       const char *topic, int queue);              \
    HDR_MUST_CHECK hdr_status type##_publish(hdr_publisher *publisher, const type *message);
HDR_MESSAGES(HDR_PUBLISHER)
HDR_STANDARD_MESSAGES(HDR_PUBLISHER)
#undef HDR_PUBLISHER

/** Number of subscribers connected now. */
int hdr_publisher_subscribers(const hdr_publisher *publisher);

/** Asks the master how many nodes have subscribed to each topic, whether they are connected yet or
 * not: registered[k] of publishers[k], 0 where that is NULL. Waits that long at most, and no longer
 * than until a stop is requested. HDR_FAULT if the master has not answered by then; HDR_NO_MEMORY.
 */
HDR_MUST_CHECK hdr_status hdr_publishers_registered(int registered[],
                                                    hdr_publisher *const publishers[], int count,
                                                    double seconds);

/** From now on _publish waits rather than that a message is lost: while it is 96 messages (as many
 * as surely fit the queue of rosbag's recorder) ahead of what a subscriber of roscpp had read 0.1 s
 * before, and while the queue for another one is full. It waits 5 s for one that reads nothing, and
 * 5 s for a queue; then it goes on with a warning, and counts what is lost. It does not wait once a
 * stop is requested. HDR_NO_MEMORY. */
HDR_MUST_CHECK hdr_status hdr_publisher_wait(hdr_publisher *publisher);

/** How far the slowest subscriber is behind; what waits in buffers of the kernel does not count. */
typedef struct hdr_lag {
    const char *topic; /**< resolved and remapped; as long as the publisher lives */
    double seconds;    /**< that a message waits; 0 if none does now */
    int messages;      /**< published meanwhile, with that one */
    int64_t lost; /**< messages so far: by queues here, and by those of subscribers that say so */
} hdr_lag;

/** May be called by any thread, the more often the more exactly; does not wait. */
hdr_lag hdr_publisher_lag(hdr_publisher *publisher);

#ifdef __cplusplus
}
#endif
#endif
