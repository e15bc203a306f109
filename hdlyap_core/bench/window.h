/** A stretch of a trajectory with the frame that it starts from: the same for every method of
 * factorisation. */
#ifndef HD_BENCH_WINDOW_H
#define HD_BENCH_WINDOW_H

#include "dynamics/trajectory.h"
#include "factor.h"
#include "gemm.h"
#include "progress.h"
#include "sample.h"
#include "tangent/frame.h"

#define WINDOW_LONGEST 2.0

typedef struct window {
    hd_scene_def scene;
    double length; /**< time units; may be changed, up to WINDOW_LONGEST times as much */
    int rows, vectors;
    hd_record *record;
    hd_frame *frame;
    double *start; /**< [rows * stride], orthonormal to rounding */
} window;

/** What a way through the window took. */
typedef struct effort {
    double replay, factor; /**< seconds in all */
    sample speed;          /**< dgemm's flops per second in between */
} effort;

/** The averaging phase of the scene: begins where hd_run would begin to average, as long as its
 * duration. */
window window_create(const hd_scene_def *scene);
void window_free(window *w);

/** What goes on beside: dgemm is measured, and the progress grows by `work` with every piece. */
typedef struct watch {
    gemm *g;
    progress *shown;
    double work;
} watch;

/** Carries the frame through the window in `pieces` equal intervals, each ended by a step of f.
 * exponents[n]. What factor_step fails with. */
HD_MUST_CHECK hd_status window_exponents(window *w, factor *f, int pieces, const watch *beside,
                                         double *exponents, effort *spent);

#endif
