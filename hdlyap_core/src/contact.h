/** When two disks meet: a pure function of their two states and the image, the same bits whoever
 *  asks, in whatever order, and whenever. */
#ifndef HD_CONTACT_H
#define HD_CONTACT_H

#include <math.h>
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

/** r x p */
static inline double hd_contact_cross(hd_pair r, hd_pair p)
{
    const hd_pair x = r * (hd_pair){p[1], p[0]};
    return x[0] - x[1];
}

static inline double hd_contact_dot(hd_pair r, hd_pair p)
{
    const hd_pair x = r * p;
    return x[0] + x[1];
}

/** True if two disks that are r apart, with the relative momentum p, approach and will touch. */
static inline int hd_contact_ahead(hd_pair r, hd_pair p)
{
    const double x = hd_contact_cross(r, p);
    return (hd_contact_dot(r, p) < 0) & (hd_contact_dot(p, p) - x * x > 0);
}

/** Wait until |r + p t| = 1 of disks with a contact ahead. With x = r x p and c = r^2 - 1 it is
 *  c / (sqrt(p^2 - x^2) - r.p): no difference of large numbers; two disks that touch within rounding
 *  while approaching meet at once. */
static inline double hd_contact_wait(hd_pair r, hd_pair p)
{
    const double x = hd_contact_cross(r, p);
    const double c = hd_contact_dot(r, r) - 1.0;
    return c > 0 ? c / (sqrt(hd_contact_dot(p, p) - x * x) - hd_contact_dot(r, p)) : 0.0;
}

#endif
