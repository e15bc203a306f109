/** The gas of mixtures: rates of the pairs of kinds and pressure beside kinetic theory, whole runs
 * beside their trajectories. Seeds are fixed: what is Z standard errors off passes or fails for
 * good. */
#include "mixed.h"
#include "runs.h"

static const double Z = 3.0;

/** After 100 collisions of each particle, over 60 samples of so many collisions of each. */
static hd_gas_means averaged(const hd_scene_def *def, double each)
{
    MADE(hd_trajectory, tr, def);
    const double unit = 0.5 * def->number / hd_trajectory_totals(tr).expected;
    MADE(hd_gas, gas, def, 0.0);
    CHECK_OK(hd_trajectory_extend(tr, NULL, 100.0 * unit));
    hd_gas_begin(gas, tr);
    for (int k = 0; k < 60; k++) {
        CHECK_OK(hd_trajectory_extend(tr, NULL, hd_trajectory_time(tr) + each * unit));
        hd_gas_add(gas, tr);
    }
    return hd_gas_read(gas);
}

/** Theory is good to 1 % at moderate packing; N particles differ from infinitely many by some 1 /
 * N, kT being larger by that. */
TEST(rates_of_pairs_and_pressure_are_those_of_theory)
{
    static const struct {
        hd_particles particles;
        double density, fraction, diameter, mass;
    } cases[] = {{HD_DISKS, 0.4, 0.35, 1.4, 1.0},
                 {HD_DISKS, 0.5, 0.5, 0.6, 5.0},
                 {HD_SPHERES, 0.4, 0.35, 1.2, 3.0},
                 {HD_SPHERES, 0.5, 0.5, 0.5, 0.3}};
    for (int c = 0; c < 4; c++) {
        hd_scene_def def = mixed(cases[c].particles, cases[c].density, cases[c].fraction,
                                 cases[c].diameter, cases[c].mass);
        def.number = 400;
        def.seed = 5;
        const hd_gas_means m = averaged(&def, HD_SANITIZED ? 4.0 : 40.0);
        const double allowed = 0.01 + 1.0 / def.number;
        double sum = 0.0;
        for (int pair = 0; pair < HD_KIND_PAIRS; pair++) {
            const double rate = m.pair_rate[pair], theory = m.pair_rate_expected[pair];
            sum += rate;
            CHECK_CLOSE(rate, theory, allowed * theory + Z * m.pair_rate_error[pair]);
            assert_true(HD_SANITIZED || Z * m.pair_rate_error[pair] < 0.03 * rate);
        }
        CHECK_CLOSE(sum, m.collision_rate, 1e-12 * sum);
        CHECK_CLOSE(m.compressibility, m.compressibility_expected,
                    0.01 * m.compressibility + Z * m.compressibility_error);
        for (int d = 0; d < hd_scene_dimension(&def); d++)
            CHECK_CLOSE(m.pressure_of[d], m.pressure,
                        Z * hypot(m.pressure_of_error[d], m.pressure_error));
    }
}

/** Nothing is known of pairs of one kind; the equation of state is that of Henderson. */
TEST(one_kind_has_no_pairs)
{
    const hd_scene_def def = mixed(HD_DISKS, 0.5, 0.0, 1.0, 1.0);
    MADE(hd_gas, gas, &def, 0.0);
    const hd_gas_means m = hd_gas_read(gas);
    const double eta = 0.5 * PI / 4.0;
    for (int pair = 0; pair < HD_KIND_PAIRS; pair++) {
        assert_true(isnan(m.pair_rate[pair]) && isnan(m.pair_rate_expected[pair]));
        assert_true(m.pair_rate_error[pair] == -1.0);
    }
    CHECK_CLOSE(m.compressibility_expected, (1.0 + eta * eta / 8.0) / pow(1.0 - eta, 2.0), 1e-14);
    const hd_scene_def soft = hd_scene_def_of(
        hd_dynamics_of(&(hd_scene_def){.particles = HD_SOFT_DISKS}));
    MADE(hd_gas, other, &soft, 0.0);
    assert_true(isnan(hd_gas_read(other).compressibility_expected));
}

/** A run goes on from a checkpoint with the rates that it had. */
TEST(rates_are_kept)
{
    static const char path[] = "test_mixture_gas.checkpoint";
    hd_scene_def def = mixed(HD_DISKS, 0.5, 0.4, 0.7, 2.0);
    def.number = 30;
    def.observe = HD_OBSERVE_GAS;
    def.exponents = HD_EXPONENTS_NONE;
    def.equilibration = 5.0;
    def.duration = 200.0;
    def.report_interval = 1.0;
    OWNED(hd_run) *run = created(def);
    until_time(run, 40.0);
    CHECK_OK(hd_run_save(run, path, "", NULL, 0));
    OWNED(hd_run) *other = NULL;
    CHECK_OK(hd_run_resume(&other, path, NULL, NULL, 0));
    finish(run);
    finish(other);
    const hd_gas_means a = hd_gas_read(hd_run_gas(run)), b = hd_gas_read(hd_run_gas(other));
    for (int pair = 0; pair < HD_KIND_PAIRS; pair++) {
        assert_true(a.pair_rate[pair] > 0.0 && a.pair_rate_error[pair] > 0.0);
        CHECK_CLOSE(b.pair_rate[pair], a.pair_rate[pair], 0.0);
        CHECK_CLOSE(b.pair_rate_error[pair], a.pair_rate_error[pair], 0.0);
    }
    remove(path);
}

/** Of a thin gas in narrow walls, Z = 1 + B2 rho: A is that of the mean diameter, as the impulses
 * on the walls, N kT / (L - d) of each kind, have it to second order in d / L. */
TEST(walls_are_half_a_mean_diameter_away)
{
    static const hd_container container[] = {HD_RECTANGLE, HD_CIRCLE};
    for (int c = 0; c < 2; c++) {
        hd_scene_def def = mixed(HD_DISKS, 0.01, 0.5, 2.0, 2.0);
        def.number = 40;
        def.container = container[c];
        for (int d = 0; d < 2 && c == 0; d++) def.boundary[d] = HD_REFLECTING;
        const hd_gas_means m = averaged(&def, HD_SANITIZED ? 10.0 : 150.0);
        /* excluded area: pi (1 + 2 1.5^2 + 2^2) / 4 of an own half each; density in A */
        const double b2 = 0.5 * PI * (1.0 + 2.0 * 2.25 + 4.0) / 4.0;
        const double z = 1.0 + b2 * def.number / hd_gas_area(&def);
        CHECK_CLOSE(m.compressibility, z, 0.01 * z + Z * m.compressibility_error);
        assert_true(HD_SANITIZED || m.compressibility_error < 0.003);
    }
}
