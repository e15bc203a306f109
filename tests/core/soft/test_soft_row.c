/** What a row of soft particles expects: how a step splits zero exponents, how fast tangent vectors
 * grow, how long sound takes; against runs and against hard disks. */
#include "runs.h"
#include "soft.h"

/* ---- split zeros --------------------------------------------------------------------------- */

/** The largest of the exponents that should vanish, at this step; a time of 9e3 leaves 0.0010 by
 * itself. */
static double largest_zero(int potential, int integrator, double step, double time)
{
    hd_scene_def def = soft_few(2, potential, integrator, step);
    def.equilibration = 20.0;
    def.warmup = 50.0;
    def.duration = time;
    def.exponents = hd_scene_counts(&def).positive + 1;
    OWNED(hd_run) *run = finished(def);
    return hd_spectrum_exponent(hd_run_spectrum(run), def.exponents - 1);
}

TEST(zeros_split_with_the_power_of_the_step_that_the_row_says)
{
    static const double jump[HD_POTENTIALS] = {
        [HD_POWER] = 2.0, [HD_WCA] = 2.0 / 3.0, [HD_LENNARD_JONES] = 4.0 / 3.0};
    static const double step[HD_POTENTIALS][HD_INTEGRATORS] = {
        [HD_POWER] = {[HD_VERLET] = 0.01, [HD_PEFRL] = 0.02},
        [HD_WCA] = {[HD_VERLET] = 0.003, [HD_PEFRL] = 0.004}};
    for (int potential = 0; potential < HD_POTENTIALS; potential++) {
        double mean = 0.0; /* a zero of one run is known to 8 % */
        for (int integrator = 0; integrator < HD_INTEGRATORS; integrator++) {
            const hd_scene_def def = soft_few(2, potential, integrator, 0.01);
            const double split = hd_dynamics_of(&def)->zero_splitting_order(&def),
                         coarse = step[potential][integrator];
            CHECK_CLOSE(split, jump[potential], 1e-15);
            if (coarse == 0.0) continue;
            const double ratio = largest_zero(potential, integrator, coarse, 9e3) /
                                 largest_zero(potential, integrator, 0.5 * coarse, 9e3);
            mean += log(ratio) / log(2.0) / split / HD_INTEGRATORS;
        }
        if (potential != HD_LENNARD_JONES) CHECK_CLOSE(mean, 1.0, 0.3);
    }
}

/** Its zeros split visibly only at steps which lose the energy. */
TEST(zeros_of_lennard_jones_do_not_split)
{
    const double time = 1000.0, zero = largest_zero(HD_LENNARD_JONES, HD_VERLET, 0.005, time);
    CHECK_WITHIN(zero, 0.0, 2.0 * log(time) / time);
}

/* ---- warm-up ------------------------------------------------------------------------------- */

/** Where there are steps that of hard disks of their speed; else 100 collisions. */
TEST(the_warmup_separates_steps_as_that_of_hard_particles)
{
    static const double energies[] = {1.0, 4.0};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int potential = 0; potential < HD_POTENTIALS; potential++)
            for (int k = 0; k < 2; k++) {
                const bool flat = dimension == 2;
                hd_scene_def def = soft_box(dimension, potential, HD_INTEGRATOR_AUTO, 0.0, 400,
                                            9.0);
                def.density = 0.2;
                def.aspect = flat ? 0.04 : 0.1;
                def.aspect_z = 0.1;
                def.own[HD_SOFT_ENERGY].real = energies[k];
                hd_scene_def hard = def;
                hard.particles = flat ? HD_DISKS : HD_SPHERES;
                CHECK_CLOSE(hd_scene_warmup(&def) * sqrt(energies[k]) / hd_scene_warmup(&hard), 1.0,
                            1e-12);
                assert_true(hd_scene_warmup(&def) > 200.0 * hd_scene_collision_time(&def));
                def.exponents = 1;
                CHECK_CLOSE(hd_scene_warmup(&def), 100.0 * hd_scene_collision_time(&def), 1e-9);
            }
}

/* ---- growth and sound ---------------------------------------------------------------------- */

static double largest_exponent(hd_scene_def def)
{
    const double unit = 1.0 / sqrt(def.own[HD_SOFT_ENERGY].real);
    def.equilibration = def.warmup = 10.0 * unit;
    def.duration = 30.0 * unit;
    def.exponents = 1;
    OWNED(hd_run) *run = finished(def);
    return hd_spectrum_exponent(hd_run_spectrum(run), 0);
}

/** Of one of them. */
TEST(the_rate_is_the_largest_exponent_but_for_a_factor_of_two)
{
    static const double densities[] = {0.1, 0.3, 0.9}, energies[] = {1.0, 20.0};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int potential = 0; potential < HD_POTENTIALS; potential++)
            for (int k = 0; k < 6; k++) {
                const double density = densities[k % 3];
                hd_scene_def def = soft_box(dimension, potential, HD_PEFRL, 0.0, 40,
                                            pow(40 / density, 1.0 / dimension));
                def.own[HD_SOFT_ENERGY].real = energies[k / 3];
                if (hd_scene_check(&def, NULL, 0) != HD_OK) continue; /* its box is too small */
                const double rate = 1.0 / hd_scene_collision_time(&def);
                CHECK_WITHIN(rate / largest_exponent(def), 0.45, 2.0);
            }
}

static double crossing(int dimension, int count, double density, double energy)
{
    hd_scene_def def = soft_box(dimension, HD_WCA, HD_PEFRL, 0.0, count,
                                pow(count / density, 1.0 / dimension));
    def.own[HD_SOFT_ENERGY].real = energy;
    return hd_scene_sound_crossing(&def);
}

TEST(sound_crosses_as_among_hard_bodies_but_for_a_factor_of_two)
{
    static const double densities[] = {0.1, 0.3, 0.6, 0.9};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int k = 0; k < 4; k++) {
            const hd_scene_def core = {.particles = dimension == 2 ? HD_DISKS : HD_SPHERES};
            hd_scene_def hard = hd_scene_def_of(hd_dynamics_of(&core));
            hard.number = 64;
            hard.density = densities[k];
            hard.aspect = 1.0;
            const double time = crossing(dimension, 64, densities[k], 1.0);
            CHECK_WITHIN(time / hd_scene_sound_crossing(&hard), 0.5, 2.0);
            CHECK_CLOSE(crossing(dimension, 64, densities[k], 9.0) / time, 1.0 / 3.0, 1e-12);
            CHECK_CLOSE(crossing(dimension, 64 << dimension, densities[k], 1.0) / time, 2.0, 1e-12);
        }
}
