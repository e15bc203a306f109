/** A circular container of radius R: its centre is (R, R), centres of disks reach R - 1/2 [T21]. */
#ifndef HD_CIRCLE_H
#define HD_CIRCLE_H

#include "hdlyap/scene.h"

/** R = sqrt(N / (pi rho)) [sigma]. */
double hd_circle_radius(const hd_scene_def *def);

#endif
