/** A part of a record of hard bodies as tangent maps, which blocks of columns are carried through.
 */
#ifndef HD_MAPS_H
#define HD_MAPS_H

#include "dynamics/hard/compiled.h"
#include "dynamics/dynamics.h"

/* Entries of the row: see hd_dynamics. */

HD_MUST_CHECK hd_status hd_maps_create(void **maps, int disks);
void hd_maps_free(void *maps);
/** All divisions done, with each disk's flight after its last one. */
HD_MUST_CHECK hd_status hd_maps_fill(void *maps, const hd_record *record, double t_begin,
                                     double t_end);
/** Cost about 40 width flops and 128 width bytes of cache traffic for a pair event of disks. */
void hd_maps_carry(const void *maps, double *block, int width);

#endif
