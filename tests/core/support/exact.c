/** Event log -> sums of ln R_ll [T1], [T3]-[T5], by the Gram-Schmidt process as it stands in
 * textbooks, twice. */
#include "exact.h"
#include "tangent/conjugate.h"
#include "testing.h"
#include "interval.h"

/** Between two factorisations: a few disks' vectors are then conditioned to a thousand, and a
 * grazing event's share. */
enum { EVENTS_MAX = 8 };

struct exact_frame {
    int rows, vectors;
    hd_exact *v;   /**< [rows][vectors] */
    hd_exact *sum; /**< [vectors] */
};

void exact_orthonormalise(hd_exact *v, int rows, int n, hd_exact *log_stretch)
{
    for (int col = 0; col < n; col++) {
        for (int before = 0; before < 2 * col; before++) {
            const int b = before % col;
            hd_exact overlap = 0.0L;
            for (int row = 0; row < rows; row++) overlap += v[row * n + b] * v[row * n + col];
            for (int row = 0; row < rows; row++) v[row * n + col] -= overlap * v[row * n + b];
        }
        hd_exact norm = 0.0L;
        for (int row = 0; row < rows; row++) norm += v[row * n + col] * v[row * n + col];
        norm = sqrtl(norm);
        log_stretch[col] += logl(norm);
        for (int row = 0; row < rows; row++) v[row * n + col] /= norm;
    }
}

hd_exact *exact_copy(const hd_frame *frame)
{
    const int n = hd_frame_vectors(frame), rows = hd_frame_rows(frame);
    hd_exact *v = malloc((size_t)(rows * n) * sizeof *v);
    assert_non_null(v);
    for (int row = 0; row < rows; row++)
        for (int col = 0; col < n; col++)
            v[row * n + col] = hd_frame_read(frame)[row * hd_frame_stride(frame) + col];
    return v;
}

exact_frame *exact_create(const hd_frame *frame)
{
    exact_frame *x = calloc(1, sizeof *x);
    assert_non_null(x);
    x->rows = hd_frame_rows(frame);
    x->vectors = hd_frame_vectors(frame);
    x->v = exact_copy(frame);
    x->sum = calloc((size_t)x->vectors, sizeof *x->sum);
    assert_non_null(x->sum);
    return x;
}

void exact_free(exact_frame *x)
{
    free(x->v);
    free(x->sum);
    free(x);
}

const hd_exact *exact_read(const exact_frame *x) { return x->v; }

double exact_log_stretch(const exact_frame *x, int col) { return (double)x->sum[col]; }

void exact_begin_anew(exact_frame *x)
{
    for (int col = 0; col < x->vectors; col++) x->sum[col] = 0.0L;
}

/** The rows of one disk: dq_x, dq_y, .., dp_x, dp_y, .. */
static hd_exact *rows_of(const exact_frame *x, int disk)
{
    return x->v + ROWS_OF_ONE * disk * x->vectors;
}

static void fly(exact_frame *x, hd_exact tau)
{
    const int n = x->vectors;
    for (int disk = 0; tau > 0 && disk < x->rows / ROWS_OF_ONE; disk++)
        for (int k = 0; k < HD_DIM * n; k++)
            rows_of(x, disk)[k] += tau * rows_of(x, disk)[HD_DIM * n + k];
}

static hd_exact product(const hd_exact *a, const hd_exact *b)
{
    hd_exact sum = 0.0L;
    for (int d = 0; d < HD_DIM; d++) sum += a[d] * b[d];
    return sum;
}

/** The usual form, with the displacement of the point of contact delta = dq - p (dq.n) / (p.n). */
static void collide(hd_exact *i, hd_exact *j, int n, const hd_event *event)
{
    hd_exact normal[HD_DIM], p[HD_DIM], q[HD_DIM], dp[HD_DIM], delta[HD_DIM];
    for (int d = 0; d < HD_DIM; d++) normal[d] = event->n[d], p[d] = event->p[d];
    const hd_exact length = sqrtl(product(normal, normal));
    for (int d = 0; d < HD_DIM; d++) normal[d] /= length;
    const hd_exact b = product(p, normal);
    for (int k = 0; k < n; k++) {
        for (int d = 0; d < HD_DIM; d++) {
            q[d] = j[d * n + k] - i[d * n + k];
            dp[d] = j[(HD_DIM + d) * n + k] - i[(HD_DIM + d) * n + k];
        }
        const hd_exact a = product(q, normal);
        for (int d = 0; d < HD_DIM; d++) delta[d] = q[d] - p[d] * a / b;
        const hd_exact along = product(dp, normal) + product(p, delta);
        for (int d = 0; d < HD_DIM; d++) {
            const hd_exact turned = along * normal[d] + b * delta[d];
            i[d * n + k] += a * normal[d];
            j[d * n + k] -= a * normal[d];
            i[(HD_DIM + d) * n + k] += turned;
            j[(HD_DIM + d) * n + k] -= turned;
        }
    }
}

/** [T21] */
static void curve(hd_exact *disk, int n, const hd_event *event)
{
    const hd_exact radius = hypotl(event->n[0], event->n[1]);
    const hd_exact nx = event->n[0] / radius, ny = event->n[1] / radius;
    const hd_exact px = event->p[0], py = event->p[1];
    const hd_exact b = px * nx + py * ny;
    for (int k = 0; k < n; k++) {
        hd_exact *v[4] = {disk + k, disk + n + k, disk + 2 * n + k, disk + 3 * n + k};
        const hd_exact a = *v[0] * nx + *v[1] * ny, d = *v[2] * nx + *v[3] * ny;
        /* delta = dq - p (dq.n) / b, of which p.delta n + b delta is added */
        const hd_exact x = *v[0] - px * a / b, y = *v[1] - py * a / b, pd = px * x + py * y;
        *v[0] -= 2 * a * nx, *v[1] -= 2 * a * ny;
        *v[2] -= 2 * d * nx + 2 / radius * (pd * nx + b * x);
        *v[3] -= 2 * d * ny + 2 / radius * (pd * ny + b * y);
    }
}

static void reflect(hd_exact *disk, int n, int d)
{
    for (int k = 0; k < n; k++) {
        disk[d * n + k] *= -1.0L;
        disk[(HD_DIM + d) * n + k] *= -1.0L;
    }
}

void exact_replay(exact_frame *x, const hd_record *log)
{
    double t = 0.0;
    for (size_t k = 0; k < log->count; k++) {
        const hd_event *event = &events_in(log)[k];
        hd_exact *i = rows_of(x, (int)event->i);
        fly(x, (hd_exact)event->t - t);
        if (event->j >= 0)
            collide(i, rows_of(x, (int)event->j), x->vectors, event);
        else if (event->j == HD_WALL_ROUND)
            curve(i, x->vectors, event);
        else
            reflect(i, x->vectors, -1 - (int)event->j);
        if (k % EVENTS_MAX == 0) exact_orthonormalise(x->v, x->rows, x->vectors, x->sum);
        t = event->t;
    }
    fly(x, (hd_exact)log->duration - t);
    exact_orthonormalise(x->v, x->rows, x->vectors, x->sum);
}

/** In pieces, so that the log stays short. */
static void carry(exact_frame *x, hd_trajectory *trajectory, hd_record *log, double length)
{
    const double begin = hd_trajectory_time(trajectory);
    const int pieces = (int)ceil(length);
    exact_begin_anew(x);
    for (int k = 1; k <= pieces; k++) {
        CHECK_OK(trajectory_to(trajectory, log, begin + length * k / pieces));
        exact_replay(x, log);
    }
}

/** That of a run: of all 4N vectors half and its conjugates [T18]. */
static hd_frame *first_frame(const hd_scene_def *scene)
{
    const int n = hd_scene_vectors(scene), carried = hd_scene_carried(scene);
    hd_frame *frame, *all;
    hd_conjugate *conjugate;
    CHECK_OK(hd_frame_create(&frame, PARTICLES(scene->number), carried, scene->seed, 1));
    if (carried == n) return frame;
    CHECK_OK(hd_conjugate_start(frame));
    CHECK_OK(hd_frame_create(&all, PARTICLES(scene->number), n, 1, 1));
    CHECK_OK(hd_conjugate_create(&conjugate, n, DIM, n / 2));
    const hd_columns whole = hd_conjugate_complete(conjugate, hd_frame_columns(frame));
    for (int row = 0; row < n; row++)
        memcpy(hd_frame_data(all) + (size_t)row * (size_t)hd_frame_stride(all),
               whole.data + (size_t)row * (size_t)n, (size_t)n * sizeof(double));
    hd_conjugate_free(conjugate);
    hd_frame_free(frame);
    return all;
}

void exact_spectrum(const hd_scene_def *scene, double *out)
{
    hd_trajectory *trajectory;
    hd_record *log;
    hd_frame *frame;
    const int n = hd_scene_vectors(scene);
    CHECK_OK(hd_trajectory_create(&trajectory, scene));
    CHECK_OK(hd_record_create(&log, DYNAMICS->entry));
    frame = first_frame(scene);
    CHECK_OK(hd_trajectory_extend(trajectory, NULL, scene->equilibration));
    exact_frame *x = exact_create(frame);
    exact_orthonormalise(x->v, x->rows, n, x->sum);
    carry(x, trajectory, log, scene->warmup);
    carry(x, trajectory, log, scene->duration);
    for (int col = 0; col < n; col++) out[col] = exact_log_stretch(x, col) / scene->duration;
    exact_free(x);
    hd_frame_free(frame);
    hd_record_free(log);
    hd_trajectory_free(trajectory);
}
