/** When stages, reports and samples end. */
#include "testing.h"
#include "run/agenda.h"

/* ---- stages and reports --------------------------------------------------------------------- */

static hd_agenda agenda_of(double warmup, double duration, double report_interval)
{
    hd_scene_def scene = scene(.equilibration = 0.0, .warmup = warmup, .duration = duration,
                               .report_interval = report_interval);
    return hd_agenda_of(&scene, 1.0);
}

/** A report is made; true if the stage ends with it. */
static bool passed(hd_agenda *agenda)
{
    hd_agenda_pass_report(agenda, false);
    return agenda->due & HD_DUE_STAGE;
}

/** A change is taken up at this time; true if the averaging ends with it. */
static bool is_over(hd_agenda *agenda, const hd_scene_def *scene, double now)
{
    hd_agenda_ask(agenda, false);
    (void)hd_agenda_change(agenda, scene, false, now, false);
    return agenda->due & HD_DUE_STAGE;
}

TEST(stages_without_length_are_skipped)
{
    hd_agenda a = agenda_of(0.0, 5.0, 1.0);
    hd_agenda_enter(&a, HD_EQUILIBRATING, 3.0);
    assert_int_equal(a.stage, HD_AVERAGING);
    CHECK_CLOSE(hd_agenda_stage_end(&a), 8.0, 0.0);
    a = agenda_of(2.0, 0.0, 1.0);
    hd_agenda_enter(&a, HD_EQUILIBRATING, 3.0);
    assert_int_equal(a.stage, HD_WARMING_UP);
    CHECK_CLOSE(hd_agenda_stage_end(&a), 5.0, 0.0);
    hd_agenda_enter(&a, HD_AVERAGING, 5.0);
    assert_true(hd_agenda_stage_end(&a) == INFINITY);
}

/** Fields come with the first report, at multiples of their interval, and where a target or a
 * change ends the averaging. */
TEST(fields_come_with_the_end)
{
    hd_scene_def scene = scene(.equilibration = 0.0, .warmup = 0.0, .duration = 0.0,
                               .report_interval = 1.0, .field_interval = 10.0);
    const unsigned both = HD_DUE_FIELDS | HD_DUE_STAGE;
    hd_agenda a = hd_agenda_of(&scene, 1.0);
    hd_agenda_enter(&a, HD_AVERAGING, 2.0);
    for (int report = 1; report <= 21; report++) {
        hd_agenda_begin(&a);
        hd_agenda_pass_report(&a, false);
        assert_int_equal(a.due & both, report == 1 || report % 10 == 0 ? HD_DUE_FIELDS : 0);
    }
    hd_agenda_pass_report(&a, true);
    assert_int_equal(a.due & both, both);
    hd_agenda_begin(&a);
    hd_agenda_enter(&a, HD_AVERAGING, 2.0);
    scene.duration = 1.0;
    assert_true(is_over(&a, &scene, 3.0));
    assert_int_equal(a.due & both, both);
}

/** Each cut is checked against its time; the last report may be a short one, but not of rounding
 * alone. */
TEST(reports_end_at_multiples_and_with_the_stage)
{
    const double intervals[] = {0.05, 0.1, 0.7, 1.0, 3.0, 33.33333333333, 99.0, 100.0, 1e4};
    for (size_t k = 0; k < sizeof intervals / sizeof *intervals; k++) {
        hd_agenda a = agenda_of(0.0, 100.0, intervals[k]);
        hd_agenda_enter(&a, HD_AVERAGING, 2.0);
        int reports = 0;
        for (bool ends = false; !ends;) {
            CHECK_CLOSE(hd_agenda_cut(&a), fmin(2.0 + ++reports * intervals[k], 102.0), 1e-9);
            ends = passed(&a);
            assert_true(reports < 10000);
        }
        assert_int_equal(reports, (int)ceil(100.0 / intervals[k] * (1.0 - 1e-9)));
    }
}

/** A cut; never a time that has passed. */
TEST(an_end_that_falls_on_a_cut_is_the_cut)
{
    hd_agenda a = agenda_of(0.0, 100.0, 0.05);
    hd_agenda_enter(&a, HD_AVERAGING, 30.0);
    const double cut = hd_agenda_cut(&a), rounding = 32.0 * DBL_EPSILON * cut;
    assert_true(hd_agenda_snap(&a, 30.0, 0.05 * (1.0 - rounding)) == cut);
    assert_true(hd_agenda_snap(&a, 30.0, 0.05 * (1.0 + rounding)) == cut);
    const double third = hd_agenda_snap(&a, cut, 0.1 - rounding);
    CHECK_CLOSE(third, 30.15, 1e-13);
    assert_true(hd_agenda_snap(&a, 30.0, 0.15 + rounding) == third);
    assert_true(hd_agenda_snap(&a, 30.0, 0.049) == 30.0 + 0.049);
    assert_true(hd_agenda_snap(&a, 30.0, 1e-11) > 30.0);
    assert_true(hd_agenda_snap(&a, 30.0, 100.0 - rounding) == 130.0);
}

/** Also where reports are counted from later than the averaging. */
TEST(an_end_falls_on_a_cut_of_another_interval)
{
    hd_scene_def scene = hd_scene_def_default();
    hd_agenda a = agenda_of(0.0, 100.0, 1.0);
    hd_agenda_enter(&a, HD_AVERAGING, 30.0);
    (void)passed(&a);
    (void)passed(&a);
    scene.duration = 100.0;
    scene.report_interval = 0.07;
    hd_agenda_ask(&a, false);
    CHECK_CLOSE(hd_agenda_change(&a, &scene, false, 32.3, false), 32.37, 1e-13);
    CHECK_CLOSE(hd_agenda_cut(&a), 32.37, 1e-13);
    const double rounding = 32.0 * DBL_EPSILON * 32.0;
    assert_true(hd_agenda_snap(&a, 32.3, 0.07 - rounding) == hd_agenda_cut(&a));
    assert_true(hd_agenda_snap(&a, 32.3, 0.07 + rounding) == hd_agenda_cut(&a));
}

/** Of the reports every `report` time units in an averaging of 50. */
static void expect_multiples(double report, double interval)
{
    hd_agenda a = agenda_of(0.0, 50.0, report);
    hd_agenda_enter(&a, HD_AVERAGING, 7.0);
    int reports = 0, due = 0;
    for (bool ends = false; !ends;) {
        const double cut = hd_agenda_cut(&a), next = hd_agenda_next_multiple(&a, interval);
        assert_true(next >= cut && next <= hd_agenda_stage_end(&a));
        ends = passed(&a);
        reports++;
        /* whole numbers of thousandths, which round nothing */
        const long unit = lround(1000.0 * interval), length = lround(1000.0 * report);
        const long now = reports * length, before = now - length;
        const bool first = reports == 1 || unit == 0 || now / unit > before / unit;
        assert_int_equal(next == cut, ends || first);
        due += next == cut;
    }
    assert_true(due >= 2 && due <= reports);
}

/** Once for each, at the first report and at the last. */
TEST(multiples_are_reached_once)
{
    const double reports[] = {1.0, 0.3, 0.1, 7.0, 2.5};
    const double intervals[] = {0.0, 0.5, 1.0, 1.3, 10.0, 1000.0};
    for (size_t r = 0; r < sizeof reports / sizeof *reports; r++)
        for (size_t k = 0; k < sizeof intervals / sizeof *intervals; k++)
            expect_multiples(reports[r], intervals[k]);
}

/** However far apart reports are: a stage is over at its end, and not before; it is what it is to
 * the rounding of a duration with 15 digits. */
TEST(reports_do_not_end_a_stage)
{
    const double starts[] = {0.0, 23.0, 1e6};
    for (double report = 1e-6; report <= 1e12; report *= 10.0)
        for (int k = 0; k < 3; k++) {
            const double start = starts[k], end = start + 30.0;
            const hd_scene_def scene = scene(.duration = 30.0, .report_interval = report);
            hd_agenda a = agenda_of(0.0, 30.0, report);
            hd_agenda_enter(&a, HD_AVERAGING, start);
            assert_false(is_over(&a, &scene, start + 29.9999999));
            assert_true(is_over(&a, &scene, end));
            assert_true(is_over(&a, &scene, end * (1.0 - 32.0 * DBL_EPSILON)));
            assert_false(hd_agenda_reopen(&a, start + 30.0000001));
            a.stage = HD_FINISHED;
            assert_true(hd_agenda_reopen(&a, end));
            assert_int_equal(a.stage, HD_FINISHED);
            assert_true(hd_agenda_reopen(&a, start + 29.9999999));
            assert_int_equal(a.stage, HD_AVERAGING);
        }
}

/** At the very report, however many there are between two multiples. */
TEST(multiples_are_not_reached_early)
{
    for (double report = 1e-6; report < 1.0; report *= 10.0) {
        hd_agenda a = agenda_of(0.0, 5000.0, report);
        hd_agenda_enter(&a, HD_AVERAGING, 7.0);
        (void)passed(&a);
        CHECK_CLOSE(hd_agenda_next_multiple(&a, 1000.0), 1007.0, 4.0 * DBL_EPSILON * 1007.0);
    }
}

/* ---- samples, interval by interval ----------------------------------------------------------- */

/** Goes to the end of the interval that is planned, and plans the next one. */
static void next_interval(hd_agenda *agenda, hd_interval_request *pace)
{
    pace->now = hd_agenda_plan(agenda, pace);
    agenda->interval_end = pace->now;
    hd_agenda_plan(agenda, pace);
}

/** Of a run whose first samples should last 1.38 blocks of 8, at intervals of 4. */
static hd_interval_request averaging(hd_agenda *agenda, hd_interval *interval, double phases)
{
    const hd_scene_def scene = scene(.number = 30, .density = 0.6, .equilibration = 0.0,
                                     .warmup = 0.0, .duration = 1000.0, .report_interval = 1000.0);
    const hd_interval_request pace = {.framed = true,
                                      .phases = phases,
                                      .snapshot = INFINITY,
                                      .interval = interval,
                                      .longest = INFINITY};
    *agenda = hd_agenda_of(&scene, 1.0);
    *interval = hd_interval_first(4.0, 4.0, 1e-8);
    hd_agenda_enter(agenda, HD_AVERAGING, 0.0);
    hd_agenda_plan(agenda, &pace);
    return pace;
}

/** Averages that begin anew where a sample was about to end have a whole one first, although the
 * interval that is planned stays. */
TEST(the_first_sample_after_a_reset_is_a_whole_one)
{
    hd_agenda agenda;
    hd_interval interval;
    hd_interval_request pace = averaging(&agenda, &interval, INFINITY);
    int intervals = 1;
    for (; !agenda.sample_ends && intervals < 100; intervals++) next_interval(&agenda, &pace);
    assert_int_equal(intervals, 3); /* 12 is nearer to 11 than 8 */
    hd_agenda_enter(&agenda, HD_AVERAGING, pace.now);
    pace.now = hd_agenda_plan(&agenda, &pace);
    assert_int_equal(hd_agenda_reached(&agenda, &pace), HD_DUE_INTERVAL);
}

/** Of 1000 time units a 32nd, of a long run as long as 80 collisions; whatever the stage. */
TEST(a_sample_is_known_to_be_no_longer)
{
    hd_scene_def scene = scene(.number = 30, .density = 0.6, .duration = 1000.0);
    hd_agenda agenda = hd_agenda_of(&scene, 1.0);
    CHECK_CLOSE(hd_agenda_sample_most(&agenda), 1000.0 / 32.0, 1e-12);
    scene.duration = 0.0;
    agenda = hd_agenda_of(&scene, 1.0);
    CHECK_CLOSE(hd_agenda_sample_most(&agenda), 80.0, 1e-12);
}

/** Samples of a run without end, with intervals of at most this length: the first one fills a
 * block, all later ones are at most a 16th of what there was before, but for half an interval, or
 * as short as the first; the last ones are 80 collisions long. */
static void check_growth(double length)
{
    const hd_scene_def scene = scene(.number = 30, .density = 0.6, .equilibration = 0.0,
                                     .warmup = 0.0, .duration = 0.0, .report_interval = 1e4);
    hd_agenda agenda = hd_agenda_of(&scene, 1.0);
    hd_interval interval = hd_interval_first(length, length, 1e-8);
    hd_interval_request pace = {.framed = true,
                                .phases = INFINITY,
                                .snapshot = INFINITY,
                                .interval = &interval,
                                .longest = INFINITY};
    const double first = 1.38 * agenda.block;
    hd_agenda_enter(&agenda, HD_AVERAGING, 0.0);
    hd_agenda_plan(&agenda, &pace);
    double sample = 0.0;
    while (pace.now < 3000.0) {
        const bool ends = agenda.sample_ends;
        const double before = agenda.sample_begin;
        pace.now = hd_agenda_plan(&agenda, &pace);
        agenda.interval_end = pace.now;
        if (ends) {
            sample = pace.now - before;
            assert_true(sample >= 0.9 * agenda.block);
            assert_true(sample <= fmax(first, before / 16.0) + 0.5 * length);
            hd_agenda_pass_sample(&agenda, pace.now);
        }
        hd_agenda_plan(&agenda, &pace);
    }
    CHECK_CLOSE(sample, 80.0, 0.5 * length);
}

TEST(samples_grow_with_what_is_averaged)
{
    const double lengths[] = {0.5, 3.0, 7.3, 7.9, 12.0, 25.0}; /* a block lasts 8 */
    for (size_t k = 0; k < sizeof lengths / sizeof *lengths; k++) check_growth(lengths[k]);
}

/** At a report, 16 blocks after the start or more; a duration that ends before it is known. */
TEST(errors_are_told_at_a_report)
{
    static const struct {
        double duration, after;
    } cases[] = {{0.0, 200.0},   /* 1.3 blocks of 8: 166 */
                 {170.0, 150.0}, /* of a short run 1.05: 134 */
                 {140.0, 140.0},
                 {130.0, 134.4}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const hd_scene_def scene = scene(.number = 30, .density = 0.6, .report_interval = 50.0,
                                         .duration = cases[k].duration);
        const hd_agenda agenda = hd_agenda_of(&scene, 1.0);
        CHECK_CLOSE(agenda.block, 8.0, 1e-12);
        CHECK_CLOSE(hd_agenda_errors_after(&agenda), cases[k].after, 1e-9);
    }
}

/** A little shorter, not by a sixth. */
TEST(intervals_fit_the_time_of_phases_where_that_is_cheap)
{
    hd_agenda agenda;
    hd_interval interval;
    hd_interval_request pace = averaging(&agenda, &interval, 11.0);
    CHECK_CLOSE(hd_agenda_plan(&agenda, &pace), 11.0 / 3.0, 1e-12);
    pace = averaging(&agenda, &interval, 10.0);
    CHECK_CLOSE(hd_agenda_plan(&agenda, &pace), 4.0, 1e-12);
}
