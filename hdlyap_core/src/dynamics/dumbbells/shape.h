/** The shape of a scene's dumbbells, and what kinetic theory predicts for them. */
#ifndef HD_SHAPE_H
#define HD_SHAPE_H

#include "hdlyap/parameters.h"
#include "scene/fluid.h"

/** Parameters that only dumbbells have. */
enum { HD_DUMBBELL_OWN = 2 };
extern const hd_parameter hd_dumbbell_own[HD_DUMBBELL_OWN];

extern const hd_fluid hd_fluid_dumbbells;

double hd_dumbbell_bond(const hd_scene_def *scene);    /**< distance of the two centres [sigma] */
double hd_dumbbell_inertia(const hd_scene_def *scene); /**< moment of inertia at mass 1 [sigma^2] */
double hd_dumbbell_size(const hd_scene_def *scene);    /**< area that both disks cover */

#endif
