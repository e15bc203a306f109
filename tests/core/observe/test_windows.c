/** Covariant vectors of whole runs: when windows begin, what gives them up, and what a run refuses
 * for them. */
#include "base/memory.h"
#include "runs.h"

enum { VECTORS = 32 };

/** Looks fall on multiples of the interval. */
static hd_scene_def small(void)
{
    return scene(.number = VECTORS / 4, .density = 0.5, .exponents = HD_EXPONENTS_ALL,
                 .equilibration = 10.0, .warmup = 100.0, .duration = 300.0, .report_interval = 1.0,
                 .interval = 0.25, .observe = HD_OBSERVE_COVARIANT, .covariant_window = 20.0,
                 .covariant_transient = 60.0, .covariant_sampling = 2.0, .threads = 1);
}

static double averaging_start(const hd_run *run)
{
    return hd_run_scene(run)->equilibration + hd_run_scene(run)->warmup;
}

static void step_to(hd_run *run, double averaged)
{
    until_time(run, averaging_start(run) + averaged - 1e-9);
}

static void step_to_the_way_back(hd_run *run)
{
    while (!hd_covariant_is_going_back(hd_run_covariant(run))) CHECK_OK(hd_run_advance(run));
}

/** Some of the way, behind the run's back: it would go all of it in one step. */
static void go_back(const hd_run *run, int intervals)
{
    hd_covariant *c = (hd_covariant *)hd_run_covariant(run);
    for (int k = 0; k < intervals; k++) CHECK_OK(hd_covariant_step(c));
    assert_true(hd_covariant_is_going_back(c));
}

/** All that is known comes from so many windows since that time. */
static void check_windows(const hd_run *run, long windows, double start)
{
    const hd_covariant *c = hd_run_covariant(run);
    assert_int_equal(hd_covariant_read(c).windows, windows);
    CHECK_CLOSE(hd_covariant_read(c).window_end, start + 20.0 * (double)windows, 1e-6);
    CHECK_CLOSE(hd_spectrum_time(hd_covariant_read(c).spectrum), 20.0 * (double)windows, 1e-6);
    assert_int_equal(hd_covariant_read(c).splitting.samples, 10 * windows);
    assert_int_equal(hd_modes_samples(hd_covariant_read(c).half[0]), 10 * windows);
    assert_int_equal(hd_modes_samples(hd_covariant_read(c).half[1]), 10 * windows);
    assert_int_equal(hd_modes_samples(hd_covariant_read(c).of_frame), 10 * windows);
}

static bool step_fails;

/** The core's own, or one that finds no memory. */
hd_status __real_hd_covariant_step(hd_covariant *covariant);
hd_status __wrap_hd_covariant_step(hd_covariant *covariant)
{
    return step_fails ? HD_NO_MEMORY : __real_hd_covariant_step(covariant);
}

/** For good, and the file that is there stays. */
TEST(a_way_back_that_fails_is_said)
{
    static const char path[] = "windows.test";
    char message[200] = "";
    hd_checkpoint kept;
    OWNED(hd_run) *run = created(small());
    step_to(run, 10.0);
    const double time = hd_run_time(run);
    CHECK_OK(hd_run_save(run, path, "", NULL, 0));
    step_to_the_way_back(run);
    CHECK_OK(hd_run_status(run));
    step_fails = true;
    assert_int_equal(hd_run_advance(run), HD_NO_MEMORY);
    step_fails = false;
    assert_int_equal(hd_run_advance(run), HD_NO_MEMORY);
    assert_int_equal(hd_run_reset_average(run), HD_NO_MEMORY);
    assert_int_equal(hd_run_status(run), HD_NO_MEMORY);
    assert_int_equal(hd_run_save(run, path, "", message, sizeof message), HD_NO_MEMORY);
    assert_string_equal(message, "windows.test: the run has failed: out of memory");
    CHECK_OK(hd_checkpoint_read(&kept, path, NULL, 0, NULL, 0));
    CHECK_CLOSE(kept.time, time, 0.0);
    assert_int_equal(remove(path), 0);
}

/** What a checkpoint waits for, too. */
TEST(a_way_back_that_fails_is_not_saved)
{
    OWNED(hd_run) *run = created(small());
    step_to_the_way_back(run);
    step_fails = true;
    assert_int_equal(hd_run_save(run, "windows.test", "", NULL, 0), HD_NO_MEMORY);
    step_fails = false;
    assert_int_equal(hd_run_advance(run), HD_NO_MEMORY);
    assert_null(fopen("windows.test", "rb"));
}

/** As many as fit with the last one's transient; all are done before the run is finished. */
TEST(windows_are_counted)
{
    const double duration[] = {80.0, 99.0, 139.0, 140.0, 300.0};
    for (size_t k = 0; k < sizeof duration / sizeof *duration; k++) {
        OWNED(hd_run) *run = finished(scene_from(small(), .duration = duration[k]));
        check_windows(run, (long)floor((duration[k] - 60.0) / 20.0), averaging_start(run));
        assert_int_equal(hd_covariant_read(hd_run_covariant(run)).lost, 0);
        assert_true(hd_run_cost(run).following > 0 &&
                    hd_run_cost(run).following < hd_run_cost(run).wall);
    }
}

/** On the way back simulated time stands still; the forward pass takes nothing of it up. */
static void check_forward_pass(int exponents)
{
    hd_scene_def scene = scene_from(small(), .exponents = exponents);
    OWNED(hd_run) *run = created(scene);
    step_to_the_way_back(run);
    const double time = hd_run_time(run);
    CHECK_OK(hd_run_advance(run));
    assert_true(hd_run_time(run) == time);
    finish(run);
    scene.observe = 0;
    OWNED(hd_run) *other = finished(scene);
    assert_null(hd_run_covariant(other));
    assert_true(hd_run_cost(other).following == 0.0);
    const double rounding = hd_run_cost(run).error_bound + hd_run_cost(other).error_bound;
    check_same_exponents(run, other, exponents == HD_EXPONENTS_ALL ? rounding : 0.0);
}

/** Half of the vectors are orthonormalised better and at other times for them. */
TEST(the_forward_pass_stays_as_it_is)
{
    check_forward_pass(HD_EXPONENTS_ALL_INDEPENDENT);
    check_forward_pass(HD_EXPONENTS_ALL);
}

/** In the middle of the way back, too. */
TEST(a_reset_begins_anew)
{
    const int gone[] = {0, 100, 250,
                        300}; /* of 240 intervals of the transient and 80 of the window */
    for (size_t k = 0; k < sizeof gone / sizeof *gone; k++) {
        const hd_scene_def scene = small();
        OWNED(hd_run) *run = created(scene);
        step_to(run, 90.0);
        step_to_the_way_back(run);
        assert_true(hd_run_time(run) > averaging_start(run) + 90.0);
        go_back(run, gone[k]);
        const double now = hd_run_time(run);
        CHECK_OK(hd_run_reset_average(run));
        check_windows(run, 0, hd_covariant_read(hd_run_covariant(run)).window_end);
        assert_true(hd_covariant_read(hd_run_covariant(run)).null_most < 0);
        finish(run);
        CHECK_CLOSE(hd_run_time(run), now + scene.duration, 1e-6);
        check_windows(run, 12, now);
    }
}

/** The first one, too, where intervals would be longer than what lies between two; and there is
 * room for those that looks cut short. */
TEST(looks_come_when_they_are_due)
{
    const double interval[] = {0.0, 1.8};
    for (int k = 0; k < 4; k++) {
        OWNED(hd_run) *run = created(scene_from(
            small(), .density = 0.1, .interval = interval[k / 2], .report_interval = 1000.0));
        if (k % 2) step_to(run, 10.0);
        if (k % 2) CHECK_OK(hd_run_reset_average(run));
        const double start = k % 2 ? hd_run_time(run) : averaging_start(run);
        while (hd_covariant_read(hd_run_covariant(run)).windows == 0) CHECK_OK(hd_run_advance(run));
        assert_int_equal(hd_covariant_read(hd_run_covariant(run)).lost, 0);
        check_windows(run, 1, start);
    }
}

/** What nobody looked at is no part of a window. */
TEST(a_window_begins_when_somebody_looks_again)
{
    for (int back = 0; back < 2; back++) {
        const hd_scene_def scene = small();
        OWNED(hd_run) *run = created(scene);
        step_to(run, 65.0);
        if (back) step_to_the_way_back(run);
        if (back)
            go_back(run, 50); /* still in the transient: nothing of the window is in the averages */
        hd_run_observe(run, 0);
        step_to(run, 90.0);
        hd_run_observe(run, HD_OBSERVE_COVARIANT);
        const double now = hd_run_time(run);
        finish(run);
        const double left = averaging_start(run) + scene.duration - now;
        check_windows(run, (long)floor((left - 60.0) / 20.0), now);
    }
}

/** Off and on again between two steps in the middle of the way back. */
TEST(a_blink_gives_up_the_window)
{
    OWNED(hd_run) *run = created(small());
    step_to_the_way_back(run);
    go_back(run, 50);
    const double now = hd_run_time(run);
    hd_run_observe(run, 0);
    hd_run_observe(run, HD_OBSERVE_COVARIANT);
    finish(run);
    check_windows(run, 8, now); /* of 300 - 80 time units */
}

/** Everything at once: the centre is still the null space. Somebody who looks in between makes
 * intervals shorter than could be foreseen: that costs a window. */
TEST(other_stages_do_not_disturb)
{
    for (int viewed = 0; viewed < 2; viewed++) {
        hd_scene_def scene = scene_from(small(), .interval = 0.0, .report_interval = 0.25);
        scene.observe |= HD_OBSERVE_MODES | HD_OBSERVE_STEPS | HD_OBSERVE_PHASES | HD_OBSERVE_HYDRO;
        OWNED(hd_run) *run = created(scene);
        if (viewed) hd_run_watch(run, 0.1);
        while (going_on(run))
            if (viewed) CHECK_OK(hd_run_measure(run, 8));
        const hd_covariant *c = hd_run_covariant(run);
        assert_in_range(hd_covariant_read(c).windows, viewed ? 8 : 11, 12);
        assert_int_equal(hd_covariant_read(c).lost, viewed);
        /* rounding turns the space by eps times the worst condition that is let pass */
        const double condition = scene.accuracy / (2.0 * DBL_EPSILON);
        CHECK_CLOSE(hd_covariant_read(c).null_most, 0.0, 16.0 * DBL_EPSILON * condition);
    }
}

/* ---- room ---------------------------------------------------------------------------------- */

TEST(too_long_a_window_is_refused)
{
    char message[400] = "";
    hd_scene_def scene = small();
    hd_run *run = NULL;
    /* 512 triangles of 2176 bytes, couplings included, 46 frames of 4352, 13 kB beside them */
    scene.covariant_memory = 1.3e-3;
    assert_int_equal(hd_run_create(&run, &scene, message, sizeof message), HD_REFUSED);
    assert_null(run);
    const char *numbers[] = {
        "covariant_window = 20 ",  "covariant_transient = 60:", "512 triangles",
        "46 frames of 16 vectors", "need 0.00134 GB",           "covariant_memory = 0.0013 GB"};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
        if (!strstr(message, numbers[k])) fail_msg("%s: not in: %s", numbers[k], message);
    assert_int_equal(hd_run_create(&run, &scene, NULL, 0), HD_REFUSED);
    scene.observe = 0;
    hd_run_free(created(scene));
    scene = small();
    scene.covariant_memory = 1.4e-3;
    hd_run_free(created(scene));
}

/** The refusal has the longest window that fits, to two digits, or says that none does. */
TEST(a_window_that_fits_is_said)
{
    char message[400] = "";
    hd_scene_def scene = scene_from(small(), .covariant_memory = 1.3e-3);
    hd_run *run = NULL;
    double fits = 0.0;
    assert_int_equal(hd_run_create(&run, &scene, message, sizeof message), HD_REFUSED);
    const char *said = strstr(message, "; covariant_window = ");
    assert_non_null(said);
    assert_int_equal(sscanf(said, "; covariant_window = %lf would fit", &fits), 1);
    CHECK_WITHIN(fits, 2.0, 19.0);
    scene.covariant_window = fits;
    hd_run_free(created(scene));
    scene.covariant_window = fits + 1.0;
    assert_int_equal(hd_run_create(&run, &scene, NULL, 0), HD_REFUSED);
    scene.covariant_memory = 1e-3; /* for the transient alone 1.02 MB */
    assert_int_equal(hd_run_create(&run, &scene, message, sizeof message), HD_REFUSED);
    assert_non_null(strstr(message, "; no window would fit with this transient"));
}

/** Of what is certain beforehand: intervals that end at each report, at fields, at samples of
 * phases and of fluctuations, or because the duration is short. Each leaves more triangles than
 * fit. */
TEST(windows_without_room_are_refused_beforehand)
{
    const hd_scene_def fits = scene_from(small(), .interval = 0.0, .covariant_memory = 1e-3,
                                         .duration = 0.0);
    const hd_scene_def without[] = {
        scene_from(fits, .observe |= HD_OBSERVE_HYDRO, .report_interval = 0.1),
        scene_from(fits, .observe |= HD_OBSERVE_STRUCTURE, .report_interval = 0.1),
        scene_from(fits, .observe |= HD_OBSERVE_PHASES, .phase_interval = 0.1),
        scene_from(fits, .observe |= HD_OBSERVE_FLUCTUATIONS, .fluctuation_time = 0.1),
        scene_from(fits, .interval = 0.1)};
    hd_scene_def with_fields = scene_from(fits, .observe |= HD_OBSERVE_FIELDS,
                                          .report_interval = 0.1);
    char message[400] = "";
    hd_run *run = NULL;
    hd_run_free(created(fits));
    for (size_t k = 0; k < sizeof without / sizeof *without; k++) {
        assert_int_equal(hd_run_create(&run, &without[k], message, sizeof message), HD_REFUSED);
        assert_non_null(strstr(message, "at most 0.1 time units apart"));
        assert_non_null(strstr(message, "1268 triangles"));
    }
    CHECK_OK(hd_memory_check_windows(&fits, NULL, 0));
    CHECK_OK(hd_memory_check_windows(&with_fields, NULL, 0));
    with_fields.field_interval = 0.0;
    assert_int_equal(hd_memory_check_windows(&with_fields, message, sizeof message), HD_REFUSED);
    assert_non_null(strstr(message, "1268 triangles"));
    hd_estimate estimate;
    assert_int_equal(hd_estimate_run(&estimate, &with_fields, NULL, 0), HD_REFUSED);
}

/** All windows of this run are left out; it goes on to its end. */
static void check_all_are_left_out(hd_run *run)
{
    finish(run);
    assert_int_equal(hd_covariant_read(hd_run_covariant(run)).windows, 0);
    assert_true(hd_covariant_read(hd_run_covariant(run)).lost > 0);
    assert_true(hd_covariant_bytes(hd_run_covariant(run)) <=
                1e9 * hd_run_scene(run)->covariant_memory);
}

/** Intervals that are as long as they choose are known when averaging begins. */
TEST(windows_that_turn_out_to_have_no_room_are_left_out)
{
    hd_scene_def scene = scene_from(small(), .exponents = HD_EXPONENTS_ALL_INDEPENDENT,
                                    .interval = 0.0);
    scene.accuracy = 1e-12; /* intervals as short as they get */
    scene.covariant_memory = 1e-3;
    OWNED(hd_run) *run = created(scene);
    check_all_are_left_out(run);
}

/** By a report interval that is changed while the run goes on; a reset and a resumed run begin
 * windows where there is no room, too, and find it again once reports are rare. */
TEST(who_begins_a_window_without_room_leaves_it_out)
{
    static const char path[] = "windows.test";
    int count;
    const hd_parameter *report = hd_scene_parameters(&count);
    while (strcmp(report->name, "report_interval") != 0) report++;
    const hd_scene_def scene = scene_from(small(), .observe |= HD_OBSERVE_HYDRO,
                                          .covariant_memory = 1.4e-3);
    OWNED(hd_run) *run = created(scene);
    step_to(run, 90.0);
    assert_true(hd_covariant_read(hd_run_covariant(run)).windows > 0);
    CHECK_OK(hd_run_change(run, report, "0.02", NULL, 0));
    step_to(run, 120.0);
    assert_true(hd_covariant_read(hd_run_covariant(run)).lost > 0);
    CHECK_OK(hd_run_save(run, path, "", NULL, 0));
    hd_run *resumed;
    CHECK_OK(hd_run_resume(&resumed, path, NULL, NULL, 0));
    CHECK_OK(hd_run_reset_average(run));
    check_all_are_left_out(run);
    const long before = hd_covariant_read(hd_run_covariant(resumed)).lost;
    step_to(resumed, 160.0);
    assert_true(hd_covariant_read(hd_run_covariant(resumed)).lost > before);
    CHECK_OK(hd_run_change(resumed, report, "1", NULL, 0));
    const long windows = hd_covariant_read(hd_run_covariant(resumed)).windows;
    finish(resumed);
    assert_true(hd_covariant_read(hd_run_covariant(resumed)).windows > windows);
    hd_run_free(resumed);
    assert_int_equal(remove(path), 0);
}

/** Once its ring has gone round, a run with windows takes no more memory. */
TEST(later_windows_take_no_memory)
{
    OWNED(hd_run) *run = created(small());
    step_to(run, 150.0); /* 512 intervals of 0.25 */
    const size_t before = hd_memory_allocations();
    finish(run);
    assert_int_equal(hd_memory_allocations(), before);
}

static void check_none_is_lost(double phase_interval, double fluctuation_time, unsigned observe)
{
    hd_scene_def def = scene(.number = 60, .density = 0.8, .aspect = 0.06, .warmup = 60.0,
                             .phase_interval = phase_interval, .covariant_window = 60.0,
                             .covariant_transient = 20.0, .duration = 90.0);
    def.fluctuation_time = fluctuation_time;
    def.exponents = HD_EXPONENTS_ALL;
    def.observe = HD_OBSERVE_COVARIANT | HD_OBSERVE_STEPS | HD_OBSERVE_PHASES | observe;
    OWNED(hd_run) *run = finished(def);
    assert_int_equal(hd_covariant_read(hd_run_covariant(run)).lost, 0);
    assert_true(hd_covariant_read(hd_run_covariant(run)).windows > 0);
}

/** Samples that are wanted close together end intervals early: there is room for all of them. */
TEST(no_window_is_lost_to_phases) { check_none_is_lost(0.2, 0.0, 0); }
TEST(no_window_is_lost_to_fluctuations) { check_none_is_lost(4.0, 0.2, HD_OBSERVE_FLUCTUATIONS); }
