/** When two disks meet: a pure function of their two states and the image, the same bits whoever
 * asks, in whatever order, and whenever. */
#ifndef HD_CONTACT_H
#define HD_CONTACT_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "events/disk.h"

/** Two numbers side by side: half the instructions, the same bits (no contraction, no reordering).
 */
typedef double hd_pair __attribute__((vector_size(16)));
typedef int64_t hd_pair_mask __attribute__((vector_size(16)));

static inline hd_pair hd_pair_load(const double *x)
{
    hd_pair pair;
    memcpy(&pair, x, sizeof pair);
    return pair;
}

static inline hd_pair hd_pair_both(double x) { return (hd_pair){x, x}; }

/** In each place: mask ? yes : no. */
static inline hd_pair hd_pair_where(hd_pair_mask mask, hd_pair yes, hd_pair no)
{
    return (hd_pair)((mask & (hd_pair_mask)yes) | (~mask & (hd_pair_mask)no));
}

/** From disk a to the image of disk b that is `shift` away, both moved to time t. */
static inline hd_pair hd_contact_separation(const hd_disk *a, const hd_disk *b, hd_pair shift,
                                            double t)
{
    return hd_pair_load(b->q) + hd_pair_load(b->p) * (t - b->t) -
           (hd_pair_load(a->q) + hd_pair_load(a->p) * (t - a->t)) + shift;
}

static inline double hd_contact_dot(hd_pair r, hd_pair p)
{
    const hd_pair x = r * p;
    return x[0] + x[1];
}

/** Two disks side by side. */
typedef struct hd_two_disks {
    hd_pair x, y, px, py, t;
} hd_two_disks;

static inline hd_two_disks hd_two_disks_of(const hd_disk *a, const hd_disk *b)
{
    return (hd_two_disks){{a->q[0], b->q[0]},
                          {a->q[1], b->q[1]},
                          {a->p[0], b->p[0]},
                          {a->p[1], b->p[1]},
                          {a->t, b->t}};
}

/** When two disks a meet two disks b whose images are (shift_x, shift_y) away; NaN if never. A
 * contact is ahead if they approach (r.p < 0) and do not pass each other (p^2 - z^2 > 0 with z = r
 * x p). The wait until |r + p t| = 1 is, with c = r^2 - 1, c / (sqrt(p^2 - z^2) - r.p): no
 * difference of large numbers; two disks that touch within rounding while approaching meet at once.
 * Without branches: one that the processor cannot foresee costs more than a root and a quotient in
 * vain. */
static inline hd_pair hd_contact_times(const hd_two_disks *a, const hd_two_disks *b,
                                       hd_pair shift_x, hd_pair shift_y)
{
    const hd_pair t = hd_pair_where(a->t > b->t, a->t, b->t), wait_a = t - a->t, wait_b = t - b->t;
    const hd_pair px = b->px - a->px, py = b->py - a->py;
    const hd_pair rx = b->x + b->px * wait_b - (a->x + a->px * wait_a) + shift_x;
    const hd_pair ry = b->y + b->py * wait_b - (a->y + a->py * wait_a) + shift_y;
    const hd_pair z = rx * py - ry * px, rp = rx * px + ry * py;
    const hd_pair square = px * px + py * py - z * z, c = rx * rx + ry * ry - 1.0;
    const hd_pair root = {sqrt(square[0]), sqrt(square[1])};
    const hd_pair wait = (hd_pair)((c > 0) & (hd_pair_mask)(c / (root - rp)));
    const hd_pair_mask ahead = (rp < 0) & (square > 0);
    return (hd_pair)((hd_pair_mask)(t + wait) | ~ahead);
}

#endif
