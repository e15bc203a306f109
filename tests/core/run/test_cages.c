/** Whether disks have left their places: by hand, and in fluids, crystals and channels [T8]. */
#include "create_from.h"
#include "kept.h"
#include "run/cages.h"
#include "runs.h"

enum { FLYING = 20 };

/** Some of FLYING disks, in rows far apart, go along x at a speed of 1, around the box of 40 x 40
 * too. */
static hd_trajectory *flying(hd_scene_def *def, int moving)
{
    double q[2 * FLYING], p[2 * FLYING] = {0};
    hd_trajectory *trajectory;
    *def = scene_in_box(FLYING, 40.0, 40.0, P, P, 1);
    for (int i = 0; i < FLYING; i++) {
        q[2 * i] = 39.0;
        q[2 * i + 1] = 1.0 + 1.9 * i;
        p[2 * i] = i < moving;
    }
    CHECK_OK(hd_trajectory_create_from(&trajectory, def, q, p));
    return trajectory;
}

static void look_at(hd_cages *cages, hd_trajectory *trajectory, const hd_scene_def *def, double t)
{
    CHECK_OK(hd_trajectory_extend(trajectory, NULL, t));
    hd_cages_look(cages, trajectory, def);
}

/** Neighbours are sqrt(1600 / 20) apart. */
TEST(a_tenth_that_goes_seven_tenths_of_the_way)
{
    const double place = 0.7 * sqrt(80.0);
    for (int moving = 1; moving <= 2; moving++) {
        hd_scene_def def;
        hd_cages cages;
        hd_trajectory *trajectory = flying(&def, moving);
        const bool enough = moving * 10 >= FLYING;
        CHECK_OK(hd_cages_create(&cages, &def));
        hd_cages_begin(&cages, trajectory);
        assert_false(hd_cages_hold(&cages, 0.0)); /* nobody has looked */
        look_at(&cages, trajectory, &def, place - 0.01);
        assert_true(hd_cages_hold(&cages, place - 0.02));
        assert_false(hd_cages_hold(&cages, place)); /* too short to say */
        look_at(&cages, trajectory, &def, place + 0.01);
        assert_int_equal(hd_cages_hold(&cages, 1.0), !enough);
        look_at(&cages, trajectory, &def, 40.0); /* once around the box: left for good */
        assert_int_equal(hd_cages_hold(&cages, 1.0), !enough);
        hd_cages_begin(&cages, trajectory);
        look_at(&cages, trajectory, &def, 45.0);
        assert_true(hd_cages_hold(&cages, 1.0));
        hd_cages_clear(&cages);
        hd_trajectory_free(trajectory);
    }
}

/** The nearest image is as near. */
TEST(around_the_box_is_no_way)
{
    hd_scene_def def;
    hd_cages cages;
    hd_trajectory *trajectory = flying(&def, FLYING);
    CHECK_OK(hd_cages_create(&cages, &def));
    hd_cages_begin(&cages, trajectory);
    look_at(&cages, trajectory, &def, 40.0 - 1.0);
    assert_true(hd_cages_hold(&cages, 1.0));
    hd_cages_clear(&cages);
    hd_trajectory_free(trajectory);
}

static hd_scene_def moving(hd_scene_def def)
{
    return scene_from(def, .exponents = HD_EXPONENTS_NONE, .equilibration = 50.0, .warmup = 0.0,
                      .duration = 100.0, .threads = 1);
}

/** Whole runs, at their ends. */
TEST(fluids_flow_and_crystals_do_not)
{
    const struct {
        hd_scene_def scene;
        bool caged;
    } cases[] = {{scene_of(100, 0.7, 0.867, P, P, 1), false},
                 {scene_of(4, 0.5, 1.0, P, P, 1), false},
                 {scene_of(36, 0.8, 0.867, P, P, 1), false},
                 {scene_of(36, 0.7, 0.5, R, R, 1), false},
                 {scene_of(60, 0.8, 0.03, P, P, 1), false}, /* in single file */
                 {scene(.container = HD_CIRCLE, .number = 60, .density = 0.8), false},
                 {scene_of(100, 1.0, 0.867, P, P, 1), true},
                 {scene_of(36, 1.05, 0.867, P, P, 1), true},
                 {scene(.container = HD_CIRCLE, .number = 100, .density = 1.0), true}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        for (uint64_t seed = 1; seed <= 3; seed++) {
            OWNED(hd_run) *run = finished(scene_from(moving(cases[k].scene), .seed = seed));
            if (hd_run_is_caged(run) != cases[k].caged) fail_msg("case %zu, seed %d", k, (int)seed);
        }
}

/** Nothing is said before errors are stated; a run that is taken up again remembers its start;
 * averages that begin anew do not. */
TEST(it_is_said_once_errors_are)
{
    const hd_scene_def scene = scene_from(moving(scene_of(36, 1.0, 0.867, P, P, 1)), .exponents = 4,
                                          .report_interval = 0.5);
    OWNED(hd_run) *run = until(kept_run(scene), HD_AVERAGING);
    const double begin = hd_run_time(run), after = HD_SPECTRUM_BLOCKS_MIN * run->agenda.block;
    until_time(run, begin + after - 1.0);
    assert_false(hd_run_is_caged(run));
    OWNED(hd_run) *resumed = kept_and_resumed(run, "cages.test", NULL);
    until_time(resumed, begin + after + 1.0);
    assert_true(hd_run_is_caged(resumed));
    CHECK_OK(hd_run_reset_average(resumed));
    assert_false(hd_run_is_caged(resumed));
}
