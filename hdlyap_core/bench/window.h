/** A window: a stretch of a trajectory with the frame at its start. All methods of factorisation
 * get the same one. */
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
    double length; /**< [time units]; the caller may lengthen it, up to WINDOW_LONGEST times */
    int rows, vectors;
    hd_record *record;
    hd_frame *frame;
    double *start; /**< [rows * stride], orthonormal to rounding */
} window;

/** What a method took for a window. */
typedef struct effort {
    double replay, factor; /**< seconds of all replays and of all factorisations */
    sample speed;          /**< flops per second of dgemm, measured in between */
} effort;

/** Makes a window that begins when hd_run would begin to average, as long as scene->duration. */
window window_create(const hd_scene_def *scene);
void window_free(window *w);

/** What happens besides: dgemm is measured, and the progress grows by `work` with every piece. */
typedef struct watch {
    gemm *g;
    progress *shown;
    double work;
} watch;

/** Carries the frame through the window in `pieces` equal intervals, each of which a step of f
 * ends. Fills exponents[n]. Fails as factor_step does. */
HD_MUST_CHECK hd_status window_exponents(window *w, factor *f, int pieces, const watch *beside,
                                         double *exponents, effort *spent);

#endif
