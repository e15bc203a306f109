/** Tangent frame -> (Q, ln diag R) by Householder reflections, A = L Q (dgelqf, dorglq):
 * orthonormal whatever the conditioning. Storage and equations as in ortho.c. */
#include <cblas.h>
#include <float.h>
#include <lapacke.h>
#include <math.h>

#include "tangent/ortho_state.h"

/** With L in a: norm2 <- |V e_k|^2, log_stretch <- ln |L_kk|, and the condition. */
static void examine_lq(hd_ortho *ortho, const double *a, int stride)
{
    const int n = ortho->vectors;
    hd_ortho_probes_clear(ortho);
    for (int col = 0; col < n; col++)
        for (int row = col; row < n; row++) {
            const double entry = a[(size_t)col * (size_t)stride + (size_t)row];
            ortho->norm2[row] += entry * entry;
        }
    ortho->condition = INFINITY;
    for (int k = 0; k < n; k++) {
        const double diagonal = fabs(a[(size_t)k * (size_t)(stride + 1)]);
        if (!hd_is_square(ortho->norm2[k]) || !(diagonal > 0.0)) return;
        ortho->log_stretch[k] = log(diagonal);
        for (int p = 0; p < HD_PROBES; p++)
            ortho->probe[p * n + k] = hd_probe_sign(k, p) * sqrt(ortho->norm2[k]);
    }
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, n, HD_PROBES, 1.0,
                a, stride, ortho->probe, n);
    ortho->condition = hd_ortho_condition_from_probes(ortho);
}

/** Column k of L takes the sign of L_kk. */
static void keep_lq(const hd_ortho *ortho, const double *a, int stride, const double *sign)
{
    if (!ortho->factor[0]) return;
    for (int col = 0; col < ortho->vectors; col++)
        for (int row = col; row < ortho->vectors; row++)
            ortho->factor[0][(size_t)col * (size_t)ortho->vectors + (size_t)row] =
                a[(size_t)col * (size_t)stride + (size_t)row] * sign[col];
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
    if (ortho->communicator) return hd_ortho_step_repeated(ortho, frame, condition_max);
    const int n = ortho->vectors, stride = hd_frame_stride(frame);
    double *a = hd_frame_data(frame), *sign = ortho->norm2;
    hd_ortho_begin(ortho, frame, HD_NORM_FULL);
    if (LAPACKE_dgelqf_work(LAPACK_COL_MAJOR, n, ortho->rows, a, stride, ortho->reflector,
                            ortho->projection, ortho->lwork) != 0)
        return HD_ILL_CONDITIONED;
    examine_lq(ortho, a, stride);
    if (!(ortho->condition <= condition_max)) return HD_ILL_CONDITIONED;
    for (int col = 0; col < n; col++)
        sign[col] = a[(size_t)col * (size_t)(stride + 1)] < 0 ? -1.0 : 1.0;
    keep_lq(ortho, a, stride, sign);
    if (LAPACKE_dorglq_work(LAPACK_COL_MAJOR, n, ortho->rows, n, a, stride, ortho->reflector,
                            ortho->projection, ortho->lwork) != 0)
        return HD_ILL_CONDITIONED;
    apply_signs(ortho, a, stride, sign);
    ortho->passes = 1;
    ortho->defect = DBL_EPSILON * HD_PANEL_CONDITION_LEAST * HD_PANEL_CONDITION_LEAST;
    return HD_OK;
}
