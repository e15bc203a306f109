/** The node's topics out: a publisher for each that is asked for, and what messages have in common.
 */
#ifndef HDLYAP_PUBLISHERS_H
#define HDLYAP_PUBLISHERS_H

#include "hdlyap/status.h"
#include "hdlyap_ros/publisher.h"
#include "topics/topic.h"

typedef struct publishers {
    hdr_publisher *publisher[TOPICS]; /**< NULL if not asked for */
    const char *node;                 /**< name, the node's own */
    char run_id[96];
} publishers;

/** Advertises a set of topics, with queues for messages of so many bytes. The run's id is made
 * here. HDR_NO_MEMORY, or HDR_FAULT if ROS refuses. */
HDR_MUST_CHECK hdr_status publishers_advertise(publishers *out, hdr_node *ros, unsigned set,
                                               const double bytes[TOPICS], const char *seed);

/** Set of the topics that have a subscriber now. */
unsigned publishers_subscribed(const publishers *out);

/** Of the topic, none of those aside, that has lost most messages, or else whose slowest subscriber
 * is furthest behind; topic "" if there is none. Any thread. */
hdr_lag publishers_lag(const publishers *out);

/** A header of now. */
hdr_header message_header(void);

/** Sends a message of each topic, with header and run_id. HD_NOT_FINITE, and nothing is sent, if a
 * number of it is not that must be. What ROS refuses is lost with a line in the log; it does not
 * end the run. */
#define TOPIC(name, type, stages, is, ...)                                                         \
    HD_MUST_CHECK hd_status topic_send_##name(const publishers *to, hdr_##type *message);
#include "topics/rows.inc"
#undef TOPIC

#endif
