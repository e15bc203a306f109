/** Directions of the transverse fields of a wave [T22]. */
#ifndef HD_POLARISATION_H
#define HD_POLARISATION_H

#include "hdlyap/wave.h"

/** e: the unit vectors across k, for a wave in space, that walls allow; a missing one is zero. */
void hd_polarisations(double e[2][3], const hd_wave *wave, const hd_scene_def *def);

#endif
