/** Ends of phases, samples and reports. */
#include <float.h>

#include "testing.h"

#include "run/schedule.h"

static hd_schedule schedule_of(double warmup, double duration, double report_interval)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.equilibration = 0.0;
    scene.warmup = warmup;
    scene.duration = duration;
    scene.report_interval = report_interval;
    return hd_schedule_of(&scene);
}

static void phases_without_length_are_skipped(void **state)
{
    (void)state;
    hd_schedule s = schedule_of(0.0, 5.0, 1.0);
    hd_schedule_enter(&s, HD_EQUILIBRATING, 3.0, 1.0);
    assert_int_equal(s.stage, HD_AVERAGING);
    CHECK_CLOSE(hd_schedule_stage_end(&s), 8.0, 0.0);
    s = schedule_of(2.0, 0.0, 1.0);
    hd_schedule_enter(&s, HD_EQUILIBRATING, 3.0, 1.0);
    assert_int_equal(s.stage, HD_WARMING_UP);
    CHECK_CLOSE(hd_schedule_stage_end(&s), 5.0, 0.0);
    hd_schedule_enter(&s, HD_AVERAGING, 5.0, 1.0);
    assert_true(hd_schedule_stage_end(&s) == INFINITY);
}

/** What ends at the cuts of one phase, until it does: counts, and every cut checked against its
 * time. */
typedef struct counts {
    int cuts, reports, samples, whole;
} counts;

static counts run_through(hd_schedule *s, double cut_length, double piece_max)
{
    counts seen = {0};
    const double start = s->start, end = hd_schedule_stage_end(s);
    for (unsigned ends = 0; !(ends & HD_ENDS_STAGE);) {
        CHECK_CLOSE(hd_schedule_cut(s), fmin(start + ++seen.cuts * cut_length, end), 1e-9);
        assert_true(hd_schedule_sample_end(s) >= hd_schedule_cut(s));
        ends = hd_schedule_pass(s, piece_max);
        seen.reports += (ends & HD_ENDS_REPORT) != 0;
        seen.samples += (ends & HD_ENDS_SAMPLE) != 0;
        seen.whole += (ends & HD_ENDS_WHOLE_SAMPLE) != 0;
        assert_true(seen.cuts < 1000000);
    }
    return seen;
}

static void before_the_averaging_there_is_one_sample(void **state)
{
    (void)state;
    hd_schedule s = schedule_of(10.0, 100.0, 0.7);
    hd_schedule_enter(&s, HD_WARMING_UP, 2.0, 0.1);
    CHECK_CLOSE(hd_schedule_sample_end(&s), 12.0, 0.0);
    const counts seen = run_through(&s, 0.7, INFINITY);
    assert_int_equal(seen.reports, 15);
    assert_int_equal(seen.samples, 1);
}

/** Several reports in a sample, or several samples in a report; never longer than allowed. */
static void samples_are_as_long_as_allowed(void **state)
{
    (void)state;
    const struct {
        double report_interval, sample_max, sample, cut;
    } cases[] = {{1.0, 2.65, 2.0, 1.0},  {1.0, 0.9, 0.5, 0.5}, {0.1, 2.65, 2.6, 0.1},
                 {10.0, 2.65, 2.5, 2.5}, {1.0, 1.0, 1.0, 1.0}, {1.0, 3.0, 3.0, 1.0}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        hd_schedule s = schedule_of(0.0, 200.0, cases[k].report_interval);
        hd_schedule_enter(&s, HD_AVERAGING, 50.0, cases[k].sample_max);
        CHECK_CLOSE(s.sample_length, cases[k].sample, 1e-12);
        const counts seen = run_through(&s, cases[k].cut, INFINITY);
        assert_int_equal(seen.reports, (int)(200.0 / cases[k].report_interval + 0.5));
        assert_int_equal(seen.whole, (int)(200.0 / cases[k].sample + 1e-6));
        assert_int_equal(seen.samples, (int)ceil(200.0 / cases[k].sample - 1e-6));
    }
}

static void a_short_averaging_has_samples_all_the_same(void **state)
{
    (void)state;
    hd_schedule s = schedule_of(0.0, 40.0, 1.0);
    hd_schedule_enter(&s, HD_AVERAGING, 0.0, 10.0);
    CHECK_CLOSE(s.sample_length, 1.0, 0.0);
    s = schedule_of(0.0, 96.0, 1.0);
    hd_schedule_enter(&s, HD_AVERAGING, 0.0, 10.0);
    CHECK_CLOSE(s.sample_length, 3.0, 0.0);
    s = schedule_of(0.0, 0.0, 1.0); /* endless */
    hd_schedule_enter(&s, HD_AVERAGING, 0.0, 10.0);
    CHECK_CLOSE(s.sample_length, 10.0, 0.0);
}

/** From the second sample on; reports stay where they were. */
static void pieces_are_short_enough_for_the_phases(void **state)
{
    (void)state;
    hd_schedule s = schedule_of(0.0, 100.0, 1.0);
    hd_schedule_enter(&s, HD_AVERAGING, 0.0, 2.0);
    (void)hd_schedule_pass(&s, 0.4);
    (void)hd_schedule_pass(&s, 0.4);
    assert_int_equal(s.pieces, 6);
    assert_int_equal(hd_schedule_cuts_per_report(&s), 3);
    for (int k = 1; k <= 6; k++) {
        CHECK_CLOSE(hd_schedule_cut(&s), 2.0 + k / 3.0, 1e-12);
        const unsigned ends = hd_schedule_pass(&s, 0.4);
        assert_int_equal((ends & HD_ENDS_REPORT) != 0, k % 3 == 0);
        assert_int_equal((ends & HD_ENDS_SAMPLE) != 0, k == 6);
    }
}

/** A cut or the end of a sample; never a time that has passed. */
static void an_end_that_falls_on_a_cut_is_the_cut(void **state)
{
    (void)state;
    hd_schedule s = schedule_of(0.0, 100.0, 0.05);
    hd_schedule_enter(&s, HD_AVERAGING, 30.0, 2.3);
    const double cut = hd_schedule_cut(&s), rounding = 32.0 * DBL_EPSILON * cut;
    assert_true(hd_schedule_snap(&s, 30.0, 0.05 * (1.0 - rounding)) == cut);
    assert_true(hd_schedule_snap(&s, 30.0, 0.05 * (1.0 + rounding)) == cut);
    const double third = hd_schedule_snap(&s, cut, 0.1 - rounding);
    CHECK_CLOSE(third, 30.15, 1e-13);
    assert_true(hd_schedule_snap(&s, 30.0, 0.15 + rounding) == third);
    assert_true(hd_schedule_snap(&s, 30.0, 0.049) == 30.0 + 0.049);
    assert_true(hd_schedule_snap(&s, 30.0, 1e-11) > 30.0);
    assert_true(hd_schedule_snap(&s, 30.0, s.sample_length - rounding) ==
                hd_schedule_sample_end(&s));
}

/** Also where reports are counted from later than the averaging. */
static void an_end_falls_on_a_cut_of_another_interval(void **state)
{
    (void)state;
    hd_scene_def scene = hd_scene_def_default();
    hd_schedule s = schedule_of(0.0, 100.0, 1.0);
    hd_schedule_enter(&s, HD_AVERAGING, 30.0, 2.3);
    (void)hd_schedule_pass(&s, INFINITY);
    (void)hd_schedule_pass(&s, INFINITY);
    scene.duration = 100.0;
    scene.report_interval = 0.07;
    hd_schedule_change(&s, &scene, 32.0, 2.3, INFINITY);
    CHECK_CLOSE(hd_schedule_cut(&s), 32.07, 1e-13);
    const double rounding = 32.0 * DBL_EPSILON * 32.0;
    assert_true(hd_schedule_snap(&s, 32.0, 0.07 - rounding) == hd_schedule_cut(&s));
    assert_true(hd_schedule_snap(&s, 32.0, 0.07 + rounding) == hd_schedule_cut(&s));
}

/** Of the reports every `report` time units in an averaging of 50, with cuts as short as piece_max.
 */
static void expect_multiples(double report, double sample_max, double piece_max, double interval)
{
    hd_schedule s = schedule_of(0.0, 50.0, report);
    hd_schedule_enter(&s, HD_AVERAGING, 7.0, sample_max);
    int reports = 0, due = 0;
    for (unsigned ends = 0; !(ends & HD_ENDS_STAGE);) {
        const bool reaches = hd_schedule_reaches_multiple(&s, interval);
        ends = hd_schedule_pass(&s, piece_max);
        reports += (ends & HD_ENDS_REPORT) != 0;
        /* whole numbers of thousandths, which round nothing */
        const long unit = lround(1000.0 * interval), length = lround(1000.0 * report);
        const long now = reports * length, before = now - length;
        const bool first = reports == 1 || unit == 0 || now / unit > before / unit;
        assert_int_equal(reaches, (ends & HD_ENDS_STAGE) || ((ends & HD_ENDS_REPORT) && first));
        due += reaches;
    }
    assert_true(due >= 2 && due <= reports);
}

/** Once for each, at the first report and at the last, and never between two reports. */
static void multiples_are_reached_once(void **state)
{
    (void)state;
    const double reports[] = {1.0, 0.3, 0.1, 7.0, 2.5};
    const double intervals[] = {0.0, 0.5, 1.0, 1.3, 10.0, 1000.0};
    for (size_t r = 0; r < sizeof reports / sizeof *reports; r++)
        for (size_t k = 0; k < sizeof intervals / sizeof *intervals; k++) {
            expect_multiples(reports[r], 0.9, INFINITY, intervals[k]);
            expect_multiples(reports[r], 2.65, INFINITY, intervals[k]);
            expect_multiples(reports[r], 2.65, 0.04, intervals[k]);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(phases_without_length_are_skipped),
        cmocka_unit_test(before_the_averaging_there_is_one_sample),
        cmocka_unit_test(samples_are_as_long_as_allowed),
        cmocka_unit_test(a_short_averaging_has_samples_all_the_same),
        cmocka_unit_test(pieces_are_short_enough_for_the_phases),
        cmocka_unit_test(an_end_that_falls_on_a_cut_is_the_cut),
        cmocka_unit_test(an_end_falls_on_a_cut_of_another_interval),
        cmocka_unit_test(multiples_are_reached_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
