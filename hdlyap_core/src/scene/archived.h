/** The scene in a checkpoint. */
#ifndef HD_SCENE_ARCHIVED_H
#define HD_SCENE_ARCHIVED_H

#include "base/archive.h"
#include "hdlyap/scene.h"

void hd_scene_archive(hd_scene_def *def, hd_archive *archive);

#endif
