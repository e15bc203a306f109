/** Half of a frame and all of it, carried side by side through the same intervals: the second one
 * starts as the first one with its conjugates, and is factored as it stands. */
#ifndef HD_CONJUGATES_H
#define HD_CONJUGATES_H

#include "interval.h"
#include "tangent/conjugate.h"
#include "testing.h"

enum { HALF, WHOLE };

typedef struct conjugates {
    int disks, rows;
    hd_trajectory *trajectory;
    hd_record *log;
    hd_frame *frame[2];
    hd_ortho *ortho[2];
    hd_conjugate *conjugate;
    double condition; /**< largest so far, of either */
} conjugates;

/** As where couplings are wanted: orthonormal to rounding. */
static const hd_ortho_limits CONJUGATES_LIMITS = {1e9, 1e-12, HD_NORM_FULL};

static inline void conjugates_copy(conjugates *x)
{
    const hd_columns all = hd_conjugate_complete(x->conjugate, hd_frame_columns(x->frame[HALF]));
    for (int row = 0; row < x->rows; row++)
        memcpy(hd_frame_data(x->frame[WHOLE]) +
                   (size_t)row * (size_t)hd_frame_stride(x->frame[WHOLE]),
               all.data + (size_t)row * (size_t)all.stride, (size_t)x->rows * sizeof(double));
}

static inline conjugates conjugates_of(hd_scene_def scene)
{
    conjugates x = {.disks = scene.number, .rows = 4 * scene.number, .condition = 1.0};
    CHECK_OK(hd_trajectory_create(&x.trajectory, &scene));
    CHECK_OK(hd_trajectory_extend(x.trajectory, NULL, 10.0));
    CHECK_OK(hd_record_create(&x.log, DYNAMICS->entry));
    CHECK_OK(hd_conjugate_create(&x.conjugate, x.rows, DIM, x.rows / 2));
    for (int k = 0; k < 2; k++) {
        const int vectors = k == HALF ? x.rows / 2 : x.rows;
        CHECK_OK(hd_frame_create(&x.frame[k], PARTICLES(x.disks), vectors, scene.seed, 1));
        CHECK_OK(hd_ortho_create(&x.ortho[k], x.rows, vectors));
        CHECK_OK(hd_ortho_keep_factor(x.ortho[k]));
    }
    CHECK_OK(hd_conjugate_start(x.frame[HALF]));
    conjugates_copy(&x);
    return x;
}

static inline void conjugates_free(conjugates *x)
{
    for (int k = 0; k < 2; k++) {
        hd_frame_free(x->frame[k]);
        hd_ortho_free(x->ortho[k]);
    }
    hd_conjugate_free(x->conjugate);
    hd_record_free(x->log);
    hd_trajectory_free(x->trajectory);
}

static inline void conjugates_interval(conjugates *x, double length)
{
    const double end = hd_trajectory_time(x->trajectory) + length;
    CHECK_OK(trajectory_to(x->trajectory, x->log, end));
    for (int k = 0; k < 2; k++) {
        CHECK_OK(hd_frame_replay(x->frame[k], x->log, 0.0, x->log->duration));
        CHECK_OK(hd_ortho_step(x->ortho[k], x->frame[k], CONJUGATES_LIMITS));
        x->condition = fmax(x->condition, hd_ortho_condition(x->ortho[k]));
    }
}

/** The half, completed. */
static inline hd_columns conjugates_completed(conjugates *x)
{
    (void)hd_conjugate_stretch(x->conjugate, hd_ortho_log_stretch(x->ortho[HALF]));
    return hd_conjugate_complete(x->conjugate, hd_frame_columns(x->frame[HALF]));
}

#endif
