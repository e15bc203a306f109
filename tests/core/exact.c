#include "exact.h"

#include <stdlib.h>

#include "testing.h"

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

hd_exact *exact_copy(hd_frame *frame)
{
    const int n = hd_frame_vectors(frame), rows = hd_frame_rows(frame);
    hd_exact *v = malloc((size_t)(rows * n) * sizeof *v);
    for (int row = 0; row < rows; row++)
        for (int col = 0; col < n; col++)
            v[row * n + col] = hd_frame_read(frame)[row * hd_frame_stride(frame) + col];
    return v;
}

/* ---- the tangent maps, as [T1], [T3] and [T4] say them ---------------------------------------- */

/** Rows of one disk: dq_x, dq_y, dp_x, dp_y, n entries each. */
static void fly(hd_exact *disk, int n, hd_exact tau)
{
    for (int k = 0; k < 2 * n; k++) disk[k] += tau * disk[2 * n + k];
}

static void collide(hd_exact *i, hd_exact *j, int n, const hd_event *event)
{
    const hd_exact nx = event->n[0], ny = event->n[1], px = event->p[0], py = event->p[1];
    const hd_exact b = px * nx + py * ny, pt = py * nx - px * ny;
    for (int k = 0; k < n; k++) {
        const hd_exact qx = j[k] - i[k], qy = j[n + k] - i[n + k];
        const hd_exact dx = j[2 * n + k] - i[2 * n + k], dy = j[3 * n + k] - i[3 * n + k];
        const hd_exact a = qx * nx + qy * ny, s = qy * nx - qx * ny - pt / b * a;
        const hd_exact along = dx * nx + dy * ny + pt * s, across = b * s;
        const hd_exact change[4] = {a * nx, a * ny, along * nx - across * ny,
                                    along * ny + across * nx};
        for (int row = 0; row < 4; row++) {
            i[row * n + k] += change[row];
            j[row * n + k] -= change[row];
        }
    }
}

static void reflect(hd_exact *disk, int n, int d)
{
    for (int k = 0; k < n; k++) {
        disk[d * n + k] *= -1.0L;
        disk[(2 + d) * n + k] *= -1.0L;
    }
}

static void replay(hd_exact *v, int disks, int n, const hd_event_log *log)
{
    double now = 0.0;
    for (size_t e = 0; e <= log->count; e++) {
        const hd_event *event = e < log->count ? &log->event[e] : NULL;
        const double t = event ? event->t : log->duration;
        for (int d = 0; t > now && d < disks; d++) fly(v + 4 * d * n, n, (hd_exact)t - now);
        now = t;
        if (!event) return;
        hd_exact *i = v + 4 * event->i * n;
        if (event->j >= 0) collide(i, v + 4 * event->j * n, n, event);
        else reflect(i, n, event->j == HD_WALL_Y);
    }
}

void exact_spectrum(const hd_scene_def *scene, double interval, double *out)
{
    hd_trajectory *trajectory;
    hd_event_log *log;
    hd_frame *frame;
    const int n = hd_scene_vectors(scene), rows = 4 * scene->disks;
    hd_exact *sum = calloc((size_t)n, sizeof *sum);
    CHECK_OK(hd_trajectory_create(&trajectory, scene));
    CHECK_OK(hd_event_log_create(&log));
    CHECK_OK(hd_frame_create(&frame, scene->disks, n, scene->seed, 1));
    CHECK_OK(hd_trajectory_advance(trajectory, NULL, scene->equilibration));
    hd_exact *v = exact_copy(frame);
    exact_orthonormalise(v, rows, n, sum);
    const double length[2] = {scene->warmup, scene->duration};
    for (int phase = 0; phase < 2; phase++) {
        const double begin = hd_trajectory_time(trajectory);
        const int pieces = (int)lround(length[phase] / interval);
        for (int col = 0; col < n; col++) sum[col] = 0.0L;
        for (int k = 1; k <= pieces; k++) {
            CHECK_OK(hd_trajectory_advance(trajectory, log, begin + length[phase] * k / pieces));
            replay(v, scene->disks, n, log);
            exact_orthonormalise(v, rows, n, sum);
        }
    }
    for (int col = 0; col < n; col++) out[col] = (double)(sum[col] / scene->duration);
    free(v);
    free(sum);
    hd_frame_free(frame);
    hd_event_log_free(log);
    hd_trajectory_free(trajectory);
}
