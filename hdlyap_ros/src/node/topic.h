/** The node's own topics: parameter names <-> one bit each. */
#ifndef HDLYAP_TOPIC_H
#define HDLYAP_TOPIC_H

typedef enum topic { TOPIC_RUN_INFO, TOPIC_SPECTRUM, TOPIC_STATE, TOPIC_COST, TOPICS } topic;

/** As in `observables` and `wait_for_subscribers`; the topic is "~" and this. */
const char *topic_name(topic t);

/** Bit of a topic in a set. */
static inline unsigned topic_bit(topic t) { return 1u << t; }

/** The set's bit for a name; 0 if there is no such topic. */
unsigned topic_bit_of(const char *name);

#endif
