/** Tangent maps of soft particles: see hd_dynamics. */
#ifndef HD_KICK_MAPS_H
#define HD_KICK_MAPS_H

#include "dynamics/dynamics.h"

HD_MUST_CHECK hd_status hd_kick_maps_create_plane(void **out, const hd_scene_def *scene);
HD_MUST_CHECK hd_status hd_kick_maps_create_space(void **out, const hd_scene_def *scene);
void hd_kick_maps_free(void *maps);
HD_MUST_CHECK hd_status hd_kick_maps_fill(void *maps, const hd_record *record, double t_begin,
                                          double t_end);
void hd_kick_maps_carry(const void *maps, double *block, int width);

#endif
