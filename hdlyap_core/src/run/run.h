/** What the core asks of a run. */
#ifndef HD_RUN_H
#define HD_RUN_H

#include "hdlyap/run.h"
#include "tangent/frame.h"

/** HD_OK; or what the run has failed with, in hd_run_advance, hd_run_reset_average, or on the way
 * back that hd_run_save ends. */
hd_status hd_run_status(const hd_run *run);
/** What is carried; of all 4N exponents half of the vectors [T18]. NULL without exponents */
const hd_frame *hd_run_frame(const hd_run *run);
/** Averaged time from which standard errors are stated [T8]; 0 without exponents. */
double hd_run_errors_after(const hd_run *run);

#endif
