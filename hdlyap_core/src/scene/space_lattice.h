/** Start positions in space: a regular lattice that uses the box as well as its kind can. */
#ifndef HD_SPACE_LATTICE_H
#define HD_SPACE_LATTICE_H

#include "hdlyap/scene.h"

/** Sites of a grid of `size` points: all of them, every other one (face-centred cubic if the
 * spacings are the same), or those with all numbers even or all odd (body-centred). */
enum { HD_LATTICE_SIMPLE, HD_LATTICE_FACES, HD_LATTICE_BODY };

typedef struct hd_space_lattice {
    int kind; /**< HD_LATTICE_SIMPLE .. */
    int size[3];
    double spacing[3]; /**< spacing of the grid's points [sigma] */
    double distance;   /**< smallest between two sites, images included */
} hd_space_lattice;

/** The lattice with at least N sites and the largest smallest distance, the best of some thousand
 * that are tried. Cost O(1). */
hd_space_lattice hd_space_lattice_best(int particles, const double *box,
                                       const hd_boundary *boundary);

/** Fills the positions q; spare sites are left empty evenly. */
void hd_space_lattice_fill(const hd_space_lattice *lattice, double *q, int particles,
                           const double *box, const hd_boundary *boundary);

#endif
