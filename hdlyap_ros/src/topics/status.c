/** How far the run has got -> message RunStatus. */
#include "topics/moment.h"

_Static_assert((int)HD_FINISHED == (int)HDR_RUN_STATUS_FINISHED, "stages as in the core");

hd_status topic_publish_status(const moment *now)
{
    const progress *last = now->last;
    hdr_run_status message = {
        .sim_time = last->time,
        .stage = (uint8_t)last->stage,
        .progress = last->cost.progress,
        .remaining_seconds = last->cost.remaining,
        .std_error = last->cost.std_error,
        .target = last->cost.target.name,
        .target_error = last->cost.target.error,
        .target_wanted = last->cost.target.wanted,
        .caged = last->caged,
        .energy_error = last->energy.error,
        .energy_error_most = last->energy.most,
        .energy_error_wanted = last->energy.asked,
        .warning = now->set->warning,
    };
    return topic_send_status(now->out, &message);
}
