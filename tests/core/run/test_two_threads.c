/** All that is computed in parallel, with two threads: what one gives. Small enough for the thread
 * sanitizer, which has to see every parallel loop. */
#include "runs.h"

/** More vectors than one block of any parallel loop holds: 128 of the modes, 64 of the frame. */
enum { DISKS = 70, VECTORS = 2 * DISKS - 3 };

/** A box so long that LP pairs are found, and somebody who watches the vectors. */
static hd_run *run_with(int threads)
{
    hd_run *run = NULL;
    run = created(scene(.number = DISKS, .density = 0.8, .aspect = 0.06, .equilibration = 5.0,
                        .warmup = 15.0, .duration = 8.0, .report_interval = 0.1,
                        .observe = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES, .threads = threads));
    hd_run_watch(run, 0.5);
    while (going_on(run)) CHECK_OK(hd_run_measure(run, VECTORS - 8));
    assert_int_equal(hd_run_vectors(run), VECTORS);
    return run;
}

/** As accurate as asked; of vectors that belong to one step the differences add up, in less than
 * 100 orthonormalisations, each by eps times the condition, which the accuracy bounds. */
static const double ACCURACY = 1e-8, SAME = 100 * 1e-8;

TEST(two_threads_give_what_one_gives)
{
    hd_run *run[2] = {run_with(1), run_with(2)};
    double theta[2][VECTORS], ratio[2][VECTORS];
    for (int k = 0; k < 2; k++) {
        assert_int_equal(hd_run_threads(run[k]), k + 1);
        assert_true(hd_run_cost(run[k]).slow_vector_samples > 0);
        assert_true(hd_run_cost(run[k]).orthonormalisations < 100);
        hd_frame_dq_dp(hd_run_frame(run[k]), theta[k], ratio[k]);
    }
    for (int col = 0; col < VECTORS; col++) {
        CHECK_CLOSE(hd_spectrum_exponent(hd_run_spectrum(run[1]), col),
                    hd_spectrum_exponent(hd_run_spectrum(run[0]), col), ACCURACY);
        CHECK_CLOSE(theta[1][col], theta[0][col], SAME);
        CHECK_CLOSE(ratio[1][col], ratio[0][col], SAME * ratio[0][col]);
    }
    assert_int_equal(hd_trajectory_totals(hd_run_trajectory(run[0])).collisions,
                     hd_trajectory_totals(hd_run_trajectory(run[1])).collisions);
    for (int k = 0; k < 2; k++) hd_run_free(run[k]);
}

/** The bits of a run depend on how many threads were chosen for it, not on how. */
static void expect_repeatable(int disks)
{
    hd_run *run[2];
    hd_scene_def scene = scene(.number = disks, .density = 0.8, .aspect = 1.0, .equilibration = 0.0,
                               .warmup = 0.0, .duration = 0.2, .report_interval = 0.2);
    for (int k = 0; k < 2; k++) {
        if (k == 1) scene.threads = hd_run_threads(run[0]);
        run[k] = finished(scene);
    }
    const size_t size = (size_t)hd_frame_rows(hd_run_frame(run[0])) *
                        (size_t)hd_frame_stride(hd_run_frame(run[0]));
    assert_memory_equal(hd_frame_read(hd_run_frame(run[0])), hd_frame_read(hd_run_frame(run[1])),
                        size * sizeof(double));
    for (int k = 0; k < 2; k++) hd_run_free(run[k]);
}

/** Of frames that are worth a trial, and one that is not. */
TEST(what_was_tried_does_not_show)
{
    static const int disks[] = {60, 120, 150, 300};
    for (int k = 0; k < 4; k++) expect_repeatable(disks[k]);
}
