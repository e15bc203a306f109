/** Half of the vectors -> all of them (2N -> 4N with two coordinates), by J (dq, dp) = (dp, -dq)
 * [T18].
 *
 * Q is row-major (stride >= n), for BLAS the column-major Q^T with its first rows the first
 * vectors. Panels, and vectors turned by J, are column-major with a column for each vector. */
#include "tangent/conjugate.h"

#include <cblas.h>
#include <math.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "base/random.h"
#include "tangent/frame.h"
#include "tangent/product.h"

enum { PANEL = 16, PAIRS = 4 };

struct hd_conjugate {
    int rows, half;  /**< number of rows M; M / 2 */
    int coordinates; /**< coordinates of a particle */
    bool fresh;      /**< whole is that of the last orthonormalisation */
    double *stretch; /**< [rows] */
    double *whole;   /**< [rows * 2 most], row-major; NULL unless asked for */
    int most;        /**< of the half that are completed */
    double *sign;    /**< [half * 2 PAIRS], random */
    double *sum;     /**< [rows * 2 PAIRS]: Q times signs */
};

double hd_conjugate_bytes(double rows, double most)
{
    return sizeof(double) * rows * (1.0 + 2.0 * most + 1.5 * 2.0 * PAIRS);
}

/** to = J from; entries of a vector in the frame's order. */
static void turn(double *to, const double *from, int rows, int coordinates)
{
    for (int row = 0; row < rows; row++)
        to[row] = hd_turned_sign(row, coordinates) * from[hd_turned(row, coordinates)];
}

/* ---- the start ----------------------------------------------------------------------------- */

typedef struct panel {
    int rows, first, width; /**< rows on this rank (some particles); first vector; vectors */
    int coordinates;        /**< coordinates of a particle */
    double *a, *turned;     /**< [rows * width], column-major: vectors; work */
    double *part;           /**< [n * width]: coefficients */
} panel;

static double *column_of(const panel *x, double *of, int col)
{
    return of + (size_t)col * (size_t)x->rows;
}

static void load(const panel *x, hd_frame *frame)
{
    for (int col = 0; col < x->width; col++)
        cblas_dcopy(x->rows, hd_frame_vector(frame, x->first + col), hd_frame_stride(frame),
                    column_of(x, x->a, col), 1);
}

static void store(const panel *x, hd_frame *frame)
{
    for (int col = 0; col < x->width; col++)
        cblas_dcopy(x->rows, column_of(x, x->a, col), 1, hd_frame_vector(frame, x->first + col),
                    hd_frame_stride(frame));
}

static void turn_all(const panel *x)
{
    for (int col = 0; col < x->width; col++)
        turn(column_of(x, x->turned, col), column_of(x, x->a, col), x->rows, x->coordinates);
}

/** Number of vectors before the panel that lie side by side, from vector col on. */
static int beside(const panel *x, const hd_frame *frame, int col)
{
    const int count = hd_frame_neighbours(frame, col);
    return count < x->first - col ? count : x->first - col;
}

/** turned <- Q Q^T `of`, with the vectors Q before the panel. */
static void project(const panel *x, hd_frame *frame, const double *of)
{
    const int stride = hd_frame_stride(frame);
    for (int col = 0; col < x->first; col += beside(x, frame, col))
        hd_dgemm(CblasNoTrans, CblasNoTrans, beside(x, frame, col), x->width, x->rows, 1.0,
                 hd_frame_vector(frame, col), stride, of, x->rows, 0.0, x->part + col, x->first);
    hd_communicator_sum(frame->communicator, x->part, (size_t)x->first * (size_t)x->width);
    for (int col = 0; col < x->first; col += beside(x, frame, col))
        hd_dgemm(CblasTrans, CblasNoTrans, x->rows, x->width, beside(x, frame, col), 1.0,
                 hd_frame_vector(frame, col), stride, x->part + col, x->first, col > 0, x->turned,
                 x->rows);
}

/** A -= Q Q^T A + (J Q)(J Q)^T A for the vectors before the panel; (J Q)^T A = -Q^T J A. */
static void project_out(const panel *x, hd_frame *frame)
{
    if (x->first == 0) return;
    for (int conjugate = 0; conjugate < 2; conjugate++) {
        if (conjugate) turn_all(x);
        project(x, frame, conjugate ? x->turned : x->a);
        for (int col = 0; col < x->width; col++) {
            double *a = column_of(x, x->a, col), *along = column_of(x, x->turned, col);
            if (conjugate) /* A += J Q (Q^T J A) */
                for (int row = 0; row < x->rows; row++)
                    a[row] += hd_turned_sign(row, x->coordinates) *
                              along[hd_turned(row, x->coordinates)];
            else
                cblas_daxpy(x->rows, -1.0, along, 1, a, 1);
        }
    }
}

/** The inner product of two vectors, summed over all ranks. */
static double inner(const panel *x, hd_communicator *c, const double *a, const double *b)
{
    double sum = cblas_ddot(x->rows, a, 1, b, 1);
    hd_communicator_sum(c, &sum, 1);
    return sum;
}

static double length_of(const panel *x, hd_communicator *c, const double *a)
{
    return c ? sqrt(inner(x, c, a, a)) : cblas_dnrm2(x->rows, a, 1);
}

/** Removes from each vector of the panel its part along the vectors before it in the panel and
 * along their conjugates, and scales it to length 1. */
static hd_status orthonormalise_panel(const panel *x, hd_communicator *c)
{
    for (int col = 0; col < x->width; col++) {
        double *a = column_of(x, x->a, col);
        for (int k = 0; k < 2 * col; k++) {
            const double *q = column_of(x, x->a, k / 2);
            double *along = column_of(x, x->turned, 0);
            if (k % 2 == 0)
                memcpy(along, q, (size_t)x->rows * sizeof *q);
            else
                turn(along, q, x->rows, x->coordinates);
            cblas_daxpy(x->rows, -inner(x, c, along, a), along, 1, a, 1);
        }
        const double length = length_of(x, c, a);
        if (!(length > 0 && length < INFINITY)) return HD_ILL_CONDITIONED;
        cblas_dscal(x->rows, 1.0 / length, a, 1);
    }
    return HD_OK;
}

/** Projects twice, which is enough: the first time leaves hardly anything to cancel. */
static hd_status start_panel(const panel *x, hd_frame *frame)
{
    load(x, frame);
    for (int pass = 0; pass < 2; pass++) {
        project_out(x, frame);
        HD_TRY(orthonormalise_panel(x, frame->communicator));
    }
    store(x, frame);
    return HD_OK;
}

hd_status hd_conjugate_start(hd_frame *frame)
{
    const int rows = hd_frame_rows_here(frame), n = hd_frame_vectors(frame);
    const size_t panels = (size_t)rows * PANEL, parts = (size_t)n * PANEL;
    HD_ASSERT(2 * n == hd_frame_rows(frame));
    double *room = hd_memory_alloc(2 * panels + parts, sizeof *room);
    hd_status status = hd_communicator_agree(frame->communicator, room ? HD_OK : HD_NO_MEMORY);
    if (status == HD_OK) hd_frame_to_rows(frame);
    for (int first = 0; first < n && status == HD_OK; first += PANEL) {
        const int width = n - first < PANEL ? n - first : PANEL;
        const panel x = {rows,
                         first,
                         width,
                         hd_frame_coordinates(frame),
                         room,
                         room + panels,
                         room + 2 * panels};
        status = start_panel(&x, frame);
    }
    if (frame->by_rows) hd_frame_to_columns(frame);
    hd_memory_free(room);
    return status;
}

/* ---- the other half ------------------------------------------------------------------------ */

static hd_status allocate(hd_conjugate *c)
{
    const size_t rows = (size_t)c->rows, sums = 2 * PAIRS;
    c->stretch = hd_memory_alloc(rows, sizeof(double));
    c->sign = hd_memory_alloc((size_t)c->half * sums, sizeof(double));
    c->sum = hd_memory_alloc(rows * sums, sizeof(double));
    if (!c->stretch || !c->sign || !c->sum) return HD_NO_MEMORY;
    if (c->most == 0) return HD_OK;
    c->whole = hd_memory_alloc(rows * 2 * (size_t)c->most, sizeof(double));
    return c->whole ? HD_OK : HD_NO_MEMORY;
}

hd_status hd_conjugate_create(hd_conjugate **out, int rows, int coordinates, int most)
{
    hd_conjugate *c = hd_memory_alloc(1, sizeof *c);
    *out = NULL;
    if (!c) return HD_NO_MEMORY;
    c->rows = rows;
    c->coordinates = coordinates;
    c->half = rows / 2;
    c->most = most;
    if (allocate(c) != HD_OK) {
        hd_conjugate_free(c);
        return HD_NO_MEMORY;
    }
    hd_random random = hd_random_seeded(1, 3);
    for (int k = 0; k < c->half * 2 * PAIRS; k++)
        c->sign[k] = hd_random_symmetric(&random) < 0 ? -1.0 : 1.0;
    *out = c;
    return HD_OK;
}

void hd_conjugate_free(hd_conjugate *conjugate)
{
    if (!conjugate) return;
    hd_memory_free(conjugate->stretch);
    hd_memory_free(conjugate->whole);
    hd_memory_free(conjugate->sign);
    hd_memory_free(conjugate->sum);
    hd_memory_free(conjugate);
}

const double *hd_conjugate_stretch(hd_conjugate *conjugate, const double *half)
{
    conjugate->fresh = false;
    for (int col = 0; col < conjugate->half; col++) {
        conjugate->stretch[col] = half[col];
        conjugate->stretch[conjugate->rows - 1 - col] = -half[col];
    }
    return conjugate->stretch;
}

void hd_conjugate_fill(double *whole, hd_columns half, int rows, int coordinates)
{
    const int n = half.count;
    for (int row = 0; row < rows; row++) {
        const double *partner = half.data +
                                (size_t)hd_turned(row, coordinates) * (size_t)half.stride;
        const double sign = hd_turned_sign(row, coordinates);
        double *to = whole + (size_t)row * 2 * (size_t)n;
        memcpy(to, half.data + (size_t)row * (size_t)half.stride, (size_t)n * sizeof *to);
        for (int col = 0; col < n; col++) to[2 * n - 1 - col] = sign * partner[col];
    }
}

int hd_conjugate_most(const hd_conjugate *conjugate) { return conjugate->most; }

hd_columns hd_conjugate_complete(hd_conjugate *conjugate, hd_columns half)
{
    HD_ASSERT(half.count <= conjugate->most);
    if (!conjugate->fresh)
        hd_conjugate_fill(conjugate->whole, half, conjugate->rows, conjugate->coordinates);
    conjugate->fresh = true;
    return (hd_columns){conjugate->whole, 2 * half.count, half.first, 2 * half.count};
}

hd_columns hd_conjugate_partners(hd_conjugate *conjugate, hd_columns half)
{
    const hd_columns both = hd_conjugate_complete(conjugate, half);
    return (hd_columns){both.data + half.count, both.stride,
                        conjugate->rows - half.first - half.count, half.count};
}

void hd_conjugate_dq_dp(double *cos_theta, double *dp_dq_ratio, int half)
{
    for (int col = 0; col < half; col++) {
        const double ratio = dp_dq_ratio[col];
        cos_theta[2 * half - 1 - col] = -cos_theta[col];
        dp_dq_ratio[2 * half - 1 - col] = isnan(ratio) ? 0.0 : ratio > 0 ? 1.0 / ratio : NAN;
    }
}

/* ---- isotropy ------------------------------------------------------------------------------ */

/** a^T J b of two vectors. */
static double product(const double *a, const double *b, int rows, int half)
{
    double sum = 0.0;
    for (int row = 0; row < rows; row += 2 * half)
        for (int d = 0; d < half; d++)
            sum += a[row + d] * b[row + half + d] - a[row + half + d] * b[row + d];
    return sum;
}

double hd_conjugate_isotropy(hd_conjugate *c, const hd_frame *frame)
{
    const hd_columns own = hd_frame_columns(frame);
    double sum = 0.0;
    hd_dgemm(CblasTrans, CblasNoTrans, c->rows, 2 * PAIRS, own.count, 1.0, own.data, own.stride,
             c->sign + own.first, c->half, 0.0, c->sum, c->rows);
    hd_communicator_sum(frame->communicator, c->sum, 2 * PAIRS * (size_t)c->rows);
    for (int k = 0; k < PAIRS; k++) {
        const double *a = c->sum + 2 * (size_t)k * (size_t)c->rows;
        const double one = product(a, a + c->rows, c->rows, c->coordinates);
        sum += one * one / PAIRS;
    }
    return sqrt(sum);
}

/** q_a^T J q_b of two columns. */
static double product_of_columns(const hd_frame *frame, int a, int b)
{
    const size_t stride = (size_t)hd_frame_stride(frame);
    const size_t half = (size_t)hd_frame_coordinates(frame);
    const int of_particle = 2 * (int)half, particles = hd_frame_rows(frame) / of_particle,
              step = of_particle * hd_frame_stride(frame);
    const double *x = hd_frame_read(frame) + a, *y = hd_frame_read(frame) + b;
    double sum = 0.0;
    for (size_t d = 0; d < half; d++)
        sum += cblas_ddot(particles, x + d * stride, step, y + (half + d) * stride, step) -
               cblas_ddot(particles, x + (half + d) * stride, step, y + d * stride, step);
    return sum;
}

double hd_conjugate_isotropy_measured(const hd_frame *frame)
{
    double worst = 0.0;
    for (int a = 0; a < hd_frame_columns(frame).count; a++)
        for (int b = 0; b < a && !isnan(worst); b++) {
            const double off = fabs(product_of_columns(frame, a, b));
            if (!(off <= worst)) worst = off; /* NaN stays */
        }
    return worst;
}
