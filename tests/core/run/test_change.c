/** What is changed while a run goes on: when it holds, what is refused, and that the same change at
 * the same time gives the same bits. */
#include "kept.h"
#include "run/run_state.h"

#define PATH "change.checkpoint"

static const hd_parameter *row_of(const char *name)
{
    int count;
    const hd_parameter *row = hd_scene_parameters(&count);
    while (strcmp(row->name, name) != 0) row++;
    return row;
}

static void change_to(hd_run *run, const char *name, const char *value)
{
    char message[256] = "";
    if (hd_run_change(run, row_of(name), value, message, sizeof message) != HD_OK)
        fail_msg("%s", message);
}

static void change(hd_run *run, const char *name, double value)
{
    char text[40];
    snprintf(text, sizeof text, "%.17g", value);
    change_to(run, name, text);
}

static void expect_text_refused(hd_run *run, const char *name, const char *value, const char *line)
{
    char message[256] = "";
    const hd_scene_def before = *hd_run_scene(run);
    assert_int_equal(hd_run_change(run, row_of(name), value, message, sizeof message), HD_REFUSED);
    if (!strstr(message, line)) fail_msg("%s: not in: %s", line, message);
    assert_true(hd_parameter_same(row_of(name), hd_run_scene(run), &before));
}

static void expect_refused(hd_run *run, const char *name, double value, const char *line)
{
    char text[40];
    snprintf(text, sizeof text, "%.17g", value);
    expect_text_refused(run, name, text, line);
}

/** In the averaging, in the middle of a sample. */
static hd_run *averaging(double report_interval, double duration)
{
    hd_run *run = kept_run(scene_from(kept_scene(30, 0.7, 1.0, 5, KEPT_ALL),
                                      .report_interval = report_interval, .duration = duration));
    while (hd_run_stage(run) != HD_AVERAGING || hd_run_time(run) < 26.0) kept_steps(run, 1);
    while (hd_run_time(run) >= hd_run_change_time(run)) kept_steps(run, 1);
    return run;
}

/** The time of the next report; that of the end where there is none. */
static double next_report(hd_run *run)
{
    do kept_steps(run, 1);
    while (!hd_run_report_due(run) && hd_run_stage(run) != HD_FINISHED);
    return hd_run_time(run);
}

/** Reports come as before until then, and as asked for after it, until the end that was. */
static void expect_reports(double before, double after)
{
    OWNED(hd_run) *run = averaging(before, 20.0);
    const double from = hd_run_change_time(run), start = 23.0;
    change(run, "report_interval", after);
    CHECK_CLOSE(hd_run_scene(run)->report_interval, after, 0.0);
    double now = next_report(run);
    for (; now < from - 1e-9; now = next_report(run)) {
        const double reports = (now - start) / before;
        CHECK_CLOSE(reports, floor(reports + 0.5), 1e-9);
    }
    for (int k = fabs(now - from) < 1e-9 ? 0 : 1; hd_run_stage(run) != HD_FINISHED; k++) {
        CHECK_CLOSE(now, fmin(from + k * after, 43.0), 1e-9);
        now = next_report(run);
    }
    CHECK_CLOSE(now, 43.0, 0.0);
}

TEST(reports_come_in_another_interval)
{
    const double intervals[] = {0.1, 0.7, 1.0, 7.0, 1e10};
    for (int k = 0; k < 5; k++)
        for (int l = 0; l < 5; l++)
            if (k != l) expect_reports(intervals[k], intervals[l]);
}

TEST(before_the_averaging_it_holds_from_the_next_report_on)
{
    OWNED(hd_run) *run = kept_run(kept_scene(30, 0.7, 1.0, 5, 0));
    while (hd_run_time(run) < 5.0) kept_steps(run, 1);
    const double from = hd_run_change_time(run);
    assert_true(from <= hd_run_time(run) + 1.0);
    change(run, "report_interval", 0.25);
    while (hd_run_time(run) < from) kept_steps(run, 1);
    for (int k = 1; hd_run_stage(run) == HD_WARMING_UP; k++)
        CHECK_CLOSE(next_report(run), fmin(from + 0.25 * k, 23.0), 1e-9);
    CHECK_CLOSE(hd_run_time(run), 23.0, 0.0);
}

static double ended(hd_run *run)
{
    while (kept_steps(run, 1)) continue;
    const double end = hd_run_time(run);
    hd_run_free(run);
    return end;
}

TEST(the_duration_changes)
{
    OWNED(hd_run) *run = averaging(1.0, 20.0);
    expect_refused(run, "duration", -1.0, "duration = -1: must be from 0");
    expect_refused(run, "duration", 1.0, "duration = 1: must be 0 or at least");
    const double least = hd_run_change_time(run) - 23.0;
    change(run, "duration", least * (1.0 - 20.0 * DBL_EPSILON)); /* as soon as it can, 15 digits */
    CHECK_CLOSE(ended(run), 23.0 + least, 1e-9);
    run = averaging(1.0, 20.0);
    change(run, "duration", 31.5);
    CHECK_CLOSE(ended(run), 54.5, 1e-9);
    run = averaging(1e12, 20.0);
    change(run, "duration", 31.3);
    CHECK_CLOSE(ended(run), 54.3, 1e-9);
    run = averaging(1.0, 0.0);
    change(run, "duration", 10.0);
    CHECK_CLOSE(ended(run), 33.0, 1e-9);
    run = averaging(1.0, 20.0);
    change(run, "duration", 0.0);
    while (hd_run_time(run) < 60.0) kept_steps(run, 1);
    assert_int_equal(hd_run_stage(run), HD_AVERAGING);
}

/** In the sample at whose end the run would have ended: there it says what it has to say. */
TEST(at_the_end_it_becomes_longer)
{
    hd_run *run = averaging(1.0, 3.9);
    while (hd_run_change_time(run) < 26.9 || hd_run_time(run) >= 26.9) kept_steps(run, 1);
    assert_true(hd_run_time(run) < 26.9);
    change(run, "duration", 10.0);
    double now = next_report(run);
    while (now < 26.9) now = next_report(run);
    CHECK_CLOSE(now, 26.9, 0.0);
    assert_int_equal(hd_run_stage(run), HD_AVERAGING);
    CHECK_CLOSE(ended(run), 33.0, 1e-9);
}

/** While covariant vectors still go their way back from it. */
TEST(at_the_end_it_is_too_late)
{
    hd_scene_def def = kept_scene(30, 0.7, 1.0, 5, HD_OBSERVE_COVARIANT);
    def.covariant_window = def.covariant_transient = 5.0;
    def.covariant_sampling = 1.0;
    OWNED(hd_run) *run = kept_run(scene_from(def, .duration = 20.0));
    while (hd_run_time(run) < 43.0) kept_steps(run, 1);
    assert_int_equal(hd_run_stage(run), HD_AVERAGING);
    expect_refused(run, "duration", 40.0, "the run has ended");
}

TEST(the_target_changes)
{
    OWNED(hd_run) *run = kept_run(scene_from(kept_scene(30, 0.7, 1.0, 5, 0), .duration = 400.0));
    expect_text_refused(run, "target", "c_T 1%", "target = c_T 1%: must be without c_T");
    expect_text_refused(run, "target", "lambda_max", "target = lambda_max: must be");
    expect_text_refused(run, "duration", "5 time units", "duration = 5 time units: must be from 0");
    while (hd_run_cost(run).std_error < 0) kept_steps(run, 1);
    const double from = hd_run_change_time(run);
    change_to(run, "target", "smallest 1000, lambda_max 99%"); /* was reached long ago */
    while (hd_run_stage(run) != HD_FINISHED) kept_steps(run, 1);
    CHECK_CLOSE(hd_run_time(run), from, 1e-9);
    assert_true(hd_run_report_due(run) && hd_run_fields_due(run)); /* of an end, as any other */
}

/** The shortest duration that is allowed ends the run where a change would hold, with its last
 * report and fields. */
/** Until it holds, a checkpoint has both: what is asked for and what is in force. */
TEST(a_checkpoint_keeps_what_is_in_force)
{
    OWNED(hd_run) *run = averaging(1.0, 400.0);
    change_to(run, "target", "smallest 1e-9");
    OWNED(hd_run) *copy = kept_and_resumed(run, PATH, NULL);
    assert_string_equal(hd_run_scene(copy)->target.line, "smallest 1e-9");
    assert_string_equal(copy->agenda.in_force.target.line, run->agenda.in_force.target.line);
    assert_string_not_equal(copy->agenda.in_force.target.line, "smallest 1e-9");
    (void)remove(PATH);
}

TEST(the_shortest_duration_ends_it)
{
    OWNED(hd_run) *run = kept_run(scene_from(kept_scene(30, 0.7, 1.0, 5, 0), .duration = 0.0));
    assert_true(isnan(hd_run_shortest_duration(run)));
    while (hd_run_stage(run) != HD_AVERAGING || hd_run_time(run) < 60.0) kept_steps(run, 1);
    const double from = hd_run_change_time(run);
    change(run, "duration", hd_run_shortest_duration(run));
    while (hd_run_stage(run) != HD_FINISHED) kept_steps(run, 1);
    CHECK_CLOSE(hd_run_time(run), from, 1e-9);
    assert_true(hd_run_report_due(run) && hd_run_fields_due(run));
    assert_true(isnan(hd_run_shortest_duration(run)));
}

/** Where a viewer had a state measured, the change holds at once; vectors are those of this state.
 */
TEST(it_ends_at_a_measured_state)
{
    OWNED(hd_run) *run = averaging(1.0, 0.0);
    CHECK_OK(hd_run_measure(run, 0));
    const double now = hd_run_time(run);
    change(run, "duration", hd_run_shortest_duration(run));
    CHECK_OK(hd_run_advance(run));
    assert_true(hd_run_time(run) == now && hd_run_stage(run) == HD_FINISHED);
    assert_true(hd_run_fields_due(run));
    assert_int_equal(hd_run_vectors_now(run).count, hd_run_vectors(run));
}

/** Before and after any change of the reports (none if they stay as they are) the first of them at
 * or after each multiple. */
static void expect_fields(double report_interval)
{
    hd_scene_def def = scene_from(kept_scene(30, 0.7, 1.0, 5, KEPT_ALL | HD_OBSERVE_FIELDS),
                                  .field_interval = 1000.0);
    OWNED(hd_run) *run = kept_run(def);
    while (hd_run_time(run) < 30.0) kept_steps(run, 1);
    const double from = hd_run_change_time(run);
    int due = 0;
    change(run, "field_interval", 2.0);
    if (report_interval != def.report_interval) change(run, "report_interval", report_interval);
    for (double now, before = hd_run_time(run); hd_run_stage(run) != HD_FINISHED; before = now) {
        now = next_report(run);
        const double multiple = floor((now - 23.0) / 2.0 + 1e-9);
        const bool reached = now > from + 1e-9 && multiple > floor((before - 23.0) / 2.0 + 1e-9);
        assert_int_equal(hd_run_fields_due(run), reached || hd_run_stage(run) == HD_FINISHED);
        due += reached;
    }
    assert_true(due >= 5);
}

TEST(the_fields_interval_changes)
{
    const double intervals[] = {1.0, 0.3, 1.3};
    for (int k = 0; k < 3; k++) expect_fields(intervals[k]);
}

TEST(the_rest_is_read_at_the_start)
{
    int count, live = 0;
    const hd_parameter *rows = hd_scene_parameters(&count);
    OWNED(hd_run) *run = averaging(1.0, 20.0);
    for (int k = 0; k < count; k++) {
        live += rows[k].live;
        assert_true(!rows[k].live || rows[k].may_differ);
        if (!rows[k].live) expect_refused(run, rows[k].name, 2.0, "is read at the start");
    }
    assert_int_equal(live, 4);
    expect_refused(run, "report_interval", 0.0, "report_interval = 0: must be from 1e-6");
    while (kept_steps(run, 1)) continue;
    expect_refused(run, "duration", 100.0, "the run has ended");
}

static void expect_same(hd_run *a, hd_run *b)
{
    assert_true(hd_run_time(a) == hd_run_time(b));
    for (int col = 0; col < 5; col++) {
        const hd_spectrum *of_a = hd_run_spectrum(a), *of_b = hd_run_spectrum(b);
        assert_true(hd_spectrum_exponent(of_a, col) == hd_spectrum_exponent(of_b, col));
        assert_true(hd_spectrum_std_error(of_a, col) == hd_spectrum_std_error(of_b, col));
    }
}

/** Wherever in the sample it was asked for; and what was asked for is in a checkpoint, before and
 * after it holds. */
TEST(the_same_change_gives_the_same_bits)
{
    hd_run *late = averaging(1.0, 200.0), *early = averaging(1.0, 200.0);
    change(early, "report_interval", 0.3);
    const double from = hd_run_change_time(early);
    hd_run *kept = kept_and_resumed(early, PATH, NULL);
    for (double before = hd_run_time(late); hd_run_time(late) + 1e-9 < from;) {
        OWNED(hd_run) *tried = kept_and_resumed(late, PATH, NULL);
        kept_steps(tried, 1);
        const bool is_last = hd_run_time(tried) + 1e-9 >= from;
        if (is_last) break;
        kept_steps(late, 1);
        assert_true(hd_run_time(late) > before);
    }
    assert_true(hd_run_time(late) < from);
    CHECK_CLOSE(hd_run_change_time(late), from, 0.0);
    change(late, "report_interval", 0.3);
    while (hd_run_time(early) < from + 1.0) kept_steps(early, 1);
    hd_run *after = kept_and_resumed(early, PATH, NULL);
    hd_run *all[] = {early, late, kept, after};
    for (int k = 0; k < 4; k++) {
        while (kept_steps(all[k], 1)) continue;
        expect_same(early, all[k]);
    }
    assert_true(hd_spectrum_std_error(hd_run_spectrum(early), 0) > 0);
    for (int k = 0; k < 4; k++) hd_run_free(all[k]);
    remove(PATH);
}
