/** Covariant vectors of whole runs: when windows begin, what gives them up, and what a run refuses for them. */
#include <float.h>
#include <string.h>

#include "memory.h"
#include "runs.h"

static hd_scene_def small(void)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.disks = 8;
    scene.density = 0.5;
    scene.exponents = HD_EXPONENTS_ALL;
    scene.equilibration = 10.0;
    scene.warmup = 100.0;
    scene.duration = 300.0;
    scene.report_interval = 1.0;
    scene.observe = HD_OBSERVE_COVARIANT;
    scene.covariant_window = 20.0;
    scene.covariant_transient = 60.0;
    scene.covariant_sampling = 2.0;
    scene.threads = 1;
    return scene;
}

static void finish(hd_run *run)
{
    while (hd_run_phase(run) != HD_FINISHED) CHECK_OK(hd_run_step(run));
}

static void step_to(hd_run *run, double averaged)
{
    const hd_scene_def *scene = hd_run_scene(run);
    while (hd_run_time(run) < scene->equilibration + scene->warmup + averaged - 1e-9) CHECK_OK(hd_run_step(run));
}

static double averaging_start(const hd_run *run)
{
    return hd_run_scene(run)->equilibration + hd_run_scene(run)->warmup;
}

/** As many as fit with their transients; the last one is done before the run is finished. */
static void windows_are_counted(void **state)
{
    (void)state;
    const double duration[] = {80.5, 300.0, 139.0, 141.5}; /* windows may last an interval longer, so their last is spared */
    const long least[] = {1, 11, 3, 4}, most[] = {1, 12, 3, 4};
    for (int k = 0; k < 2; k++) {
        hd_scene_def scene = small();
        scene.duration = duration[k];
        scene.interval = 0.25; /* of which looks are multiples */
        hd_run *run = created(&scene);
        finish(run);
        const hd_covariant *c = hd_run_covariant(run);
        const long windows = hd_covariant_windows(c);
        assert_in_range(windows, least[k], most[k]);
        assert_int_equal(hd_covariant_lost(c), 0);
        CHECK_CLOSE(hd_covariant_window_end(c), averaging_start(run) + 20.0 * (double)windows, 1e-6);
        CHECK_CLOSE(hd_spectrum_time(hd_covariant_spectrum(c)), 20.0 * (double)windows, 1e-6);
        assert_int_equal(hd_splitting_samples(hd_covariant_splitting(c)), 10 * windows);
        assert_true(hd_run_cost(run).covariant > 0);
        hd_run_free(run);
    }
    (void)least; (void)most;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(windows_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
