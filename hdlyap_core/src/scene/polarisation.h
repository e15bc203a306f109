/** Directions of the transverse fields of a wave [T22]. */
#ifndef HD_POLARISATION_H
#define HD_POLARISATION_H

#include "hdlyap/wave.h"

/** Of a wave in space; e: unit vectors across k that the walls allow, or zeros. */
void hd_polarisations(double e[2][3], const hd_wave *wave, const hd_scene_def *def);

#endif
