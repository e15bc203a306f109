/** A stretch of a trajectory whose vectors, triangles and events are all kept, for covariant
 * vectors by hand. */
#ifndef HD_PASSAGE_H
#define HD_PASSAGE_H

#include "covariant/backward.h"
#include "forward_pass.h"
#include "triangles.h"

/** Points 0 .. count; interval k goes from point k to point k + 1. */
typedef struct passage {
    int rows, vectors, count;
    double **factor;       /**< [count], row-major */
    double **q;            /**< [count + 1], vectors, row-major without padding */
    double (*stretch)[64]; /**< [count]: ln R_ll */
    hd_record *log;        /**< [count] */
    double condition;      /**< mean of the intervals */
} passage;

static inline void passage_keep(passage *x, forward_pass *f, double length)
{
    hd_record *log = &x->log[x->count];
    forward_interval(f, length);
    x->condition += hd_ortho_condition(f->ortho);
    x->factor[x->count] = triangle_copy(hd_ortho_factor(f->ortho), x->vectors);
    memcpy(x->stretch[x->count], hd_ortho_log_stretch(f->ortho),
           (size_t)x->vectors * sizeof(double));
    *log = *f->log;
    log->entry = malloc((f->log->count + 1) * sizeof(hd_event));
    memcpy(events_in(log), events_in(f->log), f->log->count * sizeof(hd_event));
    x->count++;
    x->q[x->count] = forward_copy(f);
}

/** From a random frame of that seed, after `warmup` intervals. */
static inline passage passage_of(hd_scene_def scene, uint64_t seed, int warmup, int count,
                                 double length)
{
    HELD(forward_pass) f = forward_started(scene, seed);
    passage x = {.rows = 4 * scene.number, .vectors = forward_vectors(&f)};
    const size_t points = (size_t)count + 1;
    assert_true(x.vectors <= 64);
    x.factor = calloc(points, sizeof *x.factor);
    x.q = calloc(points, sizeof *x.q);
    x.stretch = calloc(points, sizeof *x.stretch);
    x.log = calloc(points, sizeof *x.log);
    for (int k = 0; k < warmup; k++) forward_interval(&f, length);
    x.q[0] = forward_copy(&f);
    while (x.count < count) passage_keep(&x, &f, length);
    x.condition /= count;
    return x;
}

static inline void passage_free(passage *x)
{
    for (int k = 0; k <= x->count; k++) {
        free(x->factor[k]);
        free(x->q[k]);
        free(x->log[k].entry);
    }
    free(x->factor);
    free(x->q);
    free(x->stretch);
    free(x->log);
}

/** C of point `at`, begun at random at point `end`. */
static inline hd_backward *passage_back(const passage *x, int end, int at, uint64_t stream)
{
    double unused[64];
    hd_backward *c;
    CHECK_OK(hd_backward_create(&c, x->vectors));
    hd_backward_start(c, 9, stream);
    for (int k = end - 1; k >= at; k--) CHECK_OK(hd_backward_step(c, unused, x->factor[k]));
    return c;
}

/** V = Q C, row-major, to be freed. */
static inline double *passage_vectors(const passage *x, const hd_backward *c, int at)
{
    const int n = x->vectors;
    double *v = calloc((size_t)(x->rows * n), sizeof *v);
    for (int row = 0; row < x->rows; row++)
        for (int col = 0; col < n; col++)
            for (int k = 0; k <= col; k++)
                v[row * n + col] += x->q[at][row * n + k] * hd_backward_read(c)[col * n + k];
    return v;
}

/** Of column `col` of row-major vectors. */
static inline double column_length(const double *v, int rows, int n, int col)
{
    double sum = 0.0;
    for (int row = 0; row < rows; row++) sum += v[row * n + col] * v[row * n + col];
    return sqrt(sum);
}

/** Between columns `col` of two sets, whatever their signs and lengths. */
static inline double column_sine(const double *v, const double *w, int rows, int n, int col)
{
    const double vl = column_length(v, rows, n, col), wl = column_length(w, rows, n, col);
    double dot = 0.0, sum = 0.0;
    for (int row = 0; row < rows; row++) dot += v[row * n + col] * w[row * n + col];
    for (int row = 0; row < rows; row++) {
        const double off = v[row * n + col] / vl - copysign(1.0, dot) * w[row * n + col] / wl;
        sum += off * off;
    }
    return sqrt(sum * (1.0 - 0.25 * sum));
}

#endif
