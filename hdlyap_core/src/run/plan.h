/** From one orthonormalisation to the next. */
#ifndef HD_PLAN_H
#define HD_PLAN_H

#include "run/run_state.h"

/** Where the next orthonormalisation falls, and whether the sample ends there. Between two samples
 * the norm of dq will do [T5]. */
void hd_run_plan(hd_run *run);

/** When the phases must be looked at before the interval ends, as they could not be told apart by
 * then; in equal shares. INFINITY: not at all, as they are known at its end or begin anew there. */
double hd_run_look_due(const hd_run *run);

#endif
