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

/** Of a unit right-hand side; the vectors are then off by about as much. */
static const double RESIDUAL = 3e-3;
enum { STEPS_MAX = 12, NEUTRAL_MAX = 3 };

struct hd_slow_vectors {
    int disks, vectors;
    int order;             /**< 2N */
    int neutral;           /**< vectors that complete the frame */
    int axis[NEUTRAL_MAX]; /**< of each: 0, 1: e_x, e_y; 2: p */
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

static int block_of(const hd_slow_vectors *tail) { return tail->count + tail->neutral; }

static void neutral_fill(hd_slow_vectors *tail, const hd_scene_def *def)
{
    for (int d = 0; d < 2; d++)
        if (def->boundary[d] == HD_PERIODIC) tail->axis[tail->neutral++] = d;
    tail->axis[tail->neutral++] = 2;
}

static hd_status tail_allocate(hd_slow_vectors *tail)
{
    const size_t block = (size_t)(tail->count_max + tail->neutral);
    tail->pivot = hd_memory_alloc((size_t)tail->order, sizeof *tail->pivot);
    tail->column = hd_memory_alloc(4 * (size_t)tail->disks * block, sizeof *tail->column);
    tail->single = hd_memory_alloc(block * block, sizeof *tail->single);
    for (int k = 0; k < 3; k++)
        if (!(tail->small[k] = hd_memory_alloc(block * block, sizeof(double)))) return HD_NO_MEMORY;
    return tail->pivot && tail->column && tail->single ? HD_OK : HD_NO_MEMORY;
}

hd_status hd_slow_vectors_create(hd_slow_vectors **out, const hd_scene_def *def, int count_max)
{
    enum { VECTORS_MIN = 64 }; /* below, an orthonormalisation is as fast */
    *out = NULL;
    hd_slow_vectors *tail = hd_memory_alloc(1, sizeof *tail);
    if (!tail) return HD_NO_MEMORY;
    tail->disks = def->disks;
    tail->order = 2 * def->disks;
    tail->vectors = hd_scene_vectors(def);
    tail->count_max = count_max;
    neutral_fill(tail, def);
    const bool square = tail->vectors + tail->neutral == tail->order;
    const bool roomy = 3 * (count_max + tail->neutral) <= tail->vectors;
    hd_status status = square && roomy && tail->vectors >= VECTORS_MIN ? HD_OK : HD_REFUSED;
    if (status == HD_OK) status = tail_allocate(tail);
    if (status == HD_OK)
        *out = tail;
    else
        hd_slow_vectors_free(tail);
    return status;
}

void hd_slow_vectors_free(hd_slow_vectors *tail)
{
    if (!tail) return;
    hd_memory_free(tail->pivot);
    hd_memory_free(tail->column);
    hd_memory_free(tail->single);
    for (int k = 0; k < 3; k++) hd_memory_free(tail->small[k]);
    hd_memory_free(tail);
}

int hd_slow_vectors_count_max(const hd_slow_vectors *tail) { return tail->count_max; }

hd_columns hd_slow_vectors_columns(const hd_slow_vectors *tail)
{
    return (hd_columns){tail->column, block_of(tail), tail->vectors - tail->count, tail->count};
}

/* ---- the frame in single precision --------------------------------------------------------- */

/** Half of the rows (0 or 1), in place: [row][stride] doubles become [row][stride] floats. */
static void halve(const hd_slow_vectors *tail, double *data, int half)
{
    const size_t size = (size_t)tail->order * (size_t)tail->stride;
    const double *from = data + (size_t)half * size;
    unsigned char *to = (unsigned char *)(data + (size_t)half * size);
    for (size_t k = 0; k < size; k++) {
        const float value = (float)from[k];
        memcpy(to + k * sizeof value, &value, sizeof value); /* never ahead of the reading */
    }
}

/** Row j of U^T (component 0) or P^T (component 2), as the halves hold it. */
static const float *single_row(const hd_slow_vectors *tail, const double *data, int component,
                               int j)
{
    const int row = 4 * (j / 2) + component + j % 2, half = row / tail->order;
    const size_t size = (size_t)tail->order * (size_t)tail->stride;
    return (const float *)(data + (size_t)half * size) +
           (size_t)(row - half * tail->order) * (size_t)tail->stride;
}

/** Entries of the neutral vectors in one row of P^T; of unit length. */
static void neutral_row(const hd_slow_vectors *tail, float *row, int j, const double *p,
                        double p_norm)
{
    for (int e = 0; e < tail->neutral; e++) {
        const int axis = tail->axis[e];
        const double value = axis == 2 ? p[j] / p_norm : (axis == j % 2) / sqrt(tail->disks);
        row[tail->vectors + e] = (float)value;
    }
}

/** Lays the frame out as u, p and free blocks. */
static void take_apart(hd_slow_vectors *tail, double *data, const double *p)
{
    const size_t h = (size_t)tail->order, stride = (size_t)tail->stride, size = h * stride;
    const double p_norm = cblas_dnrm2(tail->order, p, 1);
    float *free_u = (float *)data + size, *free_p = (float *)(data + size) + size;
#pragma omp parallel for num_threads(tail->threads) if (tail->threads > 1)
    for (int half = 0; half < 2; half++) halve(tail, data, half);
#pragma omp parallel for num_threads(tail->threads) if (tail->threads > 1)
    for (int j = 0; j < tail->order; j++) {
        float *row = free_p + (size_t)j * stride;
        memcpy(free_u + (size_t)j * stride, single_row(tail, data, 0, j), stride * sizeof *row);
        memcpy(row, single_row(tail, data, 2, j), stride * sizeof *row);
        neutral_row(tail, row, j, p, p_norm);
    }
    const size_t block = h * (size_t)block_of(tail);
    tail->u = free_u;
    tail->p = free_p;
    tail->x = (float *)data, tail->r = tail->x + block, tail->d = tail->r + block;
    tail->w = (float *)(data + size), tail->a = tail->w + block;
}

/* ---- products ------------------------------------------------------------------------------ */

/** x <- P^-T x, or P^-1 x. */
static void solve(const hd_slow_vectors *tail, char transpose, float *x)
{
    const int h = tail->order;
    const lapack_int failed = LAPACKE_sgetrs_work(LAPACK_COL_MAJOR, transpose == 'T' ? 'N' : 'T', h,
                                                  block_of(tail), tail->p, tail->stride,
                                                  tail->pivot, x, h);
    HD_ASSERT(failed == 0);
}

/** y <- U x, or U^T x. */
static void times_u(const hd_slow_vectors *tail, char transpose, const float *x, float *y)
{
    const int h = tail->order;
    cblas_sgemm(CblasColMajor, transpose == 'T' ? CblasNoTrans : CblasTrans, CblasNoTrans, h,
                block_of(tail), h, 1.0F, tail->u, tail->stride, x, h, 0.0F, y, h);
}

/** w <- (1 + S^T S) d; a is overwritten. */
static void apply(hd_slow_vectors *tail)
{
    const size_t size = (size_t)tail->order * (size_t)block_of(tail);
    memcpy(tail->w, tail->d, size * sizeof *tail->w);
    solve(tail, 'N', tail->w);
    times_u(tail, 'N', tail->w, tail->a);
    times_u(tail, 'T', tail->a, tail->w);
    solve(tail, 'T', tail->w);
    for (size_t k = 0; k < size; k++) tail->w[k] += tail->d[k];
}

/** small <- x^T y, block x block. */
static void inner(const hd_slow_vectors *tail, const float *x, const float *y, double *small)
{
    const int h = tail->order, k = block_of(tail);
    cblas_sgemm(CblasColMajor, CblasTrans, CblasNoTrans, k, k, h, 1.0F, x, h, y, h, 0.0F,
                tail->single, k);
    for (int e = 0; e < k * k; e++) small[e] = tail->single[e];
}

/** y <- y + sign x small. */
static void add_product(const hd_slow_vectors *tail, float *y, float sign, const float *x,
                        const double *small)
{
    const int h = tail->order, k = block_of(tail);
    for (int e = 0; e < k * k; e++) tail->single[e] = (float)small[e];
    cblas_sgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, h, k, k, sign, x, h, tail->single, k,
                1.0F, y, h);
}

/* ---- conjugate gradients ------------------------------------------------------------------- */

/** x <- x T^-1 with T upper triangular and x T^-1 orthonormal: keeps the spans of the leading
 * columns. */
static hd_status orthonormalise(hd_slow_vectors *tail, float *x)
{
    const int h = tail->order, k = block_of(tail);
    double *gram = tail->small[0];
    for (int pass = 0; pass < 2; pass++) {
        inner(tail, x, x, gram);
        if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'U', k, gram, k) != 0) return HD_ILL_CONDITIONED;
        for (int e = 0; e < k * k; e++) tail->single[e] = (float)gram[e];
        cblas_strsm(CblasColMajor, CblasRight, CblasUpper, CblasNoTrans, CblasNonUnit, h, k, 1.0F,
                    tail->single, k, x, h);
    }
    return HD_OK;
}

/** b <- a^-1 b, a symmetric positive definite and overwritten; block x block. */
static hd_status divide(const hd_slow_vectors *tail, double *a, double *b)
{
    const int k = block_of(tail);
    return LAPACKE_dposv_work(LAPACK_COL_MAJOR, 'L', k, k, a, k, b, k) == 0 ? HD_OK
                                                                            : HD_ILL_CONDITIONED;
}

static double largest_norm(const hd_slow_vectors *tail, const double *gram)
{
    double worst = 0.0;
    for (int k = 0; k < block_of(tail); k++) {
        const double square = gram[k * (block_of(tail) + 1)];
        if (!(square <= worst)) worst = square; /* NaN stays */
        if (isnan(worst)) break;
    }
    return sqrt(worst);
}

/** One step of the block method (O'Leary, Linear Algebra Appl. 29, 293 (1980)); rr = r^T r of
 * before, and of after. */
static hd_status gradient_step(hd_slow_vectors *tail, double *rr, double *other)
{
    const size_t size = (size_t)tail->order * (size_t)block_of(tail);
    const size_t bytes = (size_t)(block_of(tail) * block_of(tail)) * sizeof *rr;
    double *dw = tail->small[0];
    apply(tail);
    inner(tail, tail->d, tail->w, dw);
    memcpy(other, rr, bytes);
    HD_TRY(divide(tail, dw, other));
    add_product(tail, tail->x, 1.0F, tail->d, other);
    add_product(tail, tail->r, -1.0F, tail->w, other);
    inner(tail, tail->r, tail->r, other);
    memcpy(dw, other, bytes);
    HD_TRY(divide(tail, rr, dw));
    memcpy(tail->w, tail->r, size * sizeof *tail->w);
    add_product(tail, tail->w, 1.0F, tail->d, dw);
    memcpy(tail->d, tail->w, size * sizeof *tail->d);
    memcpy(rr, other, bytes);
    return HD_OK;
}

/** x <- (1 + S^T S)^-1 P^-T e, but for a factor that keeps the spans; e: the last unit vectors. */
static hd_status iterate(hd_slow_vectors *tail)
{
    const int h = tail->order, k = block_of(tail);
    const size_t size = (size_t)h * (size_t)k;
    memset(tail->x, 0, size * sizeof *tail->x);
    memset(tail->r, 0, size * sizeof *tail->r);
    for (int j = 0; j < k; j++) tail->r[(size_t)j * (size_t)h + (size_t)(h - 1 - j)] = 1.0F;
    solve(tail, 'T', tail->r);
    HD_TRY(orthonormalise(tail, tail->r));
    memcpy(tail->d, tail->r, size * sizeof *tail->d);
    inner(tail, tail->r, tail->r, tail->small[1]);
    for (int step = 0; step < STEPS_MAX; step++) {
        HD_TRY(gradient_step(tail, tail->small[1], tail->small[2]));
        if (largest_norm(tail, tail->small[1]) <= RESIDUAL) return HD_OK;
    }
    return HD_ILL_CONDITIONED;
}

/* ---- the vectors --------------------------------------------------------------------------- */

/** column <- (S x, x), in the order of Lyapunov indices, the neutral vectors behind. */
static void put_together(hd_slow_vectors *tail)
{
    const size_t h = (size_t)tail->order, k = (size_t)block_of(tail);
    memcpy(tail->w, tail->x, h * k * sizeof *tail->w);
    solve(tail, 'N', tail->w);
    times_u(tail, 'N', tail->w, tail->a);
    for (size_t j = 0; j < h; j++)
        for (size_t b = 0; b < k; b++) {
            double *dq = tail->column + (4 * (j / 2) + j % 2) * k + (k - 1 - b);
            dq[0] = tail->a[b * h + j];
            dq[2 * k] = tail->x[b * h + j];
        }
}

/** From the slowest to the fastest: column <- column L^-1 with L lower triangular, column^T column
 * = L^T L; by dpotrf of the matrix turned round. */
static hd_status orthonormalise_backwards(hd_slow_vectors *tail)
{
    const int k = block_of(tail), rows = 4 * tail->disks;
    double *gram = tail->small[0], *turned = tail->small[1];
    for (int pass = 0; pass < 2; pass++) {
        cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, k, rows, 1.0, tail->column, k, 0.0,
                    gram, k);
        for (int a = 0; a < k; a++)
            for (int b = a; b < k; b++) turned[(k - 1 - b) * k + (k - 1 - a)] = gram[a * k + b];
        if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', k, turned, k) != 0)
            return HD_ILL_CONDITIONED;
        for (int a = 0; a < k; a++)
            for (int b = a; b < k; b++) gram[b * k + a] = turned[(k - 1 - b) * k + (k - 1 - a)];
        cblas_dtrsm(CblasColMajor, CblasLeft, CblasUpper, CblasNoTrans, CblasNonUnit, k, rows, 1.0,
                    gram, k, tail->column, k);
    }
    return HD_OK;
}

hd_status hd_slow_vectors_measure(hd_slow_vectors *tail, hd_frame *frame, const double *p,
                                  int count)
{
    HD_ASSERT(hd_frame_vectors(frame) == tail->vectors && count >= 1 && count <= tail->count_max);
    HD_ASSERT(hd_frame_stride(frame) >= tail->order);
    tail->count = count;
    tail->stride = hd_frame_stride(frame);
    tail->threads = hd_frame_threads(frame);
    take_apart(tail, hd_frame_data(frame), p);
    if (LAPACKE_sgetrf_work(LAPACK_COL_MAJOR, tail->order, tail->order, tail->p, tail->stride,
                            tail->pivot) != 0)
        return HD_ILL_CONDITIONED;
    HD_TRY(iterate(tail));
    put_together(tail);
    return orthonormalise_backwards(tail);
}
