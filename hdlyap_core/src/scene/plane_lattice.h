/** Start positions in the plane: a regular lattice that uses the box as well as its kind can. */
#ifndef HD_PLANE_LATTICE_H
#define HD_PLANE_LATTICE_H

#include "hdlyap/scene.h"

/** Rows of particles, staggered or not, along direction `along` (0 = x, 1 = y). */
typedef struct hd_plane_lattice {
    int along;
    int rows, columns; /**< sites per row; odd rows have one less if odd_short */
    int staggered;     /**< odd rows shifted by half a column */
    int odd_short;
    double column, row; /**< spacings [sigma] */
    double distance;    /**< smallest between two sites, images included */
} hd_plane_lattice;

/** The lattice with at least N sites and the largest smallest distance. Cost O(N). */
hd_plane_lattice hd_plane_lattice_best(int particles, const double *box,
                                       const hd_boundary *boundary);

/** Fills the positions q; spare sites are left empty evenly. */
void hd_plane_lattice_fill(const hd_plane_lattice *lattice, double *q, int particles,
                           const double *box, const hd_boundary *boundary);

#endif
