/** Whether the particles are where their motion allows: what rounding cannot explain is a fault. */
#ifndef HDLYAP_EXAMINATION_H
#define HDLYAP_EXAMINATION_H

#include "hdlyap/run.h"

/** Errors of the particles' state, and the largest that rounding explains. Zero: not examined yet.
 */
typedef struct examination {
    bool made;
    double overlap, overlap_max; /**< deepest overlap of two particles [sigma], and its limit */
    double energy_error, energy_error_max; /**< relative error of the energy, and its limit */
} examination;

/** Examines the particles of a run; all zero if that is not possible. */
examination examination_of(const hd_run *run);

#endif
