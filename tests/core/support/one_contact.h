/** The formula for a contact, written for one pair at a time: what the core computes for several
 * side by side must be the same bits. */
#ifndef HD_ONE_CONTACT_H
#define HD_ONE_CONTACT_H

#include <math.h>

#include "events/contact.h"

/** True if two disks that are r apart, with the relative momentum p, approach and will touch. */
static inline int one_contact_ahead(const double r[2], const double p[2])
{
    const double x = r[0] * p[1] - r[1] * p[0];
    return hd_contact_dot(r, p) < 0 && hd_contact_dot(p, p) - x * x > 0;
}

/** Wait until |r + p t| = 1 of disks with a contact ahead. */
static inline double one_contact_wait(const double r[2], const double p[2])
{
    const double x = r[0] * p[1] - r[1] * p[0], c = hd_contact_dot(r, r) - 1.0;
    return c > 0 ? c / (sqrt(hd_contact_dot(p, p) - x * x) - hd_contact_dot(r, p)) : 0.0;
}

/** When disk a meets the image of disk b that is `shift` away, or INFINITY. */
static inline double one_contact(const hd_disk *a, const hd_disk *b, const double shift[2])
{
    const double now = fmax(a->t, b->t);
    const double p[2] = {b->p[0] - a->p[0], b->p[1] - a->p[1]};
    double r[2];
    hd_contact_separation(r, a, b, shift, now);
    return one_contact_ahead(r, p) ? now + one_contact_wait(r, p) : INFINITY;
}

#endif
