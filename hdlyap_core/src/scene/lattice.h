/** Start positions: a regular lattice that uses the box as well as its kind can. */
#ifndef HD_LATTICE_H
#define HD_LATTICE_H

#include "hdlyap/scene.h"

#if HD_DIM == 2
/** Rows of disks, staggered or not, along direction `along` (0 = x, 1 = y). */
typedef struct hd_lattice {
    int along;
    int rows, columns; /**< sites per row; odd rows have one less if odd_short */
    int staggered;     /**< odd rows shifted by half a column */
    int odd_short;
    double column, row; /**< spacings [sigma] */
    double distance;    /**< smallest between two sites, images included */
} hd_lattice;
#else
/** Sites of a grid of `size` points: all of them, every other one (face-centred cubic if the
 * spacings are the same), or those with all numbers even or all odd (body-centred). */
enum { HD_LATTICE_SIMPLE, HD_LATTICE_FACES, HD_LATTICE_BODY };

typedef struct hd_lattice {
    int kind; /**< HD_LATTICE_SIMPLE .. */
    int size[HD_DIM];
    double spacing[HD_DIM]; /**< of the points [sigma] */
    double distance;        /**< smallest between two sites, images included */
} hd_lattice;
#endif

/** The lattice with at least N sites and the largest smallest distance, of spheres the best of some
 * thousand that are tried. Cost O(N), of spheres O(1). */
hd_lattice hd_lattice_best(int disks, const double box[HD_DIM], const hd_boundary boundary[HD_DIM]);

/** Fills q[HD_DIM disks]; spare sites are left empty evenly. */
void hd_lattice_fill(const hd_lattice *lattice, double *q, int disks, const double box[HD_DIM],
                     const hd_boundary boundary[HD_DIM]);

#endif
