/** How many threads a frame is worth. */
#ifndef HD_THREADS_H
#define HD_THREADS_H

#include "tangent/ortho.h"
#include "dynamics/dynamics.h"

/** The most that a frame of this size may use: `wanted` if that is not 0, else 1 or all cores. */
int hd_threads_most(int wanted, int rows, int vectors);

/** Threads to use, at most `most`, for frames of this size. Where neither one nor all of them are
 * faster by far, tries both on a frame of its own: nothing but the number depends on the trial.
 * Fails as hd_frame_create and hd_ortho_step do. */
HD_MUST_CHECK hd_status hd_threads_choose(int *threads, hd_ortho *ortho, const hd_dynamics *of,
                                          int disks, int vectors, int most);

#endif
