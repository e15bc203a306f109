/** Record of dumbbells -> tangent maps -> blocks of columns carried along [T23]. Free flight is
 * lazy, as of hard disks. */
#include "dynamics/dumbbells/bump_maps.h"

#include "base/check.h"
#include "base/memory.h"
#include "base/multiversion.h"
#include "dynamics/dumbbells/bump.h"

/** Coordinates, and rows of a molecule; maps that are fetched ahead where a block outgrows the
 * cache. */
enum { OF_ONE = 3, ROWS = 2 * OF_ONE, FETCH_AHEAD = 8, LINE = 64 / sizeof(double) };

/** Free flights of its molecules since their last events, then the event. Index 0: i, 1: j. */
typedef struct map {
    int32_t i, j; /**< j = -1: a wall */
    double flight[2];
    double n[2], across[2];
    double twice;              /**< 2 over the square of the gradient */
    double along[2];           /**< k: curvature, of what slides along the contact */
    double per_root;           /**< 1 over the root of the inertia */
    double slides, slides_per; /**< of the momenta; over the rate of the gap */
    double turns_per[2];       /**< of the angles; over the rate of the gap */
    double bends[2], bend;     /**< what the turns of the gradient add to dp along it, and by which
                                    they count */
} map;

typedef struct maps {
    int molecules;
    map *map; /**< [count] */
    size_t count, capacity;
    double *since; /**< [molecules], time of each one's last event, then its last flight */
} maps;

hd_status hd_bump_maps_create(void **out, int molecules)
{
    maps *made = *out = hd_memory_alloc(1, sizeof *made);
    if (!made) return HD_NO_MEMORY;
    made->molecules = molecules;
    made->since = hd_memory_alloc((size_t)molecules, sizeof *made->since);
    return made->since ? HD_OK : HD_NO_MEMORY;
}

void hd_bump_maps_free(void *made)
{
    maps *all = made;
    if (!all) return;
    hd_memory_free(all->map);
    hd_memory_free(all->since);
    hd_memory_free(all);
}

/* ---- events as maps ------------------------------------------------------------------------ */

static double flight(double *since, int32_t i, double t)
{
    const double tau = t - since[i];
    since[i] = t;
    return tau;
}

/** A wall is a partner that neither moves nor turns. */
static void map_fill(map *to, const hd_bump *bump, double *since)
{
    const double *n = bump->n, *p = bump->p, *across = bump->across, *along = bump->along;
    const bool wall = bump->j < 0;
    const double side = wall ? 1.0 : -1.0; /* of i in the gradient */
    *to = (map){.i = (int32_t)bump->i, .j = (int32_t)bump->j, .per_root = bump->per_root};
    to->flight[0] = flight(since, to->i, bump->t);
    if (!wall) to->flight[1] = flight(since, to->j, bump->t);
    const double rate = n[0] * p[0] + n[1] * p[1] + side * across[0] * bump->spin[0] +
                        across[1] * bump->spin[1];
    to->twice = 2.0 / ((wall ? 1.0 : 2.0) + across[0] * across[0] + across[1] * across[1]);
    to->bend = rate * to->twice;
    if (!wall) to->slides = n[0] * p[1] - n[1] * p[0];
    const double sliding = to->slides + along[1] * bump->spin[1] - along[0] * bump->spin[0];
    to->slides_per = wall ? 0.0 : sliding / rate;
    for (int k = 0; k < 2; k++) {
        to->n[k] = n[k];
        to->across[k] = across[k];
        to->along[k] = along[k];
        to->turns_per[k] = bump->spin[k] * bump->per_root / rate;
        to->bends[k] = bump->spin[k] - (k == 0 ? side : 1.0) * to->bend * across[k];
    }
}

static hd_status reserve(maps *all, size_t count)
{
    if (count <= all->capacity) return HD_OK;
    hd_memory_free(all->map);
    all->capacity = count + count / 2;
    all->map = hd_memory_alloc(all->capacity, sizeof *all->map);
    if (all->map) return HD_OK;
    all->capacity = 0;
    return HD_NO_MEMORY;
}

hd_status hd_bump_maps_fill(void *made, const hd_record *record, double t_begin, double t_end)
{
    maps *all = made;
    const hd_entries those = hd_record_within(record, t_begin, t_end);
    all->count = 0;
    HD_TRY(reserve(all, those.end - those.first));
    for (int i = 0; i < all->molecules; i++) all->since[i] = t_begin;
    for (size_t k = those.first; k < those.end; k++)
        map_fill(&all->map[all->count++], hd_record_entry(record, k), all->since);
    for (int i = 0; i < all->molecules; i++) all->since[i] = t_end - all->since[i];
    return HD_OK;
}

/* ---- a block of columns -------------------------------------------------------------------- */

#define KERNEL static inline __attribute__((always_inline))

KERNEL void fly(double *restrict v, double tau, int width)
{
    for (int k = 0; k < OF_ONE * width; k++) v[k] += tau * v[OF_ONE * width + k];
}

/** [T23]: a is how far the gap has opened too early; slid and the turns are what the shadow has
 * done until it meets, and turn the gradient. */
KERNEL void meet(double *restrict vi, double *restrict vj, const map *m, int width)
{
    const double nx = m->n[0], ny = m->n[1], ti = m->flight[0], tj = m->flight[1];
    const double ci = m->across[0], cj = m->across[1], ki = m->along[0], kj = m->along[1];
    const double per = m->per_root, twice = m->twice, slides_per = m->slides_per;
    const double pi = m->turns_per[0], pj = m->turns_per[1], slides = m->slides, bend = m->bend;
    const double gi = m->bends[0], gj = m->bends[1];
#pragma GCC ivdep
    for (int k = 0; k < width; k++) {
        double *a = vi + k, *b = vj + k, *ap = a + OF_ONE * width, *bp = b + OF_ONE * width;
        const double ax = a[0] + ti * ap[0], ay = a[width] + ti * ap[width],
                     at = a[2 * width] + ti * ap[2 * width];
        const double bx = b[0] + tj * bp[0], by = b[width] + tj * bp[width],
                     bt = b[2 * width] + tj * bp[2 * width];
        const double x = bx - ax, y = by - ay;
        const double open = nx * x + ny * y + cj * bt - ci * at;
        const double slid = nx * y - ny * x + kj * bt - ki * at - slides_per * open;
        const double fi = ki * (slid - (per * at - pi * open)),
                     fj = kj * (slid - (per * bt - pj * open));
        const double u = twice *
                         (nx * (bp[0] - ap[0]) + ny * (bp[width] - ap[width]) + cj * bp[2 * width] -
                          ci * ap[2 * width] + slides * slid + gj * fj - gi * fi);
        const double s = bend * slid, ux = u * nx - s * ny, uy = u * ny + s * nx;
        const double w = twice * open;
        a[0] = ax + w * nx, a[width] = ay + w * ny, a[2 * width] = at + w * ci;
        b[0] = bx - w * nx, b[width] = by - w * ny, b[2 * width] = bt - w * cj;
        ap[0] += ux, ap[width] += uy, ap[2 * width] += u * ci + bend * fi;
        bp[0] -= ux, bp[width] -= uy, bp[2 * width] -= u * cj + bend * fj;
    }
}

/** A wall has the gradient (n, c): the angle alone turns it. */
KERNEL void meet_wall(double *restrict v, const map *m, int width)
{
    const double nx = m->n[0], ny = m->n[1], c = m->across[0], k0 = m->along[0];
    const double per = m->per_root, twice = m->twice, turns = m->turns_per[0], g = m->bends[0];
    const double bend = m->bend;
    fly(v, m->flight[0], width);
#pragma GCC ivdep
    for (int k = 0; k < width; k++) {
        double *a = v + k, *p = a + OF_ONE * width;
        const double open = nx * a[0] + ny * a[width] + c * a[2 * width];
        const double f = -k0 * (per * a[2 * width] - turns * open);
        const double u = twice * (nx * p[0] + ny * p[width] + c * p[2 * width] + g * f);
        const double w = twice * open;
        a[0] -= w * nx, a[width] -= w * ny, a[2 * width] -= w * c;
        p[0] -= u * nx, p[width] -= u * ny, p[2 * width] -= u * c + bend * f;
    }
}

/** The rows of both molecules, into the cache. */
KERNEL void fetch(const double *block, const map *m, int width)
{
    const size_t one = ROWS * (size_t)width;
    const double *vi = block + one * (size_t)m->i, *vj = m->j < 0 ? vi : block + one * (size_t)m->j;
    for (size_t k = 0; k < one; k += LINE) {
        __builtin_prefetch(vi + k, 1);
        __builtin_prefetch(vj + k, 1);
    }
}

KERNEL void carry_width(double *block, const maps *all, size_t fetching, int width)
{
    const size_t one = ROWS * (size_t)width;
    const map *m = all->map;
    for (size_t e = 0; e < all->count; e++) {
        if (e < fetching) fetch(block, &m[e + FETCH_AHEAD], width);
        double *vi = block + one * (size_t)m[e].i;
        if (m[e].j >= 0)
            meet(vi, block + one * (size_t)m[e].j, &m[e], width);
        else
            meet_wall(vi, &m[e], width);
    }
    for (int i = 0; i < all->molecules; i++) fly(block + one * (size_t)i, all->since[i], width);
}

/** The widths are spelled out so that the compiler unrolls and vectorises each. */
HD_MULTIVERSION
static void carry_molecules(double *block, const maps *all, size_t fetching, int width)
{
    switch (width) {
    case 1: carry_width(block, all, fetching, 1); break;
    case 2: carry_width(block, all, fetching, 2); break;
    case 4: carry_width(block, all, fetching, 4); break;
    case 8: carry_width(block, all, fetching, 8); break;
    case 16: carry_width(block, all, fetching, 16); break;
    case 32: carry_width(block, all, fetching, 32); break;
    default: carry_width(block, all, fetching, HD_BLOCK_WIDTH_MAX); break;
    }
}

void hd_bump_maps_carry(const void *made, double *block, int width)
{
    const maps *all = made;
    const size_t bytes = ROWS * (size_t)width * (size_t)all->molecules * sizeof(double);
    const bool is_far = bytes > HD_BLOCK_BYTES && all->count > FETCH_AHEAD;
    carry_molecules(block, all, is_far ? all->count - FETCH_AHEAD : 0, width);
}
