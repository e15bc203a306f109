/** The slowest vectors without an orthonormalisation, against those that one gives. */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "scenes.h"
#include "testing.h"

#include "hdlyap/ortho.h"
#include "tangent/slow_vectors.h"
#include "interval.h"

enum { COUNT = 12 };

typedef struct world {
    hd_scene_def scene;
    hd_trajectory *trajectory;
    hd_event_log *log;
    hd_frame *frame;
    hd_ortho *ortho;
    hd_slow_vectors *tail;
    double *p;
} world;

static hd_scene_def dense(int disks, double density, hd_boundary x, hd_boundary y)
{
    return scene(.disks = disks, .density = density, .aspect = 1.0, .boundary[0] = x,
                 .boundary[1] = y);
}

/** A frame as a run has it after a while, orthonormalised every half mean flight time or so. */
static world settled(hd_scene_def scene)
{
    world w = {.scene = scene};
    const hd_ortho_limits limits = {1e7, DBL_EPSILON, HD_NORM_FULL};
    const int n = hd_scene_vectors(&scene);
    CHECK_OK(hd_trajectory_create(&w.trajectory, &scene));
    CHECK_OK(hd_event_log_create(&w.log));
    CHECK_OK(hd_frame_create(&w.frame, scene.disks, n, 5, 1));
    CHECK_OK(hd_ortho_create(&w.ortho, 4 * scene.disks, n));
    CHECK_OK(hd_slow_vectors_create(&w.tail, &scene, COUNT));
    w.p = malloc(2 * (size_t)scene.disks * sizeof *w.p);
    const double interval = scene.disks / hd_trajectory_collision_rate(w.trajectory);
    CHECK_OK(hd_trajectory_extend(w.trajectory, NULL, 20.0 * interval));
    for (int k = 0; k < 60; k++) {
        CHECK_OK(hd_ortho_step(w.ortho, w.frame, limits));
        const double end = hd_trajectory_time(w.trajectory) + interval;
        CHECK_OK(trajectory_to(w.trajectory, w.log, end));
        CHECK_OK(hd_frame_replay(w.frame, w.log, 0.0, w.log->duration));
    }
    CHECK_OK(hd_ortho_step(w.ortho, w.frame, limits));
    return w;
}

static void world_free(world *w)
{
    hd_slow_vectors_free(w->tail);
    hd_ortho_free(w->ortho);
    hd_frame_free(w->frame);
    hd_event_log_free(w->log);
    hd_trajectory_free(w->trajectory);
    free(w->p);
}

/** Carries the frame on by `collisions` of a disk. */
static void carry(world *w, double collisions)
{
    const double rate = 2.0 * hd_trajectory_collision_rate(w->trajectory) / w->scene.disks;
    const double end = hd_trajectory_time(w->trajectory) + collisions / rate;
    CHECK_OK(trajectory_to(w->trajectory, w->log, end));
    CHECK_OK(hd_frame_replay(w->frame, w->log, 0.0, w->log->duration));
    hd_trajectory_state(w->trajectory, NULL, w->p);
}

/** Largest distance |x - y| of a vector found, x, from the frame's, y. */
static double distance(const world *w)
{
    const hd_columns found = hd_slow_vectors_columns(w->tail), exact = hd_frame_columns(w->frame);
    double worst = 0.0;
    assert_int_equal(found.count, COUNT);
    assert_int_equal(found.first, exact.count - COUNT);
    for (int c = 0; c < found.count; c++) {
        double square = 0.0;
        for (int row = 0; row < 4 * w->scene.disks; row++) {
            const double off = found.data[row * found.stride + c] -
                               exact.data[row * exact.stride + found.first + c];
            square += off * off;
        }
        assert_true(isfinite(square));
        worst = fmax(worst, sqrt(square));
    }
    return worst;
}

static void check_orthonormal(const world *w)
{
    const hd_columns v = hd_slow_vectors_columns(w->tail);
    for (int a = 0; a < v.count; a++)
        for (int b = 0; b <= a; b++) {
            double dot = 0.0;
            for (int row = 0; row < 4 * w->scene.disks; row++)
                dot += v.data[row * v.stride + a] * v.data[row * v.stride + b];
            CHECK_CLOSE(dot, a == b, 64 * DBL_EPSILON);
        }
}

/** Within 1e-2 of the vectors of the exact factorisation, signs included; that is the accuracy of
 * the iteration and of single precision at conditions of some hundred to some thousand. */
static void check_against_orthonormalisation(hd_scene_def scene, double collisions)
{
    world w = settled(scene);
    carry(&w, collisions);
    CHECK_OK(hd_slow_vectors_measure(w.tail, w.frame, w.p, COUNT));
    check_orthonormal(&w);
    hd_frame_rewind(w.frame);
    CHECK_OK(hd_frame_replay(w.frame, w.log, 0.0, w.log->duration)); /* nothing was lost */
    CHECK_OK(hd_ortho_step(w.ortho, w.frame, (hd_ortho_limits){1e9, 1e-6, HD_NORM_FULL}));
    const double off = distance(&w);
    print_message("%d disks, density %.1f, boundaries %d %d: off by %.1e at condition %.0f\n",
                  scene.disks, scene.density, scene.boundary[0], scene.boundary[1], off,
                  hd_ortho_condition(w.ortho));
    assert_true(hd_ortho_condition(w.ortho) > 20.0);
    assert_true(off <= 1e-2);
    world_free(&w);
}

TEST(the_slowest_vectors_are_found)
{
    for (int b = 0; b < 4; b++) {
        const hd_boundary x = b & 1 ? HD_REFLECTING : HD_PERIODIC;
        const hd_boundary y = b & 2 ? HD_REFLECTING : HD_PERIODIC;
        check_against_orthonormalisation(dense(60, 0.7, x, y), 8.0);
        check_against_orthonormalisation(dense(101, 0.8, x, y), 10.0);
        check_against_orthonormalisation(dense(80, 0.4, x, y), 8.0);
    }
}

/** Not square, or too small: there an orthonormalisation has to do. */
TEST(where_it_does_not_apply_it_is_refused)
{
    hd_slow_vectors *tail;
    hd_scene_def scene = scene_from(dense(60, 0.7, HD_PERIODIC, HD_PERIODIC), .exponents = 100);
    assert_int_equal(hd_slow_vectors_create(&tail, &scene, COUNT), HD_REFUSED);
    scene.exponents = HD_EXPONENTS_ALL;
    assert_int_equal(hd_slow_vectors_create(&tail, &scene, COUNT), HD_REFUSED);
    assert_null(tail);
    scene = dense(30, 0.7, HD_PERIODIC, HD_PERIODIC);
    assert_int_equal(hd_slow_vectors_create(&tail, &scene, COUNT), HD_REFUSED);
    scene = dense(60, 0.7, HD_PERIODIC, HD_PERIODIC);
    assert_int_equal(hd_slow_vectors_create(&tail, &scene, 50), HD_REFUSED);
}

TEST(a_broken_frame_is_noticed)
{
    world w = settled(dense(60, 0.7, HD_PERIODIC, HD_PERIODIC));
    const int stride = hd_frame_stride(w.frame);
    carry(&w, 8.0);
    hd_frame_data(w.frame)[6 * stride + 3] = NAN;
    assert_int_equal(hd_slow_vectors_measure(w.tail, w.frame, w.p, COUNT), HD_ILL_CONDITIONED);
    carry(&w, 8.0);
    for (int row = 0; row < 4 * w.scene.disks; row++) /* rank lost */
        hd_frame_data(w.frame)[row * stride + 5] = hd_frame_data(w.frame)[row * stride + 7];
    assert_int_equal(hd_slow_vectors_measure(w.tail, w.frame, w.p, COUNT), HD_ILL_CONDITIONED);
    world_free(&w);
}
