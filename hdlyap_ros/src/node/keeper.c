/** Settings and run -> checkpoints. */
#include "keeper.h"

#include <math.h>

#include "clock.h"
#include "hdlyap_ros/node.h"

static double next_due(const settings *set)
{
    const bool periodic = *set->checkpoint && set->checkpoint_interval > 0.0;
    return periodic ? clock_seconds() + set->checkpoint_interval : INFINITY;
}

keeper keeper_of(const settings *set)
{
    return (keeper){.set = set, .due = next_due(set), .state = {.time = -1.0}};
}

bool keeper_due(const keeper *k) { return k->due < INFINITY && clock_seconds() >= k->due; }

void keeper_save(keeper *k, hd_run *run)
{
    const settings *set = k->set;
    kept *state = &k->state;
    if (!*set->checkpoint) return;
    const bool failed = hd_run_save(run, set->checkpoint, set->scene, state->message,
                                    sizeof state->message) != HD_OK;
    if (failed) hdr_log(HDR_ERROR, "checkpoint not written: %s", state->message);
    if (!failed && state->failed) hdr_log(HDR_INFO, "checkpoint written again");
    if (!failed) state->time = hd_run_time(run);
    state->failed = failed;
    k->due = next_due(set);
}
