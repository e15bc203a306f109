/** The node's own topics: parameter names <-> one bit each. */
#ifndef HDLYAP_TOPIC_H
#define HDLYAP_TOPIC_H

#include <stddef.h>

typedef enum topic {
    TOPIC_RUN_INFO,
    TOPIC_SPECTRUM,
    TOPIC_MODES,
    TOPIC_STEPS,
    TOPIC_LP_PHASES,
    TOPIC_T_PHASES,
    TOPIC_FIELDS,
    TOPIC_HYDRO,
    TOPIC_STRUCTURE,
    TOPIC_COVARIANT,
    TOPIC_LOCALIZATION,
    TOPIC_GAS,
    TOPIC_STATE,
    TOPIC_STATUS,
    TOPIC_COST,
    TOPICS
} topic;

/** Sets of topics: always there; whatever else can be asked for; what is made of the modes. */
enum {
    TOPICS_ALWAYS = 1u << TOPIC_RUN_INFO | 1u << TOPIC_STATUS | 1u << TOPIC_COST,
    TOPICS_OBSERVABLE = ((1u << TOPICS) - 1) ^ TOPICS_ALWAYS,
    TOPICS_OF_MODES = 1u << TOPIC_MODES | 1u << TOPIC_STEPS | 1u << TOPIC_LP_PHASES |
                      1u << TOPIC_T_PHASES | 1u << TOPIC_FIELDS | 1u << TOPIC_HYDRO |
                      1u << TOPIC_STRUCTURE,
    ALL_PUBLISHED = 1u << TOPICS /**< in a set of awaited topics: whatever the others are */
};

/** As in `observables` and `wait_for_subscribers`; the topic is "~" and this. */
const char *topic_name(topic t);

/** Bit of a topic in a set. */
static inline unsigned topic_bit(topic t) { return 1u << t; }

/** The set's bit for a name; 0 if there is no such topic. */
unsigned topic_bit_of(const char *name);

/** The set of a list of names, with commas between them, and the other way round. */
unsigned topics_named(const char *list);
void topic_names(char *text, size_t size, unsigned set);

/** Topics behind which one of these stages stands. */
unsigned topics_of_stages(unsigned stages);

/** Stages of the core (HD_OBSERVE_*) behind a set of topics; what these need comes by itself. */
unsigned topic_stages(unsigned set);

#endif
