/** An event of dumbbells, which is an entry of their record. */
#ifndef HD_BUMP_H
#define HD_BUMP_H

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

#endif
