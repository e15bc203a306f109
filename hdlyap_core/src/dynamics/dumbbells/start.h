/** Start positions of dumbbells: rows of molecules that lie side by side, all the same way. */
#ifndef HD_DUMBBELL_START_H
#define HD_DUMBBELL_START_H

#include "hdlyap/scene.h"

/** Least gap of the best rows [sigma]; negative if they do not fit. Cost O(N). */
double hd_dumbbell_start_gap(const hd_scene_def *def);
/** The largest density that such rows can hold. */
double hd_dumbbell_density_max(const hd_scene_def *def);
/** q[3 N]: places, and angles times the root of the inertia. */
void hd_dumbbell_start(const hd_scene_def *def, double *q);

#endif
