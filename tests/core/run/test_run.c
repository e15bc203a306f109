/** Whole runs: the schedule, intervals that were too long, restarts of the average, what is
 * allocated. Their interval is set by hand: no caller can make it too long. */
#include "base/memory.h"
#include "run/run_state.h"

#include "testing.h"
#include "runs.h"

static hd_scene_def small(int disks, int exponents)
{
    return scene(.disks = disks, .density = 0.7, .aspect = 1.0, .exponents = exponents,
                 .equilibration = 10.0, .warmup = 10.0, .duration = 20.0);
}

/** Largest difference between the exponents of two runs. */
static double deviation(const hd_run *a, const hd_run *b)
{
    double worst = 0.0;
    assert_int_equal(a->carrier.vectors, b->carrier.vectors);
    for (int col = 0; col < a->carrier.vectors; col++) {
        const double off = fabs(hd_spectrum_exponent(a->carrier.spectrum, col) -
                                hd_spectrum_exponent(b->carrier.spectrum, col));
        assert_true(isfinite(off));
        worst = fmax(worst, off);
    }
    return worst;
}

TEST(reports_come_on_time)
{
    hd_scene_def scene = small(12, 3);
    scene.report_interval = 0.7; /* does not divide the phases */
    hd_run *run = created(&scene);
    static const double phase_start[] = {0.0, 10.0, 20.0};
    int reports[4] = {0};
    while (hd_run_stage(run) != HD_FINISHED) {
        const hd_stage phase = hd_run_stage(run);
        CHECK_OK(hd_run_advance(run));
        if (!hd_run_report_due(run)) continue;
        reports[phase]++;
        const double end = phase_start[phase] + (phase == HD_AVERAGING ? 20.0 : 10.0);
        const double want = fmin(phase_start[phase] + 0.7 * reports[phase], end);
        CHECK_CLOSE(hd_run_time(run), want, 1e-12);
        CHECK_CLOSE(hd_trajectory_time(hd_run_trajectory(run)), hd_run_time(run), 0.0);
    }
    assert_int_equal(reports[HD_EQUILIBRATING], 15);
    assert_int_equal(reports[HD_WARMING_UP], 15);
    assert_int_equal(reports[HD_AVERAGING], 29);
    CHECK_CLOSE(hd_run_time(run), 40.0, 0.0);
    CHECK_CLOSE(hd_spectrum_time(hd_run_spectrum(run)), 20.0, 1e-11);
    CHECK_OK(hd_run_advance(run)); /* nothing more */
    CHECK_CLOSE(hd_run_time(run), 40.0, 0.0);
    hd_run_free(run);
}

TEST(without_exponents_there_is_no_frame)
{
    hd_scene_def scene = small(200, HD_EXPONENTS_NONE);
    hd_run *run = created(&scene);
    assert_null(hd_run_frame(run));
    assert_null(hd_run_spectrum(run));
    assert_null(run->carrier.log);
    finish(run);
    assert_true(hd_trajectory_collisions(hd_run_trajectory(run)) > 1000);
    CHECK_CLOSE(run->cost.replay + run->cost.ortho, 0.0, 0.0);
    hd_run_free(run);
}

/** To which the twin with an interval of 0.05 is known itself. */
static const double EXACT = 1e-13;

/** Whatever interval is asked for: the exponents of the exact factorisation, to the accuracy asked.
 */
TEST(any_interval_gives_the_same_spectrum)
{
    static const double intervals[] = {0.0, 0.01, 0.3, 1.0, 8.0, 50.0};
    static const double accuracies[] = {1e-4, 1e-8, 1e-10};
    for (int all = 0; all < 2; all++) {
        hd_scene_def scene = small(24, all ? HD_EXPONENTS_ALL : HD_EXPONENTS_POSITIVE);
        scene.interval = 0.05;
        scene.accuracy = 1e-12;
        hd_run *exact = finished(&scene);
        for (size_t k = 0; k < 6 * 3; k++) {
            scene.interval = intervals[k % 6];
            scene.accuracy = accuracies[k / 6];
            scene.report_interval = k % 2 ? 1.0 : 10.0;
            hd_run *run = finished(&scene);
            const double off = deviation(run, exact);
            if (k % 6 == 4)
                print_message("interval 8, accuracy %.0e: %.3f used, deviation %.1e, bound %.1e\n",
                              scene.accuracy, run->cost.interval, off,
                              hd_run_cost(run).error_bound);
            assert_true(off <= scene.accuracy);
            assert_true(off <= hd_run_cost(run).error_bound + EXACT);
            hd_run_free(run);
        }
        hd_run_free(exact);
    }
}

/** From the eighth interval of the averaging on; thin, dense, accurate. */
TEST(the_bound_keeps_to_the_accuracy)
{
    const struct {
        double density, report, accuracy;
        uint64_t seed;
    } cases[] = {{0.2, 10.0, 1e-8, 4}, {0.8, 1.0, 1e-8, 3}, {0.8, 1.0, 1e-10, 3}};
    for (int k = 0; k < 3; k++) {
        hd_scene_def scene = scene(.disks = 100, .density = cases[k].density,
                                   .report_interval = cases[k].report,
                                   .accuracy = cases[k].accuracy, .seed = cases[k].seed,
                                   .duration = 100.0);
        hd_run *run = until(created(&scene), HD_AVERAGING);
        const long before = hd_run_cost(run).orthonormalisations;
        double worst = 0.0;
        while (going_on(run)) {
            const hd_cost cost = hd_run_cost(run);
            if (cost.orthonormalisations >= before + 8) worst = fmax(worst, cost.error_bound);
        }
        print_message("density %.1f, accuracy %.0e: bound up to %.2f of it, at the end %.2f\n",
                      scene.density, scene.accuracy, worst / scene.accuracy,
                      hd_run_cost(run).error_bound / scene.accuracy);
        assert_true(worst > 0.0 && worst <= scene.accuracy);
        hd_run_free(run);
    }
}

/** No interval of the averaging is shorter than the reports are apart: where its end and a report
 * were the same but for rounding (of 20 + 0.05 + 0.1, say), a crumb was left, and some 28 intervals
 * to grow from it. */
TEST(no_crumbs_are_left_at_reports)
{
    const double reports[] = {0.05, 0.1, 0.5};
    for (int k = 0; k < 30; k++) {
        hd_scene_def scene = scene_from(small(12, HD_EXPONENTS_POSITIVE),
                                        .report_interval = reports[k % 3], .warmup = 2.0 * (k + 1),
                                        .duration = 80.0, .observe = 0);
        hd_run *run = until(created(&scene), HD_AVERAGING);
        double shortest = INFINITY;
        while (going_on(run)) {
            shortest = fmin(shortest, hd_run_cost(run).interval);
        }
        CHECK_CLOSE(shortest, fmax(shortest, scene.report_interval), 1e-9);
        hd_run_free(run);
    }
}

/** Forced behind the controller's back: noticed, taken back, replayed in pieces. */
TEST(an_interval_too_long_is_repaired)
{
    hd_scene_def scene = scene_from(small(40, HD_EXPONENTS_POSITIVE), .report_interval = 10.0);
    hd_run *exact = finished(&scene);
    for (double forced = 4.0; forced <= 64.0; forced *= 2.0) {
        scene.report_interval = 20.0;
        hd_run *run = until(created(&scene), HD_AVERAGING);
        force_interval(run, forced);
        finish(run);
        print_message("forced %.0f: %ld repaired, deviation %.1e\n", forced, run->cost.repairs,
                      deviation(run, exact));
        assert_true(run->cost.repairs > 0);
        assert_true(deviation(run, exact) <= scene.accuracy);
        hd_run_free(run);
    }
    hd_run_free(exact);
}

TEST(threads_do_not_change_the_physics)
{
    hd_scene_def scene = small(60, HD_EXPONENTS_POSITIVE);
    hd_run *run[3];
    for (int k = 0; k < 3; k++) {
        scene.threads = k == 1 ? 2 : 1;
        run[k] = finished(&scene);
    }
    assert_true(deviation(run[0], run[1]) < scene.accuracy);
    CHECK_CLOSE(deviation(run[0], run[2]), 0.0, 0.0); /* the same number: the same bits */
    assert_int_equal(hd_trajectory_collisions(run[0]->advance.trajectory),
                     hd_trajectory_collisions(run[1]->advance.trajectory));
    for (int k = 0; k < 3; k++) hd_run_free(run[k]);
}

TEST(the_loop_allocates_nothing)
{
    hd_scene_def scene = scene_from(small(40, HD_EXPONENTS_POSITIVE), .duration = 300.0);
    hd_run *run = until(created(&scene), HD_AVERAGING);
    until_time(run, 120.0); /* the log has grown to its size */
    const size_t before = hd_memory_allocations();
    finish(run);
    assert_true(hd_memory_allocations() - before <=
                2); /* a still longer log: itself and its maps */
    hd_run_free(run);
}

TEST(the_average_can_start_afresh)
{
    hd_scene_def scene = small(12, 4);
    hd_run *run = until(created(&scene), HD_AVERAGING);
    CHECK_OK(hd_run_reset_average(run)); /* at its very start: nothing changes */
    until_time(run, 25.0 || !hd_run_report_due(run));
    const double at = hd_run_time(run);
    CHECK_OK(hd_run_reset_average(run));
    CHECK_CLOSE(hd_spectrum_time(hd_run_spectrum(run)), 0.0, 0.0);
    finish(run);
    CHECK_CLOSE(hd_run_time(run), at + scene.duration, 1e-12);
    CHECK_CLOSE(hd_spectrum_time(hd_run_spectrum(run)), scene.duration, 1e-11);
    hd_run_free(run);
}

TEST(the_target_error_ends_the_run)
{
    hd_scene_def scene = small(12, HD_EXPONENTS_POSITIVE);
    scene.duration = 0.0; /* endless otherwise */
    scene.target_std_error = 0.02;
    hd_run *run = finished(&scene);
    for (int col = run->carrier.vectors - 8; col < run->carrier.vectors; col++) {
        const double error = hd_spectrum_std_error(run->carrier.spectrum, col);
        assert_true(error > 0 && error <= 0.02);
    }
    hd_run_free(run);
}

/** What was predicted after a tenth of the averaged time, over what it took. */
static double predicted_over_taken(uint64_t seed)
{
    static double averaged[20000], total[20000];
    hd_scene_def scene = scene_from(small(16, HD_EXPONENTS_POSITIVE), .warmup = 50.0,
                                    .duration = 0.0, .target_std_error = 0.005, .seed = seed);
    hd_run *run = until(created(&scene), HD_AVERAGING);
    int count = 0, tenth = 0;
    while (going_on(run)) {
        if (!hd_run_report_due(run) || count == 20000) continue;
        averaged[count] = hd_spectrum_time(run->carrier.spectrum);
        const double progress = hd_run_cost(run).progress;
        total[count++] = progress > 0 ? hd_run_time(run) / progress : 0.0; /* 0: not yet known */
    }
    const double taken = hd_run_time(run);
    while (averaged[tenth] < 0.1 * averaged[count - 1]) tenth++;
    hd_run_free(run);
    return total[tenth] / taken;
}

/** Errors are known to some ten percent after a tenth of the time, so the time to some twenty:
 * three of four runs end within 30 % of what was said. */
TEST(the_time_to_the_target_is_predicted)
{
    int right = 0;
    for (uint64_t seed = 1; seed <= 8; seed++) {
        const double ratio = predicted_over_taken(seed);
        print_message("predicted after a tenth: %.2f of what it took\n", ratio);
        right += fabs(ratio - 1.0) <= 0.3;
    }
    assert_true(right >= 6);
}

TEST(progress_and_cost_add_up)
{
    hd_scene_def scene = small(40, HD_EXPONENTS_POSITIVE);
    hd_run *run = created(&scene);
    double progress = 0.0;
    assert_true(hd_run_cost(run).remaining < 0); /* not known before the frame has been carried */
    while (going_on(run)) {
        const hd_cost cost = hd_run_cost(run);
        assert_true(cost.progress >= progress && cost.progress <= 1.0);
        progress = cost.progress;
        if (hd_run_stage(run) == HD_AVERAGING) assert_true(cost.remaining >= 0);
    }
    const hd_cost cost = hd_run_cost(run);
    CHECK_CLOSE(cost.progress, 1.0, 0.0);
    CHECK_CLOSE(cost.remaining, 0.0, 0.0);
    assert_true(cost.events + cost.replay + cost.ortho + cost.spectrum <= cost.wall);
    assert_true(cost.orthonormalisations > 0 && cost.events_per_second > 0);
    hd_run_free(run);
}

TEST(what_is_impossible_is_refused_by_name)
{
    hd_scene_def scene = small(12, 49);
    hd_run *run;
    char message[256] = "";
    assert_int_equal(hd_run_create(&run, &scene, message, sizeof message), HD_REFUSED);
    assert_null(run);
    assert_string_equal(
        message,
        "exponents = 49: must be positive, all, all_independent, none or from 1 to 4 disks = 48");
}
