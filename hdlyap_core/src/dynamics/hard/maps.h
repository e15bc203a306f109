/** A part of a record of disks or spheres as tangent maps, which carry blocks of columns. */
#ifndef HD_MAPS_H
#define HD_MAPS_H

#include "dynamics/hard/compiled.h"
#include "dynamics/dynamics.h"

/* Entries of the row: see hd_dynamics. */

HD_MUST_CHECK hd_status hd_maps_create(void **maps, const hd_scene_def *scene);
void hd_maps_free(void *maps);
/** Fills the maps of the events from t_begin to t_end, with all divisions done, and the flight of
 * each disk after its last event. */
HD_MUST_CHECK hd_status hd_maps_fill(void *maps, const hd_record *record, double t_begin,
                                     double t_end);
/** Carries a block of `width` columns through the maps. A pair event of disks costs about 40 width
 * flops and 128 width bytes of cache traffic. */
void hd_maps_carry(const void *maps, double *block, int width);

#endif
