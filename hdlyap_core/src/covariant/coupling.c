/** (Q before an interval, its events, Q and R after it) -> the symmetric Y = R^-1 X [T18].
 *
 * J Q is replayed as Q was: W = S J Q, X = Q'^T W. Y is symmetric, so the upper triangle of X
 * determines it, panel by panel of rows, from the last panel on:
 *
 *     Y_pq = R_pp^-1 (X_pq - R_pl Y_lq),   l: later than p;  q: first later than p, then p itself
 *
 * The upper triangle is also the more accurate one: row i of X is known to eps |W e_j| and is
 * divided by R_ii, which is largest in the first rows. All matrices are row-major. */
#include "covariant/coupling.h"

#include <cblas.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "tangent/conjugate.h"
#include "tangent/product.h"
#include "tangent/frame.h"

enum { PANEL = 96 };

struct hd_coupling {
    int rows, half;
    hd_frame *frame; /**< of J Q */
    double *y;       /**< [half * half] */
};

double hd_coupling_bytes(const hd_dynamics *of, int rows, int threads)
{
    const double half = rows / 2;
    return sizeof(double) * half * half + hd_frame_bytes(of, rows, half, threads);
}

hd_status hd_coupling_create(hd_coupling **out, const hd_scene_def *scene, int threads)
{
    hd_coupling *c = hd_memory_alloc(1, sizeof *c);
    *out = NULL;
    if (!c) return HD_NO_MEMORY;
    c->half = hd_dynamics_of(scene)->coordinates * scene->number;
    c->rows = 2 * c->half;
    c->y = hd_memory_alloc((size_t)c->half * (size_t)c->half, sizeof(double));
    if (!c->y || hd_frame_create(&c->frame, scene, c->half, 1, threads) != HD_OK) {
        hd_coupling_free(c);
        return HD_NO_MEMORY;
    }
    *out = c;
    return HD_OK;
}

void hd_coupling_free(hd_coupling *coupling)
{
    if (!coupling) return;
    hd_frame_free(coupling->frame);
    hd_memory_free(coupling->y);
    hd_memory_free(coupling);
}

/** Loads J Q into the own frame; Q are the other frame's vectors before its last replay. */
static void load(hd_coupling *c, const hd_frame *frame)
{
    const size_t stride = (size_t)hd_frame_stride(frame);
    const int coordinates = hd_frame_coordinates(frame);
    const double *before = hd_frame_before(frame);
    double *to = hd_frame_data(c->frame);
    for (int row = 0; row < c->rows; row++, to += stride) {
        const double *from = before + (size_t)hd_turned(row, coordinates) * stride;
        memcpy(to, from, (size_t)c->half * sizeof *to);
        if (hd_turned_sign(row, coordinates) < 0) cblas_dscal(c->half, -1.0, to, 1);
    }
}

/** Computes rows first .. first + width - 1 of Y, columns `col` .. col + count - 1. */
static void panel_block(hd_coupling *c, const hd_frame *frame, const double *factor, int first,
                        int width, int col, int count)
{
    const int n = c->half, stride = hd_frame_stride(frame), later = first + width;
    double *y = c->y + (size_t)first * (size_t)n + col;
    const double *r = factor + (size_t)first * (size_t)n;
    if (count == 0) return;
    hd_dgemm(CblasNoTrans, CblasTrans, count, width, c->rows, 1.0, hd_frame_read(c->frame) + col,
             stride, hd_frame_read(frame) + first, stride, 0.0, y, n);
    if (later < n)
        hd_dgemm(CblasNoTrans, CblasNoTrans, count, width, n - later, -1.0,
                 c->y + (size_t)later * (size_t)n + col, n, r + later, n, 1.0, y, n);
    cblas_dtrsm(CblasRowMajor, CblasLeft, CblasUpper, CblasNoTrans, CblasNonUnit, width, count, 1.0,
                r + first, n, y, n);
}

/** Copies a block to the other side of the diagonal; the panel's own block becomes the mean of
 * both. */
static void mirror(hd_coupling *c, int first, int width, int col, int count)
{
    const size_t n = (size_t)c->half;
    for (int i = first; i < first + width; i++)
        for (int j = col; j < col + count; j++) {
            double *here = c->y + (size_t)i * n + (size_t)j,
                   *there = c->y + (size_t)j * n + (size_t)i;
            if (j >= first + width)
                *there = *here;
            else if (j > i)
                *here = *there = 0.5 * (*here + *there);
        }
}

hd_status hd_coupling_measure(hd_coupling *c, const hd_frame *frame, const double *factor,
                              const hd_record *record, double t_begin, double t_end)
{
    const int n = c->half;
    HD_ASSERT(hd_frame_vectors(frame) == n && hd_frame_stride(frame) == hd_frame_stride(c->frame));
    load(c, frame);
    HD_TRY(hd_frame_replay(c->frame, record, t_begin, t_end));
    for (int first = (n - 1) / PANEL * PANEL; first >= 0; first -= PANEL) {
        const int width = n - first < PANEL ? n - first : PANEL, later = first + width;
        panel_block(c, frame, factor, first, width, later, n - later);
        mirror(c, first, width, later, n - later);
        panel_block(c, frame, factor, first, width, first, width);
        mirror(c, first, width, first, width);
    }
    return HD_OK;
}

const double *hd_coupling_read(const hd_coupling *coupling) { return coupling->y; }
