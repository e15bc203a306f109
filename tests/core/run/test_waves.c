/** Waves of a whole run: T modes stay where they are, LP modes rotate. */
#include "testing.h"

#include "hdlyap/hdlyap.h"
#include "runs.h"

enum { DISKS = 50 };

/** A channel, Lx = 66.7, Ly = 1.5, in which disks cannot pass each other. */
static hd_scene_def channel(unsigned observe)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.disks = DISKS;
    scene.density = 0.5;
    scene.aspect = 0.0225;
    scene.equilibration = 100.0;
    scene.warmup = 400.0;
    scene.duration = 1500.0;
    scene.report_interval = 50.0;
    scene.observe = observe;
    return scene;
}

static hd_run *finished(const hd_scene_def *scene)
{
    hd_run *run = created(scene);
    while (hd_run_stage(run) != HD_FINISHED) CHECK_OK(hd_run_advance(run));
    return run;
}

/** Longest tracked of the vectors of a step at one node along x. */
static int longest(const hd_run *run, const hd_phases *phases)
{
    int found = -1;
    for (int k = 0; k < hd_phases_count(phases); k++) {
        const hd_phase *phase = hd_phases_phase(phases, k);
        if (hd_steps_step(hd_run_steps(run), phase->step)->wave.n[0] != 1) continue;
        if (found < 0 || phase->time > hd_phases_phase(phases, found)->time) found = k;
    }
    return found;
}

/** T(1,0): no rotation within 4 of its errors, which are small beside the rate of LP(1,0); that
 * diffuses, too, and all the same turns. */
static void t_waves_diffuse_and_do_not_turn(void **state)
{
    (void)state;
    const hd_scene_def scene = channel(HD_OBSERVE_PHASES | HD_OBSERVE_T_PHASES);
    hd_run *run = finished(&scene);
    const int of_t = longest(run, hd_run_t_phases(run)), of_lp = longest(run, hd_run_phases(run));
    const hd_phase *t = hd_phases_phase(hd_run_t_phases(run), of_t);
    const hd_phase *lp = hd_phases_phase(hd_run_phases(run), of_lp);
    double error;
    const double diffusion = hd_phases_diffusion(hd_run_t_phases(run), of_t, &error);
    print_message("T: %.5f(%.5f), D = %.5f(%.5f), %.0f time units; LP: %.4f(%.4f)\n", t->omega,
                  t->omega_error, diffusion, error, t->time, lp->omega, lp->omega_error);
    assert_int_equal(hd_steps_step(hd_run_steps(run), t->step)->kind, HD_MODE_T);
    assert_true(t->time > 1000.0 && lp->time > 1000.0);
    CHECK_CLOSE(t->omega, 0.0, 4.0 * t->omega_error);
    assert_true(t->omega_error > 0 && t->omega_error < 0.1 * lp->omega);
    assert_true(lp->omega > 10.0 * lp->omega_error);
    assert_true(error > 0 && diffusion > 4.0 * error);
    hd_run_free(run);
}

/** Who asks for T phases alone has no others, and states as often as they need. */
static void t_phases_come_alone(void **state)
{
    (void)state;
    hd_scene_def scene = channel(HD_OBSERVE_T_PHASES);
    scene.duration = 60.0;
    scene.phase_interval = 0.5;
    hd_run *run = created(&scene);
    double followed = -1.0, farthest = 0.0;
    while (hd_run_stage(run) != HD_FINISHED) {
        CHECK_OK(hd_run_advance(run));
        if (hd_run_time(run) > 530.0) farthest = fmax(farthest, hd_run_followed(run) - followed);
        followed = hd_run_followed(run);
    }
    assert_null(hd_run_phases(run));
    assert_true(farthest > 0.4 && farthest <= 0.5 + 1e-9);
    assert_true(hd_phases_phase(hd_run_t_phases(run), longest(run, hd_run_t_phases(run)))->time >
                30.0);
    hd_run_free(run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(t_waves_diffuse_and_do_not_turn),
        cmocka_unit_test(t_phases_come_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
