/** Two sets of columns -> principal angles between what they span, by Bjoerck and Golub [T17].
 *
 * Q_a, Q_b: orthonormal bases by dgeqrf. The singular values of Q_a^T Q_b are the cosines; those
 * of Q_b - Q_a (Q_a^T Q_b) are the sines. Angles below pi / 4 are taken from sines, because cosines
 * near 1 have lost their digits. */
#include "covariant/angles.h"

#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "tangent/product.h"

struct hd_angles {
    int rows, widest;
    double *basis[2]; /**< [rows * widest] each */
    double *product;  /**< [widest * widest] */
    double *value[2]; /**< [widest]: sines; cosines, and before them scalars of reflectors */
    double *work;
    int lwork;
};

/** Workspace that LAPACK asks for, in entries. */
static int workspace(int rows, int widest)
{
    double qr = 0.0, q = 0.0, svd = 0.0, unused = 0.0;
    (void)LAPACKE_dgeqrf_work(LAPACK_COL_MAJOR, rows, widest, &unused, rows, &unused, &qr, -1);
    (void)LAPACKE_dorgqr_work(LAPACK_COL_MAJOR, rows, widest, widest, &unused, rows, &unused, &q,
                              -1);
    (void)LAPACKE_dgesvd_work(LAPACK_COL_MAJOR, 'N', 'N', rows, widest, &unused, rows, &unused,
                              &unused, 1, &unused, 1, &svd, -1);
    return (int)fmax(fmax(qr, q), svd);
}

hd_status hd_angles_create(hd_angles **out, int rows, int widest)
{
    HD_ASSERT(widest >= 1 && widest <= rows);
    hd_angles *angles = hd_memory_alloc(1, sizeof *angles);
    const size_t wide = (size_t)widest, all = (size_t)rows * wide;
    *out = NULL;
    if (!angles) return HD_NO_MEMORY;
    angles->rows = rows;
    angles->widest = widest;
    angles->lwork = workspace(rows, widest);
    double **const array[] = {&angles->basis[0], &angles->basis[1], &angles->product,
                              &angles->value[0], &angles->value[1], &angles->work};
    const size_t size[] = {all, all, wide * wide, wide, wide, (size_t)angles->lwork};
    for (size_t k = 0; k < sizeof size / sizeof *size; k++)
        if (!(*array[k] = hd_memory_alloc(size[k], sizeof(double)))) {
            hd_angles_free(angles);
            return HD_NO_MEMORY;
        }
    *out = angles;
    return HD_OK;
}

void hd_angles_free(hd_angles *angles)
{
    if (!angles) return;
    for (int k = 0; k < 2; k++) {
        hd_memory_free(angles->basis[k]);
        hd_memory_free(angles->value[k]);
    }
    hd_memory_free(angles->product);
    hd_memory_free(angles->work);
    hd_memory_free(angles);
}

/** basis <- an orthonormal basis of the span. Refuses columns that are not finite, which LAPACK
 * does not handle. */
static hd_status orthonormalise(hd_angles *angles, double *basis, const double *c, hd_span span)
{
    const int rows = angles->rows;
    double *tau = angles->value[1];
    memcpy(basis, c + (size_t)span.first * (size_t)rows,
           (size_t)span.count * (size_t)rows * sizeof *basis);
    for (int col = 0; col < span.count; col++) {
        double *column = basis + (size_t)col * (size_t)rows;
        const double length = cblas_dnrm2(rows, column, 1);
        if (!(length > 0 && length < INFINITY)) return HD_ILL_CONDITIONED;
        cblas_dscal(rows, 1.0 / length, column, 1);
    }
    (void)LAPACKE_dgeqrf_work(LAPACK_COL_MAJOR, rows, span.count, basis, rows, tau, angles->work,
                              angles->lwork);
    for (int col = 0; col < span.count; col++)
        if (!(fabs(basis[(size_t)col * (size_t)(rows + 1)]) > DBL_EPSILON))
            return HD_ILL_CONDITIONED;
    (void)LAPACKE_dorgqr_work(LAPACK_COL_MAJOR, rows, span.count, span.count, basis, rows, tau,
                              angles->work, angles->lwork);
    return HD_OK;
}

/** value <- singular values, largest first; overwrites the matrix. */
static hd_status singular_values(hd_angles *angles, double *value, double *matrix, int rows,
                                 int columns)
{
    double unused = 0.0;
    return LAPACKE_dgesvd_work(LAPACK_COL_MAJOR, 'N', 'N', rows, columns, matrix, rows, value,
                               &unused, 1, &unused, 1, angles->work, angles->lwork) == 0
               ? HD_OK
               : HD_ILL_CONDITIONED;
}

static void angles_of(const hd_angles *angles, double *angle, int count)
{
    for (int k = 0; k < count; k++) {
        const double small = angles->value[0][count - 1 - k];
        angle[k] = small < sqrt(0.5) ? asin(small) : acos(fmin(angles->value[1][k], 1.0));
    }
}

hd_status hd_angles_between(hd_angles *angles, double *angle, const double *c, hd_span a, hd_span b)
{
    const int rows = angles->rows;
    if (a.count < b.count) return hd_angles_between(angles, angle, c, b, a);
    HD_ASSERT(b.count >= 1 && a.count <= angles->widest);
    double *qa = angles->basis[0], *qb = angles->basis[1], *sine = angles->value[0],
           *cosine = angles->value[1];
    HD_TRY(orthonormalise(angles, qa, c, a));
    HD_TRY(orthonormalise(angles, qb, c, b));
    hd_dgemm(CblasTrans, CblasNoTrans, a.count, b.count, rows, 1.0, qa, rows, qb, rows, 0.0,
             angles->product, a.count);
    hd_dgemm(CblasNoTrans, CblasNoTrans, rows, b.count, a.count, -1.0, qa, rows, angles->product,
             a.count, 1.0, qb, rows);
    HD_TRY(singular_values(angles, sine, qb, rows, b.count));
    HD_TRY(singular_values(angles, cosine, angles->product, a.count, b.count));
    angles_of(angles, angle, b.count);
    return HD_OK;
}

/** Q_a are unit vectors: Q_a^T Q_b is the first rows of Q_b, Q_b - Q_a Q_a^T Q_b the others. */
hd_status hd_angles_leading(hd_angles *angles, double *angle, const double *c, int count, hd_span b)
{
    const size_t rows = (size_t)angles->rows, first = (size_t)count, later = rows - first;
    HD_ASSERT(b.count >= 1 && b.count <= angles->widest && b.count <= count &&
              b.count <= angles->rows - count);
    double *upper = angles->basis[0], *lower = angles->basis[1];
    for (size_t k = 0; k < first; k++)
        if (!(fabs(c[k * (rows + 1)]) > 0)) return HD_ILL_CONDITIONED;
    HD_TRY(orthonormalise(angles, lower, c, b));
    for (size_t col = 0; col < (size_t)b.count; col++) {
        memcpy(upper + col * first, lower + col * rows, first * sizeof *upper);
        memmove(lower + col * later, lower + col * rows + first, later * sizeof *lower);
    }
    HD_TRY(singular_values(angles, angles->value[0], lower, (int)later, b.count));
    HD_TRY(singular_values(angles, angles->value[1], upper, count, b.count));
    angles_of(angles, angle, b.count);
    return HD_OK;
}
