/** A ring of particles that a field drives over a periodic potential, at a constant kinetic energy
 * by Gauss's thermostat, as a row of hd_dynamics. Maps are not symplectic: dq_i/dt = p_i, dp_i/dt =
 * F_i + E - alpha p_i, alpha = sum p.(F + E) / sum p^2. Two exponents vanish (time, kinetic
 * energy); the others add in pairs to -<alpha> (Dettmann and Morriss, Phys. Rev. E 53, R5545
 * (1996)), and the divergence is -(N - 1) alpha. */
#ifndef HD_ISOKINETIC_H
#define HD_ISOKINETIC_H

#include <hdlyap/hdlyap.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RING = 4 };               /* particles */
static const double PACE = 0.02; /* time step of RK4 */

static const hd_parameter ring_own[] = {{"field", HD_PARAMETER_REAL, NULL, HD_OWN(0), 0.5, 0, 10,
                                         "from 0 to 10", "", .text = "Force on each particle."}};

/** q, p, and the integral of the divergence; or their derivatives. */
typedef struct ring {
    double q[RING], p[RING], diverged;
} ring;

typedef struct driven {
    ring x;
    double field, now, steps;
} driven;

/** An entry of the record: a particle where a time step begins. The time is that of its end. */
typedef struct stay {
    double time, q, p;
} stay;

/** Of particle i; neighbours are driven apart. */
static double charge(int i) { return i % 2 == 0 ? 1.0 : -1.0; }

/** What the changes of all vectors at a state have in common. */
typedef struct push {
    double f[RING], bend[RING], spring[RING]; /**< forces with the field; second derivatives, of the
                                                 potential and of the spring to the right */
    double square, alpha;                     /**< sum p^2 */
} push;

static push pushed(const ring *x, double field)
{
    push of = {.square = 0.0};
    double work = 0.0;
    for (int i = 0; i < RING; i++) {
        const double right = x->q[(i + 1) % RING] - x->q[i],
                     left = x->q[i] - x->q[(i + RING - 1) % RING];
        of.f[i] = charge(i) * field - sin(x->q[i]) + sin(right) - sin(left);
        of.bend[i] = cos(x->q[i]);
        of.spring[i] = cos(right);
        work += x->p[i] * of.f[i];
        of.square += x->p[i] * x->p[i];
    }
    of.alpha = work / of.square;
    return of;
}

/** Returns dx/dt. */
static ring ring_change(const ring *x, const push *of)
{
    ring d = {.diverged = -(RING - 1) * of->alpha};
    for (int i = 0; i < RING; i++) {
        d.q[i] = x->p[i];
        d.p[i] = of->f[i] - of->alpha * x->p[i];
    }
    return d;
}

/** Returns the change in time of a tangent vector v at x. */
static ring ring_tangent(const ring *x, const push *of, const ring *v)
{
    ring d = {.diverged = 0.0};
    double turn = 0.0; /* of alpha */
    for (int i = 0; i < RING; i++) {
        const int next = (i + 1) % RING, last = (i + RING - 1) % RING;
        d.q[i] = v->p[i];
        d.p[i] = of->spring[i] * (v->q[next] - v->q[i]) -
                 of->spring[last] * (v->q[i] - v->q[last]) - of->bend[i] * v->q[i];
        turn += v->p[i] * of->f[i] + x->p[i] * d.p[i] - 2.0 * of->alpha * x->p[i] * v->p[i];
    }
    for (int i = 0; i < RING; i++) d.p[i] -= of->alpha * v->p[i] + turn / of->square * x->p[i];
    return d;
}

/** x + time * d */
static ring ring_moved(const ring *x, const ring *d, double time)
{
    ring sum = *x;
    for (int i = 0; i < RING; i++) {
        sum.q[i] += time * d->q[i];
        sum.p[i] += time * d->p[i];
    }
    sum.diverged += time * d->diverged;
    return sum;
}

static const double RK_PART[] = {0.0, 0.5, 0.5, 1.0}, RK_WEIGHT[] = {1.0, 2.0, 2.0, 1.0};

/** A step of RK4. Keeps what its four stages were in at[4] and of[4]. */
static void ring_step(ring *x, double field, ring *at, push *of)
{
    ring d = {.diverged = 0.0}, sum = *x;
    for (int k = 0; k < 4; k++) {
        at[k] = ring_moved(x, &d, RK_PART[k] * PACE);
        of[k] = pushed(&at[k], field);
        d = ring_change(&at[k], &of[k]);
        sum = ring_moved(&sum, &d, RK_WEIGHT[k] * PACE / 6.0);
    }
    *x = sum;
}

/** The derivative of such a step. */
static void ring_carry_one(ring *v, const ring *at, const push *of)
{
    ring d = {.diverged = 0.0}, sum = *v;
    for (int k = 0; k < 4; k++) {
        const ring moved = ring_moved(v, &d, RK_PART[k] * PACE);
        d = ring_tangent(&at[k], &of[k], &moved);
        sum = ring_moved(&sum, &d, RK_WEIGHT[k] * PACE / 6.0);
    }
    *v = sum;
}

static double ring_entries(const hd_scene_def *s) { return s->number / PACE; }
static double ring_rate(const hd_scene_def *s) { return 0.2 * s->number; }
static int ring_zeros(const hd_scene_def *s) { return s ? 2 : 0; }

/** The flow. */
static int ring_null(const hd_scene_def *s, const double *q, const double *p, double *column)
{
    ring x = {.diverged = 0.0};
    memcpy(x.q, q, sizeof x.q);
    memcpy(x.p, p, sizeof x.p);
    const push of = pushed(&x, s->own[0].real);
    const ring d = ring_change(&x, &of);
    for (int i = 0; i < RING; i++) {
        column[2 * i] = d.q[i];
        column[2 * i + 1] = d.p[i];
    }
    return 1;
}

static double ring_now(const void *state) { return ((const driven *)state)->now; }
static double ring_diverged(const void *state) { return ((const driven *)state)->x.diverged; }

static hd_status ring_check(const hd_scene_def *s, char *message, size_t size)
{
    if (s->number == RING) return HD_OK;
    snprintf(message, size, "number = %d: must be %d with particles = ring", s->number, RING);
    return HD_REFUSED;
}

/** Kinetic energy N / 2. */
static hd_status ring_create(void **state, const hd_scene_def *scene)
{
    driven *c = *state = calloc(1, sizeof *c);
    if (!c) return HD_NO_MEMORY;
    double square = 0.0;
    c->field = scene->own[0].real;
    for (int i = 0; i < RING; i++) {
        c->x.p[i] = sin(1.0 + (double)scene->seed + 2.3 * i);
        square += c->x.p[i] * c->x.p[i];
    }
    for (int i = 0; i < RING; i++) c->x.p[i] *= sqrt(RING / square);
    return HD_OK;
}

static hd_status ring_advance(void *state, hd_record *record, double t_end)
{
    driven *c = state;
    const double begin = record ? c->now - hd_record_duration(record) : 0.0;
    hd_status status = HD_OK;
    for (; (c->steps + 1) * PACE <= t_end && status == HD_OK; c->steps++) {
        ring at[4];
        push of[4];
        for (int i = 0; i < RING && record && status == HD_OK; i++) {
            const stay s = {(c->steps + 1) * PACE - begin, c->x.q[i], c->x.p[i]};
            status = hd_record_put(record, &s);
        }
        ring_step(&c->x, c->field, at, of);
    }
    c->now = t_end;
    if (record) hd_record_end(record, t_end - begin);
    return status;
}

static void ring_carry(const void *maps, double *block, int width)
{
    const hd_record_slice *part = maps;
    const stay *s = part->entry;
    for (size_t k = 0; k < part->count; k += RING) {
        ring x = {.diverged = 0.0}, v = x, at[4];
        push of[4];
        for (int i = 0; i < RING; i++) {
            x.q[i] = s[k + (size_t)i].q;
            x.p[i] = s[k + (size_t)i].p;
        }
        ring_step(&x, part->scene->own[0].real, at, of);
        for (int col = 0; col < width; col++) {
            for (int row = 0; row < 2 * RING; row++)
                *(row % 2 ? &v.p[row / 2] : &v.q[row / 2]) = block[row * width + col];
            ring_carry_one(&v, at, of);
            for (int row = 0; row < 2 * RING; row++)
                block[row * width + col] = row % 2 ? v.p[row / 2] : v.q[row / 2];
        }
    }
}

static void ring_tell(const void *state, double *q, double *p)
{
    const driven *c = state;
    if (q) memcpy(q, c->x.q, sizeof c->x.q);
    if (p) memcpy(p, c->x.p, sizeof c->x.p);
}

static void ring_archive(void *state, hd_archive *file)
{
    driven *c = state;
    hd_archive_doubles(file, "ring time", &c->now, 1);
    hd_archive_doubles(file, "ring steps", &c->steps, 1);
    hd_archive_doubles(file, "ring q", c->x.q, RING);
    hd_archive_doubles(file, "ring p", c->x.p, RING);
    hd_archive_doubles(file, "ring diverged", &c->x.diverged, 1);
}

/* clang-format off */
static const hd_dynamics of_ring = {
    .particles = "ring", .coordinates = 1, .entry = sizeof(stay), .parameter = ring_own,
    .parameters = 1, .check = ring_check, .zero_exponents = ring_zeros,
    .null_vectors = ring_null,
    .record_rate = ring_entries, .collision_rate = ring_rate, .create = ring_create, .free = free,
    .advance = ring_advance, .time = ring_now, .state = ring_tell, .archive = ring_archive,
    .divergence = ring_diverged, .carry = ring_carry};
/* clang-format on */

#endif
