/** Between measured states a run orthonormalises in the norm of dq: nothing that is read of it may
 * show that [T5]. */
#include "runs.h"

enum { DISKS = 40, VECTORS = 2 * DISKS - 3 };

static hd_scene_def endless(unsigned observe)
{
    return scene(.number = DISKS, .density = 0.7, .aspect = 1.0, .equilibration = 10.0,
                 .warmup = 20.0, .duration = 800.0, .report_interval = 0.5, .observe = observe,
                 .threads = 1);
}

/** To the end; the number of orthonormalisations of the averaging that left the norm of dq. */
static int finish_counting(hd_run *run)
{
    int dq = 0;
    for (long before = 0; hd_run_stage(run) != HD_FINISHED;) {
        CHECK_OK(hd_run_advance(run));
        const long now = hd_run_cost(run).orthonormalisations;
        dq += now > before && hd_run_stage(run) == HD_AVERAGING && !run->carrier.whole;
        before = now;
    }
    return dq;
}

/** The twin is orthonormalised in the whole norm at every report: its hydrodynamic response is
 * looked at. */
TEST(exponents_do_not_depend_on_it)
{
    OWNED(hd_run) *run = created(endless(0)),
                  *twin = created(endless(HD_OBSERVE_MODES | HD_OBSERVE_STEPS | HD_OBSERVE_HYDRO));
    const int with = finish_counting(run), without = finish_counting(twin);
    assert_true(with > 40);
    assert_int_equal(without, 0);
    const double bound = hd_run_cost(run).error_bound + hd_run_cost(twin).error_bound;
    check_same_exponents(run, twin, bound);
}

/** Angles and ratios of the halves are those of the last measured state, like the averages, and not
 * those of the frame that stands there. */
TEST(halves_are_those_of_the_measured_state)
{
    OWNED(hd_run) *run = created(endless(0));
    double want[2][VECTORS], got[2][VECTORS], frame[2][VECTORS];
    int between = 0;
    while (hd_run_time(run) < 400.0) { /* samples of a young run are single intervals */
        CHECK_OK(hd_run_advance(run));
        if (hd_run_stage(run) != HD_AVERAGING) continue;
        hd_frame_dq_dp(hd_run_frame(run), frame[0], frame[1]);
        if (hd_run_time(run) == run->agenda.sample_begin) memcpy(want, frame, sizeof want);
        hd_run_dq_dp(run, got[0], got[1]);
        for (int half = 0; half < 2; half++)
            for (int col = 0; col < VECTORS; col++)
                CHECK_CLOSE(got[half][col], want[half][col], 0.0);
        between += !run->carrier.whole && fabs(frame[0][VECTORS - 1] - got[0][VECTORS - 1]) > 1e-6;
    }
    assert_true(between > 20);
}
