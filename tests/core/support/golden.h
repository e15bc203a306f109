/** The event log of fixed scenes and seeds as one number each: the same on every machine, at every
 * level of optimisation. A changed number means changed dynamics. */
#ifndef HD_GOLDEN_H
#define HD_GOLDEN_H

#include <stdint.h>

#include "hdlyap/scene.h"

enum { GOLDEN_SCENES = HD_DIM == 2 ? 15 : 9 };

/** FNV-1a over i, j and the bits of n and p, of dumbbells and soft particles of all but the time,
 * of the scene's first events; 0 if it could not run. */
uint64_t golden_hash(int scene);

/** What it must be. */
uint64_t golden_stored(int scene);

#endif
