/** Pressure and collision rate of whole runs: those of the trajectory over the averaged time,
 * whoever carries a frame or looks on. */
#include "runs.h"

static hd_scene_def scene_with(int exponents, unsigned observe)
{
    return scene(.number = 30, .density = 0.6, .aspect = 0.9, .boundary[1] = R, .seed = 4,
                 .exponents = exponents, .observe = observe, .equilibration = 5.0,
                 .warmup = exponents == HD_EXPONENTS_NONE ? 0.0 : 10.0, .duration = 150.0,
                 .threads = 1);
}

/** Of a trajectory by itself, between two simulated times. */
static hd_gas_means by_itself(const hd_scene_def *scene, double begin, double end)
{
    MADE(hd_trajectory, tr, scene);
    MADE(hd_gas, gas, scene, 0.0);
    CHECK_OK(hd_trajectory_extend(tr, NULL, begin));
    hd_gas_begin(gas, tr);
    CHECK_OK(hd_trajectory_extend(tr, NULL, end));
    hd_gas_add(gas, tr);
    return hd_gas_read(gas);
}

static void expect_same(hd_gas_means got, hd_gas_means want)
{
    const double rounding = 1e-11;
    CHECK_CLOSE(got.time, want.time, rounding);
    CHECK_CLOSE(got.collision_rate, want.collision_rate, rounding);
    CHECK_CLOSE(got.pressure, want.pressure, rounding);
    for (int d = 0; d < 2; d++) CHECK_CLOSE(got.pressure_of[d], want.pressure_of[d], rounding);
}

/** At every report; with a frame over the averaged time of the spectrum, without one up to now. */
TEST(means_are_those_of_the_averaged_time)
{
    static const int exponents[] = {HD_EXPONENTS_NONE, 1, HD_EXPONENTS_POSITIVE};
    for (int k = 0; k < 3; k++) {
        const hd_scene_def scene = scene_with(exponents[k], HD_OBSERVE_GAS);
        const double begin = scene.equilibration + scene.warmup;
        OWNED(hd_run) *run = created(scene);
        int reports = 0;
        while (going_on(run)) {
            if (!hd_run_report_due(run) || !(hd_gas_read(hd_run_gas(run)).time > 0)) continue;
            const double averaged = hd_run_spectrum(run) ? hd_spectrum_time(hd_run_spectrum(run))
                                                         : hd_run_time(run) - begin;
            if (++reports % 10 == 0)
                expect_same(hd_gas_read(hd_run_gas(run)),
                            by_itself(&scene, begin, begin + averaged));
        }
        const hd_gas_means last = hd_gas_read(hd_run_gas(run));
        assert_true(reports >= 100);
        CHECK_CLOSE(last.time, scene.duration, 1e-9);
        assert_true(last.pressure_error > 0 && last.pressure_error < 0.05 * last.pressure);
        assert_true(last.collision_rate_error > 0);
    }
}

static hd_gas_means watched(const hd_scene_def *scene, double between)
{
    OWNED(hd_run) *run = created(*scene);
    hd_run_watch(run, between);
    finish(run);
    return hd_gas_read(hd_run_gas(run));
}

/** Nor does it matter who looks on; one report at the end is enough for an error. */
TEST(errors_do_not_depend_on_who_looks)
{
    hd_scene_def scene = scene_with(HD_EXPONENTS_NONE, HD_OBSERVE_GAS);
    scene.report_interval = scene.duration;
    const hd_gas_means alone = watched(&scene, INFINITY), other = watched(&scene, 0.03);
    assert_true(alone.pressure_error > 0);
    CHECK_CLOSE(other.pressure, alone.pressure, 0.0);
    CHECK_CLOSE(other.pressure_error, alone.pressure_error, 0.0);
    CHECK_CLOSE(other.collision_rate_error, alone.collision_rate_error, 0.0);
}

TEST(averages_begin_anew)
{
    static const int exponents[] = {HD_EXPONENTS_NONE, 2};
    for (int k = 0; k < 2; k++) {
        const hd_scene_def scene = scene_with(exponents[k], HD_OBSERVE_GAS);
        OWNED(hd_run) *run = created(scene);
        until_time(run, 100.0);
        const double begin = hd_run_time(run);
        const hd_gas_means before = hd_gas_read(hd_run_gas(run));
        assert_true(before.time > 10.0 && before.pressure_error > 0);
        CHECK_OK(hd_run_reset_average(run));
        const hd_gas_means after = hd_gas_read(hd_run_gas(run));
        CHECK_CLOSE(after.time, 0.0, 0.0);
        assert_true(after.pressure_error < 0 && after.collision_rate_error < 0);
        finish(run);
        expect_same(hd_gas_read(hd_run_gas(run)), by_itself(&scene, begin, hd_run_time(run)));
    }
}
