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

/** Of a run whose samples should last 1000 / 32, at intervals of 4. */
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
    assert_int_equal(intervals, 8); /* 32 is nearer than 28 */
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
