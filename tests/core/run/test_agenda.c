/** When samples end, interval by interval. */
#include "testing.h"
#include "run/agenda.h"

/** Goes to the end of the interval that is planned, and plans the next one. */
static void next_interval(hd_agenda *agenda, hd_pace *pace)
{
    pace->now = hd_agenda_next(agenda, pace);
    hd_agenda_pass_interval(agenda, pace->now);
    hd_agenda_plan(agenda, pace);
}

/** Of a run whose first samples should last 1.38 blocks of 8, at intervals of 4. */
static hd_pace averaging(hd_agenda *agenda, hd_interval *interval, double phases)
{
    const hd_scene_def scene = scene(.number = 30, .density = 0.6, .equilibration = 0.0,
                                     .warmup = 0.0, .duration = 1000.0, .report_interval = 1000.0);
    const hd_pace pace = {.framed = true,
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
    hd_pace pace = averaging(&agenda, &interval, INFINITY);
    int intervals = 1;
    for (; !agenda.sample_ends && intervals < 100; intervals++) next_interval(&agenda, &pace);
    assert_int_equal(intervals, 3); /* 12 is nearer to 11 than 8 */
    hd_agenda_enter(&agenda, HD_AVERAGING, pace.now);
    pace.now = hd_agenda_next(&agenda, &pace);
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
    hd_pace pace = {.framed = true,
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
        pace.now = hd_agenda_next(&agenda, &pace);
        hd_agenda_pass_interval(&agenda, pace.now);
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
    hd_pace pace = averaging(&agenda, &interval, 11.0);
    CHECK_CLOSE(hd_agenda_next(&agenda, &pace), 11.0 / 3.0, 1e-12);
    pace = averaging(&agenda, &interval, 10.0);
    CHECK_CLOSE(hd_agenda_next(&agenda, &pace), 4.0, 1e-12);
}
