/** How many there are in a scene of what messages list -> the sizes of messages. */
#ifndef HDLYAP_EXTENT_H
#define HDLYAP_EXTENT_H

#include "hdlyap/estimate.h"
#include "node/settings.h"
#include "topics/topic.h"

/** What the core says of a scene, with the fields that are chosen: `examples` and `pairs` are those
 * of one time, at most. */
hd_extent extent_of(const settings *set, hd_extent of_run);

/** Bytes of a topic's messages, without texts. */
typedef struct topic_size {
    double report;   /**< that come with every report */
    double fields;   /**< and with fields, when these are due */
    double window;   /**< and with each window of covariant vectors */
    double messages; /**< that come at one time; 0 stands for 1 */
} topic_size;

/** By its row. */
topic_size topic_size_of(topic t, const hd_extent *e);

#endif
