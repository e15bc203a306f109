/** How phases are followed. */
#ifndef HD_PHASES_H
#define HD_PHASES_H

#include "base/archive.h"
#include "hdlyap/phases.h"

/** Follows the steps of a kind, HD_MODE_LP or HD_MODE_T. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_phases_create(hd_phases **out, const hd_steps *steps, hd_mode_kind kind);
void hd_phases_free(hd_phases *phases);
void hd_phases_clear(hd_phases *phases);

/** Adds the present snapshot of the steps' modes, taken at simulated time `time`. */
void hd_phases_add(hd_phases *phases, const hd_steps *steps, double time);

/** Longest time from the last sample to the next that unwraps every resolved step safely; INFINITY
 * if there is no resolved step. Grows as the rates become known, by at most a factor of 2 from one
 * sample to the next, and falls when phases scatter more. */
double hd_phases_sampling(const hd_phases *phases, const hd_steps *steps);

double hd_phases_bytes(double phases);
/** `now`: simulated time of the run. */
void hd_phases_archive(hd_phases *phases, hd_archive *archive, double now);

#endif
