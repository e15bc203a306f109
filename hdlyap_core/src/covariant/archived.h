/** What a checkpoint holds of the averages of covariant vectors, and bytes that they take. */
#ifndef HD_COVARIANT_ARCHIVED_H
#define HD_COVARIANT_ARCHIVED_H

#include "base/archive.h"
#include "hdlyap/covariant.h"

/** Beside the windows. */
double hd_covariant_bytes_of(const hd_scene_def *scene);
void hd_covariant_archive(hd_covariant *covariant, hd_archive *archive);
void hd_splitting_archive(hd_splitting *splitting, hd_archive *archive);

#endif
