/** The part of hd_scene_check that does not ask for a start lattice. */
#ifndef HD_SCENE_CHECK_H
#define HD_SCENE_CHECK_H

#include "hdlyap/scene.h"

/** As hd_scene_check: every range, and a box wider than a disk. */
HD_MUST_CHECK hd_status hd_scene_check_box(const hd_scene_def *def, char *message, size_t size);

#endif
