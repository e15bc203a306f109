/** The number of threads that a frame uses. */
#ifndef HD_THREADS_H
#define HD_THREADS_H

#include "tangent/ortho.h"
#include "dynamics/dynamics.h"

/** Most threads that a frame of this size may use: `wanted` if it is not 0, else 1 or all cores. */
int hd_threads_most(int wanted, int rows, int vectors);

/** Chooses the threads, at most `most`, for frames of this size. If neither one nor all of them are
 * clearly faster, tries both on a frame of its own; only the number depends on the trial. Fails as
 * hd_frame_create and hd_ortho_step do. */
HD_MUST_CHECK hd_status hd_threads_choose(int *threads, hd_ortho *ortho, const hd_scene_def *scene,
                                          int vectors, int most);

#endif
