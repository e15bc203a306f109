/** Event log -> sums of ln R_ll [T1], [T3]-[T5], by the Gram-Schmidt process as it stands in textbooks, twice. */
#include "exact.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "testing.h"

/** Between two factorisations: a few disks' vectors are then conditioned to a thousand, and a grazing event's share. */
enum { ROWS_MAX = 32, EVENTS_MAX = 8 };

struct exact {
    int rows, vectors;
    long double v[ROWS_MAX][ROWS_MAX]; /**< [column][row] */
    long double sum[ROWS_MAX];
};

exact *exact_create(const hd_frame *frame)
{
    exact *x = calloc(1, sizeof *x);
    assert_non_null(x);
    x->rows = hd_frame_rows(frame);
    x->vectors = hd_frame_vectors(frame);
    assert_true(x->rows <= ROWS_MAX);
    for (int col = 0; col < x->vectors; col++)
        for (int row = 0; row < x->rows; row++)
            x->v[col][row] = hd_frame_read(frame)[row * hd_frame_stride(frame) + col];
    return x;
}

void exact_free(exact *x) { free(x); }

double exact_log_stretch(const exact *x, int col) { return (double)x->sum[col]; }

static void factor(exact *x)
{
    for (int l = 0; l < x->vectors; l++) {
        for (int k = 0; k < 2 * l; k++) {
            long double overlap = 0;
            for (int row = 0; row < x->rows; row++) overlap += x->v[k % l][row] * x->v[l][row];
            for (int row = 0; row < x->rows; row++) x->v[l][row] -= overlap * x->v[k % l][row];
        }
        long double norm = 0;
        for (int row = 0; row < x->rows; row++) norm += x->v[l][row] * x->v[l][row];
        norm = sqrtl(norm);
        for (int row = 0; row < x->rows; row++) x->v[l][row] /= norm;
        x->sum[l] += logl(norm);
    }
}

static void fly(exact *x, long double tau)
{
    for (int col = 0; col < x->vectors; col++)
        for (int row = 0; row < x->rows; row += 4)
            for (int d = 0; d < 2; d++) x->v[col][row + d] += tau * x->v[col][row + 2 + d];
}

/** dq' = dq + (dq.n) n and the same for dp, which turns by the change of n at the displaced contact. */
static void collide(long double *vi, long double *vj, const hd_event *e)
{
    const long double length = hypotl(e->n[0], e->n[1]);
    const long double n[2] = {e->n[0] / length, e->n[1] / length}, t[2] = {-n[1], n[0]};
    const long double b = e->p[0] * n[0] + e->p[1] * n[1], pt = e->p[0] * t[0] + e->p[1] * t[1];
    long double a = 0, c = 0, normal = 0;
    for (int d = 0; d < 2; d++) {
        a += (vj[d] - vi[d]) * n[d];
        c += (vj[d] - vi[d]) * t[d];
        normal += (vj[2 + d] - vi[2 + d]) * n[d];
    }
    const long double turn = c - pt * a / b;
    for (int d = 0; d < 2; d++) {
        const long double kick = (normal + pt * turn) * n[d] + b * turn * t[d];
        vi[d] += a * n[d];
        vj[d] -= a * n[d];
        vi[2 + d] += kick;
        vj[2 + d] -= kick;
    }
}

static void take(exact *x, const hd_event *e)
{
    for (int col = 0; col < x->vectors; col++) {
        long double *vi = x->v[col] + 4 * e->i;
        if (e->j >= 0) {
            collide(vi, x->v[col] + 4 * e->j, e);
            continue;
        }
        const int d = e->j == HD_WALL_Y;
        vi[d] = -vi[d];
        vi[2 + d] = -vi[2 + d];
    }
}

void exact_replay(exact *x, const hd_event_log *log)
{
    double t = 0;
    for (size_t k = 0; k < log->count; k++) {
        fly(x, (long double)log->event[k].t - t);
        take(x, &log->event[k]);
        if (k % EVENTS_MAX == 0) factor(x);
        t = log->event[k].t;
    }
    fly(x, (long double)log->duration - t);
    factor(x);
}
