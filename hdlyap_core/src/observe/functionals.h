/** Sums over the particles of density, momentum and energy -> how they change with one particle
 * [T15], [T22]. */
#ifndef HD_FUNCTIONALS_H
#define HD_FUNCTIONALS_H

#include "hdlyap/wave.h"

/** Density, momentum along k, across k (of spheres along each of two directions), energy. */
#define HD_FUNCTIONALS_IN(dimension) ((dimension) + 2)
enum { HD_FUNCTIONALS_MAX = HD_FUNCTIONALS_IN(HD_DIMENSION_MAX) };

/** Coefficients of each functional, for dq and then for dp of a particle. */
typedef double hd_functionals[HD_FUNCTIONALS_MAX][2 * HD_DIMENSION_MAX];

/** The coefficients of a particle at q with momentum p, for modulation `bits` of a wave. */
void hd_functionals_at(hd_functionals out, int dimension, const hd_wave *wave, unsigned bits,
                       const hd_boundary *boundary, const double *q, const double *p);
/** The coefficients of a sphere. */
void hd_functionals_in_space(hd_functionals out, const hd_wave *wave, unsigned bits,
                             const hd_boundary *boundary, const double *q, const double *p);

#endif
