/** Lengths of the arrays in a scene's messages -> sizes of messages. */
#ifndef HDLYAP_EXTENT_H
#define HDLYAP_EXTENT_H

#include "hdlyap/estimate.h"
#include "node/settings.h"
#include "topics/topic.h"

/** Adapts hd_result_counts of a scene to the choice of fields: `examples` and `pairs` are the most
 * at one time. */
hd_result_counts extent_of(const settings *set, hd_result_counts of_run);

/** Bytes of a topic's messages, without texts. */
typedef struct topic_size {
    double report;   /**< at each report */
    double fields;   /**< in addition, when fields are due */
    double window;   /**< after each window of covariant vectors */
    double messages; /**< number of messages at one time; 0 stands for 1 */
} topic_size;

/** By the shapes in the .msg; 0 if it is once in a bag or not at all. */
topic_size topic_size_of(topic t, const hd_result_counts *e);

#endif
