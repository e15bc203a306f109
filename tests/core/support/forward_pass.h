/** Trajectory, frame and triangles of the forward pass, an interval at a time, without a run. */
#ifndef HD_FORWARD_PASS_H
#define HD_FORWARD_PASS_H

#include "testing.h"
#include "interval.h"

typedef struct forward_pass {
    hd_trajectory *trajectory;
    hd_record *log;
    hd_frame *frame;
    hd_ortho *ortho;
    double worst; /**< largest condition so far */
} forward_pass;

static const hd_ortho_limits FORWARD_LIMITS = {1e7, 1e-6, HD_NORM_FULL};

/** The frame is orthonormal, and what the log says must have been replayed. */
static inline void forward_factor(forward_pass *f)
{
    CHECK_OK(hd_ortho_step(f->ortho, f->frame, FORWARD_LIMITS));
    f->worst = fmax(f->worst, hd_ortho_condition(f->ortho));
}

static inline void forward_interval(forward_pass *f, double length)
{
    CHECK_OK(trajectory_to(f->trajectory, f->log, hd_trajectory_time(f->trajectory) + length));
    CHECK_OK(hd_frame_replay(f->frame, f->log, 0.0, f->log->duration));
    forward_factor(f);
}

/** At time 0, with its own random frame. */
static inline forward_pass forward_started(hd_scene_def scene, uint64_t seed)
{
    forward_pass f = {0};
    const int n = hd_scene_vectors(&scene);
    scene.observe = 0; /* what a run would refuse is not asked for here */
    scene.covariant_memory = hd_scene_def_default().covariant_memory;
    CHECK_OK(hd_trajectory_create(&f.trajectory, &scene));
    CHECK_OK(hd_record_create(&f.log, DYNAMICS->entry));
    CHECK_OK(hd_frame_create(&f.frame, PARTICLES(scene.number), n, seed, 1));
    CHECK_OK(hd_ortho_create(&f.ortho, 4 * scene.number, n));
    CHECK_OK(hd_ortho_keep_factor(f.ortho));
    forward_factor(&f);
    f.worst = 1.0;
    return f;
}

static inline void forward_pass_free(forward_pass *f)
{
    hd_trajectory_free(f->trajectory);
    hd_record_free(f->log);
    hd_frame_free(f->frame);
    hd_ortho_free(f->ortho);
}

static inline int forward_vectors(const forward_pass *f) { return hd_frame_vectors(f->frame); }

/** The present vectors without padding, row-major, to be freed. */
static inline double *forward_copy(const forward_pass *f)
{
    const size_t n = (size_t)hd_frame_vectors(f->frame), rows = (size_t)hd_frame_rows(f->frame);
    const size_t stride = (size_t)hd_frame_stride(f->frame);
    double *v = malloc(rows * n * sizeof *v);
    assert_non_null(v);
    for (size_t row = 0; row < rows; row++)
        memcpy(v + row * n, hd_frame_read(f->frame) + row * stride, n * sizeof *v);
    return v;
}

#endif
