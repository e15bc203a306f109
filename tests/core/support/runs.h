/** Whole runs, as tests make them. */
#ifndef HD_RUNS_H
#define HD_RUNS_H

#include "hdlyap/run.h"
#include "testing.h"

static inline hd_run *created(const hd_scene_def *scene)
{
    hd_run *run = NULL;
    CHECK_OK(hd_run_create(&run, scene, NULL, 0));
    return run;
}

#endif
