/** Tangent frame -> (Q, ln diag R), by Cholesky of the Gram matrix.
 *
 *  V (rows m, vectors n, row-major) is for BLAS the column-major n x m matrix A = V^T:
 *  G = A A^T (dsyrk), G = L L^T (dpotrf), L = R^T; Q^T = L^-1 A (dtrtri, dtrmm: on n x n blocks dtrsm runs
 *  far below dgemm speed). All BLAS-3. diag(L) > 0, so Q and R are unique. The stable step factors A = L Q
 *  by reflections instead (dgelqf, dorglq). Equations [T5]-[T7]. */
#include "hdlyap/ortho.h"

#include <cblas.h>
#include <float.h>
#include <lapacke.h>
#include <math.h>

#include <stdbool.h>

#include "check.h"
#include "memory.h"

/** |Q^T Q - 1| after one pass is at most this times eps condition^2; seen: 1 to 7 [T7]. */
static const double DEFECT_PER_CONDITION2 = 16.0;

struct hd_ortho {
    int rows, vectors, stride;     /**< stride of the Gram matrix */
    double *gram;                  /**< [vectors * stride], column-major, lower triangle */
    double *norm2;                 /**< [vectors], diag(G) before it is factored */
    double *row_sum;               /**< [vectors], workspace */
    double *log_stretch;           /**< [vectors] */
    double *reflector, *workspace; /**< [vectors], [lwork]: of the stable step */
    int lwork;
    double condition, defect;
    int passes;
};

/** Entries of workspace that LAPACK wants for the stable step. */
static int stable_workspace(int rows, int vectors, int stride)
{
    double lq = 0.0, q = 0.0, unused = 0.0;
    (void)LAPACKE_dgelqf_work(LAPACK_COL_MAJOR, vectors, rows, &unused, stride, &unused, &lq, -1);
    (void)LAPACKE_dorglq_work(LAPACK_COL_MAJOR, vectors, rows, vectors, &unused, stride, &unused,
                              &q, -1);
    return (int)fmax(fmax(lq, q), vectors);
}

static hd_status ortho_allocate(hd_ortho *ortho)
{
    const size_t n = (size_t)ortho->vectors;
    ortho->lwork = stable_workspace(ortho->rows, ortho->vectors, ortho->stride);
    ortho->gram = hd_memory_alloc(n * (size_t)ortho->stride, sizeof(double));
    ortho->workspace = hd_memory_alloc((size_t)ortho->lwork, sizeof(double));
    double **arrays[] = {&ortho->norm2, &ortho->row_sum, &ortho->log_stretch, &ortho->reflector};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++)
        if (!(*arrays[k] = hd_memory_alloc(n, sizeof(double)))) return HD_NO_MEMORY;
    return ortho->gram && ortho->workspace ? HD_OK : HD_NO_MEMORY;
}

hd_status hd_ortho_create(hd_ortho **out, int rows, int vectors)
{
    HD_ASSERT(vectors >= 1 && vectors <= rows);
    hd_ortho *ortho = hd_memory_alloc(1, sizeof *ortho);
    *out = NULL;
    if (!ortho) return HD_NO_MEMORY;
    ortho->rows = rows;
    ortho->vectors = vectors;
    ortho->stride = (vectors + 7) / 8 * 8;
    const hd_status status = ortho_allocate(ortho);
    if (status == HD_OK)
        *out = ortho;
    else
        hd_ortho_free(ortho);
    return status;
}

void hd_ortho_free(hd_ortho *ortho)
{
    if (!ortho) return;
    hd_memory_free(ortho->gram);
    hd_memory_free(ortho->norm2);
    hd_memory_free(ortho->row_sum);
    hd_memory_free(ortho->log_stretch);
    hd_memory_free(ortho->reflector);
    hd_memory_free(ortho->workspace);
    hd_memory_free(ortho);
}

static size_t diagonal(const hd_ortho *ortho, int col)
{
    return (size_t)col * ((size_t)ortho->stride + 1);
}

/** gram <- lower triangle of V^T V. */
static void gram_fill(hd_ortho *ortho, hd_frame *frame)
{
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, ortho->vectors, ortho->rows, 1.0,
                hd_frame_data(frame), hd_frame_stride(frame), 0.0, ortho->gram, ortho->stride);
}

/** See hd_ortho_condition; gram holds L^-1 = R^-T, norm2 the |V e_k|^2. INFINITY where an entry is not
 *  finite. Runs down the columns: n^2 / 2 entries read once. */
static double condition_of(hd_ortho *ortho)
{
    double *sum = ortho->row_sum, worst = 0.0;
    const int n = ortho->vectors;
    for (int row = 0; row < n; row++) sum[row] = 0.0;
    for (int col = 0; col < n; col++) {
        const double *column = ortho->gram + (size_t)col * (size_t)ortho->stride;
        for (int row = col; row < n; row++)
            sum[row] += column[row] * column[row] * ortho->norm2[col];
    }
    for (int row = 0; row < n; row++) {
        if (!(sum[row] < INFINITY)) return INFINITY;
        worst = fmax(worst, sum[row]);
    }
    return sqrt(worst);
}

/** With L in gram and the |V e_k|^2 in norm2: adds ln diag R, turns L into its inverse and measures the
 *  condition. */
static hd_status examine(hd_ortho *ortho, double condition_max)
{
    const int n = ortho->vectors;
    for (int col = 0; col < n; col++)
        ortho->log_stretch[col] += log(ortho->gram[diagonal(ortho, col)]);
    if (LAPACKE_dtrtri_work(LAPACK_COL_MAJOR, 'L', 'N', n, ortho->gram, ortho->stride) != 0)
        return HD_ILL_CONDITIONED;
    ortho->condition = condition_of(ortho);
    return ortho->condition <= condition_max ? HD_OK : HD_ILL_CONDITIONED;
}

static hd_status pass(hd_ortho *ortho, hd_frame *frame, double condition_max)
{
    const int n = ortho->vectors;
    gram_fill(ortho, frame);
    for (int col = 0; col < n; col++) {
        ortho->norm2[col] = ortho->gram[diagonal(ortho, col)];
        if (!(ortho->norm2[col] < INFINITY))
            return HD_ILL_CONDITIONED; /* keeps NaN out of LAPACK */
    }
    if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', n, ortho->gram, ortho->stride) != 0)
        return HD_ILL_CONDITIONED;
    HD_TRY(examine(ortho, condition_max));
    cblas_dtrmm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, n, ortho->rows,
                1.0, ortho->gram, ortho->stride, hd_frame_data(frame), hd_frame_stride(frame));
    ortho->passes++;
    return HD_OK;
}

static void step_start(hd_ortho *ortho, const hd_frame *frame)
{
    HD_ASSERT(hd_frame_rows(frame) == ortho->rows && hd_frame_vectors(frame) == ortho->vectors);
    for (int col = 0; col < ortho->vectors; col++) ortho->log_stretch[col] = 0.0;
    ortho->passes = 0;
}

hd_status hd_ortho_step(hd_ortho *ortho, hd_frame *frame, hd_ortho_limits limits)
{
    step_start(ortho, frame);
    HD_TRY(pass(ortho, frame, limits.condition));
    const double condition = ortho->condition;
    ortho->defect = DEFECT_PER_CONDITION2 * DBL_EPSILON * condition * condition;
    if (ortho->defect > limits.defect) {
        HD_TRY(pass(ortho, frame, limits.condition));
        ortho->condition = condition;
        ortho->defect = DEFECT_PER_CONDITION2 * DBL_EPSILON;
    }
    return HD_OK;
}

/** gram <- L with a positive diagonal, norm2 <- |V e_k|^2. */
static void unpack_lq(hd_ortho *ortho, const double *a, int stride)
{
    const int n = ortho->vectors;
    for (int col = 0; col < n; col++) {
        const double *from = a + (size_t)col * (size_t)stride;
        double *to = ortho->gram + (size_t)col * (size_t)ortho->stride;
        const double sign = from[col] < 0 ? -1.0 : 1.0;
        for (int row = col; row < n; row++) {
            to[row] = sign * from[row];
            ortho->norm2[row] += from[row] * from[row];
        }
    }
}

/** Row l of Q^T (column l of the row-major frame) takes the sign of L_ll. */
static void apply_signs(const hd_ortho *ortho, double *a, int stride, const double *sign)
{
    for (int row = 0; row < ortho->rows; row++)
        for (int col = 0; col < ortho->vectors; col++)
            a[(size_t)row * (size_t)stride + (size_t)col] *= sign[col];
}

hd_status hd_ortho_step_stable(hd_ortho *ortho, hd_frame *frame, double condition_max)
{
    const int n = ortho->vectors, stride = hd_frame_stride(frame);
    double *a = hd_frame_data(frame), *sign = ortho->row_sum;
    step_start(ortho, frame);
    for (int col = 0; col < n; col++) ortho->norm2[col] = 0.0;
    if (LAPACKE_dgelqf_work(LAPACK_COL_MAJOR, n, ortho->rows, a, stride, ortho->reflector,
                            ortho->workspace, ortho->lwork) != 0)
        return HD_ILL_CONDITIONED;
    unpack_lq(ortho, a, stride);
    HD_TRY(examine(ortho, condition_max));
    for (int col = 0; col < n; col++)
        sign[col] = a[(size_t)col * (size_t)(stride + 1)] < 0 ? -1.0 : 1.0;
    if (LAPACKE_dorglq_work(LAPACK_COL_MAJOR, n, ortho->rows, n, a, stride, ortho->reflector,
                            ortho->workspace, ortho->lwork) != 0)
        return HD_ILL_CONDITIONED;
    apply_signs(ortho, a, stride, sign);
    ortho->passes = 1;
    ortho->defect = DEFECT_PER_CONDITION2 * DBL_EPSILON;
    return HD_OK;
}

const double *hd_ortho_log_stretch(const hd_ortho *ortho) { return ortho->log_stretch; }
double hd_ortho_condition(const hd_ortho *ortho) { return ortho->condition; }
double hd_ortho_defect(const hd_ortho *ortho) { return ortho->defect; }
int hd_ortho_passes(const hd_ortho *ortho) { return ortho->passes; }

double hd_ortho_defect_measured(hd_ortho *ortho, hd_frame *frame)
{
    double worst = 0.0;
    gram_fill(ortho, frame);
    for (int col = 0; col < ortho->vectors; col++)
        for (int row = col; row < ortho->vectors; row++) {
            const double g = ortho->gram[(size_t)col * (size_t)ortho->stride + (size_t)row];
            const double off = fabs(g - (row == col));
            if (!(off <= worst)) worst = off; /* NaN stays */
            if (isnan(worst)) return worst;
        }
    return worst;
}
