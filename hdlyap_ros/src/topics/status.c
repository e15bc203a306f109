/** How far the run is -> RunStatus. */
#include "topics/moment.h"

_Static_assert((int)HD_FINISHED == (int)HDR_RUN_STATUS_FINISHED, "stages as in the core");

static topic_size size_of(const extent *e)
{
    (void)e;
    return (topic_size){.report = HDR_RUN_STATUS_BYTES};
}

static hd_status publish(const moment *now, void *state)
{
    const progress *last = now->last;
    hdr_run_status message = {
        .sim_time = last->time,
        .stage = (uint8_t)last->stage,
        .progress = last->cost.progress,
        .remaining_seconds = last->cost.remaining,
        .std_error = last->cost.std_error,
    };
    (void)state;
    return topic_send_status(now->out, &message);
}

const topic_maker topic_status = {.size = size_of, .publish = publish};
