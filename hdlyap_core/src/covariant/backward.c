/** (R, C at the end of an interval) -> C at its start, and how much each vector grows in between
 * [T16].
 *
 * R is row-major, for BLAS the column-major lower triangle R^T; C is column-major. Columns s .. e
 * - 1 of C have no rows below e, so a panel of them needs the leading e x e triangle alone: n^3 / 3
 * flops, in dtrsm. */
#include "covariant/backward.h"

#include <cblas.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "base/random.h"

enum { PANEL = 96 };

struct hd_backward {
    int vectors;
    double *c; /**< [n * n] */
};

hd_status hd_backward_create(hd_backward **out, int vectors)
{
    HD_ASSERT(vectors >= 1);
    hd_backward *backward = hd_memory_alloc(1, sizeof *backward);
    *out = NULL;
    if (!backward) return HD_NO_MEMORY;
    backward->vectors = vectors;
    backward->c = hd_memory_alloc((size_t)vectors * (size_t)vectors, sizeof(double));
    if (!backward->c) {
        hd_backward_free(backward);
        return HD_NO_MEMORY;
    }
    *out = backward;
    return HD_OK;
}

void hd_backward_free(hd_backward *backward)
{
    if (!backward) return;
    hd_memory_free(backward->c);
    hd_memory_free(backward);
}

static double *column_of(const hd_backward *backward, int col)
{
    return backward->c + (size_t)col * (size_t)backward->vectors;
}

/** Scales a column to length 1, whatever its entries are; returns its length before. */
static double normalise(double *column, int count)
{
    const double length = cblas_dnrm2(count, column, 1);
    cblas_dscal(count, 1.0 / length, column, 1);
    return length;
}

void hd_backward_start(hd_backward *backward, uint64_t seed, uint64_t stream)
{
    const int n = backward->vectors;
    hd_random random = hd_random_seeded(seed, stream);
    memset(backward->c, 0, (size_t)n * (size_t)n * sizeof(double));
    for (int col = 0; col < n; col++) {
        double *column = column_of(backward, col);
        for (int row = 0; row < col; row++)
            column[row] = hd_random_symmetric(&random) / sqrt(col + 1.0);
        column[col] = 1.0;
        (void)normalise(column, col + 1);
    }
}

hd_status hd_backward_step(hd_backward *backward, double *growth, const double *factor)
{
    const int n = backward->vectors;
    for (int start = 0; start < n; start += PANEL) {
        const int end = start + PANEL < n ? start + PANEL : n;
        cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasTrans, CblasNonUnit, end,
                    end - start, 1.0, factor, n, column_of(backward, start), n);
    }
    for (int col = 0; col < n; col++) {
        double *column = column_of(backward, col);
        const double length = normalise(column, col + 1);
        const bool is_new = column[col] != 0.0; /* not in the span of the columns before it */
        if (!(length > 0 && length < INFINITY) || !is_new) return HD_ILL_CONDITIONED;
        growth[col] = -log(length);
    }
    return HD_OK;
}

double *hd_backward_data(hd_backward *backward) { return backward->c; }
const double *hd_backward_read(const hd_backward *backward) { return backward->c; }

double hd_backward_apart(const hd_backward *one, const hd_backward *other, int col)
{
    return hd_vectors_apart(column_of(one, col), column_of(other, col), col + 1);
}

double hd_vectors_apart(const double *x, const double *y, int count)
{
    const double sign = cblas_ddot(count, x, 1, y, 1) < 0 ? -1.0 : 1.0;
    double sum = 0.0; /* |x - y| = 2 sin(angle / 2): small angles keep their digits */
    for (int row = 0; row < count; row++)
        sum += (x[row] - sign * y[row]) * (x[row] - sign * y[row]);
    return sqrt(sum * fmax(0.0, 1.0 - 0.25 * sum));
}

/* ---- triangles ----------------------------------------------------------------------------- */

size_t hd_triangle_size(int vectors) { return (size_t)vectors * ((size_t)vectors + 1) / 2; }

void hd_triangle_pack(double *packed, const double *factor, int vectors)
{
    for (int row = 0; row < vectors; row++) {
        const size_t left = (size_t)(vectors - row);
        memcpy(packed, factor + (size_t)row * ((size_t)vectors + 1), left * sizeof *packed);
        packed += left;
    }
}

void hd_triangle_unpack(double *factor, const double *packed, int vectors)
{
    for (int row = 0; row < vectors; row++) {
        const size_t left = (size_t)(vectors - row);
        memcpy(factor + (size_t)row * ((size_t)vectors + 1), packed, left * sizeof *packed);
        packed += left;
    }
}
