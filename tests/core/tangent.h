/** Single columns of a tangent frame, and the symplectic product that the maps keep. */
#ifndef HD_TANGENT_H
#define HD_TANGENT_H

#include "hdlyap/frame.h"

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
    for (int i = 0; i < rows; i += 4)
        for (int c = 0; c < 2; c++) sum += a[i + c] * b[i + 2 + c] - a[i + 2 + c] * b[i + c];
    return sum;
}

#endif
