/** Scenes of soft particles, and another program for them: all pairs, in long double, by the
 * distance and not its square. */
#ifndef TEST_SOFT_H
#define TEST_SOFT_H

#include "base/random.h"
#include "dynamics/soft/kick.h"
#include "dynamics/soft/soft.h"
#include "create_from.h"
#include "testing.h"

enum { SOFT_MAX = 64, SOFT_ROWS_MAX = 6 * SOFT_MAX };

typedef struct softs {
    double q[3 * SOFT_MAX], p[3 * SOFT_MAX];
} softs;

/** A square or cubic box. step = 0: chosen. */
static inline hd_scene_def soft_box(int dimension, int potential, int integrator, double step,
                                    int count, double edge)
{
    const hd_scene_def core = {.particles = dimension == 2 ? HD_SOFT_DISKS : HD_SOFT_SPHERES};
    hd_scene_def def = hd_scene_def_of(hd_dynamics_of(&core));
    def.number = count;
    def.aspect = 1.0;
    def.density = count / pow(edge, dimension);
    def.own[HD_SOFT_POTENTIAL].whole = potential;
    def.own[HD_SOFT_INTEGRATOR].whole = integrator;
    def.own[HD_SOFT_TIME_STEP].real = step;
    def.seed = 7;
    def.threads = 1;
    return def;
}

/** Few of them, and all potentials have room. */
static inline hd_scene_def soft_few(int dimension, int potential, int integrator, double step)
{
    const double edge[HD_POTENTIALS] = {2.6, 2.9, 5.2};
    hd_scene_def def = soft_box(dimension, potential, integrator, step,
                                potential == HD_LENNARD_JONES ? 12
                                : dimension == 2              ? 5
                                                              : 9,
                                edge[potential]);
    def.own[HD_SOFT_ENERGY].real = 2.0;
    return def;
}

static inline softs softs_now(const hd_trajectory *tr)
{
    softs s;
    hd_trajectory_state(tr, s.q, s.p);
    return s;
}

static inline hd_trajectory *softs_from(const hd_scene_def *def, const softs *s)
{
    hd_trajectory *tr;
    CHECK_OK(hd_trajectory_create_from(&tr, def, s->q, s->p));
    return tr;
}

static inline softs softs_later(const hd_scene_def *def, const softs *s, double time,
                                hd_record *log)
{
    OWNED(hd_trajectory) *tr = softs_from(def, s);
    CHECK_OK(hd_trajectory_extend(tr, log, time));
    return softs_now(tr);
}

/** Away from the lattice, whatever the step of the scene is. */
static inline softs softs_of_a_fluid(hd_scene_def def, uint64_t seed)
{
    def.own[HD_SOFT_INTEGRATOR].whole = HD_PEFRL;
    def.own[HD_SOFT_TIME_STEP].real = 0.004;
    def.seed = seed;
    char message[512] = "";
    if (hd_scene_check(&def, message, sizeof message) != HD_OK) fail_msg("%s", message);
    MADE(hd_trajectory, tr, &def);
    CHECK_OK(hd_trajectory_extend(tr, NULL, 5.0));
    return softs_now(tr);
}

static inline hd_record *new_soft_log(const hd_scene_def *def)
{
    hd_record *log;
    CHECK_OK(hd_record_create(&log, hd_dynamics_of(def)->entry));
    return log;
}

/** Carries block[particle][2 coordinates][width] through the record from a to b. */
static inline void soft_carry(double *block, const hd_scene_def *def, const hd_record *log,
                              double a, double b, int width)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    void *maps;
    CHECK_OK(of->maps_create(&maps, def));
    CHECK_OK(of->maps_fill(maps, log, a, b));
    of->carry(maps, block, width);
    of->maps_free(maps);
}

static inline void fill_randomly(double *v, int count)
{
    hd_random random = hd_random_seeded(11, 1);
    for (int k = 0; k < count; k++) v[k] = hd_random_symmetric(&random);
}

/** Where coordinate k of all lies among the rows of a block. */
static inline int soft_row_of(int k, int dimension)
{
    return 2 * dimension * (k / dimension) + k % dimension;
}

/* ---- the other program --------------------------------------------------------------------- */

/** V, V' and V'' at the distance r. */
static inline void soft_twin_potential(long double out[3], int potential, long double r)
{
    const long double r6 = powl(r, -6), r12 = r6 * r6;
    out[0] = out[1] = out[2] = 0;
    if (potential == HD_POWER) {
        const long double x = 1 - r * r;
        if (r >= 1) return;
        out[0] = 100 * powl(x, 4);
        out[1] = -800 * r * powl(x, 3);
        out[2] = -800 * powl(x, 3) + 4800 * r * r * x * x;
        return;
    }
    if (r >= (potential == HD_WCA ? powl(2, 1.0L / 6) : 2.5L)) return;
    out[0] = 4 * (r12 - r6) + (potential == HD_WCA);
    out[1] = 4 * (-12 * r12 + 6 * r6) / r;
    out[2] = 4 * (156 * r12 - 42 * r6) / (r * r);
    if (potential == HD_WCA || r <= 2) return;
    const long double x = (r * r - 4) / 2.25L, x1 = 2 * r / 2.25L, x2 = 2 / 2.25L;
    const long double s = 1 - 10 * powl(x, 3) + 15 * powl(x, 4) - 6 * powl(x, 5);
    const long double sx = -30 * x * x + 60 * powl(x, 3) - 30 * powl(x, 4);
    const long double sxx = -60 * x + 180 * x * x - 120 * powl(x, 3);
    out[2] = out[2] * s + 2 * out[1] * sx * x1 + out[0] * (sxx * x1 * x1 + sx * x2);
    out[1] = out[1] * s + out[0] * sx * x1;
    out[0] *= s;
}

/** Coordinates and one tangent vector, [particle][dimension] each. */
typedef struct twin_state {
    int count, dimension, pair;
    double box[3];
    long double q[3 * SOFT_MAX], p[3 * SOFT_MAX], dq[3 * SOFT_MAX], dp[3 * SOFT_MAX];
    long double kinetic[3], virial[3], potential; /* integrals over time */
} twin_state;

static inline void soft_twin_kick(twin_state *s, long double time)
{
    const int n = s->dimension;
    for (int i = 0; i < s->count; i++)
        for (int j = 0; j < s->count; j++) {
            long double r[3], square = 0, v[3], along = 0;
            for (int d = 0; d < n && i != j; d++) {
                r[d] = remainderl(s->q[n * j + d] - s->q[n * i + d], s->box[d]);
                square += r[d] * r[d];
            }
            if (i == j) continue;
            const long double length = sqrtl(square);
            soft_twin_potential(v, s->pair, length);
            s->potential += time * v[0] / 2; /* each pair is seen twice */
            for (int d = 0; d < n; d++) {
                s->virial[d] -= time * v[1] * r[d] * r[d] / length / 2;
                along += (s->dq[n * j + d] - s->dq[n * i + d]) * r[d] / length;
            }
            for (int d = 0; d < n; d++) {
                const long double e = r[d] / length,
                                  across = s->dq[n * j + d] - s->dq[n * i + d] - along * e;
                s->p[n * i + d] += time * v[1] * e;
                s->dp[n * i + d] += time * (v[2] * along * e + v[1] / length * across);
            }
        }
}

static inline void soft_twin_drift(twin_state *s, long double time)
{
    for (int k = 0; k < s->count * s->dimension; k++) {
        s->q[k] += time * s->p[k];
        s->dq[k] += time * s->dp[k];
        s->kinetic[k % s->dimension] += time * s->p[k] * s->p[k];
    }
}

/** Kinetic and potential energy. */
static inline long double soft_twin_energy(const twin_state *s)
{
    long double sum = 0, v[3];
    for (int k = 0; k < s->count * s->dimension; k++) sum += s->p[k] * s->p[k] / 2;
    for (int i = 0; i < s->count; i++)
        for (int j = 0; j < i; j++) {
            long double square = 0;
            for (int d = 0; d < s->dimension; d++)
                square += powl(
                    remainderl(s->q[s->dimension * j + d] - s->q[s->dimension * i + d], s->box[d]),
                    2);
            soft_twin_potential(v, s->pair, sqrtl(square));
            sum += v[0];
        }
    return sum;
}

/** Verlet's step, or the extended one of Forest and Ruth. */
static inline void soft_twin_step(twin_state *s, int integrator, long double h)
{
    const long double xi = 0.1786178958448091L, lambda = -0.2123418310626054L,
                      chi = -0.06626458266981849L;
    const bool verlet = integrator == HD_VERLET;
    const long double extended[5] = {xi, chi, 1 - 2 * (chi + xi), chi, xi},
                      kick[4] = {(1 - 2 * lambda) / 2, lambda, lambda, (1 - 2 * lambda) / 2};
    for (int k = 0; k < (verlet ? 2 : 5); k++) {
        soft_twin_drift(s, (verlet ? 0.5L : extended[k]) * h);
        if (k < (verlet ? 1 : 4)) soft_twin_kick(s, (verlet ? 1 : kick[k]) * h);
    }
}

static inline twin_state soft_twin_of(const hd_scene_def *def, const softs *from)
{
    twin_state s = {.count = def->number,
                    .dimension = hd_scene_dimension(def),
                    .pair = def->own[HD_SOFT_POTENTIAL].whole};
    hd_scene_box(def, s.box);
    for (int k = 0; k < s.count * s.dimension; k++) {
        s.q[k] = from->q[k];
        s.p[k] = from->p[k];
    }
    return s;
}

#endif
