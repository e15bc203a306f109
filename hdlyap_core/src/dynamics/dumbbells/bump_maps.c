/** Record of dumbbells -> tangent maps -> blocks of columns, carried through the maps [T23]. */
#include "dynamics/dumbbells/dumbbells.h"

#include "dynamics/hard/kernel.h"

enum { HD_HALF = 3 };
typedef hd_bump hd_entry;

/* ---- events as maps ------------------------------------------------------------------------ */

/** The free flights of the event's dumbbells since their last events, then the event. Index 0 is
 * for i, 1 for j. w is the gradient of the gap. */
typedef struct hd_tangent_map {
    int32_t i, j; /**< j = -1: a wall */
    double flight[2];
    double n[2], across[2];
    double twice;              /**< 2 / w^2 */
    double along[2];           /**< k */
    double per_root;           /**< 1 / sqrt(I) */
    double slides, slides_per; /**< e.(p_j - p_i); rate of u over the rate of the gap */
    double turns_per[2];       /**< rates of the angles over the rate of the gap */
    double bends[2], bend;     /**< third components of p - b w, which multiply f in a; b */
} hd_tangent_map;

/** A wall is a partner that neither moves nor turns. */
static void hd_map_fill(hd_tangent_map *to, const hd_bump *bump)
{
    const double *n = bump->n, *p = bump->p, *across = bump->across, *along = bump->along;
    const bool wall = bump->j < 0;
    const double side = wall ? 1.0 : -1.0; /* sign of n and c of i in w */
    to->per_root = bump->per_root;
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

/* ---- a block of columns -------------------------------------------------------------------- */

/** Free flights, then the contact of [T23]. open = dq.w; slid is u, and fi, fj are f, of the
 * displaced trajectory at its contact: they turn the gradient. u here is a of [T23], s is b u. */
HD_KERNEL void hd_collide(double *restrict vi, double *restrict vj, const hd_tangent_map *m,
                          int width)
{
    const double nx = m->n[0], ny = m->n[1], ti = m->flight[0], tj = m->flight[1];
    const double ci = m->across[0], cj = m->across[1], ki = m->along[0], kj = m->along[1];
    const double per = m->per_root, twice = m->twice, slides_per = m->slides_per;
    const double pi = m->turns_per[0], pj = m->turns_per[1], slides = m->slides, bend = m->bend;
    const double gi = m->bends[0], gj = m->bends[1];
#pragma GCC ivdep
    for (int k = 0; k < width; k++) {
        double *a = vi + k, *b = vj + k, *ap = a + HD_HALF * width, *bp = b + HD_HALF * width;
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

/** Free flight, then the contact with a wall. Only the angle turns its gradient (n, c). */
HD_KERNEL void hd_meet_wall(double *restrict v, const hd_tangent_map *m, int width)
{
    const double nx = m->n[0], ny = m->n[1], c = m->across[0], k0 = m->along[0];
    const double per = m->per_root, twice = m->twice, turns = m->turns_per[0], g = m->bends[0];
    const double bend = m->bend;
    hd_fly(v, m->flight[0], HD_HALF * width);
#pragma GCC ivdep
    for (int k = 0; k < width; k++) {
        double *a = v + k, *p = a + HD_HALF * width;
        const double open = nx * a[0] + ny * a[width] + c * a[2 * width];
        const double f = -k0 * (per * a[2 * width] - turns * open);
        const double u = twice * (nx * p[0] + ny * p[width] + c * p[2 * width] + g * f);
        const double w = twice * open;
        a[0] -= w * nx, a[width] -= w * ny, a[2 * width] -= w * c;
        p[0] -= u * nx, p[width] -= u * ny, p[2 * width] -= u * c + bend * f;
    }
}

/* other names than those of disks: see compiled.h */
#undef carry_block
#undef carry_block_with_walls
#define carry_block carry_block_of_dumbbells
#define carry_block_with_walls carry_block_of_dumbbells_with_walls
#include "dynamics/hard/carry.h"

hd_status hd_bump_maps_create(void **maps, const hd_scene_def *scene)
{
    return maps_create(maps, scene);
}

void hd_bump_maps_free(void *maps) { maps_free(maps); }

hd_status hd_bump_maps_fill(void *maps, const hd_record *record, double t_begin, double t_end)
{
    return maps_fill(maps, record, t_begin, t_end);
}

void hd_bump_maps_carry(const void *maps, double *block, int width)
{
    maps_carry(maps, block, width);
}
