/** Parts of hd_scene_check. */
#ifndef HD_SCENE_CHECK_H
#define HD_SCENE_CHECK_H

#include "hdlyap/scene.h"

/** Format of the line that refuses a parameter of a box: its name, its value, the particles. */
#define HD_WITHOUT_BOX                                                                             \
    "%s = %s: must not be given with particles = %s, which have no positions in a box"

/** hd_scene_check without the conditions of observables. */
HD_MUST_CHECK hd_status hd_scene_check_start(const hd_scene_def *def, char *message, size_t size);
/** Checks every range, and that the box is wider than a particle, but not that a start lattice
 * fits. */
HD_MUST_CHECK hd_status hd_scene_check_box(const hd_scene_def *def, char *message, size_t size);

#endif
