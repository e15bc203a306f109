/** What is said to limit the interval between orthonormalisations is what does: each case is one in
 * which only that can. */
#include "runs.h"

static hd_scene_def scene_of_disks(int disks, double report_interval)
{
    return scene(.number = disks, .density = 0.8, .aspect = 1.0, .equilibration = 2.0,
                 .warmup = 40.0, .duration = 0.0, .observe = 0, .report_interval = report_interval);
}

typedef struct seen {
    double interval;
    hd_limit limit;
    double sample; /**< what it should last at most */
} seen;

static seen seen_of(const hd_run *run)
{
    const hd_cost cost = hd_run_cost(run);
    return (seen){cost.interval, cost.limit,
                  hd_agenda_sample_longest(&run->agenda, &run->carrier.interval)};
}

/** Some samples after the averaging began. */
static seen settled(const hd_scene_def *scene)
{
    OWNED(hd_run) *run = created(*scene);
    until(run, HD_AVERAGING);
    const double from = run->agenda.start,
                 sample = hd_agenda_sample_longest(&run->agenda, &run->carrier.interval);
    until_time(run, from + 3.5 * fmax(sample, scene->report_interval));
    return seen_of(run);
}

/** What the conditioning allows where nothing else limits: reports are far apart, and far from a
 * multiple of it. */
static seen alone(int disks)
{
    const hd_scene_def scene = scene_of_disks(disks, 20.0);
    return settled(&scene);
}

TEST(the_conditioning_is_not_called_a_report)
{
    const seen last = alone(24);
    assert_int_equal(last.limit, HD_LIMIT_CONDITION);
    assert_true(last.interval < 10.0);
}

/** In 120 time units of averaging, after the first report, which has something to say. */
static long orthonormalisations_with(double report_interval)
{
    OWNED(hd_run) *run = created(scene_of_disks(60, report_interval));
    while (hd_run_stage(run) < HD_AVERAGING || hd_run_time(run) < run->agenda.start + 12.0)
        CHECK_OK(hd_run_advance(run));
    const long before = hd_run_cost(run).orthonormalisations;
    until_time(run, run->agenda.start + 132.0);
    return hd_run_cost(run).orthonormalisations - before;
}

/** Conditions scatter: within a tenth. */
TEST(a_report_costs_no_orthonormalisation)
{
    const double reports[] = {0.05, 0.1, 1.0, 10.0};
    const long few = orthonormalisations_with(12.0);
    for (int k = 0; k < 4; k++) {
        const long count = orthonormalisations_with(reports[k]);
        CHECK_CLOSE((double)count, (double)few, 0.1 * (double)few);
    }
}

TEST(the_parameter_limits)
{
    hd_scene_def scene = scene_from(scene_of_disks(24, 20.0), .interval = 0.3);
    assert_int_equal(settled(&scene).limit, HD_LIMIT_SCENE);
    scene.report_interval = 0.3;
    assert_int_equal(settled(&scene).limit, HD_LIMIT_SCENE);
}

TEST(samples_for_errors_limit)
{
    hd_scene_def scene = scene_of_disks(24, 0.05);
    scene.duration = 16.0; /* 32 of half a time unit, or shorter, so that they fill blocks */
    const seen last = settled(&scene);
    assert_int_equal(last.limit, HD_LIMIT_SAMPLE);
    CHECK_CLOSE(last.interval, last.sample, 0.05 * last.sample); /* equal shares of the rest */
    assert_true(last.interval <= 0.5);
    scene = scene_of_disks(24, 20.0); /* of one vector, nothing else is known */
    scene.exponents = 1;
    const seen one = settled(&scene);
    assert_int_equal(one.limit, HD_LIMIT_SAMPLE);
}

/** Foreseen, and of somebody who came in the middle of an interval; of a run whose samples are no
 * longer short. */
TEST(vectors_that_are_wanted_limit)
{
    hd_scene_def scene = scene_from(
        scene_of_disks(24, 0.5), .observe = HD_OBSERVE_MODES | HD_OBSERVE_STEPS | HD_OBSERVE_HYDRO,
        .max_mode_number = 1);
    OWNED(hd_run) *run = created(scene);
    hd_run_observe(run, HD_OBSERVE_STEPS);
    until_time(run, 150.0);
    long looks = 0, foreseen = 0;
    for (long reports = 0; hd_run_time(run) < 168.0;) {
        CHECK_OK(hd_run_advance(run));
        if (!hd_run_report_due(run) || hd_run_stage(run) != HD_AVERAGING) continue;
        hd_run_observe(run, ++reports % 8 < 4 ? scene.observe : HD_OBSERVE_STEPS);
        const seen last = seen_of(run);
        looks += last.limit == HD_LIMIT_LOOK;
        foreseen += last.limit == HD_LIMIT_SCHEDULE;
        if (last.limit == HD_LIMIT_SCHEDULE) CHECK_CLOSE(last.interval, 0.5, 1e-9);
    }
    assert_true(looks >= 4 && foreseen > 3 * looks / 2);
}

/** Learnt by doubling; then the stage ends. */
TEST(the_warmup_is_learnt_and_ends)
{
    hd_scene_def scene = scene_from(scene_of_disks(24, 0.5), .warmup = 0.5);
    OWNED(hd_run) *run = created(scene);
    assert_int_equal(seen_of(run).limit, HD_LIMIT_NONE);
    assert_true(isnan(seen_of(run).interval));
    bool learns = false;
    while (hd_run_stage(run) < HD_AVERAGING) {
        CHECK_OK(hd_run_advance(run));
        learns |= seen_of(run).limit == HD_LIMIT_GROWTH;
    }
    assert_true(learns);
    hd_run_free(run);
    scene.warmup = 1e-3;
    run = created(scene);
    until(run, HD_AVERAGING);
    assert_int_equal(seen_of(run).limit, HD_LIMIT_STAGE);
}
