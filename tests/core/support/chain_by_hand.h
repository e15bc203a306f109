/** The beta chain of Fermi, Pasta, Ulam and Tsingou as a row of hd_dynamics that nothing helps
 * with, closed to a ring: H = sum p_i^2 / 2 + d_i^2 / 2 + beta d_i^4 / 4, d_i = q_(i+1) - q_i.
 * Exponents come in pairs, and four vanish (energy and time, momentum and translation); all if beta
 * = 0. */
#ifndef HD_CHAIN_BY_HAND_H
#define HD_CHAIN_BY_HAND_H

#include <hdlyap/hdlyap.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { BETA, ENERGY, STEP, PARAMETERS };
static const hd_parameter parameters[PARAMETERS] = {
    {"beta", HD_PARAMETER_REAL, NULL, HD_OWN(BETA), 1, 0, 1e3, "from 0 to 1000", "",
     .text = "Strength of the quartic part."},
    {"energy", HD_PARAMETER_REAL, NULL, HD_OWN(ENERGY), 1, 1e-3, 1e3, "from 0.001 to 1000", "",
     .text = "Energy per particle."},
    {"time_step", HD_PARAMETER_REAL, NULL, HD_OWN(STEP), 0.02, 1e-6, 0.1, "from 1e-6 to 0.1",
     "time units", .text = "Of the integrator, which is Verlet's."}};

/** An entry of the record: one spring in one time step; springs are in their order. */
typedef struct spring {
    double time, step, stiffness;
} spring;

typedef struct chain {
    int count;
    double beta, step, now, steps; /**< steps: time steps done so far */
    double x[];                    /**< [particle][q, p] */
} chain;

static hd_status check(const hd_scene_def *scene, char *message, size_t size)
{
    if (scene->number >= 3) return HD_OK;
    snprintf(message, size, "number = %d: must be 3 or more with particles = chain", scene->number);
    return HD_REFUSED;
}

static int zeros(const hd_scene_def *s) { return s->own[BETA].real == 0 ? 2 * s->number : 4; }
static double entries(const hd_scene_def *s) { return s->number / s->own[STEP].real; }
static double rate(const hd_scene_def *s) { return 0.1 * s->number; }
static double now(const void *state) { return ((const chain *)state)->now; }

/** Creates the start: all energy is kinetic, and momenta add up to 0. */
static hd_status create(void **state, const hd_scene_def *scene)
{
    const int n = scene->number;
    chain *c = *state = calloc(1, sizeof *c + 2 * (size_t)n * sizeof(double));
    if (!c) return HD_NO_MEMORY;
    *c = (chain){.count = n, .beta = scene->own[BETA].real, .step = scene->own[STEP].real};
    double mean = 0, square = 0;
    uint64_t random = scene->seed;
    for (int i = 0; i < n; i++) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        c->x[2 * i + 1] = (double)(random >> 11);
        mean += c->x[2 * i + 1] / n;
    }
    for (int i = 0; i < n; i++) square += pow(c->x[2 * i + 1] -= mean, 2);
    for (int i = 0; i < n; i++) c->x[2 * i + 1] *= sqrt(2 * scene->own[ENERGY].real * n / square);
    return HD_OK;
}

/* drift and pull move a state, with width 1, or a block of `width` tangent vectors. */
static void drift(double *x, int n, int width, double time)
{
    for (int i = 0; i < n; i++)
        for (double *v = x + 2 * width * i; v < x + 2 * width * i + width; v++)
            *v += time * v[width];
}

static void pull(double *x, int n, int width, int i, double strength)
{
    double *here = x + 2 * width * i, *next = x + 2 * width * ((i + 1) % n);
    for (int k = 0; k < width; k++) {
        const double change = strength * (next[k] - here[k]);
        here[width + k] += change;
        next[width + k] -= change;
    }
}

/** Time steps end at multiples of their length, whatever t_end is. */
static hd_status advance(void *state, hd_record *record, double t_end)
{
    chain *c = state;
    const double begin = record ? c->now - hd_record_duration(record) : 0;
    hd_status status = HD_OK;
    for (; (c->steps + 1) * c->step <= t_end && status == HD_OK; c->steps++) {
        drift(c->x, c->count, 1, 0.5 * c->step);
        for (int i = 0; i < c->count; i++) {
            const double d = c->x[2 * ((i + 1) % c->count)] - c->x[2 * i], bend = c->beta * d * d;
            const spring s = {(c->steps + 1) * c->step - begin, c->step, 1 + 3 * bend};
            pull(c->x, c->count, 1, i, c->step * (1 + bend));
            if (record && status == HD_OK) status = hd_record_put(record, &s);
        }
        drift(c->x, c->count, 1, 0.5 * c->step);
    }
    c->now = t_end;
    if (record) hd_record_end(record, t_end - begin);
    return status;
}

static void carry(const void *maps, double *block, int width)
{
    const hd_record_slice *part = maps;
    const spring *s = part->entry, *end = s + part->count;
    for (const int n = part->particles; s < end; s += n) {
        drift(block, n, width, 0.5 * s->step);
        for (int i = 0; i < n; i++) pull(block, n, width, i, s->step * s[i].stiffness);
        drift(block, n, width, 0.5 * s->step);
    }
}

static void tell(const void *state, double *q, double *p)
{
    const chain *c = state;
    for (int i = 0; i < c->count && q; i++) q[i] = c->x[2 * i];
    for (int i = 0; i < c->count && p; i++) p[i] = c->x[2 * i + 1];
}

static void archive(void *state, hd_archive *file)
{
    chain *c = state;
    hd_archive_doubles(file, "chain time", &c->now, 1);
    hd_archive_doubles(file, "chain steps", &c->steps, 1);
    hd_archive_doubles(file, "chain q p", c->x, 2 * (size_t)c->count);
}

/* clang-format off */
static const hd_dynamics of_chain = {
    .particles = "chain", .coordinates = 1, .entry = sizeof(spring), .symplectic = true,
    .parameter = parameters, .parameters = PARAMETERS, .check = check, .zero_exponents = zeros,
    .record_rate = entries, .collision_rate = rate, .create = create, .free = free,
    .advance = advance, .time = now, .state = tell, .archive = archive, .carry = carry};
/* clang-format on */

#endif
