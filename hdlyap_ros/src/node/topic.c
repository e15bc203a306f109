/** The node's own topics. */
#include "topic.h"

#include <string.h>

static const char *const names[TOPICS] = {
    [TOPIC_RUN_INFO] = "run_info",
    [TOPIC_SPECTRUM] = "spectrum",
    [TOPIC_STATE] = "state",
    [TOPIC_COST] = "cost",
};

const char *topic_name(topic t) { return names[t]; }

unsigned topic_bit_of(const char *name)
{
    for (topic t = 0; t < TOPICS; t++)
        if (strcmp(names[t], name) == 0) return topic_bit(t);
    return 0;
}
