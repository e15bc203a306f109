/** An event of dumbbells: an entry of their record. */
#ifndef HD_BUMP_H
#define HD_BUMP_H

/** The gap of what meets has the gradient (-n, -across_i, n, across_j) in the coordinates of i and
 * j, of a wall (n, across_i) in those of i [T23]. All are doubles: i and j are whole numbers. */
typedef struct hd_bump {
    double t;                   /**< since the start of the record [time units] */
    double i, j;                /**< molecules, i < j; j = -1 for a wall */
    double n[2];                /**< from the disk of i to that of j; of a wall inwards */
    double across[2], along[2]; /**< arms of the disks of i, of j, turned by +90 degrees, and as
                                   they are: along n, over the root of the inertia */
    double per_root;            /**< 1 over the root of the inertia */
    double p[2];                /**< p_j - p_i before; of a wall p_i */
    double spin[2];             /**< third momenta of i, of j, before */
} hd_bump;

#endif
