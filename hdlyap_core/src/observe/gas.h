/** How means of the gas are taken. */
#ifndef HD_GAS_H
#define HD_GAS_H

#include "hdlyap/gas.h"

/** block: standard errors come from blocks of the averaged time that are at least so long [time
 * units]. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_gas_create(hd_gas **out, const hd_scene_def *def, double block);
void hd_gas_free(hd_gas *gas);

/** Begins anew where the disks are now. */
void hd_gas_begin(hd_gas *gas, const hd_trajectory *trajectory);
/** Ends a sample there: all that happened since the last call of one of the two. Samples may be of
 * any length; one without time is none. O(1). */
void hd_gas_add(hd_gas *gas, const hd_trajectory *trajectory);

/** Area, of spheres volume, in which centres move: between walls L - 1 instead of L
 * [sigma^d]. */
double hd_gas_area(const hd_scene_def *def);

#endif
