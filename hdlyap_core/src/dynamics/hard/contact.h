/** When two disks meet. It is a pure function of the two states and the image: its bits do not
 * depend on when and in which order contacts are computed. */
#ifndef HD_CONTACT_H
#define HD_CONTACT_H

#include <math.h>
#include <stdint.h>

#include "dynamics/hard/disk.h"

/** Two numbers side by side. They take half the instructions of two scalars and give the same bits
 * (no contraction, no reordering). */
typedef double hd_pair __attribute__((vector_size(16)));
typedef int64_t hd_pair_mask __attribute__((vector_size(16)));

static inline hd_pair hd_pair_both(double x) { return (hd_pair){x, x}; }

/** For each of the two numbers: mask ? yes : no. */
static inline hd_pair hd_pair_where(hd_pair_mask mask, hd_pair yes, hd_pair no)
{
    return (hd_pair)((mask & (hd_pair_mask)yes) | (~mask & (hd_pair_mask)no));
}

/** r: the vector from disk a to disk b shifted by `shift`, both moved to time t. */
static inline void hd_contact_separation(double r[HD_DIM], const hd_disk *a, const hd_disk *b,
                                         const double shift[HD_DIM], double t)
{
    for (int d = 0; d < HD_DIM; d++)
        r[d] = b->q[d] + b->p[d] * (t - b->t) - (a->q[d] + a->p[d] * (t - a->t)) + shift[d];
}

static inline double hd_contact_dot(const double r[HD_DIM], const double p[HD_DIM])
{
    double sum = r[0] * p[0];
    for (int d = 1; d < HD_DIM; d++) sum += r[d] * p[d];
    return sum;
}

/** The states of two disks side by side. */
typedef struct hd_two_disks {
    hd_pair q[HD_DIM], p[HD_DIM], t;
} hd_two_disks;

static inline hd_two_disks hd_two_disks_of(const hd_disk *a, const hd_disk *b)
{
    hd_two_disks both = {.t = {a->t, b->t}};
    for (int d = 0; d < HD_DIM; d++) {
        both.q[d] = (hd_pair){a->q[d], b->q[d]};
        both.p[d] = (hd_pair){a->p[d], b->p[d]};
    }
    return both;
}

/** |r x p|^2 */
static inline hd_pair hd_pair_cross_square(const hd_pair r[HD_DIM], const hd_pair p[HD_DIM])
{
    const hd_pair z = r[0] * p[1] - r[1] * p[0];
#if HD_DIM == 2
    return z * z;
#else
    const hd_pair x = r[1] * p[2] - r[2] * p[1], y = r[2] * p[0] - r[0] * p[2];
    return x * x + y * y + z * z;
#endif
}

static inline hd_pair hd_pair_dot(const hd_pair a[HD_DIM], const hd_pair b[HD_DIM])
{
    hd_pair sum = a[0] * b[0];
    for (int d = 1; d < HD_DIM; d++) sum += a[d] * b[d];
    return sum;
}

/** The times at which the two disks a meet the two disks b shifted by `shift`; NaN if never. Disks
 * will meet if they approach (r.p < 0) and do not pass each other (s^2 p^2 - |r x p|^2 > 0). The
 * wait until |r + p t| = s, the distance at which they touch, is, with c = r^2 - s^2, c / (sqrt(s^2
 * p^2 - |r x p|^2) - r.p), which is no difference of large numbers. Disks that approach and overlap
 * within rounding meet at once. There are no branches: one that the processor predicts wrongly
 * costs more than a root and a quotient whose results are not used. */
static inline hd_pair hd_contact_times(const hd_two_disks *a, const hd_two_disks *b,
                                       const hd_pair shift[HD_DIM], hd_pair touching)
{
    const hd_pair t = hd_pair_where(a->t > b->t, a->t, b->t), wait_a = t - a->t, wait_b = t - b->t;
    hd_pair p[HD_DIM], r[HD_DIM];
    for (int d = 0; d < HD_DIM; d++) {
        p[d] = b->p[d] - a->p[d];
        r[d] = b->q[d] + b->p[d] * wait_b - (a->q[d] + a->p[d] * wait_a) + shift[d];
    }
    const hd_pair s2 = touching * touching, rp = hd_pair_dot(r, p);
    const hd_pair square = s2 * hd_pair_dot(p, p) - hd_pair_cross_square(r, p);
    const hd_pair c = hd_pair_dot(r, r) - s2;
    const hd_pair root = {sqrt(square[0]), sqrt(square[1])};
    const hd_pair wait = (hd_pair)((c > 0) & (hd_pair_mask)(c / (root - rp)));
    const hd_pair_mask ahead = (rp < 0) & (square > 0);
    return (hd_pair)((hd_pair_mask)(t + wait) | ~ahead);
}

#endif
