/** Product -> pieces, each of which one thread computes by itself. The threads of OpenBLAS wait for
 * each other many times within a product, from version 0.3.27 on without giving up the processor:
 * beside other jobs a product then took several times as long. Pieces wait only at the end. */
#include "tangent/product.h"

#include <stdbool.h>
#include <stddef.h>

#include "base/blas.h"

/** Multiply-adds up to which OpenBLAS itself keeps to one thread. */
static const double FEW = 262144.0;
/** Entries of a piece that may be cut once more, so that a thread which is late holds up less. */
static const double ENTRIES_MANY = 65536.0;
enum { FINER = 4, EDGE = 16 /* rows and columns that kernels take at once, or a multiple */ };

static int least(int a, int b) { return a < b ? a : b; }

/** Of `size` cut into so many. */
static int edge_of(int size, int pieces)
{
    return ((size + pieces - 1) / pieces + EDGE - 1) / EDGE * EDGE;
}

/** Into how many the columns are cut, and the rows into count over it: the squarer a piece, the
 * less of a and b it reads. */
static int cuts_of_columns(int m, int n, int count)
{
    int best = 1;
    for (int cuts = 2; cuts <= count; cuts++)
        if (count % cuts == 0 && edge_of(m, count / cuts) + edge_of(n, cuts) <
                                     edge_of(m, count / best) + edge_of(n, best))
            best = cuts;
    return best;
}

void hd_dgemm(CBLAS_TRANSPOSE op_a, CBLAS_TRANSPOSE op_b, int m, int n, int k, double alpha,
              const double *a, int lda, const double *b, int ldb, double beta, double *c, int ldc)
{
    const int threads = (double)m * n * k > FEW ? hd_blas_threads_to_share() : 1;
    const bool many = (double)m * n > ENTRIES_MANY * FINER * threads;
    const int count = threads == 1 ? 1 : many ? FINER * threads : threads;
    const int cuts = cuts_of_columns(m, n, count);
    const int height = edge_of(m, count / cuts), width = edge_of(n, cuts);
    const size_t row_of_a = op_a == CblasNoTrans ? 1 : (size_t)lda;
    const size_t column_of_b = op_b == CblasNoTrans ? (size_t)ldb : 1;
#pragma omp parallel for collapse(2) schedule(dynamic) num_threads(threads) if (threads > 1)
    for (int col = 0; col < n; col += width)
        for (int row = 0; row < m; row += height)
            cblas_dgemm(CblasColMajor, op_a, op_b, least(height, m - row), least(width, n - col), k,
                        alpha, a + (size_t)row * row_of_a, lda, b + (size_t)col * column_of_b, ldb,
                        beta, c + (size_t)col * (size_t)ldc + row, ldc);
}
