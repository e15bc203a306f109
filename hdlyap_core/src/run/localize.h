/** Widths of a run's vectors. */
#ifndef HD_LOCALIZE_H
#define HD_LOCALIZE_H

#include "run/run_state.h"

/** What that takes, where it is observed. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_run_localize_from(hd_run *run);

/** At a measured state, while somebody looks. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_run_localize(hd_run *run);

#endif
