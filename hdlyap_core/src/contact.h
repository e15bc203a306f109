/** When two disks meet: a pure function of their two states and the image, the same bits whoever
 *  asks, in whatever order, and whenever. */
#ifndef HD_CONTACT_H
#define HD_CONTACT_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "disk.h"

/** Two components side by side: half the instructions, the same bits (no contraction, no reordering). */
typedef double hd_pair __attribute__((vector_size(16)));

static inline hd_pair hd_pair_load(const double *x)
{
    hd_pair pair;
    memcpy(&pair, x, sizeof pair);
    return pair;
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

/* ---- several contacts side by side ------------------------------------------------------------ */

/** One AVX register, or two of SSE2. They are handed over by address: how they would be handed over by
 *  value depends on the processor. */
enum { HD_LANES = 4 };
typedef double hd_lanes __attribute__((vector_size(8 * HD_LANES)));
typedef int64_t hd_lanes_mask __attribute__((vector_size(8 * HD_LANES)));
typedef int32_t hd_lanes_int __attribute__((vector_size(4 * HD_LANES)));

#define HD_LANES_ALL(x) ((hd_lanes){(x), (x), (x), (x)})

/** Lane by lane: mask ? yes : no. */
#define HD_LANES_WHERE(mask, yes, no)                                                              \
    ((hd_lanes)(((mask) & (hd_lanes_mask)(yes)) | (~(mask) & (hd_lanes_mask)(no))))

/** When disks that are r = (x, y) apart at time t, with the relative momentum p, meet; NaN if never.
 *  Contact is ahead if they approach (r.p < 0) and do not pass each other (p^2 - z^2 > 0 with
 *  z = r x p). The wait until |r + p t| = 1 is, with c = r^2 - 1, c / (sqrt(p^2 - z^2) - r.p): no
 *  difference of large numbers; two disks that touch within rounding while approaching meet at once. */
static inline void hd_contact_times(hd_lanes *contact, const hd_lanes *x, const hd_lanes *y,
                                    const hd_lanes *px, const hd_lanes *py, const hd_lanes *t)
{
    const hd_lanes z = *x * *py - *y * *px, rp = *x * *px + *y * *py;
    const hd_lanes square = *px * *px + *py * *py - z * z, c = *x * *x + *y * *y - 1.0;
    hd_lanes root;
    for (int k = 0; k < HD_LANES; k++) root[k] = sqrt(square[k]);
    const hd_lanes wait = (hd_lanes)((c > 0) & (hd_lanes_mask)(c / (root - rp)));
    const hd_lanes_mask ahead = (rp < 0) & (square > 0);
    *contact = (hd_lanes)((hd_lanes_mask)(*t + wait) | ~ahead);
}

#endif
