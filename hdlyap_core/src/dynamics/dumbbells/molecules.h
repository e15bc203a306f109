/** The molecules: two disks of diameter 1 whose centres are a bond apart, rigid, of mass 1
 * together. Their centres are the disks of dynamics/hard, with its cells and its queue. */
#ifndef HD_MOLECULES_H
#define HD_MOLECULES_H

#include "dynamics/hard/contact.h"
#include "dynamics/hard/hard.h"

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

typedef struct hd_molecules {
    hard hard; /**< their centres; first, as what is the same of all hard bodies has only this */
    hd_shape shape;
    hd_spin *spin;   /**< [count] */
    int32_t *which;  /**< [count], HD_MEETS of the next contact, seen from the lower number */
    double rounding; /**< of a gap [sigma] */
} hd_molecules;

static inline void hd_molecule_move_to(hd_molecules *m, int32_t i, double t)
{
    hd_disk *disk = &m->hard.motion.disk[i];
    m->spin[i].q += m->spin[i].p * (t - disk->t);
    hd_disk_move_to(disk, t);
}

static inline double hd_one_turn(const hd_molecules *m, double q)
{
    return q - floor(q / m->shape.turn + 0.5) * m->shape.turn;
}

/** Back into the box, and into one turn; the cell that it is booked in stays. */
static inline void hd_molecule_fold(hd_molecules *m, int32_t i)
{
    hd_cells_fold(&m->hard.motion.cells, &m->hard.motion.disk[i]);
    m->spin[i].q = hd_one_turn(m, m->spin[i].q);
}

/** Unit vectors of two angles, (c, s). Within 2 eps, and the same bits everywhere: + - * / alone.
 */
static inline void hd_headings(hd_pair *c, hd_pair *s, hd_pair angle)
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

static inline void hd_heading(double e[2], double angle)
{
    hd_pair c, s;
    hd_headings(&c, &s, hd_pair_both(angle));
    e[0] = c[0];
    e[1] = s[0];
}

/** Of disk 0 or 1 of a molecule: -1 or 1 times the arm. */
static inline double hd_sign(int disk) { return disk ? 1.0 : -1.0; }

/** Where that disk of molecule i is, seen from its centre. */
static inline void hd_arm_at(double arm[2], const hd_molecules *m, int32_t i, int disk, double t)
{
    const double rate = m->spin[i].p / m->shape.root;
    hd_heading(arm, m->spin[i].q / m->shape.root + rate * (t - m->hard.motion.disk[i].t));
    for (int d = 0; d < 2; d++) arm[d] *= hd_sign(disk) * m->shape.arm;
}

#endif
