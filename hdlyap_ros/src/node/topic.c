/** The node's own topics. */
#include "topic.h"

#include <stdio.h>
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
    [TOPIC_T_PHASES] = {"t_phases", HD_OBSERVE_T_PHASES},
    [TOPIC_FIELDS] = {"fields", HD_OBSERVE_FIELDS},
    [TOPIC_HYDRO] = {"hydro", HD_OBSERVE_HYDRO},
    [TOPIC_STRUCTURE] = {"structure", HD_OBSERVE_STRUCTURE},
    [TOPIC_COVARIANT] = {"covariant", HD_OBSERVE_COVARIANT},
    [TOPIC_LOCALIZATION] = {"localization", HD_OBSERVE_LOCALIZATION},
    [TOPIC_GAS] = {"gas", HD_OBSERVE_GAS},
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

unsigned topics_of_stages(unsigned stages)
{
    unsigned set = 0;
    for (topic t = 0; t < TOPICS; t++)
        if (topics[t].stage & stages) set |= topic_bit(t);
    return set;
}

unsigned topic_stages(unsigned set)
{
    unsigned stages = 0;
    for (topic t = 0; t < TOPICS; t++)
        if (set & topic_bit(t)) stages |= topics[t].stage;
    return stages;
}
