/** Products in pieces against sums in loops, and that threads of OpenBLAS never meet in one. */
#include <dlfcn.h>
#include <omp.h>
#include <stdatomic.h>
#include "testing.h"
#include "tangent/product.h"

static atomic_int calls, alone; /**< of cblas_dgemm; outside of parallel regions */

/** In place of the library's. */
void cblas_dgemm(CBLAS_LAYOUT layout, CBLAS_TRANSPOSE op_a, CBLAS_TRANSPOSE op_b, blasint m,
                 blasint n, blasint k, double alpha, const double *a, blasint lda, const double *b,
                 blasint ldb, double beta, double *c, blasint ldc)
{
    __typeof__(&cblas_dgemm) next;
    void *found = dlsym(RTLD_NEXT, "cblas_dgemm");
    memcpy(&next, &found, sizeof next);
    atomic_fetch_add(&calls, 1);
    atomic_fetch_add(&alone, !omp_in_parallel());
    next(layout, op_a, op_b, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc);
}

typedef struct {
    int m, n, k;
} shape;

static const double ALPHA = -0.75;

static double *numbers(size_t count)
{
    double *a = malloc(count * sizeof *a);
    assert_non_null(a);
    for (size_t i = 0; i < count; i++) a[i] = sin(1.0 + (double)i);
    return a;
}

/** Entry (row, col) of op(x). */
static double entry(const double *x, CBLAS_TRANSPOSE op, int ld, int row, int col)
{
    return op == CblasNoTrans ? x[(size_t)col * (size_t)ld + (size_t)row]
                              : x[(size_t)row * (size_t)ld + (size_t)col];
}

/** Each entry within what rounding k products and sums may do. What lies between columns stays;
 * with beta = 0, c is not read. */
static void check(shape s, CBLAS_TRANSPOSE op_a, CBLAS_TRANSPOSE op_b, double beta)
{
    enum { GAP = 3 };
    const int lda = (op_a == CblasNoTrans ? s.m : s.k) + GAP,
              ldb = (op_b == CblasNoTrans ? s.k : s.n) + GAP, ldc = s.m + GAP;
    HEAP double *a = numbers((size_t)lda * (size_t)(op_a == CblasNoTrans ? s.k : s.m)),
                *b = numbers((size_t)ldb * (size_t)(op_b == CblasNoTrans ? s.n : s.k)),
                *c = numbers((size_t)ldc * (size_t)s.n),
                *before = numbers((size_t)ldc * (size_t)s.n);
    if (beta == 0.0) c[0] = NAN;
    hd_dgemm(op_a, op_b, s.m, s.n, s.k, ALPHA, a, lda, b, ldb, beta, c, ldc);
    for (int col = 0; col < s.n; col++)
        for (int row = 0; row < ldc; row++) {
            const size_t at = (size_t)col * (size_t)ldc + (size_t)row;
            double sum = beta * before[at], size = fabs(sum);
            for (int i = 0; i < s.k && row < s.m; i++) {
                const double term = entry(a, op_a, lda, row, i) * entry(b, op_b, ldb, i, col);
                sum += ALPHA * term;
                size += fabs(ALPHA * term);
            }
            if (row < s.m)
                assert_true(fabs(c[at] - sum) <= (s.k + 3) * DBL_EPSILON * size);
            else
                assert_true(c[at] == before[at]);
        }
}

static const shape SHAPES[] = {{1, 1, 1},    {5, 3, 2},      {17, 400, 160}, {704, 33, 70},
                               {100, 7, 96}, {50, 1700, 60}, {1700, 47, 60}, {801, 1203, 4}};

TEST(every_shape)
{
    for (int threads = 1; threads <= 6; threads++) {
        hd_blas_use_threads(threads);
        for (size_t k = 0; k < sizeof SHAPES / sizeof *SHAPES; k++)
            for (int op = 0; op < 4; op++)
                check(SHAPES[k], op & 1 ? CblasTrans : CblasNoTrans,
                      op & 2 ? CblasTrans : CblasNoTrans, op == 1 ? 0.0 : 0.5);
    }
}

/** Calls for one product; all of them in a parallel region, or one. */
static int pieces(shape s)
{
    atomic_store(&calls, 0);
    atomic_store(&alone, 0);
    check(s, CblasNoTrans, CblasTrans, 1.0);
    assert_true(calls == 1 || alone == 0);
    return calls;
}

TEST(a_piece_is_of_one_thread)
{
    const shape small = {64, 64, 64}, next = {192, 64, 22}, even = {320, 160, 60},
                large = {704, 1500, 8};
    const bool openmp = strcmp(hd_blas_query().threading, "openmp") == 0;
    for (int threads = 1; threads <= 4; threads++) {
        hd_blas_use_threads(threads);
        const bool cut = openmp && threads > 1;
        assert_int_equal(pieces(small), 1);
        assert_int_equal(pieces(next), cut ? threads : 1);
        assert_int_equal(pieces(even), cut ? threads : 1);
        assert_int_equal(pieces(large), cut ? 4 * threads : 1);
    }
}
