/** Whole runs, as tests make them. */
#ifndef HD_RUNS_H
#define HD_RUNS_H

#include "run/run_state.h"
#include "testing.h"

static inline hd_run *created(hd_scene_def scene)
{
    hd_run *run = NULL;
    CHECK_OK(hd_run_create(&run, &scene, NULL, 0));
    return run;
}

/** Goes on to that stage. Returns the run. */
static inline hd_run *until(hd_run *run, hd_stage stage)
{
    while (hd_run_stage(run) < stage) CHECK_OK(hd_run_advance(run));
    return run;
}

static inline hd_run *finish(hd_run *run) { return until(run, HD_FINISHED); }

static inline hd_run *finished(hd_scene_def scene) { return finish(created(scene)); }

/** Goes on to that simulated time, or to the end. */
static inline void until_time(hd_run *run, double time)
{
    while (hd_run_time(run) < time && hd_run_stage(run) != HD_FINISHED)
        CHECK_OK(hd_run_advance(run));
}

/** Goes on to the end of another interval. False at the end of the run: while (going_on(run)) .. */
static inline bool going_on(hd_run *run)
{
    if (hd_run_stage(run) == HD_FINISHED) return false;
    CHECK_OK(hd_run_advance(run));
    return true;
}

/** All exponents of both runs, apart by no more than this. */
static inline void check_same_exponents(const hd_run *a, const hd_run *b, double tolerance)
{
    assert_int_equal(hd_run_vectors(a), hd_run_vectors(b));
    for (int col = 0; col < hd_run_vectors(a); col++)
        CHECK_CLOSE(hd_spectrum_exponent(hd_run_spectrum(a), col),
                    hd_spectrum_exponent(hd_run_spectrum(b), col), tolerance);
}

/** Of a run that several ranks carry, and of one alone: frames differ by rounding, the record is
 * the same bits. */
static inline void check_same_run(const hd_run *run, const hd_run *alone)
{
    const hd_scene_def *scene = hd_run_scene(run);
    const size_t count = (size_t)(hd_scene_coordinates(scene) * scene->number);
    HEAP double *q = calloc(2 * count, sizeof *q);
    check_same_exponents(run, alone, hd_run_cost(run).error_bound + hd_run_cost(alone).error_bound);
    hd_trajectory_state(hd_run_trajectory(run), q, NULL);
    hd_trajectory_state(hd_run_trajectory(alone), q + count, NULL);
    assert_memory_equal(q, q + count, count * sizeof *q);
    for (int col = 0; col < hd_run_vectors(run); col++)
        CHECK_CLOSE(hd_localization_widths(hd_run_localization(run))[col],
                    hd_localization_widths(hd_run_localization(alone))[col], 1e-6);
}

/** Behind the controller's back: where an interval would be planned, one of this length, within the
 * stage. */
static inline void force_interval(hd_run *run, double length)
{
    if (run->carrier.record->duration > 0) return;
    run->agenda.interval_end = fmin(hd_run_time(run) + length, hd_agenda_stage_end(&run->agenda));
    run->agenda.sample_ends = true;
}

#endif
