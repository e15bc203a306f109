/** The topics of the node, whose rows are in rows.inc: their numbers, names and sets. */
#ifndef HDLYAP_TOPIC_H
#define HDLYAP_TOPIC_H

#include <stdbool.h>
#include <stddef.h>

#include "hdlyap/scene.h"

/** Properties of a topic, as a set. The first three exclude each other. */
enum {
    TOPIC_ALWAYS = 1,      /**< every run publishes it */
    TOPIC_OBSERVABLE = 2,  /**< it is one of the parameter `observables` */
    TOPIC_FOR_VIEWERS = 4, /**< for viewers: queue of one; no run waits for it, no bag records it */
    TOPIC_LATCHED = 8,
    TOPIC_OF_VECTORS = 16, /**< it needs exponents */
    TOPIC_OF_WINDOWS = 32, /**< published when a window of covariant vectors has ended */
    TOPIC_OF_STEPS = 64,   /**< it is about steps; nothing is published before modes are measured */
    TOPIC_OF_FIELDS = 256, /**< several messages, published when fields are due */
    TOPIC_ONCE = 512       /**< once in a bag, but for changes */
};

typedef enum topic {
#define TOPIC(name, type, stages, is) TOPIC_##name,
#include "topics/rows.inc"
#undef TOPIC
    TOPICS
} topic;

/** The value of `awaited` that stands for all topics of the run. */
enum { ALL_PUBLISHED = 1u << TOPICS };

/** The name as in `observables` and `wait_for_subscribers`; the topic is "~" and this. */
const char *topic_name(topic t);

/** The bit of a topic in a set. */
static inline unsigned topic_bit(topic t) { return 1u << t; }

/** The bit of the topic with this name; 0 if there is none. */
unsigned topic_bit_of(const char *name);

/** A list of names with commas between them -> a set, and the other way round. */
unsigned topics_named(const char *list);
void topic_names(char *text, size_t size, unsigned set);

/** Whether a topic has one of these properties; the set of topics that have. */
bool topic_is(topic t, unsigned any);
unsigned topics_that_are(unsigned any);

/** The set of observables that need one of these stages. */
unsigned topics_of_stages(unsigned stages);

/** The set of observables that such particles can have: see hd_observe_of. */
unsigned topics_of_particles(const hd_dynamics *of);

/** The stages of the core (HD_OBSERVE_*) that a set of topics needs; the core adds the stages that
 * these need. */
unsigned topic_stages(unsigned set);

#endif
