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

/** Wait until |r + p t| = 1, or INFINITY. With x = r x p and c = r^2 - 1 it is
 *  c / (sqrt(p^2 - x^2) - r.p): no difference of large numbers; two disks that touch within rounding
 *  while approaching meet at once. Free of branches, so that loops over it become vector code. */
static inline double hd_contact_wait(double rx, double ry, double px, double py)
{
    const double approach = rx * px + ry * py;
    const double x = rx * py - ry * px;
    const double below = px * px + py * py - x * x;
    const double c = rx * rx + ry * ry - 1.0;
    const double wait = (c > 0 ? c : 0.0) / (sqrt(below > 0 ? below : 0.0) - approach);
    return approach < 0 && below > 0 ? wait : INFINITY;
}

#endif
