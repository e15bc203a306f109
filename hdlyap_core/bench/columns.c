/** V -> Q, ln |diag R|, with vectors stored one after the other. */
#include "columns.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>

#include "timing.h"

columns columns_create(int rows, int n)
{
    columns x = {.rows = rows, .n = n, .lwork = 64 * n}; /* 64: block size of LAPACK */
    x.v = room((size_t)n * (size_t)rows, sizeof(double));
    x.log_stretch = room((size_t)n, sizeof(double));
    x.tau = room((size_t)n, sizeof(double));
    x.workspace = room((size_t)x.lwork, sizeof(double));
    return x;
}

void columns_free(columns *x)
{
    free(x->v);
    free(x->log_stretch);
    free(x->tau);
    free(x->workspace);
}

void columns_householder(columns *x)
{
    const int m = x->rows, n = x->n;
    if (LAPACKE_dgeqrf_work(LAPACK_COL_MAJOR, m, n, x->v, m, x->tau, x->workspace, x->lwork) != 0)
        require(HD_ILL_CONDITIONED, "dgeqrf");
    for (int l = 0; l < n; l++) x->log_stretch[l] = log(fabs(x->v[(size_t)l * (size_t)(m + 1)]));
    if (LAPACKE_dorgqr_work(LAPACK_COL_MAJOR, m, n, n, x->v, m, x->tau, x->workspace, x->lwork) !=
        0)
        require(HD_ILL_CONDITIONED, "dorgqr");
}

void columns_gram_schmidt(columns *x)
{
    for (int l = 0; l < x->n; l++) {
        double *v = x->v + (size_t)l * (size_t)x->rows;
        const double norm = cblas_dnrm2(x->rows, v, 1);
        x->log_stretch[l] = log(norm);
        cblas_dscal(x->rows, 1.0 / norm, v, 1);
        for (int k = l + 1; k < x->n; k++) {
            double *w = x->v + (size_t)k * (size_t)x->rows;
            cblas_daxpy(x->rows, -cblas_ddot(x->rows, v, 1, w, 1), v, 1, w, 1);
        }
    }
}
