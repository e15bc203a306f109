/** Sums over the disks of density, momentum and energy -> what they change by with one disk [T15],
 * [T22]. */
#ifndef HD_FUNCTIONALS_H
#define HD_FUNCTIONALS_H

#include "hdlyap/wave.h"

/** Density, momentum along k, across k (of spheres along each of two directions), energy. */
#define HD_FUNCTIONALS_IN(dimension) ((dimension) + 2)
enum { HD_FUNCTIONALS_MAX = HD_FUNCTIONALS_IN(HD_DIMENSION_MAX) };

/** Coefficients of each on dq, then on dp of a disk. */
typedef double hd_functionals[HD_FUNCTIONALS_MAX][2 * HD_DIMENSION_MAX];

/** Of a disk at q with the momentum p, of modulation `bits` of the pairs of a wave. */
void hd_functionals_at(hd_functionals out, int dimension, const hd_wave *wave, unsigned bits,
                       const hd_boundary *boundary, const double *q, const double *p);
/** Those of a sphere. */
void hd_functionals_in_space(hd_functionals out, const hd_wave *wave, unsigned bits,
                             const hd_boundary *boundary, const double *q, const double *p);

#endif
