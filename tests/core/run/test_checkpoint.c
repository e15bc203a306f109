/** A run that is taken up again is the run that was not interrupted. */
#include "kept.h"
#include "same.h"
#include "run/run_state.h"

static const char PATH[] = "checkpoint.test";

/* ---- the run goes on ----------------------------------------------------------------------- */

/** Steps, after each of which the slowest vectors are looked at; how many were taken. */
static int watched_steps(hd_run *run, int most, int slowest)
{
    int taken = 0;
    for (; taken < most && kept_steps(run, 1); taken++)
        if (slowest > 0) CHECK_OK(hd_run_measure(run, hd_run_vectors(run) - slowest));
    return taken;
}

/** Stopped and taken up again every few steps, beside one that is left alone; both with steps no
 * longer than `between`, and so many of the slowest vectors looked at. */
static void expect_uninterrupted_watched(const hd_scene_def *def, int every, int least,
                                         double between, int slowest)
{
    OWNED(hd_run) *alone = kept_run(*def), *other = kept_run(*def);
    int times = 0, taken = 0;
    hd_run_watch(alone, between);
    do {
        hd_run_watch(other, between);
        watched_steps(alone, every, slowest);
        taken = watched_steps(other, every, slowest);
        hd_run *resumed = kept_and_resumed(other, PATH, def);
        hd_run_free(other);
        other = resumed;
        expect_same_state(alone, other);
        times++;
    } while (taken == every);
    assert_int_equal(hd_run_stage(other), HD_FINISHED);
    assert_true(times >= least);
}

static void expect_uninterrupted(const hd_scene_def *def, int every, int least)
{
    expect_uninterrupted_watched(def, every, least, INFINITY, 0);
}

TEST(a_resumed_run_is_the_uninterrupted_one)
{
    hd_scene_def walls = scene_from(kept_scene(24, 0.6, 0.5, HD_EXPONENTS_ALL, KEPT_AT_REPORTS),
                                    .boundary[0] = R, .boundary[1] = R);
    hd_scene_def crowded = scene_from(
        kept_scene(60, 0.8, 0.06, HD_EXPONENTS_POSITIVE, KEPT_AT_REPORTS | HD_OBSERVE_FIELDS),
        .report_interval = 0.25, .threads = 2);
    hd_scene_def looks = scene_from(kept_scene(60, 0.8, 0.06, HD_EXPONENTS_POSITIVE, KEPT_ALL),
                                    .report_interval = 0.1);
    hd_scene_def rare = scene_from(kept_scene(20, 0.05, 1.0, 3, 0), .report_interval = 7.0);
    const hd_scene_def few = kept_scene(2, 0.3, 1.0, HD_EXPONENTS_ALL, KEPT_ALL);
    const hd_scene_def none = kept_scene(50, 0.7, 1.0, HD_EXPONENTS_NONE, HD_OBSERVE_GAS);
    const hd_scene_def longest = scene_from(
        kept_scene(100, 1e-6, 1e-6, HD_EXPONENTS_NONE, HD_OBSERVE_GAS), .duration = 2e6,
        .report_interval = 1e5);
    expect_uninterrupted(&walls, 5, 8);
    expect_uninterrupted(&crowded, 37, 4);
    expect_uninterrupted(&looks, 7, 30);
    expect_uninterrupted(&rare, 1, 5);
    expect_uninterrupted(&few, 3, 10);
    expect_uninterrupted(&none, 2, 10);
    expect_uninterrupted(&longest, 2, 10);
    expect_uninterrupted(&longest, 2, 10);
}

/** Also where a watcher has stopped it in the middle of a step that is planned. */
TEST(a_run_that_is_looked_at_keeps_its_plan)
{
    const hd_scene_def def = kept_scene(20, 0.7, 1.0, HD_EXPONENTS_POSITIVE, 0);
    const hd_scene_def none = kept_scene(50, 0.7, 1.0, HD_EXPONENTS_NONE, HD_OBSERVE_GAS);
    const hd_scene_def looks = kept_scene(60, 0.8, 0.06, HD_EXPONENTS_POSITIVE, KEPT_ALL);
    expect_uninterrupted_watched(&def, 37, 100, 0.01, 0);
    expect_uninterrupted_watched(&none, 37, 100, 0.01, 0);
    expect_uninterrupted_watched(&looks, 7, 10, 0.1, 8);
}

/** The states that the run above went through are not all the same kind: looks, tracked phases,
 * found steps. */
TEST(what_was_compared_was_there)
{
    OWNED(hd_run) *run = kept_run(scene_from(
        kept_scene(60, 0.8, 0.06, HD_EXPONENTS_POSITIVE, KEPT_ALL), .report_interval = 0.1));
    hd_run_watch(run, 0.1);
    watched_steps(run, 1000000, 8);
    int tracked = 0, resolved = 0;
    const hd_phases *phases = hd_run_phases(run);
    for (int k = 0; k < hd_phases_count(phases); k++)
        tracked += hd_phases_phase(phases, k)->state == HD_PHASE_TRACKED;
    for (int k = 0; k < hd_steps_count(hd_run_steps(run)); k++)
        resolved += hd_steps_step(hd_run_steps(run), k)->resolved;
    assert_true(hd_run_cost(run).slow_vector_samples > 0);
    assert_true(tracked > 0);
    assert_true(resolved > 0);
}

TEST(clocks_and_costs_go_on)
{
    OWNED(hd_run) *run = kept_run(kept_scene(30, 0.7, 1.0, HD_EXPONENTS_POSITIVE, KEPT_ALL));
    while (hd_run_stage(run) != HD_AVERAGING || isnan(hd_run_cost(run).error_bound))
        kept_steps(run, 1);
    hd_run_observe(run, HD_OBSERVE_MODES);
    run->cost.limit = HD_LIMIT_REPAIR;
    run->cost.communication = 1.0; /* as if several ranks had carried it */
    run->cost.bytes = 2.0;
    run->cost.calls = 3.0;
    for (int k = 1; k < 200; k++) hd_error_trend_add(&run->errors, k, 0.1); /* it does not fall */
    const hd_cost before = hd_run_cost(run);
    OWNED(hd_run) *resumed = kept_and_resumed(run, PATH, NULL);
    const hd_cost after = hd_run_cost(resumed);
    assert_true(before.orthonormalisations > 0);
    assert_int_equal(after.orthonormalisations, before.orthonormalisations);
    assert_int_equal(after.limit, before.limit);
    CHECK_CLOSE(after.ortho, before.ortho, 0.0);
    CHECK_CLOSE(after.progress, before.progress, 0.0);
    CHECK_CLOSE(after.error_bound, before.error_bound, 0.0);
    CHECK_CLOSE(after.communication, 1.0, 0.0);
    CHECK_CLOSE(after.bytes, 2.0, 0.0);
    CHECK_CLOSE(after.calls, 3.0, 0.0);
    assert_true(before.stalled_since > 0.0);
    CHECK_CLOSE(after.stalled_since, before.stalled_since, 0.0);
    CHECK_CLOSE(after.stalled_error, before.stalled_error, 0.0);
    assert_true(after.wall >= before.wall);
    /* seconds left over simulated time left, as over what was carried: wall time runs on */
    assert_true(after.remaining >= before.remaining);
    CHECK_CLOSE(resumed->clocks.frame_start_time, run->clocks.frame_start_time, 0.0);
    assert_int_equal(resumed->observables.looked_at, HD_OBSERVE_MODES);
}

/** As many as before, and as said: any number. */
TEST(threads_are_as_before_where_none_are_asked_for)
{
    hd_scene_def scene = kept_scene(12, 0.7, 1.0, 4, 0);
    OWNED(hd_run) *run = kept_run(scene);
    scene.threads = 0;
    OWNED(hd_run) *resumed = kept_and_resumed(run, PATH, &scene);
    assert_int_equal(hd_run_threads(resumed), 1);
    assert_int_equal(hd_run_scene(resumed)->threads, 0);
}

/** The clock may have begun anew, less ago than the run has been going on. */
TEST(the_time_left_is_known_after_a_restart)
{
    OWNED(hd_run) *run = kept_run(kept_scene(30, 0.7, 1.0, HD_EXPONENTS_POSITIVE, 0));
    while (hd_run_stage(run) != HD_AVERAGING) kept_steps(run, 1);
    run->clocks.frame_started = -1000.0;
    assert_true(hd_run_cost(run).remaining > 0.0);
    OWNED(hd_run) *resumed = kept_and_resumed(run, PATH, NULL);
    assert_true(hd_run_cost(resumed).remaining > 0.0);
    kept_steps(resumed, 1000);
    CHECK_CLOSE(resumed->clocks.frame_start_time, run->clocks.frame_start_time, 0.0);
}

/* ---- another duration ---------------------------------------------------------------------- */

/** Rounding of two ways to cut the same time into intervals [T6]: the accuracy that the scene asks
 * for. */
TEST(a_finished_run_can_be_made_longer)
{
    hd_scene_def def = scene_from(kept_scene(30, 0.7, 1.0, HD_EXPONENTS_POSITIVE, KEPT_ALL),
                                  .duration = 33.3);
    OWNED(hd_run) *run = kept_run(def);
    hd_run_watch(run, 0.1);
    watched_steps(run, 1000000, 8);
    hd_scene_def longer = scene_from(def, .duration = 80.0);
    OWNED(hd_run) *resumed = kept_and_resumed(run, PATH, &longer), *once = kept_run(longer);
    assert_int_equal(hd_run_stage(resumed), HD_AVERAGING);
    assert_true(hd_run_phase_time(run) > 0.0);
    CHECK_CLOSE(hd_run_phase_time(resumed), hd_run_phase_time(run), 0.0);
    kept_steps(resumed, 1000000);
    kept_steps(once, 1000000);
    const hd_spectrum *a = hd_run_spectrum(resumed), *b = hd_run_spectrum(once);
    CHECK_CLOSE(hd_spectrum_time(a), 80.0, 1e-9);
    CHECK_CLOSE(hd_run_time(resumed), hd_run_time(once), 0.0);
    for (int col = 0; col < hd_run_vectors(resumed); col++)
        CHECK_CLOSE(hd_spectrum_exponent(a, col), hd_spectrum_exponent(b, col), def.accuracy);
    assert_int_equal(hd_trajectory_totals(hd_run_trajectory(resumed)).collisions,
                     hd_trajectory_totals(hd_run_trajectory(once)).collisions);
}

/** At every moment of the averaging: what has been averaged, and hardly more, is a duration; what
 * comes of it is a file that can be gone on from. */
TEST(the_duration_can_end_at_once)
{
    static const double more[] = {0.0, 0.01, 0.1, 0.35, -5e-14}; /* of 20 with 15 digits */
    const hd_scene_def def = kept_scene(20, 0.7, 1.0, HD_EXPONENTS_POSITIVE, KEPT_ALL);
    OWNED(hd_run) *run = kept_run(def);
    for (int k = 0; kept_steps(run, 1) == 1; k++) {
        if (hd_run_stage(run) != HD_AVERAGING || hd_run_time(run) == run->agenda.start) continue;
        hd_scene_def shorter = scene_from(def, .duration = hd_run_time(run) - run->agenda.start +
                                                           more[k % 5]);
        OWNED(hd_run) *ended = kept_and_resumed(run, PATH, &shorter);
        kept_steps(ended, 1000);
        assert_int_equal(hd_run_stage(ended), HD_FINISHED);
        hd_run_free(kept_and_resumed(ended, PATH, &def));
    }
}

/** A step of no length teaches nothing. */
TEST(phases_too_short_for_the_time_to_move_are_kept)
{
    hd_scene_def def = scene_from(kept_scene(20, 0.7, 1.0, HD_EXPONENTS_POSITIVE, 0),
                                  .equilibration = 100.0, .warmup = 1e-15, .duration = 2.0);
    OWNED(hd_run) *run = kept_run(def);
    for (int taken = 1; taken == 1; taken = kept_steps(run, 1))
        hd_run_free(kept_and_resumed(run, PATH, &def));
}

TEST(what_the_target_has_ended_stays_ended)
{
    hd_scene_def def = scene_from(kept_scene(20, 0.7, 1.0, HD_EXPONENTS_POSITIVE, 0),
                                  .duration = 0.0, .target = (hd_text){"smallest 0.05"});
    OWNED(hd_run) *run = kept_run(def);
    kept_steps(run, 100000);
    assert_int_equal(hd_run_stage(run), HD_FINISHED);
    OWNED(hd_run) *again = kept_and_resumed(run, PATH, &def);
    assert_int_equal(hd_run_stage(again), HD_FINISHED);
    hd_run_free(again);
    def.target = (hd_text){"smallest 0.02"};
    again = kept_and_resumed(run, PATH, &def);
    assert_int_equal(hd_run_stage(again), HD_AVERAGING);
}

/** Not with the interval that is under way. */
TEST(another_target_holds_at_once)
{
    const hd_scene_def def = scene(.number = 20, .density = 0.1, .exponents = 3, .threads = 1,
                                   .equilibration = 5.0, .warmup = 20.0, .duration = 1e4,
                                   .report_interval = 0.05);
    OWNED(hd_run) *run = kept_run(def);
    while (!(hd_run_cost(run).std_error > 0)) CHECK_OK(hd_run_advance(run));
    while (!hd_run_report_due(run) || hd_run_time(run) == run->agenda.sample_begin)
        CHECK_OK(hd_run_advance(run));
    hd_scene_def asked = def;
    snprintf(asked.target.line, HD_TEXT, "smallest %.17g", 2 * hd_run_cost(run).std_error);
    OWNED(hd_run) *other = kept_and_resumed(run, PATH, &asked);
    const double now = hd_run_time(other);
    assert_true(other->agenda.interval_end > now + 2 * def.report_interval);
    do CHECK_OK(hd_run_advance(other));
    while (!hd_run_report_due(other));
    CHECK_CLOSE(hd_run_time(other), now + def.report_interval, 1e-9);
    assert_int_equal(hd_run_stage(other), HD_FINISHED);
}

/** Turns of a thousandth of a sample say nothing about a velocity, and end no tracking. */
TEST(an_end_that_cuts_a_sample_short_keeps_the_phases)
{
    hd_scene_def def = scene_from(kept_scene(60, 0.8, 0.06, HD_EXPONENTS_POSITIVE, KEPT_ALL),
                                  .duration = 80.0);
    hd_scene_def odd = def, longer = def;
    odd.duration = 80.001;
    longer.duration = 100.0;
    OWNED(hd_run) *even = kept_run(def), *cut = kept_run(odd);
    kept_steps(even, 100000);
    kept_steps(cut, 100000);
    const hd_velocity v = hd_phases_velocity(hd_run_phases(even));
    assert_true(v.phases > 0);
    CHECK_CLOSE(hd_phases_velocity(hd_run_phases(cut)).v, v.v, 0.1 * v.v_error);
    OWNED(hd_run) *resumed = kept_and_resumed(cut, PATH, &longer);
    kept_steps(resumed, 100000);
    double longest = 0.0;
    for (int k = 0; k < hd_phases_count(hd_run_phases(resumed)); k++)
        longest = fmax(longest, hd_phases_phase(hd_run_phases(resumed), k)->time);
    assert_true(longest > 50.0); /* it was not begun anew at 80 */
}

static void expect_refused(const hd_scene_def *asked, hd_status expected, const char *word)
{
    hd_run *run;
    char message[512] = "";
    assert_int_equal(hd_run_resume(&run, PATH, asked, message, sizeof message), expected);
    assert_null(run);
    if (!strstr(message, word)) fail_msg("\"%s\" does not say \"%s\"", message, word);
    assert_null(strchr(message, '\n'));
}

/** Another value of the parameter, with which the scene is still one. */
static hd_scene_def with_another(const hd_scene_def *def, const hd_parameter *row)
{
    hd_scene_def other = *def;
    const double value = hd_parameter_value(row, def);
    switch (row->kind) {
    case HD_PARAMETER_REAL:
    case HD_PARAMETER_INTERVAL:
        hd_parameter_assign(row, &other, value == 0.0 ? 0.5 : 1.01 * value);
        break;
    case HD_PARAMETER_WORD: hd_parameter_assign(row, &other, 1.0 - value); break;
    case HD_PARAMETER_TEXT: assert_true(hd_parameter_read(row, &other, "lambda_max 1e-9")); break;
    default: hd_parameter_assign(row, &other, value < row->max ? value + 1.0 : value - 1.0);
    }
    return other;
}

TEST(each_parameter_may_differ_or_is_refused_by_name)
{
    const hd_scene_def def = kept_scene(30, 0.7, 1.0, 5, KEPT_ALL);
    int count, free_to_change = 0;
    const hd_parameter *rows = hd_scene_parameters(&count);
    OWNED(hd_run) *run = kept_run(def);
    while (hd_run_stage(run) != HD_AVERAGING || hd_run_time(run) < 25.0) kept_steps(run, 1);
    hd_run_free(kept_and_resumed(run, PATH, &def));
    for (int k = 0; k < count; k++) {
        const hd_scene_def asked = with_another(&def, &rows[k]);
        const char *name = rows[k].kind == HD_PARAMETER_SET ? "observables" : rows[k].name;
        const double value = hd_parameter_value(&rows[k], &asked);
        assert_true(value != hd_parameter_value(&rows[k], &def));
        if (!rows[k].may_differ) {
            expect_refused(&asked, HD_REFUSED, name);
            continue;
        }
        OWNED(hd_run) *other = kept_and_resumed(run, PATH, &asked);
        CHECK_CLOSE(hd_parameter_value(&rows[k], hd_run_scene(other)), value, 0.0);
        free_to_change++;
    }
    assert_true(free_to_change > 2);
    hd_scene_def shorter = def;
    shorter.duration = 0.5; /* than what has been averaged */
    expect_refused(&shorter, HD_REFUSED, "duration");
}

/** Exclude max_mode_number; aspect and boundaries. */
static const size_t WAVE_NUMBER = offsetof(hd_scene_def, max_wave_number),
                    CONTAINER = offsetof(hd_scene_def, container);

TEST(it_says_whose_it_is)
{
    hd_scene_def def = kept_scene(30, 0.7, 1.0, 4, KEPT_ALL);
    int count;
    const hd_parameter *rows = hd_scene_parameters(&count);
    for (int k = 0; k < count; k++) /* nothing is as it usually is */
        if (hd_parameter_value(&rows[k], &def) == rows[k].default_value &&
            rows[k].offset != WAVE_NUMBER && rows[k].offset != CONTAINER &&
            !is_of_spheres(&rows[k]))
            def = with_another(&def, &rows[k]);
    OWNED(hd_run) *run = kept_run(def);
    hd_checkpoint found;
    char long_label[200] = "", message[512] = "";
    kept_steps(run, 12);
    memset(long_label, 'x', sizeof long_label - 1);
    CHECK_OK(hd_run_save(run, PATH, long_label, message, sizeof message));
    CHECK_OK(hd_checkpoint_read(&found, PATH, NULL, 0, message, sizeof message));
    assert_int_equal(strlen(found.label), HD_CHECKPOINT_LABEL - 1);
    CHECK_OK(hd_run_save(run, PATH, KEPT_LABEL, message, sizeof message));
    CHECK_OK(hd_checkpoint_read(&found, PATH, NULL, 0, message, sizeof message));
    assert_string_equal(found.label, KEPT_LABEL);
    for (int k = 0; k < count; k++)
        CHECK_CLOSE(hd_parameter_value(&rows[k], &found.scene), hd_parameter_value(&rows[k], &def),
                    0.0);
    CHECK_CLOSE(found.time, hd_run_time(run), 0.0);
}
