/** Tangent vectors as most programs keep them, one after the other, and how most programs
 * orthonormalise them. */
#ifndef HD_BENCH_COLUMNS_H
#define HD_BENCH_COLUMNS_H

typedef struct columns {
    int rows, n, lwork;
    double *v;               /**< [n][rows] */
    double *log_stretch;     /**< [n]: ln |R_ll| of the last factorisation */
    double *tau, *workspace; /**< [n], [lwork]: used by LAPACK */
} columns;

columns columns_create(int rows, int n);
void columns_free(columns *x);

/** Replaces V by Q of V = Q R by Householder reflections (dgeqrf, dorgqr), with LAPACK's signs. */
void columns_householder(columns *x);
/** Replaces V by Q of V = Q R by modified Gram-Schmidt, vector by vector (ddot, daxpy). */
void columns_gram_schmidt(columns *x);

#endif
