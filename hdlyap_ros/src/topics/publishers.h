/** Publishes the node's topics: a publisher for each one of the run, and what messages share. */
#ifndef HDLYAP_PUBLISHERS_H
#define HDLYAP_PUBLISHERS_H

#include "hdlyap/status.h"
#include "hdlyap_ros/publisher.h"
#include "topics/topic.h"

typedef struct publishers {
    hdr_publisher *publisher[TOPICS]; /**< NULL if the run does not publish the topic */
    const char *node;                 /**< name of the node */
    char run_id[96];
    hdr_time stamp; /**< of the messages that follow: of a report all have the same */
} publishers;

/** Advertises a set of topics and makes the run's id. bytes: size of a message of each topic, for
 * the length of its queue; waits: publishing waits for slow subscribers. Fails with HDR_NO_MEMORY,
 * or HDR_FAULT if ROS refuses. */
HDR_MUST_CHECK hdr_status publishers_advertise(publishers *out, hdr_node *ros, unsigned set,
                                               const double bytes[TOPICS], bool waits,
                                               const char *seed);

/** How long publishing has waited for subscribers so far [s]. */
double publishers_waited(const publishers *out);

/** The set of topics that have a subscriber now. */
unsigned publishers_subscribed(const publishers *out);

/** The lag of the topic that has lost most messages or, if none is lost, whose slowest subscriber
 * is furthest behind; topic "" if there is none. TOPIC_FOR_VIEWERS topics do not count. Any thread
 * may call. */
hdr_lag publishers_lag(const publishers *out);

/** For each topic, a function that fills header and run_id of a message and sends it. It fails with
 * HD_NOT_FINITE, and sends nothing, if a number is not finite that has to be. If ROS refuses, the
 * message is lost, with a line in the log, and the run goes on. */
#define TOPIC(name, type, stages, is)                                                              \
    HD_MUST_CHECK hd_status topic_send_##name(const publishers *to, hdr_##type *message);
#include "topics/rows.inc"
#undef TOPIC

#endif
