/** Six steps in places that are known: the world in which sets and steps are found. */
#ifndef HD_PLACES_H
#define HD_PLACES_H

#include "synthetic.h"

enum { DISKS = 100, VECTORS = 60, PLACES = 6 };

/** Means over a handful of numbers of order 1. */
#define ROUNDING (100.0 * DBL_EPSILON)

/** T(1,0), LP(1,0), T(0,1), LP(0,1), T(1,1), LP(1,1) at the end of the frame, in this order from
 * its end. */
typedef struct place {
    hd_mode_kind kind;
    int nx, ny, col, count;
    double exponent;
} place;
extern const place places[PLACES];

/** Both directions periodic, the six subspaces of one node: 24 dimensions. */
hd_scene_def scene_of_places(double aspect);
int subspace_of(const world *w, int k);
const hd_step *step_of(const world *w, int k);
/** All steps in their places, with noise as world_span; exponents [VECTORS]. */
world steps_in_place(double *exponents, double noise);

void check_step(const hd_step *step, int col, int count, int members, double exponent);
void check_unresolved(const hd_step *step);

#endif
