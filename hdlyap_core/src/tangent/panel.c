/** Some neighbouring vectors -> orthonormal ones, which are taken out of all later vectors. Storage
 * and equations are those of ortho.c. */
#include "tangent/panel.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <string.h>

#include "base/check.h"
#include "tangent/product.h"

/** A panel with a condition above this gets a second Cholesky pass, because its loss of
 * orthogonality, eps condition^2, spoils the projection of later panels. */
static const double PANEL_CONDITION_GOOD = 16.0;

/** The panel of `most` vectors from `first` on; of fewer if the next ones lie elsewhere. */
static hd_panel panel_at(hd_frame *frame, int first, int most)
{
    const int left = hd_frame_neighbours(frame, first);
    return (hd_panel){hd_frame_vector(frame, first), hd_frame_stride(frame), first,
                      left < most ? left : most};
}

/** Copies a panel's vectors, wherever they are, into its copy, or back. */
static void copy(const hd_ortho *ortho, hd_frame *frame, hd_panel x, bool back)
{
    for (int col = 0; col < x.width;) {
        const hd_panel part = panel_at(frame, x.first + col, x.width - col);
        for (int row = 0; row < ortho->rows; row++) {
            double *there = part.a + (size_t)row * (size_t)part.lda,
                   *here = x.a + (size_t)row * (size_t)x.lda + col;
            memcpy(back ? there : here, back ? here : there, (size_t)part.width * sizeof *here);
        }
        col += part.width;
    }
}

hd_panel hd_panel_load(hd_ortho *ortho, hd_frame *frame, int first, int width)
{
    const hd_panel there = panel_at(frame, first, width);
    const hd_panel here = {ortho->copy, width, first, width};
    if (there.width == width) return there;
    copy(ortho, frame, here, false);
    return here;
}

void hd_panel_store(const hd_ortho *ortho, hd_frame *frame, hd_panel x)
{
    if (x.a == ortho->copy) copy(ortho, frame, x, true);
}

int hd_panel_later_width(int later)
{
    const int pieces = (later + HD_LATER_MAX - 1) / HD_LATER_MAX;
    return pieces > 1 ? ((later + pieces - 1) / pieces + 7) / 8 * 8 : later;
}

/** The square block of a panel's triangle that belongs to a part of the panel. */
static double *triangle_at(double *triangle, hd_panel whole, hd_panel part)
{
    return triangle + (size_t)(part.first - whole.first) * (size_t)(whole.width + 1);
}

/** s <- A_y A_x^T over the particles of this rank, in the norm, column-major. The norm of dq uses
 * only the columns of A that are dq_x, dq_y, .. */
static void inner_products_here(const hd_ortho *ortho, double *s, int lds, hd_panel y, hd_panel x)
{
    const bool dq = ortho->norm == HD_NORM_DQ;
    const int parts = dq ? ortho->coordinates : 1, step = dq ? 2 * parts : 1;
    for (int part = 0; part < parts; part++)
        hd_dgemm(CblasNoTrans, CblasTrans, y.width, x.width, ortho->rows / step, 1.0,
                 y.a + part * y.lda, step * y.lda, x.a + part * x.lda, step * x.lda, part > 0, s,
                 lds);
}

/** s <- A_y A_x^T over the particles of all ranks, in the norm, column-major. */
static void inner_products(const hd_ortho *ortho, double *s, int lds, hd_panel y, hd_panel x)
{
    const size_t height = (size_t)y.width, width = (size_t)x.width;
    double *sum = ortho->communicator && lds != y.width ? ortho->sum : s;
    inner_products_here(ortho, sum, sum == s ? lds : y.width, y, x);
    if (!ortho->communicator) return;
    hd_communicator_sum(ortho->communicator, sum, height * width);
    for (size_t col = 0; col < width && sum != s; col++)
        memcpy(s + col * (size_t)lds, sum + col * height, height * sizeof *s);
}

/** A_y <- A_y - S A_x. */
static void take_out(const hd_ortho *ortho, const double *s, int lds, hd_panel y, hd_panel x)
{
    hd_dgemm(CblasNoTrans, CblasNoTrans, y.width, ortho->rows, x.width, -1.0, s, lds, x.a, x.lda,
             1.0, y.a, y.lda);
}

/** The entry of L at a row and the panel's first column, in the factor of the present pass. */
static double *factor_at(const hd_ortho *ortho, hd_panel x, int row)
{
    return ortho->factor[ortho->passes > 0] + (size_t)x.first * (size_t)ortho->vectors + row;
}

/** Keeps the panel's own triangle, which is in gram; again: the second Cholesky pass, L = L_1 L_2.
 */
static void keep_panel(const hd_ortho *ortho, hd_panel x, bool again)
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

/** Keeps S, the rows of L that belong to some later vectors. */
static void keep_projection(const hd_ortho *ortho, hd_panel x, int first, int count)
{
    if (!ortho->factor[0]) return;
    for (int col = 0; col < x.width; col++)
        memcpy(factor_at(ortho, x, first) + (size_t)col * (size_t)ortho->vectors,
               ortho->projection + (size_t)col * (size_t)count, (size_t)count * sizeof(double));
}

/** Orthonormalises a narrow part of a panel: gram <- L of G = A_p A_p^T, inverse <- L^-1,
 * A_p <- L^-1 A_p. */
static hd_status cholesky(hd_ortho *ortho, hd_panel whole, hd_panel x)
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

/** Fills the block of L^-1 below the first half, -L_2^-1 S L_1^-1; both halves are there already.
 */
static void invert_corner(hd_ortho *ortho, hd_panel whole, hd_panel first, hd_panel second)
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

/** Does what `cholesky` does for a part of any width: orthonormalises its first half and takes that
 * out of the second. Thus most of the work is in dgemm. */
static hd_status by_halves(hd_ortho *ortho, hd_panel whole, hd_panel x)
{
    if (x.width <= ortho->leaf) return cholesky(ortho, whole, x);
    const int half = x.width > HD_LEAF_MAX ? (x.width / 2 + 7) / 8 * 8 : x.width / 2;
    const hd_panel first = {x.a, x.lda, x.first, half};
    const hd_panel second = {x.a + half, x.lda, x.first + half, x.width - half};
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

/** Condition of the panel alone; INFINITY if it is not finite. */
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

/** Completes the probes' rows of this panel, which lacked only D x. */
static void probe_panel(hd_ortho *ortho, hd_panel x)
{
    for (int k = 0; k < x.width; k++) ortho->norm2[x.first + k] += ortho->scale[k];
    for (int p = 0; p < HD_PROBES; p++)
        for (int k = x.first; k < x.first + x.width; k++)
            ortho->probe[p * ortho->vectors + k] += hd_probe_sign(k, p) * sqrt(ortho->norm2[k]);
}

hd_status hd_panel_orthonormalise(hd_ortho *ortho, hd_panel x)
{
    bool good = false;
    for (int pass = 0; pass < 2 && !good; pass++) {
        HD_TRY(by_halves(ortho, x, x));
        panel_scale(ortho, x.width);
        for (int k = 0; k < x.width; k++)
            ortho->log_stretch[x.first + k] += log(ortho->gram[k * (x.width + 1)]);
        keep_panel(ortho, x, pass > 0);
        const double condition = panel_condition(ortho, x.width);
        if (!(condition <= ortho->panel_condition_max)) return HD_ILL_CONDITIONED;
        if (pass == 0) probe_panel(ortho, x);
        cblas_dtrmm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, x.width,
                    HD_PROBES, 1.0, ortho->inverse, x.width, ortho->probe + x.first,
                    ortho->vectors);
        good = condition <= PANEL_CONDITION_GOOD;
        if (good) ortho->panel_condition = fmax(ortho->panel_condition, condition);
    }
    return HD_OK;
}

void hd_panel_products(hd_ortho *ortho, hd_frame *frame, double *s, int first, int count,
                       hd_panel x)
{
    for (int at = 0; at < count;) {
        const hd_panel part = panel_at(frame, first + at, count - at);
        inner_products_here(ortho, s + at, count, part, x);
        at += part.width;
    }
    hd_communicator_sum(ortho->communicator, s, (size_t)count * (size_t)x.width);
}

/** Takes the panel out of `count` later vectors, and out of their probes. */
static void panel_project(hd_ortho *ortho, hd_frame *frame, hd_panel x, int first, int count)
{
    double *s = ortho->projection;
    hd_panel_products(ortho, frame, s, first, count, x);
    keep_projection(ortho, x, first, count);
    for (int col = 0; col < x.width; col++)
        for (int row = 0; row < count; row++) {
            const double entry = s[(size_t)col * (size_t)count + (size_t)row];
            ortho->norm2[first + row] += entry * entry;
        }
    hd_dgemm(CblasNoTrans, CblasNoTrans, count, HD_PROBES, x.width, -1.0, s, count,
             ortho->probe + x.first, ortho->vectors, 1.0, ortho->probe + first, ortho->vectors);
    for (int at = 0; at < count;) {
        const hd_panel part = panel_at(frame, first + at, count - at);
        take_out(ortho, s + at, count, part, x);
        at += part.width;
    }
}

void hd_panel_project_out(hd_ortho *ortho, hd_frame *frame, hd_panel x)
{
    const int first = x.first + x.width, width = hd_panel_later_width(ortho->vectors - first);
    for (int next = first; next < ortho->vectors; next += width) {
        const int left = ortho->vectors - next;
        panel_project(ortho, frame, x, next, left < width ? left : width);
    }
}
