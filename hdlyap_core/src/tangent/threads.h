/** How many threads a frame is worth. */
#ifndef HD_THREADS_H
#define HD_THREADS_H

#include "hdlyap/ortho.h"

/** The most that a frame of this size may use: `wanted` if that is not 0, else 1 or all cores. */
int hd_threads_most(int wanted, int rows, int vectors);

/** Where neither one thread nor all of them are faster by far, tries both on this orthonormal
 * frame, which stays as it is but for rounding, and tells BLAS and frame to use the better number.
 * `wanted` as above is not doubted. The number in use. Fails as hd_ortho_step does. */
HD_MUST_CHECK hd_status hd_threads_choose(int *threads, hd_ortho *ortho, hd_frame *frame,
                                          int wanted);

#endif
