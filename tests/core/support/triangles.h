/** Triangles beside each other, and how well two ways of computing one can agree. */
#ifndef HD_TRIANGLES_H
#define HD_TRIANGLES_H

#include "testing.h"

/** Row-major copy of R, to be freed; zeros below the diagonal. */
static inline double *triangle_copy(const double *factor, int n)
{
    double *copy = calloc((size_t)n * (size_t)n, sizeof *copy);
    assert_non_null(copy);
    for (int row = 0; row < n; row++)
        memcpy(copy + row * (n + 1), factor + row * (n + 1), (size_t)(n - row) * sizeof *copy);
    return copy;
}

/** Column l of R is Q^T V e_l: what rounding does to Q, relative, it does to that column relative
 * to its length. */
static inline void check_triangle(const double *got, const double *want, int n, double rounding)
{
    for (int col = 0; col < n; col++) {
        double length = 0.0;
        for (int row = 0; row <= col; row++) length = hypot(length, want[row * n + col]);
        for (int row = 0; row <= col; row++)
            CHECK_CLOSE(got[row * n + col], want[row * n + col], rounding * length);
    }
}

static inline void check_same_triangle(const double *got, const double *want, int n)
{
    for (int row = 0; row < n; row++)
        assert_memory_equal(got + row * (n + 1), want + row * (n + 1),
                            (size_t)(n - row) * sizeof *got);
}

#endif
