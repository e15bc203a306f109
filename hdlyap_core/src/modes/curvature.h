/** How lambda(k) of long waves bends, in long boxes [T12]. */
#ifndef HD_CURVATURE_H
#define HD_CURVATURE_H

#include "hdlyap/steps.h"

/** c2, c3 and the scatter of a step, with their errors, of a gas with this mean free path. */
hd_relation hd_curvature_of(hd_mode_kind kind, double free_path);

#endif
