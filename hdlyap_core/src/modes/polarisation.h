/** Directions of the transverse fields of a wave [T22]. */
#ifndef HD_POLARISATION_H
#define HD_POLARISATION_H

#include "hdlyap/wave.h"

/** e[2]: unit vectors across k that walls allow (bit d: walls across direction d), or zeros. */
void hd_polarisations(double e[2][HD_DIM], const hd_wave *wave, unsigned walls);

#endif
