/** The node's topics out: a publisher for each that is asked for, and what messages have in common.
 */
#ifndef HDLYAP_PUBLISHERS_H
#define HDLYAP_PUBLISHERS_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/status.h"
#include "hdlyap_ros/publisher.h"
#include "topic.h"

typedef struct publishers {
    hdr_publisher *publisher[TOPICS]; /**< NULL if not asked for */
    const char *node;                 /**< name, the node's own */
    char run_id[96];
} publishers;

/** Advertises a set of topics; doubles[t]: about so many numbers in a message, for the length of
 * the queue. The run's id is made here. HDR_NO_MEMORY, or HDR_FAULT if ROS refuses. */
HDR_MUST_CHECK hdr_status publishers_advertise(publishers *out, hdr_node *ros, unsigned set,
                                               const double doubles[TOPICS], const char *seed);

/** Set of the topics that have a subscriber now. */
unsigned publishers_subscribed(const publishers *out);

/** Of the topic that has lost most messages, or else whose slowest subscriber is furthest behind;
 * topic "" if there is none. Any thread. */
hdr_lag publishers_lag(const publishers *out);

/** Name of the frame that positions are in. */
const char *message_frame(void);

/** A header of now. */
hdr_header message_header(void);
/** Messages that ROS refuses are lost with a line in the log; they do not end the run. */
HD_MUST_CHECK hd_status publishers_sent(hdr_status status, topic t);

/** float64[] of every stride-th element. */
static inline hdr_doubles message_array(const double *data, size_t count, size_t stride)
{
    return (hdr_doubles){.data = data, .count = (uint32_t)count, .stride = (uint32_t)stride};
}

/** What is not finite is never published. */
bool message_finite(const double *x, size_t count);

#endif
