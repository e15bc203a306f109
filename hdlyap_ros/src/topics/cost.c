/** Times and counters of the run -> message Cost. */
#include "topics/moment.h"

_Static_assert((int)HD_LIMIT_NONE == (int)HDR_COST_LIMIT_NONE, "limits as in the core");

hd_status topic_publish_cost(const moment *now)
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
        .covariant_seconds = cost->following,
        .publish_seconds = now->seconds,
        .waiting_seconds = now->waited,
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
    return topic_send_cost(now->out, &message);
}
