/** Triangles of intervals -> C of two starts, and the growth of the first one's vectors [T16].
 *
 * Where all vectors are carried, a start is a triangle (backward.h). Where half of them are, it is
 * the triangle C_11 of that half and the symmetric Z of the stable space, the graph of Z in the
 * coordinates (Q, J Q) [T18]; C is computed from them when it is read. Z is kept with both indices
 * reversed, column-major, upper triangle, for dsygst. The second Z is the first one plus W sign
 * W^T, of a few random directions W. */
#include "covariant/backward_pair.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "base/random.h"
#include "covariant/backward.h"

enum { PROBES = 8 };

struct hd_backward_pair {
    int vectors, half;     /**< 4N, 2N; half is 0 where all are carried */
    hd_backward *start[2]; /**< of the half */
    double *grown;         /**< [vectors] of the first, since its growth was read */
    double *told;          /**< [vectors] that was read */
    double *edge;          /**< [vectors], ln |C_ll| at its last look */
    double *z;             /**< [half * half] */
    double *probe;         /**< W, [half * PROBES], column-major, not reversed */
    double *work[2];       /**< [half * half] */
    double *whole[2];      /**< C of each, [vectors * vectors] */
    bool fresh;            /**< that of the first is of this time */
};

static hd_status allocate(hd_backward_pair *s)
{
    const size_t n = (size_t)s->vectors, m = (size_t)s->half;
    for (int k = 0; k < 2; k++)
        HD_TRY(hd_backward_create(&s->start[k], s->half ? s->half : s->vectors));
    const struct {
        double **array;
        size_t size;
    } wanted[] = {{&s->grown, n},       {&s->told, n},           {&s->edge, n},
                  {&s->z, m * m},       {&s->probe, m * PROBES}, {&s->work[0], m * m},
                  {&s->work[1], m * m}, {&s->whole[0], n * n},   {&s->whole[1], n * n}};
    const size_t count = s->half ? sizeof wanted / sizeof *wanted : 2;
    for (size_t k = 0; k < count; k++)
        if (!(*wanted[k].array = hd_memory_alloc(wanted[k].size, sizeof(double))))
            return HD_NO_MEMORY;
    return HD_OK;
}

hd_status hd_backward_pair_create(hd_backward_pair **out, int vectors, bool conjugate)
{
    hd_backward_pair *s = hd_memory_alloc(1, sizeof *s);
    *out = NULL;
    if (!s) return HD_NO_MEMORY;
    s->vectors = vectors;
    s->half = conjugate ? vectors / 2 : 0;
    const hd_status status = allocate(s);
    if (status == HD_OK)
        *out = s;
    else
        hd_backward_pair_free(s);
    return status;
}

void hd_backward_pair_free(hd_backward_pair *s)
{
    if (!s) return;
    for (int k = 0; k < 2; k++) {
        hd_backward_free(s->start[k]);
        hd_memory_free(s->work[k]);
        hd_memory_free(s->whole[k]);
    }
    double *arrays[] = {s->grown, s->told, s->edge, s->z, s->probe};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) hd_memory_free(arrays[k]);
    hd_memory_free(s);
}

/** Draws both Z, with entries of the size of C's. */
static void begin_spaces(hd_backward_pair *s, uint64_t seed, uint64_t stream)
{
    const uint64_t apart = (uint64_t)1 << 32; /* keeps these streams apart from those of C */
    const size_t m = (size_t)s->half;
    const double scale = 1.0 / sqrt(s->vectors);
    const double part = sqrt(scale / sqrt(3.0 * PROBES)) * sqrt(3.0); /* the same mean square */
    hd_random random = hd_random_seeded(seed, stream + apart);
    for (size_t k = 0; k < m * m; k++) s->z[k] = scale * hd_random_symmetric(&random);
    for (size_t k = 0; k < m * PROBES; k++) s->probe[k] = part * hd_random_symmetric(&random);
}

void hd_backward_pair_begin(hd_backward_pair *s, uint64_t seed, uint64_t stream)
{
    for (uint64_t k = 0; k < 2; k++) hd_backward_start(s->start[k], seed, stream + k);
    if (s->half) begin_spaces(s, seed, stream);
    memset(s->grown, 0, (size_t)s->vectors * sizeof *s->grown);
    s->fresh = false;
}

/* ---- a step -------------------------------------------------------------------------------- */

/** Z <- R^-1 Z R^-T - Y: reversed, R is the transpose of an upper triangle U, and this is U^-T Z
 * U^-1 - Y. */
static void step_spaces(hd_backward_pair *s, const double *factor, const double *coupling,
                        bool both)
{
    const size_t m = (size_t)s->half, last = m * m - 1;
    double *u = s->work[0];
    for (size_t k = 0; k <= last; k++) u[k] = factor[last - k];
    (void)LAPACKE_dsygst_work(LAPACK_COL_MAJOR, 1, 'U', s->half, s->z, s->half, u, s->half);
    for (size_t col = 0; col < m; col++)
        for (size_t k = col * m; k <= col * m + col; k++) s->z[k] -= coupling[last - k];
    if (both)
        cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasTrans, CblasNonUnit, s->half, PROBES,
                    1.0, factor, s->half, s->probe, s->half);
}

hd_status hd_backward_pair_step(hd_backward_pair *s, const double *factor, const double *coupling,
                                bool both)
{
    double *growth = s->told;
    const int n = s->half ? s->half : s->vectors;
    if (both) HD_TRY(hd_backward_step(s->start[1], growth, factor));
    HD_TRY(hd_backward_step(s->start[0], growth, factor));
    for (int col = 0; col < n; col++) s->grown[col] += growth[col];
    s->fresh = false;
    if (!s->half) return HD_OK;
    for (int col = 0; col < n; col++)
        s->grown[s->vectors - 1 - col] -= log(factor[(size_t)col * (size_t)(n + 1)]);
    step_spaces(s, factor, coupling, both);
    return HD_OK;
}

/* ---- a look -------------------------------------------------------------------------------- */

/** The J-dual of C_11, C_22 = C_11^-T, in the last half of C's rows, which are reversed, as its
 * columns are: an upper triangle again. Columns of length 1. */
static hd_status fill_dual(hd_backward_pair *s, double *whole, const double *c11)
{
    const size_t m = (size_t)s->half, n = (size_t)s->vectors;
    double *inverse = s->work[1];
    memcpy(inverse, c11, m * m * sizeof *inverse);
    if (LAPACKE_dtrtri_work(LAPACK_COL_MAJOR, 'U', 'N', s->half, inverse, s->half) != 0)
        return HD_ILL_CONDITIONED;
    for (size_t col = 0; col < m; col++) {
        double *to = whole + (m + col) * n + m;
        const double *from = inverse + (m - 1 - col);
        for (size_t row = 0; row <= col; row++) to[row] = from[(m - 1 - row) * m];
        const double length = cblas_dnrm2((int)col + 1, to, 1);
        if (!(length > 0 && length < INFINITY)) return HD_ILL_CONDITIONED;
        cblas_dscal((int)col + 1, 1.0 / length, to, 1);
    }
    return HD_OK;
}

/** Computes C = ((C_11, Z C_22), (0, C_22)) with columns of length 1. */
static hd_status complete(hd_backward_pair *s, double *whole, const double *c11, const double *z)
{
    const size_t m = (size_t)s->half, n = (size_t)s->vectors;
    double *product = s->work[1];
    memset(whole, 0, n * n * sizeof *whole);
    for (size_t col = 0; col < m; col++)
        memcpy(whole + col * n, c11 + col * m, (col + 1) * sizeof *whole);
    HD_TRY(fill_dual(s, whole, c11));
    cblas_dsymm(CblasColMajor, CblasLeft, CblasUpper, s->half, s->half, 1.0, z, s->half,
                whole + m * n + m, s->vectors, 0.0, product, s->half);
    for (size_t col = 0; col < m; col++) {
        double *column = whole + (m + col) * n;
        for (size_t row = 0; row < m; row++) column[row] = product[col * m + m - 1 - row];
        const double length = cblas_dnrm2(s->vectors, column, 1);
        if (!(length < INFINITY) || column[m + col] == 0.0) return HD_ILL_CONDITIONED;
        cblas_dscal(s->vectors, 1.0 / length, column, 1);
    }
    return HD_OK;
}

/** Completes the growth, which diagonals of triangles give except for those of C [T16]. */
static void end_growth(hd_backward_pair *s)
{
    for (int col = s->half; col < s->vectors; col++) {
        const double now = log(fabs(s->whole[0][(size_t)col * (size_t)(s->vectors + 1)]));
        s->grown[col] += now - s->edge[col];
        s->edge[col] = now;
    }
}

hd_status hd_backward_pair_look(hd_backward_pair *s, const double **c)
{
    *c = s->half ? s->whole[0] : hd_backward_read(s->start[0]);
    if (!s->half || s->fresh) return HD_OK;
    HD_TRY(complete(s, s->whole[0], hd_backward_read(s->start[0]), s->z));
    end_growth(s);
    s->fresh = true;
    return HD_OK;
}

/** The second Z: the first one plus W sign W^T; upper triangle, reversed. */
static double *other_space(hd_backward_pair *s)
{
    const int m = s->half;
    double *z = s->work[0];
    memcpy(z, s->z, (size_t)m * (size_t)m * sizeof *z);
    for (int k = 0; k < PROBES; k++) /* BLAS begins at the end where steps are negative */
        cblas_dsyr(CblasColMajor, CblasUpper, m, k % 2 ? -1.0 : 1.0,
                   s->probe + (size_t)k * (size_t)m, -1, z, m);
    return z;
}

hd_status hd_backward_pair_meet(hd_backward_pair *s, const double *c[2])
{
    HD_TRY(hd_backward_pair_look(s, &c[0]));
    c[1] = s->half ? s->whole[1] : hd_backward_read(s->start[1]);
    if (!s->half) return HD_OK;
    return complete(s, s->whole[1], hd_backward_read(s->start[1]), other_space(s));
}

const double *hd_backward_pair_growth(hd_backward_pair *s)
{
    memcpy(s->told, s->grown, (size_t)s->vectors * sizeof *s->told);
    memset(s->grown, 0, (size_t)s->vectors * sizeof *s->grown);
    return s->told;
}
