/** Dumbbells, called molecules in the code: two disks of diameter 1 whose centres are a rigid bond
 * apart, of mass 1 together. The centre of a dumbbell is a disk of dynamics/hard, in the cells and
 * in the queue of that folder. */
#ifndef HD_DUMBBELLS_H
#define HD_DUMBBELLS_H

#include <float.h>

#include "dynamics/hard/contact.h"
#include "dynamics/hard/hard.h"
#include "hdlyap/parameters.h"
#include "scene/fluid.h"

/* ---- the scene: its shape, and what kinetic theory predicts (shape.c) ----------------------- */

/** Parameters that only dumbbells have. */
enum { HD_DUMBBELL_OWN = 2 };
extern const hd_parameter hd_dumbbell_own[HD_DUMBBELL_OWN];

extern const hd_fluid hd_fluid_dumbbells;

double hd_dumbbell_bond(const hd_scene_def *scene); /**< distance of the two centres [sigma] */
int hd_dumbbell_sites(const hd_scene_def *scene, double *site); /**< places of its disks [sigma] */
double hd_dumbbell_inertia(const hd_scene_def *scene); /**< moment of inertia at mass 1 [sigma^2] */
double hd_dumbbell_size(const hd_scene_def *scene);    /**< area that both disks cover */

/* ---- start positions, rows of parallel dumbbells (start.c) ---------------------------------- */

/** The least gap in the best rows [sigma]; negative if no rows fit. Costs O(N). */
double hd_dumbbell_start_gap(const hd_scene_def *def);
/** The largest density at which rows fit. */
double hd_dumbbell_density_max(const hd_scene_def *def);
/** Fills q[3 N]: for each dumbbell its position, then its angle times sqrt(I). */
void hd_dumbbell_start(const hd_scene_def *def, double *q);

/* ---- the state ------------------------------------------------------------------------------ */

/** Third coordinate of a dumbbell, which is its angle times sqrt(I), I: moment of inertia, and the
 * momentum of this coordinate. Both belong to the time hd_disk.t of the centre. */
typedef struct hd_spin {
    double q, p;
} hd_spin;

typedef struct hd_shape {
    double arm;  /**< half of the bond */
    double root; /**< sqrt(I) */
    double turn; /**< the third coordinate after a whole turn */
} hd_shape;

enum { HD_MEETS = 4 }; /* contacts of two disks with two disks, or with two walls */

typedef struct hd_molecules {
    hard hard; /**< the centres; first, because the code for all hard particles gets only this */
    hd_shape shape;
    hd_spin *spin;   /**< [count] */
    int32_t *which;  /**< [count]: which disks meet next, see hd_meeting_of_pair */
    double rounding; /**< how much a gap rounds [sigma], without rotation */
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

/** Folds the centre into the box and the angle into one turn. The dumbbell stays in its cell. */
static inline void hd_molecule_fold(hd_molecules *m, int32_t i)
{
    hd_cells_fold(&m->hard.motion.cells, &m->hard.motion.disk[i]);
    m->spin[i].q = hd_one_turn(m, m->spin[i].q);
}

/** c, s: cosines and sines of two angles, exact to 2 eps. They are computed with + - * only, so
 * that all machines give the same bits. */
static inline void hd_headings(hd_pair *c, hd_pair *s, hd_pair angle)
{
    static const double quarter[3] = {1.57079632673412561417e+00, 6.07710050630396597660e-11,
                                      2.02226624879595063154e-21}; /* they add up to pi / 2 */
    const double whole = 6755399441055744.0; /* 1.5 2^52: adding it rounds to a whole number */
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

/** Sign of the arm of disk 0 or 1 of a dumbbell. */
static inline double hd_sign(int disk) { return disk ? 1.0 : -1.0; }

/** arm: the vector from the centre of dumbbell i to its disk 0 or 1, at time t. */
static inline void hd_arm_at(double arm[2], const hd_molecules *m, int32_t i, int disk, double t)
{
    const double rate = m->spin[i].p / m->shape.root;
    hd_heading(arm, m->spin[i].q / m->shape.root + rate * (t - m->hard.motion.disk[i].t));
    for (int d = 0; d < 2; d++) arm[d] *= hd_sign(disk) * m->shape.arm;
}

/* ---- when two dumbbells meet, or one meets a wall (meeting.c) ------------------------------- */
/* These are pure functions of the states and the image: their bits do not depend on when and in
 * which order contacts are computed. */

/** The time at which dumbbell a meets this image of dumbbell b, a < b; INFINITY if they never meet,
 * or later than `until`. which: the disk of a plus twice the disk of b. */
double hd_meeting_of_pair(const hd_molecules *m, int32_t a, int32_t b, const int32_t image[2],
                          double until, int32_t *which);

/** The time at which dumbbell i meets a wall in direction d, likewise. which: the disk, plus 2 if
 * it meets the far wall. */
double hd_meeting_of_wall(const hd_molecules *m, int32_t i, int d, double until, int32_t *which);

/** The deepest overlap [sigma] that rounding can cause when two dumbbells, or one and a wall, meet.
 * turning: sum of the absolute angular velocities. */
static inline double hd_meeting_depth(const hd_molecules *m, double turning)
{
    return m->rounding + 4.0 * DBL_EPSILON * m->shape.arm * turning * m->hard.epoch_length;
}

/* ---- the earliest event of each dumbbell, from the states of its neighbours (next.c) -------- */

/** Predicts all events of dumbbell i from its present state, and puts the earliest into the queue.
 * A contact later than the one that the partner has predicted is left out, because the partner will
 * predict anew then. */
void hd_next_renew(hd_molecules *m, int32_t i);

/** Does what hd_prediction_extend does, for a dumbbell. */
void hd_next_extend(hd_molecules *m, int32_t i, int d, int side);

/** Predicts the events of all dumbbells, and forgets all earlier predictions. */
void hd_next_restart(hd_molecules *m);

/* ---- an event, which is an entry of the record; tangent maps (bump_maps.c): see hd_dynamics -- */

/** The gap between the two disks that meet has the gradient (-n, -across_i, n, across_j) in the
 * coordinates of i and j; the gap at a wall has (n, across_i) in those of i [T23]. i and j are
 * whole numbers, kept as doubles as all else is. */
typedef struct hd_bump {
    double t;    /**< since the start of the record [time units] */
    double i, j; /**< dumbbells, i < j; j = -1 for a wall */
    double n[2]; /**< unit vector from the disk of i to that of j; inwards at a wall */
    double across[2], along[2]; /**< c and k of i, of j in [T23]: components along n of the disk's
                                   arm turned by +90 degrees, and of the arm, over sqrt(I) */
    double per_root;            /**< 1 / sqrt(I), I: moment of inertia */
    double p[2];                /**< p_j - p_i before the event; at a wall p_i */
    double spin[2];             /**< third momenta of i, of j, before the event */
} hd_bump;

HD_MUST_CHECK hd_status hd_bump_maps_create(void **out, const hd_scene_def *scene);
void hd_bump_maps_free(void *maps);
HD_MUST_CHECK hd_status hd_bump_maps_fill(void *maps, const hd_record *record, double t_begin,
                                          double t_end);
void hd_bump_maps_carry(const void *maps, double *block, int width);

#endif
