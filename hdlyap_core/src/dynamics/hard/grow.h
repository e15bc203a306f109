/** Scene of two kinds -> positions at which its disks or spheres do not overlap, at any density of
 * a fluid. */
#ifndef HD_GROW_H
#define HD_GROW_H

#include "dynamics/hard/compiled.h"
#include "hdlyap/dynamics.h"

/** Packing fraction up to which a start is looked for. */
#define HD_GROW_PACKING (HD_DIM == 2 ? 0.8 : 0.6)

/** Fills q[particle][HD_DIM]. Fails with HD_NO_MEMORY, or with HD_REFUSED if none is found. */
HD_MUST_CHECK hd_status hd_hard_grow(const hd_scene_def *def, double *q);

/** Refuses a density at which there is no start, by HD_GROW_PACKING. Whether one is found for a few
 * particles, which may not fit into their box at lower ones, is tried. See hd_dynamics.check. */
HD_MUST_CHECK hd_status hd_hard_grow_check(const hd_scene_def *def, char *message, size_t size);

#endif
