/** Ends of stages and reports. */
#include "testing.h"
#include "run/schedule.h"

static hd_schedule schedule_of(double warmup, double duration, double report_interval)
{
    hd_scene_def scene = scene(.equilibration = 0.0, .warmup = warmup, .duration = duration,
                               .report_interval = report_interval);
    return hd_schedule_of(&scene);
}

TEST(stages_without_length_are_skipped)
{
    hd_schedule s = schedule_of(0.0, 5.0, 1.0);
    hd_schedule_enter(&s, HD_EQUILIBRATING, 3.0);
    assert_int_equal(s.stage, HD_AVERAGING);
    CHECK_CLOSE(hd_schedule_stage_end(&s), 8.0, 0.0);
    s = schedule_of(2.0, 0.0, 1.0);
    hd_schedule_enter(&s, HD_EQUILIBRATING, 3.0);
    assert_int_equal(s.stage, HD_WARMING_UP);
    CHECK_CLOSE(hd_schedule_stage_end(&s), 5.0, 0.0);
    hd_schedule_enter(&s, HD_AVERAGING, 5.0);
    assert_true(hd_schedule_stage_end(&s) == INFINITY);
}

/** Each cut is checked against its time; the last report may be a short one, but not of rounding
 * alone. */
TEST(reports_end_at_multiples_and_with_the_stage)
{
    const double intervals[] = {0.05, 0.1, 0.7, 1.0, 3.0, 33.33333333333, 99.0, 100.0, 1e4};
    for (size_t k = 0; k < sizeof intervals / sizeof *intervals; k++) {
        hd_schedule s = schedule_of(0.0, 100.0, intervals[k]);
        hd_schedule_enter(&s, HD_AVERAGING, 2.0);
        int reports = 0;
        for (bool ends = false; !ends;) {
            CHECK_CLOSE(hd_schedule_cut(&s), fmin(2.0 + ++reports * intervals[k], 102.0), 1e-9);
            ends = hd_schedule_pass(&s);
            assert_true(reports < 10000);
        }
        assert_int_equal(reports, (int)ceil(100.0 / intervals[k] * (1.0 - 1e-9)));
    }
}

/** A cut; never a time that has passed. */
TEST(an_end_that_falls_on_a_cut_is_the_cut)
{
    hd_schedule s = schedule_of(0.0, 100.0, 0.05);
    hd_schedule_enter(&s, HD_AVERAGING, 30.0);
    const double cut = hd_schedule_cut(&s), rounding = 32.0 * DBL_EPSILON * cut;
    assert_true(hd_schedule_snap(&s, 30.0, 0.05 * (1.0 - rounding)) == cut);
    assert_true(hd_schedule_snap(&s, 30.0, 0.05 * (1.0 + rounding)) == cut);
    const double third = hd_schedule_snap(&s, cut, 0.1 - rounding);
    CHECK_CLOSE(third, 30.15, 1e-13);
    assert_true(hd_schedule_snap(&s, 30.0, 0.15 + rounding) == third);
    assert_true(hd_schedule_snap(&s, 30.0, 0.049) == 30.0 + 0.049);
    assert_true(hd_schedule_snap(&s, 30.0, 1e-11) > 30.0);
    assert_true(hd_schedule_snap(&s, 30.0, 100.0 - rounding) == 130.0);
}

/** Also where reports are counted from later than the averaging. */
TEST(an_end_falls_on_a_cut_of_another_interval)
{
    hd_scene_def scene = hd_scene_def_default();
    hd_schedule s = schedule_of(0.0, 100.0, 1.0);
    hd_schedule_enter(&s, HD_AVERAGING, 30.0);
    (void)hd_schedule_pass(&s);
    (void)hd_schedule_pass(&s);
    scene.duration = 100.0;
    scene.report_interval = 0.07;
    hd_schedule_change(&s, &scene, 32.3);
    CHECK_CLOSE(hd_schedule_cut(&s), 32.37, 1e-13);
    const double rounding = 32.0 * DBL_EPSILON * 32.0;
    assert_true(hd_schedule_snap(&s, 32.3, 0.07 - rounding) == hd_schedule_cut(&s));
    assert_true(hd_schedule_snap(&s, 32.3, 0.07 + rounding) == hd_schedule_cut(&s));
}

/** Of the reports every `report` time units in an averaging of 50. */
static void expect_multiples(double report, double interval)
{
    hd_schedule s = schedule_of(0.0, 50.0, report);
    hd_schedule_enter(&s, HD_AVERAGING, 7.0);
    int reports = 0, due = 0;
    for (bool ends = false; !ends;) {
        const double cut = hd_schedule_cut(&s), next = hd_schedule_next_multiple(&s, interval);
        assert_true(next >= cut && next <= hd_schedule_stage_end(&s));
        ends = hd_schedule_pass(&s);
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
            hd_schedule s = schedule_of(0.0, 30.0, report);
            hd_schedule_enter(&s, HD_AVERAGING, start);
            assert_false(hd_schedule_is_over(&s, start + 29.9999999));
            assert_true(hd_schedule_is_over(&s, end));
            assert_true(hd_schedule_is_over(&s, end * (1.0 - 32.0 * DBL_EPSILON)));
            assert_false(hd_schedule_reopen(&s, start + 30.0000001));
            s.stage = HD_FINISHED;
            assert_true(hd_schedule_reopen(&s, end));
            assert_int_equal(s.stage, HD_FINISHED);
            assert_true(hd_schedule_reopen(&s, start + 29.9999999));
            assert_int_equal(s.stage, HD_AVERAGING);
        }
}

/** At the very report, however many there are between two multiples. */
TEST(multiples_are_not_reached_early)
{
    for (double report = 1e-6; report < 1.0; report *= 10.0) {
        hd_schedule s = schedule_of(0.0, 5000.0, report);
        hd_schedule_enter(&s, HD_AVERAGING, 7.0);
        (void)hd_schedule_pass(&s);
        CHECK_CLOSE(hd_schedule_next_multiple(&s, 1000.0), 1007.0, 4.0 * DBL_EPSILON * 1007.0);
    }
}
