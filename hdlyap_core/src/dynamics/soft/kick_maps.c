/** Record of soft particles -> tangent maps -> blocks of columns carried along [T24]. Free flight
 * is lazy: a particle flies when a kick comes to it, which goes through its pairs by their first
 * particle, whose rows stay in registers. */
#include "dynamics/soft/kick_maps.h"

#include "base/check.h"
#include "base/memory.h"
#include "base/multiversion.h"
#include "dynamics/soft/kick.h"

/** A particle and its partners in a kick: `pairs` of them follow the former run's. */
typedef struct run {
    int32_t i, pairs;
    double flight; /**< of i before, since it was moved */
} run;

typedef struct partner {
    int32_t j;
    double flight;
} partner;

typedef struct maps {
    int particles, dimension, bends;
    double *since; /**< [particles]: when each one was moved, then its last flight */
    size_t runs, pairs, capacity;
    run *run;         /**< [runs] */
    partner *partner; /**< [pairs] */
    double *bend;     /**< [pairs][bends] */
} maps;

static hd_status create(void **out, int particles, int dimension)
{
    maps *all = *out = hd_memory_alloc(1, sizeof *all);
    if (!all) return HD_NO_MEMORY;
    all->particles = particles;
    all->dimension = dimension;
    all->bends = dimension == 2 ? HD_BENDS_PLANE : HD_BENDS_SPACE;
    all->since = hd_memory_alloc((size_t)particles, sizeof *all->since);
    return all->since ? HD_OK : HD_NO_MEMORY;
}

hd_status hd_kick_maps_create_plane(void **out, int particles) { return create(out, particles, 2); }
hd_status hd_kick_maps_create_space(void **out, int particles) { return create(out, particles, 3); }

static void release(maps *all)
{
    hd_memory_free(all->run);
    hd_memory_free(all->partner);
    hd_memory_free(all->bend);
}

void hd_kick_maps_free(void *made)
{
    maps *all = made;
    if (!all) return;
    release(all);
    hd_memory_free(all->since);
    hd_memory_free(all);
}

/* ---- steps as maps ------------------------------------------------------------------------- */

/** For so many pairs, each of which may be a run. */
static hd_status reserve(maps *all, size_t pairs)
{
    if (pairs <= all->capacity) return HD_OK;
    size_t room = 4096; /* as records grow */
    while (room < pairs) room *= 2;
    release(all);
    all->capacity = 0;
    all->run = hd_memory_alloc(room, sizeof *all->run);
    all->partner = hd_memory_alloc(room, sizeof *all->partner);
    all->bend = hd_memory_alloc(room * (size_t)all->bends, sizeof *all->bend);
    if (!all->run || !all->partner || !all->bend) return HD_NO_MEMORY;
    all->capacity = room;
    return HD_OK;
}

/** Until `now`, of the passage: none if it has taken part in this kick. */
static double flight(maps *all, int32_t i, double now)
{
    const double time = now - all->since[i];
    all->since[i] = now;
    return time;
}

static void add_pair(maps *all, const hd_kick *entry, bool same_run, double now)
{
    const int32_t i = (int32_t)entry->i, j = (int32_t)entry->j;
    if (!same_run) all->run[all->runs++] = (run){i, 0, flight(all, i, now)};
    all->run[all->runs - 1].pairs++;
    all->partner[all->pairs] = (partner){j, flight(all, j, now)};
    for (int k = 0; k < all->bends; k++)
        all->bend[all->pairs * (size_t)all->bends + (size_t)k] = entry->bend[k];
    all->pairs++;
}

/** Returns how long the steps take. */
static double add_steps(maps *all, const hd_record *record, hd_entries those)
{
    double begin = 0.0, end = 0.0, at = -1.0, i = -1.0;
    for (size_t k = those.first; k < those.end; k++) {
        const hd_kick *entry = hd_record_entry(record, k);
        if (entry->i < 0) {
            begin = end;
            end = begin + entry->at;
            at = i = -1.0;
            continue;
        }
        add_pair(all, entry, entry->at == at && entry->i == i, begin + entry->at);
        at = entry->at;
        i = entry->i;
    }
    return end;
}

hd_status hd_kick_maps_fill(void *made, const hd_record *record, double t_begin, double t_end)
{
    maps *all = made;
    const hd_entries those = hd_record_within(record, t_begin, t_end);
    all->runs = all->pairs = 0;
    HD_TRY(reserve(all, those.end - those.first));
    for (int i = 0; i < all->particles; i++) all->since[i] = 0.0;
    const double end = add_steps(all, record, those);
    for (int i = 0; i < all->particles; i++) all->since[i] = end - all->since[i];
    return HD_OK;
}

/* ---- a block of columns -------------------------------------------------------------------- */

#define KERNEL static inline __attribute__((always_inline))

/** So many columns at once, wherever they lie; narrower blocks leave the others empty. */
enum { LANES = 8 };
typedef double lanes
    __attribute__((vector_size(LANES * sizeof(double)), aligned(sizeof(double)), may_alias));

KERNEL void load(lanes *to, const double *from, int width)
{
    if (width >= LANES) {
        *to = *(const lanes *)from;
        return;
    }
    *to = (lanes){0.0};
    for (int k = 0; k < width; k++) (*to)[k] = from[k];
}

KERNEL void store(double *to, const lanes *from, int width)
{
    if (width >= LANES)
        *(lanes *)to = *from;
    else
        for (int k = 0; k < width; k++) to[k] = (*from)[k];
}

KERNEL void fly(double *restrict v, double time, int of_one, int width)
{
    for (int k = 0; k < of_one * width; k++) v[k] += time * v[of_one * width + k];
}

/** Place of (d, e) in the upper half of a symmetric matrix. */
KERNEL int place(int d, int e, int of_one)
{
    const int row = d < e ? d : e;
    return row * of_one - row * (row + 1) / 2 + (d < e ? e : d);
}

/** A pair: bend (dq_j - dq_i) is added to dp_i and taken from dp_j. */
KERNEL void pull(lanes *p, const lanes *q, double *other, double flight, const double *bend,
                 int of_one, int width)
{
    lanes r[3], theirs[3];
    for (int d = 0; d < of_one; d++) {
        load(&r[d], other + d * width, width);
        load(&theirs[d], other + (of_one + d) * width, width);
    }
    for (int d = 0; d < of_one && flight != 0; d++) {
        r[d] += flight * theirs[d];
        store(other + d * width, &r[d], width);
    }
    for (int d = 0; d < of_one; d++) r[d] -= q[d];
    for (int d = 0; d < of_one; d++) {
        lanes f = bend[place(d, 0, of_one)] * r[0];
        for (int e = 1; e < of_one; e++) f += bend[place(d, e, of_one)] * r[e];
        p[d] += f;
        theirs[d] -= f;
        store(other + (of_one + d) * width, &theirs[d], width);
    }
}

/** Columns from `block` on, as many as LANES, of a particle with its partners. */
KERNEL void pull_run(double *block, const run *r, const partner *with, const double *bend,
                     int of_one, int width)
{
    const size_t one = 2 * (size_t)(of_one * width), bends = of_one == 2 ? 3 : 6;
    double *own = block + one * (size_t)r->i;
    lanes q[3], p[3];
    for (int d = 0; d < of_one; d++) {
        load(&q[d], own + d * width, width);
        load(&p[d], own + (of_one + d) * width, width);
        q[d] += r->flight * p[d];
        store(own + d * width, &q[d], width);
    }
    for (int32_t n = 0; n < r->pairs; n++)
        pull(p, q, block + one * (size_t)with[n].j, with[n].flight, bend + bends * (size_t)n,
             of_one, width);
    for (int d = 0; d < of_one; d++) store(own + (of_one + d) * width, &p[d], width);
}

KERNEL void carry_width(double *block, const maps *all, int of_one, int width)
{
    const size_t one = 2 * (size_t)(of_one * width), bends = of_one == 2 ? 3 : 6;
    size_t pair = 0;
    for (const run *r = all->run; r < all->run + all->runs; pair += (size_t)r++->pairs)
        for (int c = 0; c < width; c += LANES)
            pull_run(block + c, r, all->partner + pair, all->bend + bends * pair, of_one, width);
    for (int i = 0; i < all->particles; i++)
        fly(block + one * (size_t)i, all->since[i], of_one, width);
}

/** The widths are spelled out so that the compiler unrolls and vectorises each. */
KERNEL void carry_of(double *block, const maps *all, int of_one, int width)
{
    switch (width) {
    case 1: carry_width(block, all, of_one, 1); break;
    case 2: carry_width(block, all, of_one, 2); break;
    case 4: carry_width(block, all, of_one, 4); break;
    case 8: carry_width(block, all, of_one, 8); break;
    case 16: carry_width(block, all, of_one, 16); break;
    case 32: carry_width(block, all, of_one, 32); break;
    default: carry_width(block, all, of_one, HD_BLOCK_WIDTH_MAX); break;
    }
}

HD_MULTIVERSION
static void carry_plane(double *block, const maps *all, int width)
{
    carry_of(block, all, 2, width);
}

HD_MULTIVERSION
static void carry_space(double *block, const maps *all, int width)
{
    carry_of(block, all, 3, width);
}

void hd_kick_maps_carry(const void *made, double *block, int width)
{
    const maps *all = made;
    (all->dimension == 2 ? carry_plane : carry_space)(block, all, width);
}
