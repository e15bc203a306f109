/** When two disks meet: a pure function of their two states and the image, the same bits whoever
 *  asks, in whatever order, and whenever. */
#ifndef HD_CONTACT_H
#define HD_CONTACT_H

#include <math.h>

#include "disk.h"

/** Where a line of motion begins: one component of a disk's state. */
static inline double hd_contact_position(double q, double p, double since)
{
    return q + p * since;
}

/** From disk a to the image of disk b that is `shift` away, both moved to time t. */
static inline void hd_contact_separation(double r[2], const hd_disk *a, const hd_disk *b,
                                         const double shift[2], double t)
{
    for (int d = 0; d < 2; d++)
        r[d] = hd_contact_position(b->q[d], b->p[d], t - b->t) -
               hd_contact_position(a->q[d], a->p[d], t - a->t) + shift[d];
}

/** True if two disks that are r apart, with the relative momentum p, approach and will touch. */
static inline int hd_contact_ahead(double rx, double ry, double px, double py)
{
    const double x = rx * py - ry * px;
    return (rx * px + ry * py < 0) & (px * px + py * py - x * x > 0);
}

/** Wait until |r + p t| = 1 of disks with a contact ahead. With x = r x p and c = r^2 - 1 it is
 *  c / (sqrt(p^2 - x^2) - r.p): no difference of large numbers; two disks that touch within rounding
 *  while approaching meet at once. */
static inline double hd_contact_wait(double rx, double ry, double px, double py)
{
    const double x = rx * py - ry * px;
    const double c = rx * rx + ry * ry - 1.0;
    const double below = px * px + py * py - x * x;
    return c > 0 ? c / (sqrt(below) - (rx * px + ry * py)) : 0.0;
}

#endif
