/** Frame -> (Q, ln diag R) by eight methods.
 *
 * For BLAS the row-major frame V (m x n) is the column-major n x m matrix A = V^T:
 * G = A A^T = L L^T, Q^T = L^-1 A. */
#include "factor.h"

#include <cblas.h>
#include <float.h>
#include "tangent/ortho.h"
#include <lapacke.h>
#include <math.h>

#include "base/check.h"
#include "columns.h"
#include "tangent/interval.h"
#include "timing.h"

/** The loss of orthogonality that hd_run allows between measured states. */
static const double DEFECT_LOOSE = 0.1;

struct factor {
    factor_method method;
    int m, n;
    double *log_stretch;           /**< [n] */
    double *gram;                  /**< [n * n]: lower triangle, column-major */
    float *gram_single, *v_single; /**< [n * n], [m * stride] */
    columns x;
    hd_ortho *ortho;
    double seconds;
};

static const char *const NAMES[FACTOR_METHODS] = {"ours",           "ours_dq",     "cholesky",
                                                  "cholesky_twice", "mixed",       "single",
                                                  "householder",    "gram_schmidt"};

const char *factor_name(factor_method method) { return NAMES[method]; }

factor *factor_create(factor_method method, int rows, int vectors)
{
    const size_t n = (size_t)vectors, stride = n + 8;
    factor *f = room(1, sizeof *f);
    f->method = method;
    f->m = rows;
    f->n = vectors;
    f->log_stretch = room(n, sizeof(double));
    if (method <= FACTOR_OURS_DQ)
        require(hd_ortho_create(&f->ortho, rows, vectors), "factorisation");
    if (method >= FACTOR_HOUSEHOLDER) f->x = columns_create(rows, vectors);
    if (method >= FACTOR_CHOLESKY && method <= FACTOR_SINGLE) f->gram = room(n * n, sizeof(double));
    if (method == FACTOR_MIXED || method == FACTOR_SINGLE) {
        f->gram_single = room(n * n, sizeof(float));
        f->v_single = room((size_t)rows * stride, sizeof(float));
    }
    return f;
}

void factor_free(factor *f)
{
    free(f->log_stretch);
    free(f->gram);
    free(f->gram_single);
    free(f->v_single);
    columns_free(&f->x);
    hd_ortho_free(f->ortho);
    free(f);
}

/* ---- Cholesky ------------------------------------------------------------------------------ */

static hd_status pass_double(factor *f, hd_frame *frame)
{
    const int m = f->m, n = f->n, stride = hd_frame_stride(frame);
    double *a = hd_frame_data(frame);
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, n, m, 1.0, a, stride, 0.0, f->gram, n);
    for (int l = 0; l < n; l++) /* LAPACK must not get NaN */
        if (!(f->gram[(size_t)l * (size_t)(n + 1)] < INFINITY)) return HD_ILL_CONDITIONED;
    if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', n, f->gram, n) != 0) return HD_ILL_CONDITIONED;
    for (int l = 0; l < n; l++) f->log_stretch[l] += log(f->gram[(size_t)l * (size_t)(n + 1)]);
    if (LAPACKE_dtrtri_work(LAPACK_COL_MAJOR, 'L', 'N', n, f->gram, n) != 0)
        return HD_ILL_CONDITIONED;
    cblas_dtrmm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, n, m, 1.0,
                f->gram, n, a, stride);
    return HD_OK;
}

/** Copies V to v_single and computes its L^-1 in gram_single. V will be multiplied by this
 * triangle, so its diagonal gives exact logarithms, however roughly the triangle was computed. */
static hd_status triangle_single(factor *f, hd_frame *frame)
{
    const int m = f->m, n = f->n, stride = hd_frame_stride(frame);
    const double *a = hd_frame_read(frame);
#pragma omp parallel for
    for (int row = 0; row < m; row++)
        for (int k = row * stride; k < (row + 1) * stride; k++) f->v_single[k] = (float)a[k];
    cblas_ssyrk(CblasColMajor, CblasLower, CblasNoTrans, n, m, 1.0f, f->v_single, stride, 0.0f,
                f->gram_single, n);
    for (int l = 0; l < n; l++)
        if (!(f->gram_single[(size_t)l * (size_t)(n + 1)] < INFINITY)) return HD_ILL_CONDITIONED;
    if (LAPACKE_spotrf_work(LAPACK_COL_MAJOR, 'L', n, f->gram_single, n) != 0 ||
        LAPACKE_strtri_work(LAPACK_COL_MAJOR, 'L', 'N', n, f->gram_single, n) != 0)
        return HD_ILL_CONDITIONED;
    for (int l = 0; l < n; l++)
        f->log_stretch[l] -= log((double)f->gram_single[(size_t)l * (size_t)(n + 1)]);
    return HD_OK;
}

static hd_status pass_mixed(factor *f, hd_frame *frame)
{
    const int n = f->n;
    HD_TRY(triangle_single(f, frame));
#pragma omp parallel for
    for (int col = 0; col < n; col++)
        for (int k = col * n + col; k < (col + 1) * n; k++) f->gram[k] = (double)f->gram_single[k];
    cblas_dtrmm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, n, f->m, 1.0,
                f->gram, n, hd_frame_data(frame), hd_frame_stride(frame));
    return HD_OK;
}

static hd_status pass_single(factor *f, hd_frame *frame)
{
    const int m = f->m, n = f->n, stride = hd_frame_stride(frame);
    double *a = hd_frame_data(frame);
    HD_TRY(triangle_single(f, frame));
    cblas_strmm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, n, m, 1.0f,
                f->gram_single, n, f->v_single, stride);
#pragma omp parallel for
    for (int row = 0; row < m; row++)
        for (int k = row * stride; k < (row + 1) * stride; k++) a[k] = (double)f->v_single[k];
    return HD_OK;
}

/* ---- the others ---------------------------------------------------------------------------- */

/** Orthonormalises as hd_run does, with the condition that it accepts at the loosest accuracy. */
static hd_status step_ours(factor *f, hd_frame *frame, double interval, int last)
{
    const hd_interval loosest = {.accuracy = 1.0, .last = interval};
    const hd_ortho_limits limits = {
        hd_interval_condition_max(&loosest, interval), last ? DBL_EPSILON : DEFECT_LOOSE,
        f->method == FACTOR_OURS_DQ && !last ? HD_NORM_DQ : HD_NORM_FULL};
    HD_TRY(hd_ortho_step(f->ortho, frame, limits));
    for (int l = 0; l < f->n; l++) f->log_stretch[l] = hd_ortho_log_stretch(f->ortho)[l];
    return HD_OK;
}

/** Copies a row-major frame into columns, or back. This time does not count as the method's. */
static void transpose(columns *x, hd_frame *frame, int back)
{
    const size_t stride = (size_t)hd_frame_stride(frame), m = (size_t)x->rows, n = (size_t)x->n;
    double *a = hd_frame_data(frame);
    for (size_t row = 0; row < m; row++)
        for (size_t l = 0; l < n; l++)
            if (back)
                a[row * stride + l] = x->v[l * m + row];
            else
                x->v[l * m + row] = a[row * stride + l];
}

static hd_status step_columns(factor *f, hd_frame *frame)
{
    transpose(&f->x, frame, 0);
    const double start = seconds();
    if (f->method == FACTOR_HOUSEHOLDER)
        columns_householder(&f->x);
    else
        columns_gram_schmidt(&f->x);
    f->seconds += seconds() - start;
    transpose(&f->x, frame, 1);
    for (int l = 0; l < f->n; l++) f->log_stretch[l] = f->x.log_stretch[l];
    return HD_OK;
}

static hd_status step_on_frame(factor *f, hd_frame *frame, double interval, int last)
{
    switch (f->method) {
    case FACTOR_OURS:
    case FACTOR_OURS_DQ: return step_ours(f, frame, interval, last);
    case FACTOR_CHOLESKY: return pass_double(f, frame);
    case FACTOR_MIXED: HD_TRY(pass_mixed(f, frame)); break;
    case FACTOR_SINGLE: HD_TRY(pass_single(f, frame)); break;
    default: HD_TRY(pass_double(f, frame)); break;
    }
    return last || f->method == FACTOR_CHOLESKY_TWICE ? pass_double(f, frame) : HD_OK;
}

hd_status factor_step(factor *f, hd_frame *frame, double interval, int last)
{
    for (int l = 0; l < f->n; l++) f->log_stretch[l] = 0.0;
    if (f->method >= FACTOR_HOUSEHOLDER) return step_columns(f, frame);
    const double start = seconds();
    const hd_status status = step_on_frame(f, frame, interval, last);
    f->seconds += seconds() - start;
    return status;
}

const double *factor_log_stretch(const factor *f) { return f->log_stretch; }
double factor_seconds(const factor *f) { return f->seconds; }
