/** Temperature, potential energy and pressure of soft particles: against the energy of stretched
 * boxes, sums over all pairs, the energy, virial coefficients, hard disks, the spread over seeds.
 * Seeds are fixed, so that a tolerance of Z standard errors passes or fails for good. */
#include "observe/gas.h"

#include "dynamics/trajectory.h"
#include "soft.h"

static const double Z = 3.0;

/** Moves them by `time`, one sample for each of so many parts. */
static hd_gas_means averaged(const hd_scene_def *def, hd_trajectory *tr, double time, int parts)
{
    const double begin = hd_trajectory_time(tr);
    MADE(hd_gas, gas, def, 0.0);
    hd_gas_begin(gas, tr);
    for (int k = 1; k <= parts; k++) {
        CHECK_OK(hd_trajectory_extend(tr, NULL, begin + time * k / parts));
        hd_gas_add(gas, tr);
    }
    return hd_gas_read(gas);
}

/** After so much time away from the lattice. */
static hd_gas_means of_a_fluid(const hd_scene_def *def, double before, double time, int parts)
{
    MADE(hd_trajectory, tr, def);
    CHECK_OK(hd_trajectory_extend(tr, NULL, before));
    return averaged(def, tr, time, parts);
}

/* ---- exact sums ---------------------------------------------------------------------------- */

/** Potential energy in a box that is longer along d by a part of its edge. */
static double stretched(const hd_scene_def *def, const softs *s, int d, double part)
{
    twin_state twin = soft_twin_of(def, s);
    for (int k = d; k < twin.count * twin.dimension; k += twin.dimension) twin.q[k] *= 1.0 + part;
    twin.box[d] *= 1.0 + part;
    return (double)soft_twin_energy(&twin);
}

/** P_d V = -dE / d ln L_d of what is at rest: kicks lie where these are. */
TEST(pressure_is_what_stretching_the_box_takes)
{
    const double part = 1e-5, step = 1e-7;
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int potential = 0; potential < HD_POTENTIALS; potential++) {
            hd_scene_def def = soft_few(dimension, potential, HD_VERLET, step);
            softs s = softs_of_a_fluid(def, 5);
            for (int k = 0; k < dimension * def.number; k++) s.p[k] = 0.0;
            def.observe = HD_OBSERVE_GAS;
            OWNED(hd_trajectory) *tr = softs_from(&def, &s);
            const hd_gas_means m = averaged(&def, tr, 1.5 * step, 1);
            const double energy = stretched(&def, &s, 0, 0.0), volume = hd_gas_area(&def);
            double sum = 0.0;
            CHECK_CLOSE(m.potential_energy * def.number, energy, 1e-12 * (1.0 + fabs(energy)));
            for (int d = 0; d < dimension; d++) {
                const double slope = (stretched(&def, &s, d, part) -
                                      stretched(&def, &s, d, -part)) /
                                     (2 * part);
                CHECK_WITHIN(fabs(slope), 0.5, 1e3);
                CHECK_CLOSE(m.pressure_of[d] * volume, -slope, 1e-6);
                sum -= slope / dimension;
            }
            CHECK_CLOSE(m.pressure * volume, sum, 1e-6);
        }
}

static void compare_with_twin(const hd_scene_def *def, int steps)
{
    const double h = def->own[HD_SOFT_TIME_STEP].real, time = steps * h;
    const softs from = softs_of_a_fluid(*def, 3);
    twin_state twin = soft_twin_of(def, &from);
    OWNED(hd_trajectory) *tr = softs_from(def, &from);
    const hd_gas_means m = averaged(def, tr, time + 0.5 * h, 7);
    double twice = 0.0, virial = 0.0;
    for (int k = 0; k < steps; k++) soft_twin_step(&twin, def->own[HD_SOFT_INTEGRATOR].whole, h);
    CHECK_CLOSE(m.time, time, 1e-12);
    for (int d = 0; d < twin.dimension; d++) {
        const double flight = (double)twin.kinetic[d] / time, w = (double)twin.virial[d] / time;
        CHECK_CLOSE(m.pressure_of[d] * hd_gas_area(def), flight + w, 1e-10 * (flight + fabs(w)));
        twice += flight;
        virial += w;
    }
    CHECK_CLOSE(m.pressure * hd_gas_area(def) * twin.dimension, twice + virial, 1e-9);
    CHECK_CLOSE(m.compressibility, 1.0 + virial / twice, 1e-10);
    CHECK_CLOSE(m.temperature, twice / (twin.dimension * (def->number - 1)), 1e-10);
    CHECK_CLOSE(m.potential_energy, (double)twin.potential / time / def->number, 1e-10);
    assert_true(isnan(m.collision_rate) && m.collision_rate_error == -1.0);
}

TEST(means_are_those_of_the_slow_twin)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int potential = 0; potential < HD_POTENTIALS; potential++)
            for (int integrator = 0; integrator < HD_INTEGRATORS; integrator++) {
                hd_scene_def def = soft_few(dimension, potential, integrator, 0.004);
                def.observe = HD_OBSERVE_GAS;
                compare_with_twin(&def, 200);
            }
}

/** Nothing is summed up, and who is asked moves as who is not. */
TEST(sums_are_taken_where_they_are_asked_for)
{
    hd_scene_def def = soft_few(2, HD_WCA, HD_PEFRL, 0.004);
    const softs s = softs_of_a_fluid(def, 5);
    OWNED(hd_trajectory) *plain = softs_from(&def, &s);
    def.observe = HD_OBSERVE_GAS;
    OWNED(hd_trajectory) *asked = softs_from(&def, &s);
    CHECK_OK(hd_trajectory_extend(plain, NULL, 4.0));
    CHECK_OK(hd_trajectory_extend(asked, NULL, 4.0));
    assert_true(hd_trajectory_fingerprint(plain) == hd_trajectory_fingerprint(asked));
    const hd_totals none = hd_trajectory_totals(plain), some = hd_trajectory_totals(asked);
    CHECK_CLOSE(none.time + none.kinetic[0] + none.virial[1] + none.potential, 0.0, 0.0);
    CHECK_WITHIN(some.time, 3.99, 4.0);
    CHECK_WITHIN(some.kinetic[0], 1.0, 100.0);
}

/* ---- means --------------------------------------------------------------------------------- */

/** Kinetic and potential energy make the whole one, as exactly as steps of fourth order do. */
TEST(temperature_and_potential_energy_make_the_energy)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        double off[2];
        for (int k = 0; k < 2; k++) {
            hd_scene_def def = soft_few(dimension, HD_POWER, HD_PEFRL, k ? 0.005 : 0.01);
            def.observe = HD_OBSERVE_GAS;
            const hd_gas_means m = of_a_fluid(&def, 20.0, 400.0, 40);
            const double n = def.number, each = 0.5 * dimension * (n - 1) / n;
            off[k] = fabs(each * m.temperature + m.potential_energy - def.own[HD_SOFT_ENERGY].real);
            CHECK_WITHIN(m.potential_energy, 0.1, 0.5);
        }
        CHECK_WITHIN(off[0], 0.0, 1e-3);
        CHECK_WITHIN(off[1], 0.0, off[0] / 8.0);
    }
}

/** Of particles with a potential, -1/2 of the integral of exp(-V / T) - 1. */
static double second_virial(int potential, double temperature)
{
    const double cut = hd_potentials[potential].cut, h = cut / 20000;
    double sum = 0.0;
    for (double r = 0.5 * h; r < cut; r += h)
        sum -= expm1(-hd_potentials[potential].at(r * r).v / temperature) * r * h;
    return PI * sum;
}

/** A thin gas, and what hard disks of that coefficient have beyond. */
TEST(a_thin_gas_has_its_second_virial_coefficient)
{
    hd_scene_def def = soft_box(2, HD_WCA, HD_PEFRL, 0.008, 64, sqrt(64 / 0.04));
    def.observe = HD_OBSERVE_GAS;
    const hd_gas_means m = of_a_fluid(&def, 200.0, 4000.0, 400);
    const double x = second_virial(HD_WCA, m.temperature) * def.density;
    CHECK_WITHIN(m.compressibility_error, 1e-5, 1e-3);
    CHECK_CLOSE(m.compressibility, 1.0 + x + 0.782 * x * x, Z * m.compressibility_error);
}

/** The harder, the more: hard disks of the diameter that their second coefficient has, by
 * Henderson's equation, which is good to 2e-3 there. */
TEST(the_stiff_limit_is_that_of_hard_disks)
{
    static const double energies[] = {1e-2, 1e-4};
    double square[2];
    for (int k = 0; k < 2; k++) {
        hd_scene_def def = soft_box(2, HD_POWER, HD_PEFRL, 0.0, 64, sqrt(64 / 0.4));
        const double unit = 1.0 / sqrt(energies[k]);
        def.accuracy = 1e-4;
        def.own[HD_SOFT_ENERGY].real = energies[k];
        def.observe = HD_OBSERVE_GAS;
        const hd_gas_means m = of_a_fluid(&def, 50.0 * unit, 400.0 * unit, 400);
        square[k] = 2.0 / PI * second_virial(HD_POWER, m.temperature);
        const double eta = 0.25 * PI * def.density * square[k];
        const double z = (1.0 + eta * eta / 8.0) / ((1.0 - eta) * (1.0 - eta));
        CHECK_WITHIN(m.compressibility_error, 1e-4, 1e-2);
        CHECK_CLOSE(m.compressibility, z, Z * m.compressibility_error + 2e-3 * z);
    }
    CHECK_WITHIN(square[0], 0.9, square[1]);
    CHECK_WITHIN(square[1], 0.97, 1.0);
}

/* ---- errors -------------------------------------------------------------------------------- */

/** Means of independent runs scatter as their errors say. */
TEST(errors_are_those_of_seeds)
{
    enum { SEEDS = 64, NUMBERS = 5 };
    double value[NUMBERS][SEEDS], square[NUMBERS] = {0}, mean[NUMBERS] = {0}, score[NUMBERS] = {0};
    if (HD_SANITIZED) skip();
    for (int seed = 0; seed < SEEDS; seed++) {
        hd_scene_def def = soft_box(2, HD_POWER, HD_PEFRL, 0.01, 16, sqrt(16 / 0.8));
        def.own[HD_SOFT_ENERGY].real = 10.0;
        def.observe = HD_OBSERVE_GAS;
        def.seed = (uint64_t)seed + 1;
        const hd_gas_means m = of_a_fluid(&def, 50.0, 500.0, 200);
        const double means[NUMBERS] = {m.pressure, m.pressure_of[1], m.compressibility,
                                       m.temperature, m.potential_energy};
        const double errors[NUMBERS] = {m.pressure_error, m.pressure_of_error[1],
                                        m.compressibility_error, m.temperature_error,
                                        m.potential_energy_error};
        for (int k = 0; k < NUMBERS; k++) {
            assert_true(errors[k] > 0);
            value[k][seed] = means[k];
            mean[k] += means[k] / SEEDS;
            square[k] += errors[k] * errors[k] / SEEDS;
        }
    }
    for (int k = 0; k < NUMBERS; k++) {
        for (int seed = 0; seed < SEEDS; seed++)
            score[k] += (value[k][seed] - mean[k]) * (value[k][seed] - mean[k]) / (SEEDS - 1);
        /* known to 1 / sqrt(2 (SEEDS - 1)) = 9 % */
        CHECK_CLOSE(sqrt(score[k] / square[k]), 1.0, Z * 0.09);
    }
}
