/** Whole runs, as tests make them. */
#ifndef HD_RUNS_H
#define HD_RUNS_H

#include <math.h>

#include "run/run_state.h"
#include "testing.h"

static inline hd_run *created(const hd_scene_def *scene)
{
    hd_run *run = NULL;
    CHECK_OK(hd_run_create(&run, scene, NULL, 0));
    return run;
}

/** Behind the controller's back: where an interval would be planned, one of this length, within the
 * stage. */
static inline void force_interval(hd_run *run, double length)
{
    if (run->log->duration > 0) return;
    run->interval_end = fmin(hd_run_time(run) + length, hd_schedule_stage_end(&run->schedule));
    run->sample.ends = true;
}

#endif
