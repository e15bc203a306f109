/** Tangent frame -> (Q, ln diag R), by block Gram-Schmidt.
 *
 * V (rows m, vectors n, row-major) is for BLAS the column-major n x m matrix A = V^T. The vectors
 * are taken in panels: a panel is orthonormalised, and then taken out of all later ones: S = A_rest
 * A_p^T, A_rest -= S A_p (dgemm). A panel itself is halved in the same way, down to narrow parts,
 * which are orthonormalised by Cholesky of their Gram matrix: G = A_p A_p^T = L L^T,
 * A_p <- L^-1 A_p (dgemm, dpotrf, dtrtri, dtrmm). That is 2 m n^2 flops nearly all in dgemm, and,
 * as in the modified Gram-Schmidt process, each panel meets vectors that the earlier ones have
 * cleaned: it loses orthogonality in proportion to the condition, where one Cholesky factorisation
 * of all loses its square. diag(L) > 0, so Q and R = L^T are unique; R is kept only if
 * hd_ortho_keep_factor was called. In the norm of dq G and S are products of the dq halves, which
 * for BLAS are two matrices with a leading dimension of four strides; that is 1.5 m n^2 flops.
 * Equations [T5]-[T7]. */
#include <cblas.h>
#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "tangent/ortho.h"
#include "tangent/panel.h"

/** Cholesky of a Gram matrix breaks down near 1 / sqrt(16 eps) = 2e7. */
static const double PANEL_CONDITION_MAX = 1e7;
/** Repeated passes go on until the loss of orthogonality is below this. */
static const double REPEATED = 1e-13;
/** Largest condition that a second pass may find in what the first one has left. */
static const double CONDITION_AGAIN = 2.0;

/** Number of panels if there are vectors enough, and their widths: the last half of the flops then
 * falls into wide products. */
enum { PANELS = 8, PANEL_MIN = 8, PANEL_MAX = 160 };

static hd_status ortho_allocate(hd_ortho *ortho)
{
    const size_t n = (size_t)ortho->vectors, width = (size_t)ortho->width;
    const size_t later = n < HD_LATER_MAX ? n : HD_LATER_MAX;
    const struct {
        double **array;
        size_t size;
    } wanted[] = {{&ortho->gram, width * width},
                  {&ortho->projection, later * width},
                  {&ortho->norm2, n},
                  {&ortho->scale, width},
                  {&ortho->probe, n * HD_PROBES},
                  {&ortho->log_stretch, n},
                  {&ortho->sum, ortho->communicator ? width * width : 0},
                  {&ortho->copy, ortho->communicator ? width * (size_t)ortho->rows : 0}};
    for (size_t k = 0; k < sizeof wanted / sizeof *wanted; k++)
        if (wanted[k].size > 0 &&
            !(*wanted[k].array = hd_memory_alloc(wanted[k].size, sizeof(double))))
            return HD_NO_MEMORY;
    ortho->inverse = ortho->projection;
    return HD_OK;
}

static int panel_width(int vectors)
{
    const int even = (vectors / PANELS + 7) / 8 * 8;
    const int width = even < PANEL_MIN ? PANEL_MIN : even > PANEL_MAX ? PANEL_MAX : even;
    return width < vectors ? width : vectors;
}

double hd_ortho_bytes(double rows, double vectors, double ranks)
{
    const double width = panel_width((int)vectors), later = fmin(vectors, HD_LATER_MAX);
    const double copied = ranks > 1 ? width * (width + rows / ranks) : 0.0;
    const double blocked = 32.0 * vectors; /* workspace that LAPACK was seen to ask for */
    return sizeof(double) *
           (width * width + fmax(later * width, blocked) + (HD_PROBES + 3.0) * vectors + copied);
}

hd_status hd_ortho_create(hd_ortho **out, int rows, int vectors)
{
    return hd_ortho_create_shared(out, rows, 1, vectors, NULL);
}

hd_status hd_ortho_create_shared(hd_ortho **out, int rows, int of_particle, int vectors,
                                 hd_communicator *communicator)
{
    HD_ASSERT(vectors >= 1 && vectors <= rows);
    hd_ortho *ortho = hd_memory_alloc(1, sizeof *ortho);
    *out = NULL;
    const hd_status head = hd_communicator_agree(communicator, ortho ? HD_OK : HD_NO_MEMORY);
    if (head != HD_OK) {
        hd_memory_free(ortho);
        return head;
    }
    const int ranks = hd_communicator_ranks(communicator);
    ortho->communicator = communicator;
    ortho->rows = of_particle * ((rows / of_particle + ranks - 1) / ranks);
    ortho->vectors = vectors;
    ortho->width = panel_width(vectors);
    const hd_status status = hd_communicator_agree(communicator, ortho_allocate(ortho));
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
    hd_memory_free(ortho->projection);
    hd_memory_free(ortho->norm2);
    hd_memory_free(ortho->scale);
    hd_memory_free(ortho->probe);
    hd_memory_free(ortho->log_stretch);
    hd_memory_free(ortho->sum);
    hd_memory_free(ortho->copy);
    hd_memory_free(ortho->factor[0]);
    hd_memory_free(ortho->factor[1]);
    hd_memory_free(ortho);
}

/* ---- the condition ------------------------------------------------------------------------- */

double hd_probe_sign(int row, int probe)
{
    uint32_t hash = (uint32_t)row * 2654435761u;
    hash = (hash ^ hash >> 15) * 2246822519u;
    hash = (hash ^ hash >> 13) * 3266489917u;
    return hash >> (16 + probe) & 1 ? 1.0 : -1.0;
}

bool hd_is_square(double sum) { return sum > DBL_MIN / DBL_EPSILON && sum < INFINITY; }

double hd_ortho_condition_from_probes(const hd_ortho *ortho)
{
    double worst = 1.0;
    for (int col = 0; col < ortho->vectors; col++) {
        if (!hd_is_square(ortho->norm2[col])) return INFINITY;
        double sum = 0.0;
        for (int p = 0; p < HD_PROBES; p++) {
            const double y = ortho->probe[p * ortho->vectors + col];
            sum += y * y / HD_PROBES;
        }
        if (!(sum < INFINITY)) return INFINITY;
        worst = fmax(worst, sum);
    }
    return sqrt(worst);
}

/* ---- a step -------------------------------------------------------------------------------- */

void hd_ortho_probes_clear(hd_ortho *ortho)
{
    memset(ortho->norm2, 0, (size_t)ortho->vectors * sizeof *ortho->norm2);
    memset(ortho->probe, 0, (size_t)ortho->vectors * HD_PROBES * sizeof *ortho->probe);
}

/** Width of the panel that begins at vector `first`. */
static int width_at(const hd_ortho *ortho, int first)
{
    const int left = ortho->vectors - first;
    return left < ortho->width ? left : ortho->width;
}

static hd_status pass(hd_ortho *ortho, hd_frame *frame, double condition_max)
{
    hd_ortho_probes_clear(ortho);
    ortho->panel_condition = HD_PANEL_CONDITION_LEAST;
    for (int first = 0; first < ortho->vectors; first += ortho->width) {
        const hd_panel x = hd_panel_load(ortho, frame, first, width_at(ortho, first));
        HD_TRY(hd_panel_orthonormalise(ortho, x));
        hd_panel_store(ortho, frame, x);
        hd_panel_project_out(ortho, frame, x);
    }
    ortho->condition = hd_ortho_condition_from_probes(ortho);
    ortho->passes++;
    return ortho->condition <= condition_max ? HD_OK : HD_ILL_CONDITIONED;
}

void hd_ortho_begin(hd_ortho *ortho, const hd_frame *frame, hd_norm norm)
{
    HD_ASSERT(hd_frame_rows_here(frame) == ortho->rows &&
              hd_frame_vectors(frame) == ortho->vectors);
    HD_ASSERT(norm == HD_NORM_FULL || 2 * ortho->vectors <= hd_frame_rows(frame));
    ortho->norm = norm;
    ortho->coordinates = hd_frame_coordinates(frame);
    ortho->leaf = HD_LEAF_MAX;
    ortho->panel_condition_max = PANEL_CONDITION_MAX;
    for (int col = 0; col < ortho->vectors; col++) ortho->log_stretch[col] = 0.0;
    ortho->passes = 0;
}

/** Multiplies the factors of both passes: V = Q (L_1 L_2)^T. */
static void factors_multiply(const hd_ortho *ortho)
{
    const int n = ortho->vectors;
    if (!ortho->factor[0]) return;
    for (int col = 1; col < n; col++)
        memset(ortho->factor[0] + (size_t)col * (size_t)n, 0, (size_t)col * sizeof(double));
    cblas_dtrmm(CblasColMajor, CblasRight, CblasLower, CblasNoTrans, CblasNonUnit, n, n, 1.0,
                ortho->factor[1], n, ortho->factor[0], n);
}

static double defect_foreseen(const hd_ortho *ortho)
{
    return DBL_EPSILON * ortho->condition * ortho->panel_condition * ortho->panel_condition;
}

/** Looks for NaN in dp halves, which the norm of dq does not see. Each vector is subtracted from
 * all later ones, so the last one shows it. */
static hd_status unseen_check(const hd_ortho *ortho, hd_frame *frame)
{
    const double *last = hd_frame_vector(frame, ortho->vectors - 1);
    bool finite = true;
    for (int row = 0; row < ortho->rows; row++)
        finite = finite && isfinite(last[(size_t)row * (size_t)hd_frame_stride(frame)]);
    return hd_communicator_agree(ortho->communicator, finite ? HD_OK : HD_ILL_CONDITIONED);
}

static hd_status step_by_rows(hd_ortho *ortho, hd_frame *frame, hd_ortho_limits limits)
{
    HD_TRY(pass(ortho, frame, limits.condition));
    const double condition = ortho->condition;
    ortho->defect = defect_foreseen(ortho);
    if (ortho->defect > limits.defect) {
        HD_TRY(pass(ortho, frame, limits.condition));
        ortho->defect = defect_foreseen(ortho);
        ortho->condition = condition;
        factors_multiply(ortho);
    }
    return limits.norm == HD_NORM_DQ ? unseen_check(ortho, frame) : HD_OK;
}

hd_status hd_ortho_step(hd_ortho *ortho, hd_frame *frame, hd_ortho_limits limits)
{
    hd_ortho_begin(ortho, frame, limits.norm);
    hd_frame_to_rows(frame);
    const hd_status status = step_by_rows(ortho, frame, limits);
    hd_frame_to_columns(frame);
    return status;
}

/** Orthonormalises one vector at a time, so that no Cholesky factorisation can break down. A pass
 * leaves rounding times the condition, and the next pass finds vectors that are nearly orthonormal.
 * If it does not, the first pass has left only rounding of some vector: its condition was higher
 * than it could measure. */
static hd_status repeat_by_rows(hd_ortho *ortho, hd_frame *frame, double condition_max)
{
    enum { PASSES_MAX = 4 };
    HD_TRY(pass(ortho, frame, condition_max));
    const double condition = ortho->condition;
    while (defect_foreseen(ortho) > REPEATED && ortho->passes < PASSES_MAX) {
        HD_TRY(pass(ortho, frame, CONDITION_AGAIN));
        factors_multiply(ortho);
    }
    ortho->defect = defect_foreseen(ortho);
    ortho->condition = condition;
    return HD_OK;
}

hd_status hd_ortho_step_stable(hd_ortho *ortho, hd_frame *frame, double condition_max)
{
    hd_ortho_begin(ortho, frame, HD_NORM_FULL);
    ortho->leaf = 1;
    ortho->panel_condition_max = INFINITY;
    hd_frame_to_rows(frame);
    const hd_status status = repeat_by_rows(ortho, frame, condition_max);
    hd_frame_to_columns(frame);
    return status;
}

hd_status hd_ortho_keep_factor(hd_ortho *ortho)
{
    const size_t n = (size_t)ortho->vectors;
    for (int pass = 0; pass < 2; pass++)
        if (!ortho->factor[pass] && !(ortho->factor[pass] = hd_memory_alloc(n * n, sizeof(double))))
            return HD_NO_MEMORY;
    return HD_OK;
}

const double *hd_ortho_factor(const hd_ortho *ortho) { return ortho->factor[0]; }
const double *hd_ortho_log_stretch(const hd_ortho *ortho) { return ortho->log_stretch; }
double hd_ortho_condition(const hd_ortho *ortho) { return ortho->condition; }
double hd_ortho_defect(const hd_ortho *ortho) { return ortho->defect; }
int hd_ortho_passes(const hd_ortho *ortho) { return ortho->passes; }
hd_norm hd_ortho_norm(const hd_ortho *ortho) { return ortho->norm; }

/** max(worst, |x^T y - diagonal|) over all pairs of columns x of the panel and `count` vectors y;
 * NaN stays. */
static double panel_defect(hd_ortho *ortho, hd_frame *frame, hd_panel x, int first, int count,
                           double worst)
{
    const double *s = ortho->projection;
    hd_panel_products(ortho, frame, ortho->projection, first, count, x);
    for (int col = 0; col < x.width; col++)
        for (int row = 0; row < count; row++) {
            const bool same = x.first + col == first + row;
            const double off = fabs(s[(size_t)col * (size_t)count + (size_t)row] - same);
            if (isnan(worst)) return worst;
            if (!(off <= worst)) worst = off;
        }
    return worst;
}

double hd_ortho_defect_measured(hd_ortho *ortho, hd_frame *frame, hd_norm norm)
{
    const hd_norm of_the_step = ortho->norm;
    double worst = 0.0;
    ortho->norm = norm;
    ortho->coordinates = hd_frame_coordinates(frame);
    hd_frame_to_rows(frame);
    for (int first = 0; first < ortho->vectors; first += ortho->width) {
        const hd_panel x = hd_panel_load(ortho, frame, first, width_at(ortho, first));
        const int width = hd_panel_later_width(ortho->vectors - first);
        for (int next = first; next < ortho->vectors; next += width) {
            const int left = ortho->vectors - next;
            worst = panel_defect(ortho, frame, x, next, left < width ? left : width, worst);
        }
    }
    hd_frame_to_columns(frame);
    ortho->norm = of_the_step;
    return worst;
}
