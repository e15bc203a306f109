/** Cuts a product into pieces, each of which one thread computes alone. OpenBLAS's own threads wait
 * for each other many times within a product, since version 0.3.27 without giving up the processor;
 * beside other jobs a product took several times as long. Pieces wait for each other only once. */
#include "tangent/product.h"

#include <stdbool.h>
#include <stddef.h>

#include "base/blas.h"

/** Up to this many multiply-adds OpenBLAS itself uses one thread. */
static const double FEW = 262144.0;
/** A piece with more entries than this may be cut once more, so that a late thread delays less. */
static const double ENTRIES_MANY = 65536.0;
enum { FINER = 4, EDGE = 16 /* rows and columns that kernels take at once, or a multiple */ };

static int least(int a, int b) { return a < b ? a : b; }

/** Edge of a piece if `size` is cut into this many. */
static int edge_of(int size, int pieces)
{
    return ((size + pieces - 1) / pieces + EDGE - 1) / EDGE * EDGE;
}

/** Number of cuts of the columns; rows are cut into `count` over it. A square piece reads least of
 * a and b. */
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
