/** Tangent maps of dumbbells: see hd_dynamics. */
#ifndef HD_BUMP_MAPS_H
#define HD_BUMP_MAPS_H

#include "dynamics/dynamics.h"

HD_MUST_CHECK hd_status hd_bump_maps_create(void **out, int molecules);
void hd_bump_maps_free(void *maps);
HD_MUST_CHECK hd_status hd_bump_maps_fill(void *maps, const hd_record *record, double t_begin,
                                          double t_end);
void hd_bump_maps_carry(const void *maps, double *block, int width);

#endif
