/** Tangent frame between two orthonormalisations -> its slowest Lyapunov vectors.
 *
 * The last columns of Q = V R^-1 span the same nested spaces as those of V G^-1, G = V^T V. With U
 * and P the dq and dp halves of V, completed to square matrices by the neutral vectors dp = e_x,
 * e_y, p, G = P^T (1 + S^T S) P,  S = U P^-1, so that c = G^-1 e is found from an LU factorisation
 * of P (half of the rows, a third of the flops of a Cholesky factorisation, and with the condition,
 * not its square, at stake: single precision will do) and a few conjugate gradient steps: dq = S
 * dp, and the largest values of S, the inverse curvatures, belong to the slow vectors themselves.
 * All of them are iterated as one block [T16].
 *
 * Everything large lies in the frame's own memory. It is turned into single precision by halves;
 * each leaves as much room as it takes: U goes there from the first, P from the second; then the
 * rooms where they came from are free for the blocks of vectors. Blocks are column-major, 2N x
 * block, slowest vector first. */
#include "tangent/slow_vectors.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "scene/null_space.h"

/** Of a unit right-hand side; the vectors are then off by about as much. */
static const double RESIDUAL = 3e-3;
enum { STEPS_MAX = 12 };

struct hd_slow_vectors {
    int disks, vectors;
    int order;             /**< 2N */
    hd_null_space neutral; /**< vectors that complete the frame */
    int count_max, count;  /**< of vectors found */
    int stride, threads;   /**< of the frame */
    lapack_int *pivot;     /**< [order] */
    double *column;        /**< [4N][count_max + neutral], row-major */
    double *small[3];      /**< [block * block] */
    float *single;         /**< [block * block] */
    /** [stride columns][order]: U^T, and the factors of P^T; in the frame */
    float *u, *p;
    float *x, *r, *d, *w, *a; /**< [block][order], in the frame */
};

/* ---- creation ------------------------------------------------------------------------------ */

static int block_of(const hd_slow_vectors *slow) { return slow->count + slow->neutral.count; }

static hd_status allocate(hd_slow_vectors *slow)
{
    const size_t block = (size_t)(slow->count_max + slow->neutral.count);
    slow->pivot = hd_memory_alloc((size_t)slow->order, sizeof *slow->pivot);
    slow->column = hd_memory_alloc(4 * (size_t)slow->disks * block, sizeof *slow->column);
    slow->single = hd_memory_alloc(block * block, sizeof *slow->single);
    for (int k = 0; k < 3; k++)
        if (!(slow->small[k] = hd_memory_alloc(block * block, sizeof(double)))) return HD_NO_MEMORY;
    return slow->pivot && slow->column && slow->single ? HD_OK : HD_NO_MEMORY;
}

hd_status hd_slow_vectors_create(hd_slow_vectors **out, const hd_scene_def *def, int count_max)
{
    enum { VECTORS_MIN = 64 }; /* below, an orthonormalisation is as fast */
    *out = NULL;
    hd_slow_vectors *slow = hd_memory_alloc(1, sizeof *slow);
    if (!slow) return HD_NO_MEMORY;
    slow->disks = def->disks;
    slow->order = 2 * def->disks;
    slow->vectors = hd_scene_vectors(def);
    slow->count_max = count_max;
    slow->neutral = hd_null_space_of(def->boundary);
    const bool square = slow->vectors + slow->neutral.count == slow->order;
    const bool roomy = 3 * (count_max + slow->neutral.count) <= slow->vectors;
    hd_status status = square && roomy && slow->vectors >= VECTORS_MIN ? HD_OK : HD_REFUSED;
    if (status == HD_OK) status = allocate(slow);
    if (status == HD_OK)
        *out = slow;
    else
        hd_slow_vectors_free(slow);
    return status;
}

void hd_slow_vectors_free(hd_slow_vectors *slow)
{
    if (!slow) return;
    hd_memory_free(slow->pivot);
    hd_memory_free(slow->column);
    hd_memory_free(slow->single);
    for (int k = 0; k < 3; k++) hd_memory_free(slow->small[k]);
    hd_memory_free(slow);
}

int hd_slow_vectors_count_max(const hd_slow_vectors *slow) { return slow->count_max; }

hd_columns hd_slow_vectors_columns(const hd_slow_vectors *slow)
{
    return (hd_columns){slow->column, block_of(slow), slow->vectors - slow->count, slow->count};
}

/* ---- the frame in single precision --------------------------------------------------------- */

/** Half of the rows (0 or 1), in place: [row][stride] doubles become [row][stride] floats. */
static void halve(const hd_slow_vectors *slow, double *data, int half)
{
    const size_t size = (size_t)slow->order * (size_t)slow->stride;
    const double *from = data + (size_t)half * size;
    unsigned char *to = (unsigned char *)(data + (size_t)half * size);
    for (size_t k = 0; k < size; k++) {
        const float value = (float)from[k];
        memcpy(to + k * sizeof value, &value, sizeof value); /* never ahead of the reading */
    }
}

/** Row j of U^T (component 0) or P^T (component 2), as the halves hold it. */
static const float *single_row(const hd_slow_vectors *slow, const double *data, int component,
                               int j)
{
    const int row = 4 * (j / 2) + component + j % 2, half = row / slow->order;
    const size_t size = (size_t)slow->order * (size_t)slow->stride;
    return (const float *)(data + (size_t)half * size) +
           (size_t)(row - half * slow->order) * (size_t)slow->stride;
}

/** Entries of the neutral vectors in one row of P^T; of unit length. */
static void neutral_row(const hd_slow_vectors *slow, float *row, int j, const double *p,
                        double p_norm)
{
    for (int e = 0; e < slow->neutral.count; e++) {
        const int axis = slow->neutral.axis[e];
        const double norm = axis == HD_NULL_P ? p_norm : sqrt(slow->disks);
        row[slow->vectors + e] = (float)(hd_null_entry(axis, j % 2, p[j]) / norm);
    }
}

/** Lays the frame out as u, p and free blocks. */
static void take_apart(hd_slow_vectors *slow, double *data, const double *p)
{
    const size_t h = (size_t)slow->order, stride = (size_t)slow->stride, size = h * stride;
    const double p_norm = cblas_dnrm2(slow->order, p, 1);
    float *free_u = (float *)data + size, *free_p = (float *)(data + size) + size;
#pragma omp parallel for num_threads(slow->threads) if (slow->threads > 1)
    for (int half = 0; half < 2; half++) halve(slow, data, half);
#pragma omp parallel for num_threads(slow->threads) if (slow->threads > 1)
    for (int j = 0; j < slow->order; j++) {
        float *row = free_p + (size_t)j * stride;
        memcpy(free_u + (size_t)j * stride, single_row(slow, data, 0, j), stride * sizeof *row);
        memcpy(row, single_row(slow, data, 2, j), stride * sizeof *row);
        neutral_row(slow, row, j, p, p_norm);
    }
    const size_t block = h * (size_t)block_of(slow);
    slow->u = free_u;
    slow->p = free_p;
    slow->x = (float *)data, slow->r = slow->x + block, slow->d = slow->r + block;
    slow->w = (float *)(data + size), slow->a = slow->w + block;
}

/* ---- products ------------------------------------------------------------------------------ */

/** x <- P^-T x, or P^-1 x. */
static void solve(const hd_slow_vectors *slow, char transpose, float *x)
{
    const int h = slow->order;
    const lapack_int failed = LAPACKE_sgetrs_work(LAPACK_COL_MAJOR, transpose == 'T' ? 'N' : 'T', h,
                                                  block_of(slow), slow->p, slow->stride,
                                                  slow->pivot, x, h);
    HD_ASSERT(failed == 0);
}

/** y <- U x, or U^T x. */
static void times_u(const hd_slow_vectors *slow, char transpose, const float *x, float *y)
{
    const int h = slow->order;
    cblas_sgemm(CblasColMajor, transpose == 'T' ? CblasNoTrans : CblasTrans, CblasNoTrans, h,
                block_of(slow), h, 1.0F, slow->u, slow->stride, x, h, 0.0F, y, h);
}

/** w <- (1 + S^T S) d; a is overwritten. */
static void apply(hd_slow_vectors *slow)
{
    const size_t size = (size_t)slow->order * (size_t)block_of(slow);
    memcpy(slow->w, slow->d, size * sizeof *slow->w);
    solve(slow, 'N', slow->w);
    times_u(slow, 'N', slow->w, slow->a);
    times_u(slow, 'T', slow->a, slow->w);
    solve(slow, 'T', slow->w);
    for (size_t k = 0; k < size; k++) slow->w[k] += slow->d[k];
}

/** small <- x^T y, block x block. */
static void inner(const hd_slow_vectors *slow, const float *x, const float *y, double *small)
{
    const int h = slow->order, k = block_of(slow);
    cblas_sgemm(CblasColMajor, CblasTrans, CblasNoTrans, k, k, h, 1.0F, x, h, y, h, 0.0F,
                slow->single, k);
    for (int e = 0; e < k * k; e++) small[e] = slow->single[e];
}

/** y <- y + sign x small. */
static void add_product(const hd_slow_vectors *slow, float *y, float sign, const float *x,
                        const double *small)
{
    const int h = slow->order, k = block_of(slow);
    for (int e = 0; e < k * k; e++) slow->single[e] = (float)small[e];
    cblas_sgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, h, k, k, sign, x, h, slow->single, k,
                1.0F, y, h);
}

/* ---- conjugate gradients ------------------------------------------------------------------- */

/** x <- x T^-1 with T upper triangular and x T^-1 orthonormal: keeps the spans of the leading
 * columns. */
static hd_status orthonormalise(hd_slow_vectors *slow, float *x)
{
    const int h = slow->order, k = block_of(slow);
    double *gram = slow->small[0];
    for (int pass = 0; pass < 2; pass++) {
        inner(slow, x, x, gram);
        if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'U', k, gram, k) != 0) return HD_ILL_CONDITIONED;
        for (int e = 0; e < k * k; e++) slow->single[e] = (float)gram[e];
        cblas_strsm(CblasColMajor, CblasRight, CblasUpper, CblasNoTrans, CblasNonUnit, h, k, 1.0F,
                    slow->single, k, x, h);
    }
    return HD_OK;
}

/** b <- a^-1 b, a symmetric positive definite and overwritten; block x block. */
static hd_status divide(const hd_slow_vectors *slow, double *a, double *b)
{
    const int k = block_of(slow);
    return LAPACKE_dposv_work(LAPACK_COL_MAJOR, 'L', k, k, a, k, b, k) == 0 ? HD_OK
                                                                            : HD_ILL_CONDITIONED;
}

static double largest_norm(const hd_slow_vectors *slow, const double *gram)
{
    double worst = 0.0;
    for (int k = 0; k < block_of(slow); k++) {
        const double square = gram[k * (block_of(slow) + 1)];
        if (!(square <= worst)) worst = square; /* NaN stays */
        if (isnan(worst)) break;
    }
    return sqrt(worst);
}

/** One step of the block method (O'Leary, Linear Algebra Appl. 29, 293 (1980)); rr = r^T r of
 * before, and of after. */
static hd_status gradient_step(hd_slow_vectors *slow, double *rr, double *other)
{
    const size_t size = (size_t)slow->order * (size_t)block_of(slow);
    const size_t bytes = (size_t)(block_of(slow) * block_of(slow)) * sizeof *rr;
    double *dw = slow->small[0];
    apply(slow);
    inner(slow, slow->d, slow->w, dw);
    memcpy(other, rr, bytes);
    HD_TRY(divide(slow, dw, other));
    add_product(slow, slow->x, 1.0F, slow->d, other);
    add_product(slow, slow->r, -1.0F, slow->w, other);
    inner(slow, slow->r, slow->r, other);
    memcpy(dw, other, bytes);
    HD_TRY(divide(slow, rr, dw));
    memcpy(slow->w, slow->r, size * sizeof *slow->w);
    add_product(slow, slow->w, 1.0F, slow->d, dw);
    memcpy(slow->d, slow->w, size * sizeof *slow->d);
    memcpy(rr, other, bytes);
    return HD_OK;
}

/** x <- (1 + S^T S)^-1 P^-T e, but for a factor that keeps the spans; e: the last unit vectors. */
static hd_status iterate(hd_slow_vectors *slow)
{
    const int h = slow->order, k = block_of(slow);
    const size_t size = (size_t)h * (size_t)k;
    memset(slow->x, 0, size * sizeof *slow->x);
    memset(slow->r, 0, size * sizeof *slow->r);
    for (int j = 0; j < k; j++) slow->r[(size_t)j * (size_t)h + (size_t)(h - 1 - j)] = 1.0F;
    solve(slow, 'T', slow->r);
    HD_TRY(orthonormalise(slow, slow->r));
    memcpy(slow->d, slow->r, size * sizeof *slow->d);
    inner(slow, slow->r, slow->r, slow->small[1]);
    for (int step = 0; step < STEPS_MAX; step++) {
        HD_TRY(gradient_step(slow, slow->small[1], slow->small[2]));
        if (largest_norm(slow, slow->small[1]) <= RESIDUAL) return HD_OK;
    }
    return HD_ILL_CONDITIONED;
}

/* ---- the vectors --------------------------------------------------------------------------- */

/** column <- (S x, x), in the order of Lyapunov indices, the neutral vectors behind. */
static void put_together(hd_slow_vectors *slow)
{
    const size_t h = (size_t)slow->order, k = (size_t)block_of(slow);
    memcpy(slow->w, slow->x, h * k * sizeof *slow->w);
    solve(slow, 'N', slow->w);
    times_u(slow, 'N', slow->w, slow->a);
    for (size_t j = 0; j < h; j++)
        for (size_t b = 0; b < k; b++) {
            double *dq = slow->column + (4 * (j / 2) + j % 2) * k + (k - 1 - b);
            dq[0] = slow->a[b * h + j];
            dq[2 * k] = slow->x[b * h + j];
        }
}

/** From the slowest to the fastest: column <- column L^-1 with L lower triangular, column^T column
 * = L^T L; by dpotrf of the matrix turned round. */
static hd_status orthonormalise_backwards(hd_slow_vectors *slow)
{
    const int k = block_of(slow), rows = 4 * slow->disks;
    double *gram = slow->small[0], *turned = slow->small[1];
    for (int pass = 0; pass < 2; pass++) {
        cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, k, rows, 1.0, slow->column, k, 0.0,
                    gram, k);
        for (int a = 0; a < k; a++)
            for (int b = a; b < k; b++) turned[(k - 1 - b) * k + (k - 1 - a)] = gram[a * k + b];
        if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', k, turned, k) != 0)
            return HD_ILL_CONDITIONED;
        for (int a = 0; a < k; a++)
            for (int b = a; b < k; b++) gram[b * k + a] = turned[(k - 1 - b) * k + (k - 1 - a)];
        cblas_dtrsm(CblasColMajor, CblasLeft, CblasUpper, CblasNoTrans, CblasNonUnit, k, rows, 1.0,
                    gram, k, slow->column, k);
    }
    return HD_OK;
}

hd_status hd_slow_vectors_measure(hd_slow_vectors *slow, hd_frame *frame, const double *p,
                                  int count)
{
    HD_ASSERT(hd_frame_vectors(frame) == slow->vectors && count >= 1 && count <= slow->count_max);
    HD_ASSERT(hd_frame_stride(frame) >= slow->order);
    slow->count = count;
    slow->stride = hd_frame_stride(frame);
    slow->threads = hd_frame_threads(frame);
    take_apart(slow, hd_frame_data(frame), p);
    if (LAPACKE_sgetrf_work(LAPACK_COL_MAJOR, slow->order, slow->order, slow->p, slow->stride,
                            slow->pivot) != 0)
        return HD_ILL_CONDITIONED;
    HD_TRY(iterate(slow));
    put_together(slow);
    return orthonormalise_backwards(slow);
}
