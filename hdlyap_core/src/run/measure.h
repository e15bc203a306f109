/** What is observed of a measured state. */
#ifndef HD_MEASURE_H
#define HD_MEASURE_H

#include "run/run_state.h"

/** The modes of an orthonormal frame. Fails as hd_modes_measure. */
HD_MUST_CHECK hd_status hd_run_measure(hd_run *run);

/** The same, and steps and phases; what is asked for is enough for each. Averages take them up. */
HD_MUST_CHECK hd_status hd_run_measure_and_add(hd_run *run);

/** The phases of vectors that are known now. */
void hd_run_follow_phases(hd_run *run);

#endif
