/** Lengths of the arrays in messages -> bytes. */
#include "topics/extent.h"

#include "hdlyap_ros/messages.h"

hd_result_counts extent_of(const settings *set, hd_result_counts of_run)
{
    if (set->fields.count == 0) return of_run;
    of_run.examples = set->fields.count; /* which steps these belong to is not known yet */
    of_run.pairs = HD_MODULATIONS_IN(of_run.dimension) * set->fields.count;
    return of_run;
}

topic_size topic_size_of(topic t, const hd_result_counts *e)
{
    const topic_size sizes[TOPICS] = {
#define TOPIC(name, type, stages, is, ...) [TOPIC_##name] = {__VA_ARGS__},
#include "topics/rows.inc"
#undef TOPIC
    };
    return sizes[t];
}
