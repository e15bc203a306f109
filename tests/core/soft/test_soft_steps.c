/** Steps and their tangent maps: orders, the slow twin, shadow trajectories, exact invariants. */
#include "soft.h"

/** Relative to the twin's: state, and one vector that went through the record. */
static void compare_with_twin(const hd_scene_def *def, int steps)
{
    const int n = hd_scene_dimension(def), all = n * def->number;
    const double h = def->own[HD_SOFT_TIME_STEP].real, time = (steps + 0.5) * h;
    const softs from = softs_of_a_fluid(*def, 3);
    double v[SOFT_ROWS_MAX], size = 0.0, off = 0.0;
    OWNED(hd_record) *log = new_soft_log(def);
    twin_state twin = soft_twin_of(def, &from);
    fill_randomly(v, 2 * all);
    for (int k = 0; k < all; k++) {
        twin.dq[k] = v[soft_row_of(k, n)];
        twin.dp[k] = v[soft_row_of(k, n) + n];
    }
    for (int k = 0; k < steps; k++) soft_twin_step(&twin, def->own[HD_SOFT_INTEGRATOR].whole, h);
    const softs now = softs_later(def, &from, time, log);
    soft_carry(v, def, log, 0.0, time, 1);
    for (int k = 0; k < all; k++) {
        CHECK_CLOSE(remainder(now.q[k] - (double)twin.q[k], twin.box[k % n]), 0.0, 1e-11);
        CHECK_CLOSE(now.p[k], (double)twin.p[k], 1e-10);
        size = hypot(size, hypot((double)twin.dq[k], (double)twin.dp[k]));
        off = hypot(off, hypot(v[soft_row_of(k, n)] - (double)twin.dq[k],
                               v[soft_row_of(k, n) + n] - (double)twin.dp[k]));
    }
    CHECK_CLOSE(off / size, 0.0, 1e-10);
}

TEST(few_move_as_the_slow_twin_does)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int potential = 0; potential < HD_POTENTIALS; potential++)
            for (int integrator = 0; integrator < HD_INTEGRATORS; integrator++)
                for (int count = 3; count <= 6; count++) {
                    hd_scene_def def = soft_few(dimension, potential, integrator, 0.004);
                    def.density *= (double)count / def.number;
                    def.number = count;
                    compare_with_twin(&def, 200);
                }
}

/* ---- orders -------------------------------------------------------------------------------- */

/** How far a step is from where a very short one leads, rms over some starts. */
static double step_error(hd_scene_def def, double step, double time)
{
    enum { STARTS = 8 };
    double square = 0.0, box[3];
    hd_scene_box(&def, box);
    for (uint64_t seed = 1; seed <= STARTS; seed++) {
        const softs from = softs_of_a_fluid(def, seed);
        hd_scene_def exact = def;
        def.own[HD_SOFT_TIME_STEP].real = step;
        exact.own[HD_SOFT_TIME_STEP].real = time / 4096;
        exact.own[HD_SOFT_INTEGRATOR].whole = HD_PEFRL;
        const softs a = softs_later(&def, &from, time * (1.0 + 1e-12), NULL),
                    b = softs_later(&exact, &from, time * (1.0 + 1e-12), NULL);
        for (int k = 0; k < 2 * def.number; k++)
            square += pow(remainder(a.q[k] - b.q[k], box[k % 2]), 2) + pow(a.p[k] - b.p[k], 2);
    }
    return sqrt(square / STARTS);
}

/** Fourth order needs two derivatives without a jump: wca has one. */
TEST(errors_are_of_the_order_that_the_rows_say)
{
    const double time = 0.25;
    for (int potential = 0; potential < HD_POTENTIALS; potential++)
        for (int integrator = 0; integrator < HD_INTEGRATORS; integrator++) {
            const hd_scene_def def = soft_few(2, potential, integrator, 0.0);
            const double coarse = step_error(def, time / 64, time),
                         order = log(coarse / step_error(def, time / 256, time)) / log(4.0);
            if (hd_potentials[potential].smooth >= 2)
                CHECK_CLOSE(order, hd_integrators[integrator].order, 0.4);
            else
                CHECK_WITHIN(order, 1.7, 2.8);
        }
}

/* ---- tangent maps -------------------------------------------------------------------------- */

/** Relative deviation of central differences of shadows from what is carried. */
static double shadow_error(const hd_scene_def *def, const softs *s, double time, double epsilon)
{
    const int n = hd_scene_dimension(def), all = n * def->number;
    double v[SOFT_ROWS_MAX], block[SOFT_ROWS_MAX], off = 0.0, size = 0.0, box[3];
    OWNED(hd_record) *log = new_soft_log(def);
    softs shadow[2] = {*s, *s};
    (void)softs_later(def, s, time, log);
    hd_scene_box(def, box);
    fill_randomly(v, 2 * all);
    memcpy(block, v, sizeof v);
    soft_carry(block, def, log, 0.0, time, 1);
    for (int side = 0; side < 2; side++) {
        for (int k = 0; k < all; k++) {
            double *q = &shadow[side].q[k];
            *q += (1 - 2 * side) * epsilon * v[soft_row_of(k, n)];
            *q -= box[k % n] * floor(*q / box[k % n]);
            shadow[side].p[k] += (1 - 2 * side) * epsilon * v[soft_row_of(k, n) + n];
        }
        shadow[side] = softs_later(def, &shadow[side], time, NULL);
    }
    for (int k = 0; k < all; k++) {
        const double dq = remainder(shadow[0].q[k] - shadow[1].q[k], box[k % n]) / (2 * epsilon),
                     dp = (shadow[0].p[k] - shadow[1].p[k]) / (2 * epsilon);
        off = hypot(off, hypot(dq - block[soft_row_of(k, n)], dp - block[soft_row_of(k, n) + n]));
        size = hypot(size, hypot(dq, dp));
    }
    return off / size;
}

TEST(shadows_follow_what_is_carried)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int integrator = 0; integrator < HD_INTEGRATORS; integrator++)
            for (int potential = 0; potential < HD_POTENTIALS; potential++) {
                const hd_scene_def def = soft_few(dimension, potential, integrator, 0.004);
                const softs s = softs_of_a_fluid(def, 5);
                const double coarse = shadow_error(&def, &s, 1.0, 1e-5),
                             fine = shadow_error(&def, &s, 1.0, 2.5e-6);
                CHECK_WITHIN(fine, 0.0, 1e-6);
                CHECK_WITHIN(fine, 0.0, fmax(0.25 * coarse, 2e-8)); /* or rounding */
            }
}

/** dp_a.dq_b - dq_a.dp_b of columns a and b. */
static double product(const double *block, int all, int n, int a, int b, int width)
{
    double sum = 0.0;
    for (int k = 0; k < all; k++) {
        const double *q = block + soft_row_of(k, n) * width, *p = q + n * width;
        sum += p[a] * q[b] - q[a] * p[b];
    }
    return sum;
}

TEST(maps_are_symplectic_and_every_width_carries_the_same)
{
    enum { WIDE = 64 };
    static double wide[SOFT_ROWS_MAX * WIDE], before[SOFT_ROWS_MAX * WIDE],
        narrow[SOFT_ROWS_MAX * WIDE];
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int integrator = 0; integrator < HD_INTEGRATORS; integrator++) {
            const hd_scene_def def = soft_few(dimension, HD_WCA, integrator, 0.005);
            const int rows = 2 * dimension * def.number;
            const softs s = softs_of_a_fluid(def, 5);
            OWNED(hd_record) *log = new_soft_log(&def);
            (void)softs_later(&def, &s, 1.0, log);
            fill_randomly(before, rows * WIDE);
            memcpy(wide, before, sizeof wide);
            soft_carry(wide, &def, log, 0.0, 1.0, WIDE);
            for (int b = 1; b < WIDE; b++) {
                const double was = product(before, rows / 2, dimension, 0, b, WIDE),
                             is = product(wide, rows / 2, dimension, 0, b, WIDE);
                double scale = 0.0;
                for (int k = 0; k < rows * WIDE; k++) scale = fmax(scale, fabs(wide[k]));
                CHECK_CLOSE(is - was, 0.0, 1e-13 * rows * scale * scale);
            }
            for (int width = 1; width <= WIDE; width *= 2) {
                for (int row = 0; row < rows; row++)
                    memcpy(narrow + row * width, before + row * WIDE,
                           (size_t)width * sizeof *narrow);
                soft_carry(narrow, &def, log, 0.0, 0.4, width); /* in two pieces */
                soft_carry(narrow, &def, log, 0.4, 1.0, width);
                for (int row = 0; row < rows; row++)
                    for (int col = 0; col < width; col++)
                        CHECK_CLOSE(narrow[row * width + col] / wide[row * WIDE + col], 1.0, 1e-9);
            }
        }
}

/* ---- what is conserved --------------------------------------------------------------------- */

TEST(a_start_has_its_energy_and_no_momentum)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int potential = 0; potential < HD_POTENTIALS; potential++) {
            hd_scene_def def = soft_few(dimension, potential, HD_PEFRL, 0.001);
            def.own[HD_SOFT_ENERGY].real = 1.7;
            MADE(hd_trajectory, tr, &def);
            softs now = softs_now(tr);
            twin_state twin = soft_twin_of(&def, &now);
            CHECK_CLOSE((double)soft_twin_energy(&twin) / def.number, 1.7, 1e-13);
            CHECK_OK(hd_trajectory_extend(tr, NULL, 20.0));
            now = softs_now(tr);
            twin = soft_twin_of(&def, &now);
            const hd_invariants examined = hd_trajectory_examined(tr);
            const double kinetic = hd_trajectory_examined(tr).kinetic_energy,
                         is = (double)soft_twin_energy(&twin), was = 1.7 * def.number;
            CHECK_CLOSE(examined.energy_error, (is - was) / (kinetic + fabs(is - kinetic)), 1e-13);
            CHECK_WITHIN(fabs(examined.energy_error), 1e-15, 2e-5);
            for (int d = 0; d < dimension; d++) CHECK_CLOSE(examined.momentum[d], 0.0, 1e-11);
        }
}
