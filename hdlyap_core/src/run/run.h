/** Functions on a run that only the core calls. */
#ifndef HD_RUN_H
#define HD_RUN_H

#include "hdlyap/run.h"
#include "tangent/frame.h"

/** The frame that is carried: half of the vectors if all exponents follow from half of them [T18].
 * NULL without exponents. */
const hd_frame *hd_run_frame(const hd_run *run);
/** The scene of the trial of hd_estimate_run: shorter, and with fewer particles in a box of the
 * same shape and with the same waves if its own would take too long. */
hd_scene_def hd_estimate_trial(const hd_scene_def *def);

/** Ends the stages before the averaging, if they go on, and begins the averaging now. For a single
 * rank. Fails as hd_run_advance. */
HD_MUST_CHECK hd_status hd_run_average_now(hd_run *run);

#endif
