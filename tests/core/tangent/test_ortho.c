/** The factorisation against LAPACK's Householder one, and the honesty of its condition estimate.
 */
#include <lapacke.h>
#include "testing.h"
#include "base/random.h"

static const hd_ortho_limits LOOSE = {1e7, 0.5, HD_NORM_FULL},
                             TIGHT = {1e7, DBL_EPSILON, HD_NORM_FULL};

/** m x n row-major copy of the frame's vectors, without padding. */
static double *copied(hd_frame *frame)
{
    const int n = hd_frame_vectors(frame);
    double *v = malloc((size_t)(hd_frame_rows(frame) * n) * sizeof *v);
    for (int row = 0; row < hd_frame_rows(frame); row++)
        for (int col = 0; col < n; col++)
            v[row * n + col] = hd_frame_data(frame)[row * hd_frame_stride(frame) + col];
    return v;
}

/** |diag R| of a row-major matrix by dgeqrf. */
static void householder(const double *v, int rows, int n, double *diagonal)
{
    HEAP double *a = malloc((size_t)(rows * n) * sizeof *a), *tau = malloc((size_t)n * sizeof *tau);
    memcpy(a, v, (size_t)(rows * n) * sizeof *a);
    assert_int_equal(LAPACKE_dgeqrf(LAPACK_ROW_MAJOR, rows, n, a, n, tau), 0);
    for (int col = 0; col < n; col++) diagonal[col] = fabs(a[col * n + col]);
}

/** Lets the columns lean into the first two, the last ones e^spread times: so does a long interval.
 */
static void make_ill_conditioned(hd_frame *frame, double spread)
{
    const int n = hd_frame_vectors(frame);
    for (int row = 0; row < hd_frame_rows(frame); row++) {
        double *v = hd_frame_data(frame) + row * hd_frame_stride(frame);
        const double fast[2] = {v[0], n > 1 ? v[1] : 0.0};
        for (int col = 1; col < n; col++)
            v[col] += exp(spread * col / n) * (fast[0] + (col > 1 ? 0.3 * fast[1] : 0.0));
    }
}

/** max |Q^T V - R| off the upper triangle and max |V - Q (Q^T V)|, both relative to column norms.
 */
static void check_factors(const double *v, const double *q, int rows, int n, double tolerance)
{
    for (int col = 0; col < n; col++) {
        double norm = 0.0;
        HEAP double *left = malloc((size_t)rows * sizeof *left);
        for (int row = 0; row < rows; row++) {
            left[row] = v[row * n + col];
            norm += left[row] * left[row];
        }
        for (int k = 0; k <= col; k++) { /* only the columns up to col: nested spans */
            double r = 0.0;
            for (int row = 0; row < rows; row++) r += q[row * n + k] * v[row * n + col];
            for (int row = 0; row < rows; row++) left[row] -= r * q[row * n + k];
        }
        for (int row = 0; row < rows; row++) CHECK_CLOSE(left[row], 0.0, tolerance * sqrt(norm));
    }
}

/** max |V - Q R| with the R that was kept, relative to column norms; of many columns every
 * seventh, with the last. */
static void check_kept(const double *v, const double *q, const double *r, int rows, int n)
{
    for (int col = n - 1; col >= 0; col -= n > 200 ? 7 : 1) {
        double norm = 0.0;
        for (int row = 0; row < rows; row++) norm += v[row * n + col] * v[row * n + col];
        for (int row = 0; row < rows; row++) {
            double sum = 0.0;
            for (int k = 0; k <= col; k++) sum += q[row * n + k] * r[k * n + col];
            CHECK_CLOSE(sum, v[row * n + col], 64 * DBL_EPSILON * sqrt(norm));
        }
    }
}

/** With the passes that a step made: none, one or two of them have to be multiplied. */
static void check_factor(int disks, int n, double spread, hd_ortho_limits limits, int passes)
{
    MADE(hd_frame, frame, PARTICLES(disks), n, 11, 1);
    MADE(hd_ortho, ortho, 4 * disks, n);
    assert_null(hd_ortho_factor(ortho));
    CHECK_OK(hd_ortho_keep_factor(ortho));
    for (int again = 0; again < 2; again++) { /* nothing of the first is left in the second */
        make_ill_conditioned(frame, spread);
        HEAP double *v = copied(frame);
        if (passes == 0)
            CHECK_OK(hd_ortho_step_stable(ortho, frame, 1e13));
        else
            CHECK_OK(hd_ortho_step(ortho, frame, limits));
        if (passes > 0) assert_int_equal(hd_ortho_passes(ortho), passes);
        HEAP double *q = copied(frame);
        const double *r = hd_ortho_factor(ortho);
        check_kept(v, q, r, 4 * disks, n);
        for (int col = 0; col < n; col++)
            CHECK_CLOSE(log(r[col * n + col]), hd_ortho_log_stretch(ortho)[col], 64 * DBL_EPSILON);
    }
}

TEST(keeps_the_triangle)
{
    const int sizes[][2] = {{3, 1}, {5, 2}, {12, 17}, {40, 80}, {40, 160}, {200, 750}};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        const double spread = sizes[k][1] > 1 ? 10.0 : 0.0;
        if (spread > 0) check_factor(sizes[k][0], sizes[k][1], spread, TIGHT, 2);
        check_factor(sizes[k][0], sizes[k][1], spread, LOOSE, 1);
        check_factor(sizes[k][0], sizes[k][1], spread, LOOSE, 0);
    }
}

static void check_step(int disks, int n, double spread, int stable)
{
    const int rows = 4 * disks;
    double diagonal[200];
    MADE(hd_frame, frame, PARTICLES(disks), n, 11, 1);
    MADE(hd_ortho, ortho, rows, n);
    make_ill_conditioned(frame, spread);
    HEAP double *v = copied(frame);
    householder(v, rows, n, diagonal);
    if (stable)
        CHECK_OK(hd_ortho_step_stable(ortho, frame, 1e13));
    else
        CHECK_OK(hd_ortho_step(ortho, frame, TIGHT));
    HEAP double *q = copied(frame);
    const double rounding = 32 * DBL_EPSILON * hd_ortho_condition(ortho);
    for (int col = 0; col < n; col++)
        CHECK_CLOSE(hd_ortho_log_stretch(ortho)[col], log(diagonal[col]), rounding);
    assert_true(hd_ortho_defect_measured(ortho, frame, HD_NORM_FULL) < 32 * DBL_EPSILON);
    check_factors(v, q, rows, n, 64 * DBL_EPSILON);
}

TEST(agrees_with_householder)
{
    check_step(3, 1, 0.0, 0);
    for (int stable = 0; stable < 2; stable++)
        for (double spread = 0.0; spread <= 12.0; spread += 4.0) {
            check_step(5, 2, spread, stable);
            check_step(12, 17, spread, stable);
            check_step(40, 80, spread, stable);
            check_step(40, 160, 0.5 * spread, stable);
        }
    check_step(20, 40, 20.0, 1); /* 5e8: beyond Cholesky, not beyond reflections */
}

/** max_l sqrt(sum_k (R^-1)_kl^2 |V e_k|^2), R by dgeqrf, its inverse by dtrtri. */
static double exact_condition(const double *v, int rows, int n)
{
    HEAP double *a = malloc((size_t)(rows * n) * sizeof *a), *tau = malloc((size_t)n * sizeof *tau);
    double worst = 0.0;
    memcpy(a, v, (size_t)(rows * n) * sizeof *a);
    assert_int_equal(LAPACKE_dgeqrf(LAPACK_ROW_MAJOR, rows, n, a, n, tau), 0);
    for (int k = 0; k < n; k++) { /* |V e_k|^2, before R is overwritten */
        tau[k] = 0.0;
        for (int l = 0; l <= k; l++) tau[k] += a[l * n + k] * a[l * n + k];
    }
    assert_int_equal(LAPACKE_dtrtri(LAPACK_ROW_MAJOR, 'U', 'N', n, a, n), 0);
    for (int l = 0; l < n; l++) {
        double sum = 0.0;
        for (int k = 0; k <= l; k++) sum += a[k * n + l] * a[k * n + l] * tau[k];
        worst = fmax(worst, sum);
    }
    return sqrt(worst);
}

/** Eight probes know each column to a quarter; the largest of a hundred such estimates is within
 * 0.8 and 2 of the truth. */
TEST(the_condition_is_that_of_the_inverse)
{
    for (double spread = 0.0; spread <= 12.0; spread += 1.5)
        for (int stable = 0; stable < 2; stable++) {
            MADE(hd_frame, frame, PARTICLES(40), 90, 3, 1);
            MADE(hd_ortho, ortho, 160, 90);
            make_ill_conditioned(frame, spread);
            HEAP double *v = copied(frame);
            if (stable)
                CHECK_OK(hd_ortho_step_stable(ortho, frame, 1e13));
            else
                CHECK_OK(hd_ortho_step(ortho, frame, LOOSE));
            const double ratio = hd_ortho_condition(ortho) / exact_condition(v, 160, 90);
            assert_true(ratio > 0.8 && ratio < 2.0);
        }
}

/** One pass: the predicted defect is never below what is measured, and not far above it. It grows
 * as the condition, not as its square. */
TEST(the_defect_is_foreseen)
{
    for (double spread = 2.0; spread <= 12.0; spread += 1.0) {
        MADE(hd_frame, frame, PARTICLES(50), 100, 7, 1);
        MADE(hd_ortho, ortho, 200, 100);
        make_ill_conditioned(frame, spread);
        CHECK_OK(hd_ortho_step(ortho, frame, LOOSE));
        assert_int_equal(hd_ortho_passes(ortho), 1);
        const double measured = hd_ortho_defect_measured(ortho, frame, HD_NORM_FULL);
        assert_true(measured <= hd_ortho_defect(ortho) + 16 * DBL_EPSILON);
        assert_true(measured >= 1e-2 * hd_ortho_defect(ortho));
    }
}

/** A loose Q costs nothing: what one step leaves out, the next one adds [T5]. Made loose by hand: a
 * factor D, upper triangular with a diagonal of 1, is in no logarithm at all. */
static void loosen(hd_frame *frame)
{
    for (int row = 0; row < hd_frame_rows(frame); row++) {
        double *v = hd_frame_data(frame) + row * hd_frame_stride(frame);
        for (int col = hd_frame_vectors(frame) - 1; col > 0; col--) v[col] += 0.01 * v[col - 1];
    }
}

TEST(logarithms_telescope)
{
    enum { N = 60 };
    double sum[2][N] = {{0}};
    MADE(hd_frame, loose, PARTICLES(30), N, 7, 1);
    MADE(hd_frame, tight, PARTICLES(30), N, 7, 1);
    MADE(hd_ortho, ortho, 120, N);
    double defect = 0.0;
    for (int step = 0; step < 6; step++) {
        const hd_ortho_limits limits = step < 5 ? LOOSE : TIGHT;
        make_ill_conditioned(loose, 12.0);
        make_ill_conditioned(tight, 12.0);
        CHECK_OK(hd_ortho_step(ortho, loose, limits));
        if (step < 5) loosen(loose);
        if (step < 5) defect = fmax(defect, hd_ortho_defect_measured(ortho, loose, HD_NORM_FULL));
        for (int col = 0; col < N; col++) sum[0][col] += hd_ortho_log_stretch(ortho)[col];
        CHECK_OK(hd_ortho_step_stable(ortho, tight, 1e13));
        for (int col = 0; col < N; col++) sum[1][col] += hd_ortho_log_stretch(ortho)[col];
    }
    const double rounding = 6 * 64 * DBL_EPSILON * hd_ortho_condition(ortho);
    assert_true(defect > 10 * rounding); /* the loose states were loose */
    for (int col = 0; col < N; col++) CHECK_CLOSE(sum[0][col], sum[1][col], rounding);
}

/** One entry that is no number is seen in the measured defect wherever it stands. */
TEST(a_measured_defect_keeps_nan)
{
    for (int col = 0; col < 30; col++) {
        MADE(hd_frame, frame, PARTICLES(10), 30, 7, 1);
        MADE(hd_ortho, ortho, 40, 30);
        CHECK_OK(hd_ortho_step(ortho, frame, TIGHT));
        hd_frame_data(frame)[5 * hd_frame_stride(frame) + col] = NAN;
        assert_true(isnan(hd_ortho_defect_measured(ortho, frame, HD_NORM_FULL)));
    }
}

static hd_status step_with_entry(double value, double condition, int twin)
{
    MADE(hd_frame, frame, PARTICLES(10), 12, 7, 1);
    MADE(hd_ortho, ortho, 40, 12);
    double *v = hd_frame_data(frame);
    v[5 * hd_frame_stride(frame) + 3] = value;
    if (twin)
        for (int row = 0; row < 40; row++)
            v[row * hd_frame_stride(frame) + 9] = v[row * hd_frame_stride(frame) + 2];
    const hd_ortho_limits limits = {condition, 0.5, HD_NORM_FULL};
    return hd_ortho_step(ortho, frame, limits);
}

TEST(what_cannot_be_trusted_is_refused)
{
    assert_int_equal(step_with_entry(0.5, 1e7, 0), HD_OK);
    assert_int_equal(step_with_entry(NAN, 1e7, 0), HD_ILL_CONDITIONED);
    assert_int_equal(step_with_entry(INFINITY, 1e7, 0), HD_ILL_CONDITIONED);
    assert_int_equal(step_with_entry(1e200, 1e7, 0), HD_ILL_CONDITIONED);
    assert_int_equal(step_with_entry(0.5, 1e7, 1), HD_ILL_CONDITIONED); /* lost rank */
    assert_int_equal(step_with_entry(0.5, 1.01, 0), HD_ILL_CONDITIONED);
}
