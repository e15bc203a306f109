/** Triangles beside each other. */
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

static inline void check_same_triangle(const double *got, const double *want, int n)
{
    for (int row = 0; row < n; row++)
        assert_memory_equal(got + row * (n + 1), want + row * (n + 1),
                            (size_t)(n - row) * sizeof *got);
}

#endif
