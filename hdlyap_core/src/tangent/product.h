/** Matrix products on all threads. */
#ifndef HD_PRODUCT_H
#define HD_PRODUCT_H

#include <cblas.h>

/** Computes what cblas_dgemm computes of column-major matrices, c[m x n] <- alpha op(a)[m x k]
 * op(b)[k x n] + beta c, on the threads that hd_blas_use_threads has set. Allocates nothing. */
void hd_dgemm(CBLAS_TRANSPOSE op_a, CBLAS_TRANSPOSE op_b, int m, int n, int k, double alpha,
              const double *a, int lda, const double *b, int ldb, double beta, double *c, int ldc);

#endif
