/** The topics of the node. */
#include "topics/topic.h"

#include <stdio.h>
#include <string.h>

#include "hdlyap/dynamics.h"
#include "hdlyap/observables.h"

static const struct {
    const char *name;
    unsigned stages, is;
} topics[TOPICS] = {
#define TOPIC(name, type, stages, is) [TOPIC_##name] = {#name, stages, is},
#include "topics/rows.inc"
#undef TOPIC
};

const char *topic_name(topic t) { return topics[t].name; }

unsigned topic_bit_of(const char *name)
{
    for (topic t = 0; t < TOPICS; t++)
        if (strcmp(topics[t].name, name) == 0) return topic_bit(t);
    return 0;
}

/** Names end at commas and blanks. */
unsigned topics_named(const char *list)
{
    unsigned set = 0;
    char name[16];
    while (*(list += strspn(list, ", "))) {
        const size_t length = strcspn(list, ", ");
        snprintf(name, sizeof name, "%.*s", (int)length, list);
        set |= topic_bit_of(name);
        list += length;
    }
    return set;
}

void topic_names(char *text, size_t size, unsigned set)
{
    size_t length = 0;
    if (size > 0) *text = '\0';
    for (topic t = 0; t < TOPICS && length < size; t++)
        if (set & topic_bit(t))
            length += (size_t)snprintf(text + length, size - length, "%s%s", length ? ", " : "",
                                       topics[t].name);
}

bool topic_is(topic t, unsigned any) { return topics[t].is & any; }

unsigned topics_that_are(unsigned any)
{
    unsigned set = 0;
    for (topic t = 0; t < TOPICS; t++)
        if (topic_is(t, any)) set |= topic_bit(t);
    return set;
}

unsigned topics_of_stages(unsigned stages)
{
    unsigned set = 0;
    for (topic t = 0; t < TOPICS; t++)
        if (topics[t].stages & stages) set |= topic_bit(t);
    return set & topics_that_are(TOPIC_OBSERVABLE);
}

unsigned topics_of_particles(const hd_dynamics *of)
{
    return topics_that_are(TOPIC_OBSERVABLE) &
           ~topics_of_stages(HD_OBSERVE_ANY & ~hd_observe_of(of));
}

unsigned topic_stages(unsigned set)
{
    unsigned stages = 0;
    for (topic t = 0; t < TOPICS; t++)
        if (set & topic_bit(t)) stages |= topics[t].stages;
    return stages;
}
