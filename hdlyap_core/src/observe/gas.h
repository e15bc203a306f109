/** How the gas of a run is measured, sample by sample. */
#ifndef HD_GAS_H
#define HD_GAS_H

#include "hdlyap/gas.h"

/** Makes a gas that has averaged nothing. block: standard errors come from blocks of averaged time
 * that are at least this long [time units]. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_gas_create(hd_gas **out, const hd_scene_def *def, double block);
void hd_gas_free(hd_gas *gas);

/** Begins the averages anew at the present state of the trajectory. */
void hd_gas_begin(hd_gas *gas, const hd_trajectory *trajectory);
/** Adds a sample: what happened since the last call of hd_gas_begin or hd_gas_add. Samples may have
 * any length; nothing is added if no time has passed. O(1). */
void hd_gas_add(hd_gas *gas, const hd_trajectory *trajectory);

/** Area, in space volume, that centres of particles can reach [sigma^d]: between walls L - 1
 * instead of L. */
double hd_gas_area(const hd_scene_def *def);

#endif
