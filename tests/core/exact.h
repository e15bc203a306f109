/** Event log -> exponents in extended precision, the slow way: what the core's factorisations are held against. */
#ifndef HD_EXACT_H
#define HD_EXACT_H

#include "hdlyap/frame.h"

typedef long double hd_exact;

/** Gram and Schmidt, twice: v (row-major, rows x n) <- Q, log_stretch[n] += ln diag R. */
void exact_orthonormalise(hd_exact *v, int rows, int n, hd_exact *log_stretch);

/** The current vectors, row-major without padding, to be freed; rows x n. */
hd_exact *exact_copy(hd_frame *frame);

/** Exponents of the averaged time of a scene, its own start vectors factored every `interval`; out[n]. Off by 1e-15
 *  at most: intervals of 0.05 and 0.1 agree to that. */
void exact_spectrum(const hd_scene_def *scene, double interval, double *out);

#endif
