/** The tangent dynamics once more, slowly: extended precision, and factored after a few events. */
#ifndef HD_EXACT_H
#define HD_EXACT_H

#include "dynamics/trajectory.h"
#include "tangent/frame.h"

typedef long double hd_exact;

/** Gram and Schmidt, twice: v (row-major, rows x n) <- Q, log_stretch[n] += ln diag R. */
void exact_orthonormalise(hd_exact *v, int rows, int n, hd_exact *log_stretch);

/** The current vectors, row-major without padding, to be freed; rows x n. */
hd_exact *exact_copy(const hd_frame *frame);

typedef struct exact_frame exact_frame;

/** The same vectors as the frame's. */
exact_frame *exact_create(const hd_frame *frame);
void exact_free(exact_frame *x);
/** The present vectors, row-major without padding */
const hd_exact *exact_read(const exact_frame *x);

/** Carries them through all of the log. */
void exact_replay(exact_frame *x, const hd_record *log);

/** Sum of ln R_ll since the start, or since it was begun anew, column col. */
double exact_log_stretch(const exact_frame *x, int col);
void exact_begin_anew(exact_frame *x);

/** Exponents of the averaged time of a scene from its own start vectors; out[n]. Off by 1e-15 at
 * most: factored twice as often they agree to that. */
void exact_spectrum(const hd_scene_def *scene, double *out);

#endif
