/** Start positions: rows of disks, staggered or not, that use the box as well as rows can. */
#ifndef HD_LATTICE_H
#define HD_LATTICE_H

#include "hdlyap/scene.h"

/** Rows along direction `along` (0 = x, 1 = y). */
typedef struct hd_lattice {
    int along;
    int rows, columns; /**< sites per row; odd rows have one less if odd_short */
    int staggered;     /**< odd rows shifted by half a column */
    int odd_short;
    double column, row; /**< spacings [sigma] */
    double distance;    /**< smallest between two sites, images included */
} hd_lattice;

/** The lattice with at least N sites and the largest smallest distance. Cost O(N). */
hd_lattice hd_lattice_best(int disks, const double box[HD_DIM], const hd_boundary boundary[HD_DIM]);

/** Fills q[2 disks]; spare sites are left empty evenly. */
void hd_lattice_fill(const hd_lattice *lattice, double *q, int disks, const double box[HD_DIM],
                     const hd_boundary boundary[HD_DIM]);

/** Largest density that hd_lattice_best can hold with these N, aspect ratio and boundaries. */
double hd_lattice_density_max(const hd_scene_def *def);

#endif
