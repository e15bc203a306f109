/** Scene -> record and first frame of a window -> exponents by some method. */
#include "window.h"

#include <hdlyap/run.h>
#include <string.h>

#include "base/check.h"
#include "dynamics/dynamics.h"
#include "timing.h"
#include "run/run.h"

/** Keeps the frame with which an accurate run of this scene begins to average. */
static void record_start(window *w)
{
    hd_scene_def tight = w->scene;
    tight.interval = 0.5;
    tight.accuracy = 1e-12;
    hd_run *run = created(&tight);
    while (hd_run_stage(run) != HD_AVERAGING) require(hd_run_advance(run), "warm-up of the window");
    const hd_frame *frame = hd_run_frame(run);
    w->rows = hd_frame_rows(frame);
    w->vectors = hd_frame_vectors(frame);
    const size_t size = (size_t)w->rows * (size_t)hd_frame_stride(frame);
    w->start = room(size, sizeof(double));
    memcpy(w->start, hd_frame_read(frame), size * sizeof(double));
    require(hd_frame_create(&w->frame, &w->scene, w->vectors, 1, hd_run_threads(run)), "window");
    hd_run_free(run);
}

static void record_events(window *w)
{
    const double begin = w->scene.equilibration + w->scene.warmup;
    hd_trajectory *trajectory;
    require(hd_record_create(&w->record, hd_dynamics_of(&w->scene)->entry), "window");
    require(hd_trajectory_create(&trajectory, &w->scene), "window");
    require(hd_trajectory_extend(trajectory, NULL, begin), "window");
    hd_record_clear(w->record);
    require(hd_trajectory_extend(trajectory, w->record, begin + WINDOW_LONGEST * w->length),
            "window");
    hd_trajectory_free(trajectory);
}

window window_create(const hd_scene_def *scene)
{
    window w = {.scene = *scene, .length = scene->duration};
    record_start(&w);
    record_events(&w);
    return w;
}

void window_free(window *w)
{
    hd_record_free(w->record);
    hd_frame_free(w->frame);
    free(w->start);
}

/** Shows progress, and measures dgemm after every second piece, from the first one on. */
static void look_beside(const watch *beside, int piece, effort *spent)
{
    progress_add(beside->shown, beside->work);
    if (piece % 2 != 0) return;
    gemm_measure(beside->g);
    sample_add(&spent->speed, gemm_last(beside->g));
}

hd_status window_exponents(window *w, factor *f, int pieces, const watch *beside, double *exponents,
                           effort *spent)
{
    const size_t size = (size_t)w->rows * (size_t)hd_frame_stride(w->frame);
    const double before = factor_seconds(f);
    memcpy(hd_frame_data(w->frame), w->start, size * sizeof(double));
    for (int l = 0; l < w->vectors; l++) exponents[l] = 0.0;
    *spent = (effort){0};
    for (int k = 0; k < pieces; k++) {
        const double begin = w->length * k / pieces, end = w->length * (k + 1) / pieces;
        const double start = seconds();
        HD_TRY(hd_frame_replay(w->frame, w->record, begin, end));
        spent->replay += seconds() - start;
        HD_TRY(factor_step(f, w->frame, w->length / pieces, k == pieces - 1));
        for (int l = 0; l < w->vectors; l++) exponents[l] += factor_log_stretch(f)[l] / w->length;
        look_beside(beside, k, spent);
    }
    spent->factor = factor_seconds(f) - before;
    return HD_OK;
}
