/** The molecules: two disks of diameter 1 whose centres are a bond apart, rigid, of mass 1
 * together. Their centres are the disks of dynamics/hard, with its cells and its queue. */
#ifndef HD_MOLECULES_H
#define HD_MOLECULES_H

#include "dynamics/hard/cells.h"
#include "dynamics/hard/contact.h"
#include "dynamics/hard/queue.h"

/** Third coordinate of a molecule, its angle times the root of the inertia, and the momentum of it;
 * of the time of its centre. */
typedef struct hd_spin {
    double q, p;
} hd_spin;

typedef struct hd_shape {
    double arm;  /**< half of the bond */
    double root; /**< of the moment of inertia */
    double turn; /**< q of a whole turn */
} hd_shape;

enum { HD_MEETS = 4 }; /* two disks with two disks, or with two walls */

/** The earliest event of a molecule. */
typedef struct hd_next {
    double contact;              /**< time of its earliest known contact, or INFINITY */
    int32_t partner;             /**< a molecule, or -1 - direction of a wall */
    int32_t which;               /**< of HD_MEETS, seen from the lower number */
    uint32_t partner_collisions; /**< when it was predicted */
    int32_t image[HD_DIM];       /**< box edges to add to the partner's position */
    int32_t direction, side;     /**< of the next cell edge */
} hd_next;

typedef struct hd_molecules {
    int32_t count;
    hd_shape shape;
    hd_disk *disk; /**< [count], the centres */
    hd_spin *spin; /**< [count] */
    hd_next *next; /**< [count] */
    hd_cells cells;
    hd_queue queue;
    double epoch_length;
    double rounding; /**< of a gap [sigma] */
} hd_molecules;

/** Unit vectors of two angles, (c, s). Within 2 eps, and the same bits everywhere: + - * / alone.
 */
static inline void hd_directions(hd_pair *c, hd_pair *s, hd_pair angle)
{
    static const double quarter[3] = {1.57079632673412561417e+00, 6.07710050630396597660e-11,
                                      2.02226624879595063154e-21}; /* of a turn, in parts */
    const double whole = 6755399441055744.0; /* 1.5 2^52: beside it fractions are rounded away */
    const hd_pair turned = angle * 0.63661977236758134308 + whole, k = turned - whole;
    const hd_pair x = ((angle - k * quarter[0]) - k * quarter[1]) - k * quarter[2], z = x * x;
    const hd_pair odd = x + x * z *
                                (-1.66666666666666324348e-01 +
                                 z * (8.33333333332248946124e-03 +
                                      z * (-1.98412698298579493134e-04 +
                                           z * (2.75573137070700676789e-06 +
                                                z * (-2.50507602534068634195e-08 +
                                                     z * 1.58969099521155010221e-10)))));
    const hd_pair even = 1.0 -
                         (0.5 * z - z * z *
                                        (4.16666666666666019037e-02 +
                                         z * (-1.38888888888741095749e-03 +
                                              z * (2.48015872894767294178e-05 +
                                                   z * (-2.75573143513906633035e-07 +
                                                        z * (2.08757232129817482790e-09 +
                                                             z * -1.13596475577881948265e-11))))));
    const hd_pair_mask quadrant = (hd_pair_mask)turned, swap = (quadrant & 1) != 0,
                       sign = {INT64_MIN, INT64_MIN};
    *c = (hd_pair)((hd_pair_mask)hd_pair_where(swap, odd, even) ^
                   ((((quadrant + 1) & 2) != 0) & sign));
    *s = (hd_pair)((hd_pair_mask)hd_pair_where(swap, even, odd) ^ (((quadrant & 2) != 0) & sign));
}

static inline void hd_direction(double e[2], double angle)
{
    hd_pair c, s;
    hd_directions(&c, &s, hd_pair_both(angle));
    e[0] = c[0];
    e[1] = s[0];
}

/** Of disk 0 or 1 of a molecule: -1 or 1 times the arm. */
static inline double hd_sign(int disk) { return disk ? 1.0 : -1.0; }

/** Where that disk of molecule i is, seen from its centre. */
static inline void hd_arm_at(double arm[2], const hd_molecules *m, int32_t i, int disk, double t)
{
    const double rate = m->spin[i].p / m->shape.root;
    hd_direction(arm, m->spin[i].q / m->shape.root + rate * (t - m->disk[i].t));
    for (int d = 0; d < 2; d++) arm[d] *= hd_sign(disk) * m->shape.arm;
}

#endif
