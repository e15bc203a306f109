/** What a run says of its own time, by a clock that the test moves. */
#include "base/clock.h"
#include "runs.h"

static double now;  /* seconds */
static double tick; /* by which each look moves it on */

/** In place of the core's. */
double hd_clock_now(void) { return now += tick; }

enum {
    SINCE = 100,
    EQUILIBRATION = 5,
    END = 55,
    SECONDS = 3 /* for a time unit, with the frame */
};

static hd_run *started(double by)
{
    now = SINCE;
    tick = by;
    return created(scene(.number = 20, .density = 0.7, .aspect = 1.0,
                         .exponents = HD_EXPONENTS_POSITIVE, .equilibration = EQUILIBRATION,
                         .warmup = 10.0, .duration = END - 10.0 - EQUILIBRATION,
                         .report_interval = 1.0));
}

/** Of sums of intervals, relative. */
static const double ROUNDING = 1e-10;

/** As the frame is carried at one pace, what is predicted is what is taken. */
TEST(the_rest_takes_what_the_frame_has_taken)
{
    OWNED(hd_run) *run = started(0.0);
    while (going_on(run)) {
        const double time = hd_run_time(run);
        const double taken = fmax(time - EQUILIBRATION, 0.0) * SECONDS;
        now = SINCE + taken;
        const hd_cost cost = hd_run_cost(run);
        CHECK_CLOSE(cost.wall, taken, ROUNDING * END * SECONDS);
        CHECK_CLOSE(cost.progress, time / END, ROUNDING);
        CHECK_CLOSE(cost.remaining, time > EQUILIBRATION ? SECONDS * (END - time) : -1.0,
                    ROUNDING * SECONDS * END);
    }
}

/** What is observed of a sample, and at a report, is of the modes: a second for each. */
TEST(observables_have_their_seconds)
{
    long samples = 0, reports = 0;
    now = SINCE;
    tick = 1.0;
    OWNED(hd_run) *run = created(scene(.number = 20, .density = 0.7, .aspect = 1.0,
                                       .exponents = HD_EXPONENTS_POSITIVE, .equilibration = 1.0,
                                       .warmup = 10.0, .duration = 20.0, .report_interval = 1.0,
                                       .observe = HD_OBSERVE_HYDRO));
    while (going_on(run)) {
        const bool averaged = hd_spectrum_time(hd_run_spectrum(run)) > 0;
        reports += averaged && hd_run_report_due(run);
        samples = hd_modes_samples(hd_run_modes(run));
    }
    assert_true(samples >= 20 && reports == 20);
    CHECK_CLOSE(hd_run_cost(run).modes, (double)(samples + reports), 0.0);
}

/** Each stage looks at the clock before and after: it takes a second each time that it runs. At a
 * report of the averaging the run also looks where the particles are. */
TEST(each_stage_has_its_own_seconds)
{
    OWNED(hd_run) *run = started(1.0);
    long advances = 0, reports = 0;
    while (going_on(run)) {
        advances++;
        reports += hd_spectrum_time(hd_run_spectrum(run)) > 0 && hd_run_report_due(run);
    }
    const hd_cost cost = hd_run_cost(run);
    const double intervals = (double)cost.orthonormalisations;
    assert_true(intervals > 10 && intervals < (double)advances);
    CHECK_CLOSE(cost.events, (double)(advances + reports), 0.0);
    CHECK_CLOSE(cost.replay, intervals, 0.0);
    CHECK_CLOSE(cost.ortho, intervals, 0.0);
    CHECK_CLOSE(cost.spectrum, intervals, 0.0);
    CHECK_CLOSE(cost.modes + cost.following + cost.communication, 0.0, 0.0);
    CHECK_CLOSE(cost.events_per_second * cost.events,
                (double)hd_trajectory_totals(hd_run_trajectory(run)).collisions, 1e-6);
}

static bool errors_stall;

/** In place of the core's: once they stall, errors stay what they are. */
double __wrap_hd_spectrum_largest_error(const hd_spectrum *spectrum, int begin, int end)
{
    (void)begin, (void)end;
    return errors_stall ? 0.25 : 1.0 / sqrt(fmax(hd_spectrum_time(spectrum), 1e-3));
}

/** The run knows since when its errors do not fall; not any more once its averages begin anew. */
TEST(errors_that_do_not_fall_are_told)
{
    hd_scene_def def = scene(.number = 20, .density = 0.7, .aspect = 1.0,
                             .exponents = HD_EXPONENTS_POSITIVE, .equilibration = 1.0,
                             .warmup = 10.0, .duration = 2000.0, .report_interval = 1.0);
    hd_run *run = until(created(def), HD_AVERAGING);
    until_time(run, 11.0 + 400.0);
    CHECK_CLOSE(hd_run_cost(run).stalled_since, -1.0, 0.0);
    errors_stall = true;
    until_time(run, 11.0 + 1950.0);
    const hd_cost cost = hd_run_cost(run);
    const double averaged = hd_spectrum_time(hd_run_spectrum(run));
    CHECK_CLOSE(cost.std_error, 0.25, 0.0);
    assert_true(cost.stalled_since > 0.0 && 8.0 * cost.stalled_since <= averaged);
    CHECK_CLOSE(cost.stalled_error, 1.0 / sqrt(cost.stalled_since), 1e-12);
    CHECK_OK(hd_run_reset_average(run));
    CHECK_CLOSE(hd_run_cost(run).stalled_since, -1.0, 0.0);
    hd_run_free(run);
    errors_stall = false;
}
