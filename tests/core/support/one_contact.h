/** The formula for a contact, written for one pair at a time: what the core computes for several
 * side by side must be the same bits. */
#ifndef HD_ONE_CONTACT_H
#define HD_ONE_CONTACT_H

#include <math.h>

#include "dynamics/hard/contact.h"

/** s^2 p^2 - |r x p|^2; s: the distance at which the two touch. */
static inline double one_contact_square(const double r[HD_DIM], const double p[HD_DIM], double s)
{
    double cross = pow(r[0] * p[1] - r[1] * p[0], 2.0);
#if HD_DIM == 3
    const double x = r[1] * p[2] - r[2] * p[1], y = r[2] * p[0] - r[0] * p[2];
    cross = x * x + y * y + cross;
#endif
    return s * s * hd_contact_dot(p, p) - cross;
}

/** True if two disks that are r apart, with the relative momentum p, approach and will touch. */
static inline int one_contact_ahead(const double r[HD_DIM], const double p[HD_DIM], double s)
{
    return hd_contact_dot(r, p) < 0 && one_contact_square(r, p, s) > 0;
}

/** Wait until |r + p t| = s of disks with a contact ahead. */
static inline double one_contact_wait(const double r[HD_DIM], const double p[HD_DIM], double s)
{
    const double c = hd_contact_dot(r, r) - s * s;
    return c > 0 ? c / (sqrt(one_contact_square(r, p, s)) - hd_contact_dot(r, p)) : 0.0;
}

/** When disk a meets the image of disk b that is `shift` away, at the distance s; or INFINITY. */
static inline double one_contact(const hd_disk *a, const hd_disk *b, const double shift[HD_DIM],
                                 double s)
{
    const double now = fmax(a->t, b->t);
    double p[HD_DIM], r[HD_DIM];
    for (int d = 0; d < HD_DIM; d++) p[d] = b->p[d] - a->p[d];
    hd_contact_separation(r, a, b, shift, now);
    return one_contact_ahead(r, p, s) ? now + one_contact_wait(r, p, s) : INFINITY;
}

#endif
