/** The slowest Lyapunov vectors of a frame that is not orthonormalised, for a fraction of what that
 * would cost [T16]. */
#ifndef HD_SLOW_VECTORS_H
#define HD_SLOW_VECTORS_H

#include "hdlyap/frame.h"

typedef struct hd_slow_vectors hd_slow_vectors;

/** Up to count_max vectors of a frame of the positive half. HD_NO_MEMORY; HD_REFUSED where the
 * method does not apply: another number of vectors, or too few for it to pay. */
HD_MUST_CHECK hd_status hd_slow_vectors_create(hd_slow_vectors **out, const hd_scene_def *def,
                                               int count_max);
void hd_slow_vectors_free(hd_slow_vectors *slow);

int hd_slow_vectors_count_max(const hd_slow_vectors *slow);

/** Replaces the frame's contents by workspace (rewind it) and finds its last `count` Lyapunov
 * vectors. p[2N]: momenta. In single precision: off by about 100 eps_single condition, towards the
 * fast vectors. HD_ILL_CONDITIONED if the iteration does not converge. Cost 2/3 (2N)^3 flops of
 * sgetrf, and about 5 times 8 (2N)^2 count of sgetrs and sgemm. */
HD_MUST_CHECK hd_status hd_slow_vectors_measure(hd_slow_vectors *slow, hd_frame *frame,
                                                const double *p, int count);

/** The vectors found, orthonormal to rounding; valid until the next measurement. */
hd_columns hd_slow_vectors_columns(const hd_slow_vectors *slow);

#endif
