/** The energy of soft particles: the step that is chosen for it, what is said of it, and when it is
 * lost. */
#include "hdlyap/checkpoint.h"
#include "kept.h"
#include "runs.h"
#include "same.h"
#include "soft.h"

/** Particles alone, for this time. */
static hd_scene_def alone(int potential, int integrator, double step, int count, double density,
                          double time)
{
    hd_scene_def def = soft_box(2, potential, integrator, step, count, sqrt(count / density));
    def.exponents = HD_EXPONENTS_NONE;
    def.equilibration = def.warmup = 0.0;
    def.duration = time;
    def.observe = HD_OBSERVE_GAS;
    return def;
}

static hd_energy energy_after(const hd_run *run)
{
    return hd_trajectory_energy(hd_run_trajectory(run));
}

/* ---- the step that is chosen --------------------------------------------------------------- */

/** Dense and hot: the chosen step holds the energy, and is no shorter than that takes. */
TEST(the_chosen_step_holds_the_energy)
{
    static const double energies[] = {0.01, 1.0, 100.0, 1e4};
    for (int potential = 0; potential < HD_POTENTIALS; potential++)
        for (int integrator = 0; integrator < HD_INTEGRATORS; integrator++)
            for (int k = 0; k < 4; k++) {
                hd_scene_def def = alone(potential, integrator, 0.0, 64, 64 / 81.0, 0.0);
                def.own[HD_SOFT_ENERGY].real = energies[k];
                MADE(hd_trajectory, tr, &def);
                for (int n = 1; n <= 20; n++)
                    CHECK_OK(hd_trajectory_extend(tr, NULL, 100.0 * n * hd_soft_time_step(&def)));
                const hd_energy energy = hd_trajectory_energy(tr);
                CHECK_CLOSE(energy.asked, potential == HD_WCA ? 5e-4 : 1e-5, 1e-18);
                CHECK_WITHIN(energy.most, energies[k] == 1.0 ? 5e-8 : 0.0, energy.asked);
            }
}

/** The energy walks where V is cut, most of all that of few: the step is for the end of the run. */
TEST(the_chosen_step_holds_the_energy_to_the_end)
{
    enum { LONG = 2 };
    static const struct {
        int potential, count;
        double density, time;
    } cases[] = {{HD_WCA, 4, 0.5, 2000.0},
                 {HD_POWER, 6, 0.5, 2000.0},
                 {HD_WCA, 24, 0.5, 8000.0},
                 {HD_POWER, 24, 0.5, 8000.0}};
    const int count = second_tier() ? LONG + 2 : LONG;
    for (int k = 0; k < count; k++)
        for (uint64_t seed = 2; seed <= 3; seed++) {
            hd_scene_def def = alone(cases[k].potential, HD_INTEGRATOR_AUTO, 0.0, cases[k].count,
                                     cases[k].density, cases[k].time);
            def.seed = seed;
            OWNED(hd_run) *run = finished(def);
            const hd_energy energy = energy_after(run);
            CHECK_WITHIN(energy.most, 0.01 * energy.asked, energy.asked);
            CHECK_WITHIN(fabs(energy.error), 0.0, energy.most);
        }
}

/** As the order says; or where the walk decides, which it does not of Verlet's steps where V is
 * smooth, as h^(s + 1) and the root of the time. */
TEST(a_coarser_accuracy_takes_longer_steps_and_a_longer_run_shorter_ones)
{
    for (int integrator = 0; integrator < HD_INTEGRATORS; integrator++) {
        hd_scene_def def = alone(HD_POWER, integrator, 0.0, 24, 0.5, 1.0);
        const double fine = hd_soft_time_step(&def), order = hd_integrators[integrator].order;
        def.accuracy = 1e-4;
        CHECK_CLOSE(hd_soft_time_step(&def) / fine, pow(100.0, 1.0 / order), 1e-12);
        for (int potential = 0; potential < HD_POTENTIALS; potential++) {
            if (integrator == HD_VERLET && potential != HD_WCA) continue;
            const double each = 1.0 / (2.0 * (hd_potentials[potential].smooth + 1));
            hd_scene_def longer = alone(potential, integrator, 0.0, 64, 0.5, 1e9);
            const double shorter = hd_soft_time_step(&longer);
            longer.duration = 1e10;
            CHECK_CLOSE(hd_soft_time_step(&longer) / shorter, pow(0.1, each), 1e-6);
            longer.duration = 0.0; /* until stopped: as 1e4 */
            hd_scene_def open = longer;
            open.duration = 1e4;
            CHECK_CLOSE(hd_soft_time_step(&longer), hd_soft_time_step(&open), 0.0);
        }
        def.own[HD_SOFT_TIME_STEP].real = 0.0123;
        CHECK_CLOSE(hd_soft_time_step(&def), 0.0123, 0.0);
    }
}

TEST(auto_is_verlet_where_the_force_has_a_kink)
{
    static const int stands_for[HD_POTENTIALS] = {
        [HD_POWER] = HD_PEFRL, [HD_WCA] = HD_VERLET, [HD_LENNARD_JONES] = HD_PEFRL};
    for (int k = 0; k < HD_POTENTIALS; k++) {
        const hd_scene_def def = alone(k, HD_INTEGRATOR_AUTO, 0.0, 64, 0.5, 1.0);
        assert_ptr_equal(hd_soft_integrator(&def), &hd_integrators[stands_for[k]]);
        const hd_scene_def usual = hd_scene_def_of(hd_dynamics_of(&def));
        assert_int_equal(usual.own[HD_SOFT_INTEGRATOR].whole, HD_INTEGRATOR_AUTO);
    }
}

/** Whatever the duration is then: its step stays, and so does what is known of its energy. */
TEST(a_run_that_is_made_longer_goes_on_with_its_step)
{
    const char *path = "soft_energy.checkpoint";
    char message[512] = "";
    hd_scene_def def = alone(HD_WCA, HD_INTEGRATOR_AUTO, 0.0, 6, 0.5, 20.0);
    hd_run *resumed;
    OWNED(hd_run) *run = finished(def);
    const double step = hd_run_scene(run)->own[HD_SOFT_TIME_STEP].real;
    assert_int_equal(hd_run_scene(run)->own[HD_SOFT_INTEGRATOR].whole, HD_VERLET);
    CHECK_CLOSE(step, hd_soft_time_step(&def), 0.0);
    CHECK_OK(hd_run_save(run, path, "", message, sizeof message));
    def.duration = 1e6;
    assert_true(hd_soft_time_step(&def) < 0.5 * step);
    if (hd_run_resume(&resumed, path, &def, message, sizeof message) != HD_OK)
        fail_msg("%s", message);
    CHECK_CLOSE(hd_run_scene(resumed)->own[HD_SOFT_TIME_STEP].real, step, 0.0);
    CHECK_CLOSE(energy_after(resumed).most, energy_after(run).most, 0.0);
    CHECK_CLOSE(energy_after(resumed).error, energy_after(run).error, 0.0);
    until_time(resumed, 30.0);
    hd_run_free(resumed);
    (void)remove(path);
}

/* ---- what is said of it -------------------------------------------------------------------- */

/** The most that it was off at any report, and now. */
TEST(the_error_of_the_energy_is_measured)
{
    const hd_scene_def def = alone(HD_WCA, HD_VERLET, 0.004, 24, 0.5, 0.0);
    MADE(hd_trajectory, tr, &def);
    double most = 0.0;
    for (int k = 1; k <= 50; k++) {
        CHECK_OK(hd_trajectory_extend(tr, NULL, 2.0 * k));
        const hd_energy energy = hd_trajectory_energy(tr);
        most = fmax(most, fabs(hd_trajectory_examined(tr).energy_error));
        CHECK_CLOSE(energy.error, hd_trajectory_examined(tr).energy_error, 0.0);
        CHECK_CLOSE(energy.most, most, 0.0);
    }
    assert_true(most > fabs(hd_trajectory_energy(tr).error));
}

/** However coarse the accuracy, a run ends far beyond what is asked. */
TEST(what_is_asked_is_half_of_what_ends_a_run)
{
    hd_scene_def def = alone(HD_WCA, HD_INTEGRATOR_AUTO, 0.0, 24, 0.5, 100.0);
    def.accuracy = 1e-2;
    OWNED(hd_run) *run = created(def);
    CHECK_CLOSE(energy_after(run).asked, 0.01, 1e-17);
}

/** Hard particles have none, and nothing is asked of them. */
TEST(hard_particles_have_no_error_of_the_energy)
{
    const hd_scene_def def = scene(.number = 12, .density = 0.5, .aspect = 1.0);
    MADE(hd_trajectory, tr, &def);
    CHECK_OK(hd_trajectory_extend(tr, NULL, 1.0));
    const hd_energy energy = hd_trajectory_energy(tr);
    assert_true(isnan(energy.error) && isnan(energy.most) && isnan(energy.asked));
}

/** Long before a fifth of the energy is new: it is above what was asked at once, and the run ends
 * soon. */
TEST(a_run_ends_before_its_energy_is_another)
{
    hd_scene_def def = alone(HD_LENNARD_JONES, HD_VERLET, 0.014, 24, 0.7, 300.0);
    def.own[HD_SOFT_ENERGY].real = 0.5;
    hd_status status = HD_OK;
    OWNED(hd_run) *run = created(def);
    until_time(run, 2.0);
    const hd_energy early = energy_after(run);
    CHECK_WITHIN(early.most, 10.0 * early.asked, HD_ENERGY_LOST_FROM);
    while (status == HD_OK && hd_run_stage(run) < HD_FINISHED) status = hd_run_advance(run);
    assert_int_equal(status, HD_ENERGY_LOST);
    CHECK_WITHIN(hd_run_time(run), 2.0, 290.0);
    CHECK_WITHIN(energy_after(run).most, HD_ENERGY_LOST_FROM, 2.0 * HD_ENERGY_LOST_FROM);
}
