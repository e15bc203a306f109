/** Sums over the disks of density, momentum and energy -> what they change by with one disk [T15],
 * [T22]. */
#ifndef HD_FUNCTIONALS_H
#define HD_FUNCTIONALS_H

#include "hdlyap/wave.h"

/** Density, momentum along k, across k (of spheres along each of two directions), energy. */
enum { HD_FUNCTIONALS = HD_DIM + 2 };

/** Coefficients of each on dq and dp of a disk at q with the momentum p, of modulation `bits` of
 * the pairs of a wave. */
void hd_functionals_at(double out[HD_FUNCTIONALS][HD_ROWS], const hd_wave *wave, unsigned bits,
                       const hd_boundary boundary[HD_DIM], const double *q, const double *p);

#endif
