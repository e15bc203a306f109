/** The rate of dgemm, and the floor of costs that it sets. */
#include "gemm.h"

#include <cblas.h>
#include <math.h>

#include "sample.h"
#include "timing.h"

struct gemm {
    int m, n;
    double *a, *c;
    double last;
    sample rate; /**< all measurements [flops per second] */
};

gemm *gemm_create(int m, int n)
{
    gemm *g = room(1, sizeof *g);
    g->m = m;
    g->n = n;
    g->a = room((size_t)m * (size_t)n, sizeof(double));
    g->c = room((size_t)n * (size_t)n, sizeof(double));
    for (size_t k = 0; k < (size_t)m * (size_t)n; k++) g->a[k] = 1.0 / (double)(k % 97 + 1);
    return g;
}

void gemm_free(gemm *g)
{
    free(g->a);
    free(g->c);
    free(g);
}

double gemm_measure(gemm *g)
{
    const double start = seconds();
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, g->n, g->n, g->m, 1.0, g->a, g->n, g->a,
                g->n, 0.0, g->c, g->n);
    const double taken = seconds() - start;
    g->last = 2.0 * g->m * g->n * (double)g->n / taken;
    sample_add(&g->rate, g->last);
    return taken;
}

double gemm_once(void)
{
    gemm *g = gemm_create(1000, 1000);
    gemm_measure(g);
    const double rate = g->last;
    gemm_free(g);
    return rate;
}

double gemm_last(const gemm *g) { return g->last; }
double gemm_rate(const gemm *g) { return sample_median(&g->rate); }

double gemm_floor(double rate, int m, int n, double spread)
{
    return 4.0 * m * n * (double)n / rate * spread / log(1e8);
}
