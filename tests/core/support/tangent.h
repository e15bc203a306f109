/** Single columns of a tangent frame, and the symplectic product that the maps keep. */
#ifndef HD_TANGENT_H
#define HD_TANGENT_H

#include "testing.h"

static inline double *frame_entry(hd_frame *frame, int row, int col)
{
    return hd_frame_data(frame) + (size_t)row * (size_t)hd_frame_stride(frame) + (size_t)col;
}

static inline double *frame_column(hd_frame *frame, int col, double *out)
{
    for (int row = 0; row < hd_frame_rows(frame); row++) out[row] = *frame_entry(frame, row, col);
    return out;
}

/** Column k is the unit vector of row k. */
static inline void frame_identity(hd_frame *frame)
{
    for (int row = 0; row < hd_frame_rows(frame); row++)
        for (int col = 0; col < hd_frame_vectors(frame); col++)
            *frame_entry(frame, row, col) = row == col;
}

static inline double dot(const double *a, const double *b, int rows)
{
    double sum = 0.0;
    for (int row = 0; row < rows; row++) sum += a[row] * b[row];
    return sum;
}

/** a^T J b = sum of dq_a . dp_b - dp_a . dq_b */
static inline double symplectic(const double *a, const double *b, int rows)
{
    double sum = 0.0;
    for (int i = 0; i < rows; i += ROWS_OF_ONE)
        for (int c = i; c < i + HD_DIM; c++) sum += a[c] * b[c + HD_DIM] - a[c + HD_DIM] * b[c];
    return sum;
}

/** S of the log, applied to the unit vectors, is finite and S^T J S = J. Of one event a column of S
 * is computed by products whose largest is at most |S|, some ten in a row: it is known to 16 eps
 * |S|, and enters with the other column. Returns |S|. */
static inline double check_symplectic_map(const hd_record *log, int disks)
{
    enum { MAX = 16 };
    const int rows = ROWS_OF_ONE * disks;
    const double known = 16.0 * DBL_EPSILON * fmax(1.0, (double)log->count);
    double a[MAX], b[MAX], size[MAX], all = 0.0;
    assert_true(rows <= MAX);
    MADE(hd_frame, frame, PARTICLES(disks), rows, 1, 1);
    frame_identity(frame);
    CHECK_OK(hd_frame_replay(frame, log, 0.0, log->duration));
    for (int k = 0; k < rows; k++) {
        frame_column(frame, k, a);
        size[k] = sqrt(dot(a, a, rows));
        assert_true(isfinite(size[k]));
        all = hypot(all, size[k]);
    }
    for (int k = 0; k < rows; k++)
        for (int l = 0; l < rows; l++) {
            const double sign = k % ROWS_OF_ONE < HD_DIM ? 1.0 : -1.0; /* of dq, of dp */
            const double want = l == k + (int)sign * HD_DIM ? sign : 0.0;
            frame_column(frame, k, a);
            frame_column(frame, l, b);
            CHECK_CLOSE(symplectic(a, b, rows), want, known * all * (size[k] + size[l]));
        }
    return all;
}

#endif
