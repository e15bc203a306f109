/** The node's own topics. */
#include "topic.h"

#include <string.h>

#include "hdlyap/scene.h"

static const struct {
    const char *name;
    unsigned stage;
} topics[TOPICS] = {
    [TOPIC_RUN_INFO] = {"run_info", 0},
    [TOPIC_SPECTRUM] = {"spectrum", 0},
    [TOPIC_MODES] = {"modes", HD_OBSERVE_MODES},
    [TOPIC_STEPS] = {"steps", HD_OBSERVE_STEPS},
    [TOPIC_LP_PHASES] = {"lp_phases", HD_OBSERVE_PHASES},
    [TOPIC_FIELDS] = {"fields", HD_OBSERVE_FIELDS},
    [TOPIC_HYDRO] = {"hydro", HD_OBSERVE_HYDRO},
    [TOPIC_COVARIANT] = {"covariant", HD_OBSERVE_COVARIANT},
    [TOPIC_STATE] = {"state", 0},
    [TOPIC_STATUS] = {"status", 0},
    [TOPIC_COST] = {"cost", 0},
};

const char *topic_name(topic t) { return topics[t].name; }

unsigned topic_bit_of(const char *name)
{
    for (topic t = 0; t < TOPICS; t++)
        if (strcmp(topics[t].name, name) == 0) return topic_bit(t);
    return 0;
}

unsigned topic_stages(unsigned set)
{
    unsigned stages = 0;
    for (topic t = 0; t < TOPICS; t++)
        if (set & topic_bit(t)) stages |= topics[t].stage;
    return stages;
}
