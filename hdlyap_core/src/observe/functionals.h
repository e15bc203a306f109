/** Sums over the particles of density, momentum and energy -> how they change with one particle
 * [T15], [T22]. */
#ifndef HD_FUNCTIONALS_H
#define HD_FUNCTIONALS_H

#include "hdlyap/wave.h"

/** The functionals of a modulation: density; momentum along k; momentum across k, in space one for
 * each of two directions; energy. */
#define HD_FUNCTIONALS_IN(dimension) ((dimension) + 2)
enum { HD_FUNCTIONALS_MAX = HD_FUNCTIONALS_IN(HD_DIMENSION_MAX) };

/** Coefficients of each functional: for the components of dq and then of dp of a particle. */
typedef double hd_functionals[HD_FUNCTIONALS_MAX][2 * HD_DIMENSION_MAX];

/** The coefficients of a particle at q with momentum p, for modulation `bits` of a wave. */
void hd_functionals_at(hd_functionals out, int dimension, const hd_wave *wave, unsigned bits,
                       const hd_boundary *boundary, const double *q, const double *p);
/** The same in space. */
void hd_functionals_in_space(hd_functionals out, const hd_wave *wave, unsigned bits,
                             const hd_boundary *boundary, const double *q, const double *p);

#endif
