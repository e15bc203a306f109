/** Parts of hd_scene_check. */
#ifndef HD_SCENE_CHECK_H
#define HD_SCENE_CHECK_H

#include "hdlyap/scene.h"

/** The line that refuses what is of a box where there is none: what, its value, the particles. */
#define HD_WITHOUT_BOX                                                                             \
    "%s = %s: must not be given with particles = %s, which have no positions in a box"

/** But for what observables ask of a scene. */
HD_MUST_CHECK hd_status hd_scene_check_start(const hd_scene_def *def, char *message, size_t size);
/** Without a start lattice, too: every range, and a box wider than a disk. */
HD_MUST_CHECK hd_status hd_scene_check_box(const hd_scene_def *def, char *message, size_t size);

#endif
