/** What a scene says of its dumbbells, and what is to be expected of them. */
#ifndef HD_SHAPE_H
#define HD_SHAPE_H

#include "hdlyap/parameters.h"
#include "scene/fluid.h"

/** Parameters of dumbbells alone. */
enum { HD_DUMBBELL_OWN = 2 };
extern const hd_parameter hd_dumbbell_own[HD_DUMBBELL_OWN];

extern const hd_fluid hd_fluid_dumbbells;

double hd_dumbbell_bond(const hd_scene_def *scene);    /**< distance of the two centres [sigma] */
double hd_dumbbell_inertia(const hd_scene_def *scene); /**< [sigma^2], of mass 1 */
double hd_dumbbell_size(const hd_scene_def *scene);    /**< area of both disks together */

#endif
