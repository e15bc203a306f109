/** Start positions of dumbbells: rows of parallel dumbbells. */
#ifndef HD_DUMBBELL_START_H
#define HD_DUMBBELL_START_H

#include "hdlyap/scene.h"

/** The least gap in the best rows [sigma]; negative if no rows fit. Costs O(N). */
double hd_dumbbell_start_gap(const hd_scene_def *def);
/** The largest density at which rows fit. */
double hd_dumbbell_density_max(const hd_scene_def *def);
/** Fills q[3 N]: for each dumbbell its position, then its angle times sqrt(I). */
void hd_dumbbell_start(const hd_scene_def *def, double *q);

#endif
