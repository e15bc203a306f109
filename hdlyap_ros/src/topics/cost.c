/** What the run pays for -> Cost. */
#include "topics/moment.h"

_Static_assert((int)HD_LIMIT_NONE == (int)HDR_COST_LIMIT_NONE, "limits as in the core");

static topic_size size_of(const extent *e)
{
    (void)e;
    return (topic_size){.report = HDR_COST_BYTES};
}

static hd_status publish(const moment *now, void *state)
{
    const hd_cost *cost = &now->last->cost;
    hdr_cost message = {
        .sim_time = now->last->time,
        .wall_seconds = cost->wall,
        .events_seconds = cost->events,
        .replay_seconds = cost->replay,
        .ortho_seconds = cost->ortho,
        .spectrum_seconds = cost->spectrum,
        .modes_seconds = cost->modes,
        .covariant_seconds = cost->covariant,
        .publish_seconds = now->seconds,
        .events_per_second = cost->events_per_second,
        .interval = cost->interval,
        .interval_limit = (uint8_t)cost->limit,
        .condition = cost->condition,
        .orthogonality_defect = cost->defect,
        .error_bound = cost->error_bound,
        .orthonormalisations = (uint64_t)cost->orthonormalisations,
        .second_passes = (uint64_t)cost->second_passes,
        .slow_vector_samples = (uint64_t)cost->slow_vector_samples,
        .repairs = (uint64_t)cost->repairs,
        .communication_seconds = cost->communication,
        .communication_bytes = cost->bytes,
        .communication_calls = cost->calls,
    };
    (void)state;
    return topic_send_cost(now->out, &message);
}

const topic_maker topic_cost = {.size = size_of, .publish = publish};
