/** What long boxes say of every other one: curvature of lambda(k), and how far steps stray [T12]. */
#ifndef HD_RELATION_H
#define HD_RELATION_H

#include "hdlyap/steps.h"

/** kind: HD_MODE_T or HD_MODE_LP. */
hd_relation hd_relation_of(const hd_scene_def *def, hd_mode_kind kind);

#endif
