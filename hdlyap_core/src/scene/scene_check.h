/** Limits of a scene, and the part of hd_scene_check that does not ask for a start lattice. */
#ifndef HD_SCENE_CHECK_H
#define HD_SCENE_CHECK_H

#include "hdlyap/scene.h"

enum {
    HD_DISKS_MIN = 2,
    HD_DISKS_MAX = 1000000,
    HD_THREADS_MAX = 1024,
    HD_OBSERVE_ALL = 63 /**< every HD_OBSERVE_* */
};

/** As hd_scene_check: every range, and a box wider than a disk. */
HD_MUST_CHECK hd_status hd_scene_check_box(const hd_scene_def *def, char *message, size_t size);

#endif
