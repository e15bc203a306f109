/** The node's own topics, whose rows stand in rows.inc: their numbers, names and sets. */
#ifndef HDLYAP_TOPIC_H
#define HDLYAP_TOPIC_H

#include <stddef.h>

#include "hdlyap/scene.h"

/** What a topic is: a set, of which the first three exclude each other. */
enum {
    TOPIC_ALWAYS = 1,     /**< there whatever is asked for */
    TOPIC_OBSERVABLE = 2, /**< one of `observables` */
    TOPIC_ASIDE = 4, /**< for who looks on: its last message alone, neither awaited nor recorded */
    TOPIC_LATCHED = 8,
    TOPIC_OF_VECTORS = 16, /**< not without exponents */
    TOPIC_OF_WINDOWS = 32, /**< published when a window of covariant vectors has ended */
    TOPIC_OF_STEPS = 64, /**< tells nothing unless steps are carried, nor before modes are known */
    TOPIC_OF_BOX = 128   /**< of positions in a box, itself: others are by their stages */
};

typedef enum topic {
#define TOPIC(name, type, stages, is, ...) TOPIC_##name,
#include "topics/rows.inc"
#undef TOPIC
    TOPICS
} topic;

/** In a set of awaited topics: whatever the others are */
enum { ALL_PUBLISHED = 1u << TOPICS };

/** As in `observables` and `wait_for_subscribers`; the topic is "~" and this. */
const char *topic_name(topic t);

/** Bit of a topic in a set. */
static inline unsigned topic_bit(topic t) { return 1u << t; }

/** The set's bit for a name; 0 if there is no such topic. */
unsigned topic_bit_of(const char *name);

/** The set of a list of names, with commas between them, and the other way round. */
unsigned topics_named(const char *list);
void topic_names(char *text, size_t size, unsigned set);

/** Topics that are one of these. */
unsigned topics_that_are(unsigned any);

/** Observables behind which one of these stages stands. */
unsigned topics_of_stages(unsigned stages);

/** Observables that there are of such particles: without a box none of positions in it, nor of what
 * is computed from them. */
unsigned topics_of_particles(const hd_dynamics *of);

/** Stages of the core (HD_OBSERVE_*) behind a set of topics; what these need comes by itself. */
unsigned topic_stages(unsigned set);

#endif
