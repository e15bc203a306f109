/** Lengths of the arrays in messages -> bytes. */
#include "topics/extent.h"

#include "hdlyap/scene.h"
#include "hdlyap_ros/messages.h"

hd_result_counts extent_of(const settings *set, hd_result_counts of_run)
{
    if (set->fields.count == 0) return of_run;
    of_run.examples = set->fields.count; /* which steps these belong to is not known yet */
    of_run.pairs = HD_MODULATIONS_IN(of_run.dimension) * set->fields.count;
    return of_run;
}

static hdr_lengths lengths_of(const hd_result_counts *e)
{
    const bool box = e->dimension > 0;
    return (hdr_lengths){.angle = e->angles,
                         .average = e->averages,
                         .bin = HD_ANGLE_BINS,
                         .coordinate = (double)e->coordinates * e->particles,
                         .kind = HD_KINDS_MAX,
                         .modulation = HD_MODULATIONS_IN(e->dimension),
                         .order = e->orders,
                         .pair = e->examples > 0 ? (double)e->pairs / e->examples : 0.0,
                         .particle = e->particles,
                         .phase = e->phases,
                         .resolved = e->found,
                         .response = e->responses,
                         .site = HD_SITES_MAX,
                         .step = e->steps,
                         .subspace = e->subspaces,
                         .t_phase = e->t_phases,
                         .growth_time = e->times,
                         .transverse = HD_TRANSVERSE_IN(e->dimension),
                         .vector = e->vectors,
                         .wave = e->waves,
                         .box = box,
                         .others = !box || e->coordinates > e->dimension + e->turning,
                         .space = e->dimension == 3,
                         .turning = e->turning};
}

topic_size topic_size_of(topic t, const hd_result_counts *e)
{
    const hdr_lengths n = lengths_of(e);
    const hdr_size sizes[TOPICS] = {
#define TOPIC(name, type, stages, is) [TOPIC_##name] = hdr_##type##_size(&n),
#include "topics/rows.inc"
#undef TOPIC
    };
    const hdr_size size = sizes[t];
    if (topic_is(t, TOPIC_ONCE | TOPIC_FOR_VIEWERS)) return (topic_size){.report = 0.0};
    if (topic_is(t, TOPIC_OF_WINDOWS)) return (topic_size){.window = size.always};
    if (topic_is(t, TOPIC_OF_FIELDS))
        return (topic_size){.fields = e->examples * size.always, .messages = e->examples};
    return (topic_size){.report = size.always, .fields = size.fields};
}
