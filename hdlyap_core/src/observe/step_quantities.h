/** Quantities of steps, and of LP phases. */
#ifndef HD_STEP_QUANTITIES_H
#define HD_STEP_QUANTITIES_H

#include "observe/quantity.h"

extern const hd_quantities hd_step_quantities, hd_phase_quantities;

#endif
