/** From one orthonormalisation to the next. */
#ifndef HD_PLAN_H
#define HD_PLAN_H

#include "run/run_state.h"

/** Where the next orthonormalisation falls, and whether the sample ends there. Between two samples
 * the norm of dq will do [T5]. */
void hd_run_plan(hd_run *run);

#endif
