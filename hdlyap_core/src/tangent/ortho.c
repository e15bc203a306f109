/** Tangent frame -> (Q, ln diag R), by block Gram-Schmidt.
 *
 * V (rows m, vectors n, row-major) is for BLAS the column-major n x m matrix A = V^T. The vectors
 * are taken in panels: a panel is orthonormalised, and then taken out of all later ones: S = A_rest
 * A_p^T, A_rest -= S A_p (dgemm). By itself it is dealt with in the same way by halves, down to
 * narrow parts, which are orthonormalised by Cholesky of their Gram matrix: G = A_p A_p^T = L L^T,
 * A_p <- L^-1 A_p (dgemm, dpotrf, dtrtri, dtrmm). That is 2 m n^2 flops nearly all in dgemm, and,
 * as in the modified Gram-Schmidt process, each panel meets vectors that the earlier ones have
 * cleaned: it loses orthogonality in proportion to the condition, where one Cholesky factorisation
 * of all loses its square. diag(L) > 0, so Q and R = L^T are unique; R is used up on the way unless
 * somebody keeps it. In the norm of dq the inner products G and S are those of the dq halves, which
 * for BLAS are two matrices with a leading dimension of four strides; that is 1.5 m n^2 flops.
 * Equations [T5]-[T7]. */
#include "tangent/ortho_state.h"

#include <cblas.h>
#include <float.h>
#include <lapacke.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"

/** A panel that is worse conditioned by itself gets a second Cholesky pass: its loss of
 * orthogonality, eps condition^2, multiplies what the later panels are cleaned of. */
static const double PANEL_CONDITION_GOOD = 16.0;
/** Cholesky of a Gram matrix breaks down near 1 / sqrt(16 eps) = 2e7. */
static const double PANEL_CONDITION_MAX = 1e7;

/** PANELS of them if there are that many vectors: the last half of the flops then falls into wide
 * products. A panel wider than LEAF_MAX is orthonormalised by halves. S is of LATER_MAX vectors at
 * most, for the sake of its room. */
enum { PANELS = 8, PANEL_MIN = 8, PANEL_MAX = 160, LEAF_MAX = 48, LATER_MAX = 704 };

/** Entries of workspace that LAPACK wants for the stable step. */
static int stable_workspace(int rows, int vectors)
{
    double lq = 0.0, q = 0.0, unused = 0.0;
    (void)LAPACKE_dgelqf_work(LAPACK_COL_MAJOR, vectors, rows, &unused, vectors, &unused, &lq, -1);
    (void)LAPACKE_dorglq_work(LAPACK_COL_MAJOR, vectors, rows, vectors, &unused, vectors, &unused,
                              &q, -1);
    return (int)fmax(fmax(lq, q), vectors);
}

static hd_status ortho_allocate(hd_ortho *ortho)
{
    const size_t n = (size_t)ortho->vectors, width = (size_t)ortho->width;
    const int wanted_by_lapack = stable_workspace(ortho->rows, ortho->vectors);
    ortho->lwork = (ortho->vectors < LATER_MAX ? ortho->vectors : LATER_MAX) * ortho->width;
    if (ortho->lwork < wanted_by_lapack) ortho->lwork = wanted_by_lapack;
    const struct {
        double **array;
        size_t size;
    } wanted[] = {{&ortho->gram, width * width},
                  {&ortho->projection, (size_t)ortho->lwork},
                  {&ortho->norm2, n},
                  {&ortho->scale, width},
                  {&ortho->probe, n * HD_PROBES},
                  {&ortho->log_stretch, n},
                  {&ortho->reflector, n}};
    for (size_t k = 0; k < sizeof wanted / sizeof *wanted; k++)
        if (!(*wanted[k].array = hd_memory_alloc(wanted[k].size, sizeof(double))))
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

hd_status hd_ortho_create(hd_ortho **out, int rows, int vectors)
{
    HD_ASSERT(vectors >= 1 && vectors <= rows);
    hd_ortho *ortho = hd_memory_alloc(1, sizeof *ortho);
    *out = NULL;
    if (!ortho) return HD_NO_MEMORY;
    ortho->rows = rows;
    ortho->vectors = vectors;
    ortho->width = panel_width(vectors);
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
    hd_memory_free(ortho->projection);
    hd_memory_free(ortho->norm2);
    hd_memory_free(ortho->scale);
    hd_memory_free(ortho->probe);
    hd_memory_free(ortho->log_stretch);
    hd_memory_free(ortho->reflector);
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

/* ---- a panel ------------------------------------------------------------------------------- */

/** Some neighbouring vectors: the panel whose turn it is, a part of it, or later ones. */
typedef struct panel {
    double *a; /**< its rows of A */
    int lda, first, width;
} panel;

static panel panel_of(const hd_ortho *ortho, hd_frame *frame, int first)
{
    const int left = ortho->vectors - first;
    return (panel){hd_frame_data(frame) + first, hd_frame_stride(frame), first,
                   left < ortho->width ? left : ortho->width};
}

/** Of the equal pieces, of LATER_MAX vectors at most, that so many later ones are dealt with in. */
static int piece_width(int later)
{
    const int pieces = (later + LATER_MAX - 1) / LATER_MAX;
    return pieces > 1 ? ((later + pieces - 1) / pieces + 7) / 8 * 8 : later;
}

/** The piece that begins at a vector. */
static panel piece_at(const hd_ortho *ortho, panel x, int next, int width)
{
    const int left = ortho->vectors - next;
    return (panel){x.a + (next - x.first), x.lda, next, left < width ? left : width};
}

/** The square of a panel's triangle that belongs to a part of it. */
static double *triangle_at(double *triangle, panel whole, panel part)
{
    return triangle + (size_t)(part.first - whole.first) * (size_t)(whole.width + 1);
}

/** s <- A_y A_x^T in the norm, column-major. That of dq sees two parts of every fourth column of A:
 * dq_x and dq_y of the disks. */
static void inner_products(const hd_ortho *ortho, double *s, int lds, panel y, panel x)
{
    const bool dq = ortho->norm == HD_NORM_DQ;
    const int parts = dq ? 2 : 1, step = dq ? 4 : 1;
    for (int part = 0; part < parts; part++)
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, y.width, x.width, ortho->rows / step,
                    1.0, y.a + part * y.lda, step * y.lda, x.a + part * x.lda, step * x.lda,
                    part > 0, s, lds);
}

/** A_y <- A_y - S A_x. */
static void take_out(const hd_ortho *ortho, const double *s, int lds, panel y, panel x)
{
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, y.width, ortho->rows, x.width, -1.0, s,
                lds, x.a, x.lda, 1.0, y.a, y.lda);
}

/** Entry of L of the present pass at a row and the panel's first column. */
static double *factor_at(const hd_ortho *ortho, panel x, int row)
{
    return ortho->factor[ortho->passes] + (size_t)x.first * (size_t)ortho->vectors + row;
}

/** The panel's own triangle in gram, of its first or second time: L = L_1 L_2. */
static void keep_panel(const hd_ortho *ortho, panel x, bool again)
{
    if (!ortho->factor[0]) return;
    double *own = factor_at(ortho, x, x.first);
    const int n = ortho->vectors, w = x.width;
    if (again)
        cblas_dtrmm(CblasColMajor, CblasRight, CblasLower, CblasNoTrans, CblasNonUnit, w, w, 1.0,
                    ortho->gram, w, own, n);
    else
        for (int col = 0; col < w; col++) {
            memset(own + (size_t)col * (size_t)n, 0, (size_t)col * sizeof *own);
            memcpy(own + (size_t)col * (size_t)n + col, ortho->gram + (size_t)col * (size_t)w + col,
                   (size_t)(w - col) * sizeof *own);
        }
}

/** S, the rows of L of some later vectors. */
static void keep_projection(const hd_ortho *ortho, panel x, panel later)
{
    if (!ortho->factor[0]) return;
    for (int col = 0; col < x.width; col++)
        memcpy(factor_at(ortho, x, later.first) + (size_t)col * (size_t)ortho->vectors,
               ortho->projection + (size_t)col * (size_t)later.width,
               (size_t)later.width * sizeof(double));
}

/** A narrow part of a panel: gram <- L of G = A_p A_p^T, inverse <- L^-1, A_p <- L^-1 A_p. */
static hd_status cholesky(hd_ortho *ortho, panel whole, panel x)
{
    double *l = triangle_at(ortho->gram, whole, x),
           *inverse = triangle_at(ortho->inverse, whole, x);
    const int ld = whole.width;
    inner_products(ortho, l, ld, x, x);
    for (int k = 0; k < x.width; k++) /* keeps NaN out of LAPACK */
        if (!hd_is_square(l[k * (ld + 1)])) return HD_ILL_CONDITIONED;
    if (LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', x.width, l, ld) != 0) return HD_ILL_CONDITIONED;
    for (int col = 0; col < x.width; col++)
        memcpy(inverse + col * (ld + 1), l + col * (ld + 1),
               (size_t)(x.width - col) * sizeof *inverse);
    if (LAPACKE_dtrtri_work(LAPACK_COL_MAJOR, 'L', 'N', x.width, inverse, ld) != 0)
        return HD_ILL_CONDITIONED;
    cblas_dtrmm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, x.width,
                ortho->rows, 1.0, inverse, ld, x.a, x.lda);
    return HD_OK;
}

/** With both halves in their squares: L^-1 below the first is -L_2^-1 S L_1^-1. */
static void invert_corner(hd_ortho *ortho, panel whole, panel first, panel second)
{
    const double *one = triangle_at(ortho->inverse, whole, first);
    const double *two = triangle_at(ortho->inverse, whole, second);
    const int ld = whole.width;
    const size_t corner = (size_t)(one - ortho->inverse) + (size_t)first.width;
    double *inverse = ortho->inverse + corner;
    for (int col = 0; col < first.width; col++)
        memcpy(inverse + col * ld, ortho->gram + corner + col * ld,
               (size_t)second.width * sizeof *inverse);
    cblas_dtrmm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, second.width,
                first.width, -1.0, two, ld, inverse, ld);
    cblas_dtrmm(CblasColMajor, CblasRight, CblasLower, CblasNoTrans, CblasNonUnit, second.width,
                first.width, 1.0, one, ld, inverse, ld);
}

/** The same as cholesky of a part of any width: the first half, which is then taken out of the
 * second. Most of the work is thus in dgemm. */
static hd_status by_halves(hd_ortho *ortho, panel whole, panel x)
{
    if (x.width <= LEAF_MAX) return cholesky(ortho, whole, x);
    const int half = (x.width / 2 + 7) / 8 * 8;
    const panel first = {x.a, x.lda, x.first, half};
    const panel second = {x.a + half, x.lda, x.first + half, x.width - half};
    double *s = triangle_at(ortho->gram, whole, first) + half;
    HD_TRY(by_halves(ortho, whole, first));
    inner_products(ortho, s, whole.width, second, first);
    take_out(ortho, s, whole.width, second, first);
    HD_TRY(by_halves(ortho, whole, second));
    invert_corner(ortho, whole, first, second);
    return HD_OK;
}

/** scale <- diagonal of G = L L^T. */
static void panel_scale(hd_ortho *ortho, int width)
{
    memset(ortho->scale, 0, (size_t)width * sizeof *ortho->scale);
    for (int col = 0; col < width; col++)
        for (int row = col; row < width; row++) {
            const double entry = ortho->gram[col * width + row];
            ortho->scale[row] += entry * entry;
        }
}

/** Condition of the panel by itself. INFINITY if not finite. */
static double panel_condition(const hd_ortho *ortho, int width)
{
    double worst = 0.0;
    for (int row = 0; row < width; row++) {
        double sum = 0.0;
        for (int col = 0; col <= row; col++) {
            const double entry = ortho->inverse[col * width + row];
            sum += entry * entry * ortho->scale[col];
        }
        if (!(sum < INFINITY)) return INFINITY;
        worst = fmax(worst, sum);
    }
    return sqrt(worst);
}

/** The probes' rows of this panel are complete but for D x itself. */
static void probe_panel(hd_ortho *ortho, panel x)
{
    for (int k = 0; k < x.width; k++) ortho->norm2[x.first + k] += ortho->scale[k];
    for (int p = 0; p < HD_PROBES; p++)
        for (int k = x.first; k < x.first + x.width; k++)
            ortho->probe[p * ortho->vectors + k] += hd_probe_sign(k, p) * sqrt(ortho->norm2[k]);
}

static hd_status panel_orthonormalise(hd_ortho *ortho, panel x)
{
    bool good = false;
    for (int pass = 0; pass < 2 && !good; pass++) {
        HD_TRY(by_halves(ortho, x, x));
        panel_scale(ortho, x.width);
        for (int k = 0; k < x.width; k++)
            ortho->log_stretch[x.first + k] += log(ortho->gram[k * (x.width + 1)]);
        keep_panel(ortho, x, pass > 0);
        const double condition = panel_condition(ortho, x.width);
        if (!(condition <= PANEL_CONDITION_MAX)) return HD_ILL_CONDITIONED;
        if (pass == 0) probe_panel(ortho, x);
        cblas_dtrmm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, x.width,
                    HD_PROBES, 1.0, ortho->inverse, x.width, ortho->probe + x.first,
                    ortho->vectors);
        good = condition <= PANEL_CONDITION_GOOD;
        if (good) ortho->panel_condition = fmax(ortho->panel_condition, condition);
    }
    return HD_OK;
}

/** Takes the panel out of later vectors, and out of their probes. */
static void panel_project(hd_ortho *ortho, panel x, panel later)
{
    double *s = ortho->projection;
    const int count = later.width;
    inner_products(ortho, s, count, later, x);
    keep_projection(ortho, x, later);
    for (int col = 0; col < x.width; col++)
        for (int row = 0; row < count; row++) {
            const double entry = s[(size_t)col * (size_t)count + (size_t)row];
            ortho->norm2[later.first + row] += entry * entry;
        }
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, count, HD_PROBES, x.width, -1.0, s,
                count, ortho->probe + x.first, ortho->vectors, 1.0, ortho->probe + later.first,
                ortho->vectors);
    take_out(ortho, s, count, later, x);
}

static void panel_project_out(hd_ortho *ortho, panel x)
{
    const int first = x.first + x.width, width = piece_width(ortho->vectors - first);
    for (int next = first; next < ortho->vectors; next += width)
        panel_project(ortho, x, piece_at(ortho, x, next, width));
}

/* ---- a step -------------------------------------------------------------------------------- */

void hd_ortho_probes_clear(hd_ortho *ortho)
{
    memset(ortho->norm2, 0, (size_t)ortho->vectors * sizeof *ortho->norm2);
    memset(ortho->probe, 0, (size_t)ortho->vectors * HD_PROBES * sizeof *ortho->probe);
}

static hd_status pass(hd_ortho *ortho, hd_frame *frame, double condition_max)
{
    hd_ortho_probes_clear(ortho);
    ortho->panel_condition = HD_PANEL_CONDITION_LEAST;
    for (int first = 0; first < ortho->vectors; first += ortho->width) {
        const panel x = panel_of(ortho, frame, first);
        HD_TRY(panel_orthonormalise(ortho, x));
        panel_project_out(ortho, x);
    }
    ortho->condition = hd_ortho_condition_from_probes(ortho);
    ortho->passes++;
    return ortho->condition <= condition_max ? HD_OK : HD_ILL_CONDITIONED;
}

void hd_ortho_begin(hd_ortho *ortho, const hd_frame *frame, hd_norm norm)
{
    HD_ASSERT(hd_frame_rows(frame) == ortho->rows && hd_frame_vectors(frame) == ortho->vectors);
    HD_ASSERT(norm == HD_NORM_FULL || 2 * ortho->vectors <= ortho->rows);
    ortho->norm = norm;
    for (int col = 0; col < ortho->vectors; col++) ortho->log_stretch[col] = 0.0;
    ortho->passes = 0;
}

/** V = Q (L_1 L_2)^T. */
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

/** What is no number in dp halves, which the norm of dq does not see, has gone on to the last
 * vector: each is added to all later ones. */
static hd_status unseen_check(const hd_ortho *ortho, const hd_frame *frame)
{
    const double *last = hd_frame_read(frame) + ortho->vectors - 1;
    bool finite = true;
    for (int row = 0; row < ortho->rows; row++)
        finite = finite && isfinite(last[(size_t)row * (size_t)hd_frame_stride(frame)]);
    return finite ? HD_OK : HD_ILL_CONDITIONED;
}

hd_status hd_ortho_step(hd_ortho *ortho, hd_frame *frame, hd_ortho_limits limits)
{
    hd_ortho_begin(ortho, frame, limits.norm);
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

/** max(worst, |x^T y - diagonal|) over all pairs of columns x of the panel and y; NaN stays. */
static double panel_defect(hd_ortho *ortho, panel x, panel y, double worst)
{
    const double *s = ortho->projection;
    inner_products(ortho, ortho->projection, y.width, y, x);
    for (int col = 0; col < x.width; col++)
        for (int row = 0; row < y.width; row++) {
            const bool same = x.first + col == y.first + row;
            const double off = fabs(s[(size_t)col * (size_t)y.width + (size_t)row] - same);
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
    for (int first = 0; first < ortho->vectors; first += ortho->width) {
        const panel x = panel_of(ortho, frame, first);
        const int width = piece_width(ortho->vectors - first);
        for (int next = first; next < ortho->vectors; next += width)
            worst = panel_defect(ortho, x, piece_at(ortho, x, next, width), worst);
    }
    ortho->norm = of_the_step;
    return worst;
}
