/** The norm of dq against a slow twin, and against the full norm on tangent maps of a scene. */
#include "exact.h"
#include "forward_pass.h"
#include "tangent.h"

static const hd_ortho_limits FULL = {1e9, DBL_EPSILON, HD_NORM_FULL},
                             LOOSE = {1e9, 0.5, HD_NORM_DQ}, TIGHT = {1e9, DBL_EPSILON, HD_NORM_DQ};

/* ---- the twin ------------------------------------------------------------------------------ */

static hd_exact dot_dq(const hd_exact *v, int rows, int n, int a, int b)
{
    hd_exact sum = 0.0L;
    for (int row = 0; row < rows; row++)
        if (row % 4 < 2) sum += v[row * n + a] * v[row * n + b];
    return sum;
}

/** Gram and Schmidt, twice: v <- Q, r[n * n] row-major, V = Q R. */
static void twin(hd_exact *v, int rows, int n, hd_exact *r)
{
    for (int col = 0; col < n; col++) {
        for (int again = 0; again < 2; again++)
            for (int b = 0; b < col; b++) {
                const hd_exact overlap = dot_dq(v, rows, n, b, col);
                r[b * n + col] += overlap;
                for (int row = 0; row < rows; row++) v[row * n + col] -= overlap * v[row * n + b];
            }
        const hd_exact norm = sqrtl(dot_dq(v, rows, n, col, col));
        r[col * n + col] = norm;
        for (int row = 0; row < rows; row++) v[row * n + col] /= norm;
    }
}

/** max_l sqrt(sum_k (R^-1)_kl^2 |R e_k|^2), with |V e_k| = |R e_k|. */
static double condition_of(const hd_exact *r, int n)
{
    hd_exact *inverse = calloc((size_t)(n * n), sizeof *inverse), worst = 0.0L;
    for (int l = 0; l < n; l++) {
        hd_exact sum = 0.0L;
        for (int k = l; k >= 0; k--) { /* R x = e_l */
            hd_exact right = k == l, length2 = 0.0L;
            for (int j = k + 1; j <= l; j++) right -= r[k * n + j] * inverse[j * n + l];
            inverse[k * n + l] = right / r[k * n + k];
            for (int j = 0; j <= k; j++) length2 += r[j * n + k] * r[j * n + k];
            sum += inverse[k * n + l] * inverse[k * n + l] * length2;
        }
        worst = fmaxl(worst, sum);
    }
    free(inverse);
    return (double)sqrtl(worst);
}

/** All columns lean into the first, the last one e^spread times; dp halves differ in size. */
static void lean(hd_frame *frame, double spread)
{
    const int n = hd_frame_vectors(frame);
    for (int row = 0; row < hd_frame_rows(frame); row++) {
        double *v = hd_frame_data(frame) + row * hd_frame_stride(frame);
        for (int col = 0; col < n; col++) v[col] *= row % 4 < 2 ? 1.0 : 3.0;
        for (int col = 1; col < n; col++) v[col] += exp(spread * col / n) * v[0];
    }
}

/** max |V - Q R|, relative to the columns of V. */
static void check_kept(const hd_exact *v, const hd_frame *q, const double *r, int n)
{
    const int rows = hd_frame_rows(q);
    for (int col = 0; col < n; col++) {
        hd_exact length2 = 0.0L;
        for (int row = 0; row < rows; row++) length2 += v[row * n + col] * v[row * n + col];
        for (int row = 0; row < rows; row++) {
            hd_exact sum = 0.0L;
            for (int k = 0; k <= col; k++)
                sum += (hd_exact)hd_frame_read(q)[row * hd_frame_stride(q) + k] * r[k * n + col];
            CHECK_CLOSE((double)sum, (double)v[row * n + col],
                        64 * DBL_EPSILON * sqrt((double)length2));
        }
    }
}

/** Frames of 1 panel, of several, and of as many vectors as the norm can tell apart. */
static void check_against_twin(int disks, int n, double spread, hd_ortho_limits limits)
{
    const int rows = 4 * disks;
    MADE(hd_frame, frame, PARTICLES(disks), n, 11, 1);
    MADE(hd_ortho, ortho, rows, n);
    CHECK_OK(hd_ortho_keep_factor(ortho));
    lean(frame, spread);
    HEAP hd_exact *v = exact_copy(frame), *q = exact_copy(frame);
    HEAP hd_exact *r = calloc((size_t)(n * n), sizeof *r);
    twin(q, rows, n, r);
    CHECK_OK(hd_ortho_step(ortho, frame, limits));
    assert_int_equal(hd_ortho_norm(ortho), HD_NORM_DQ);
    const double condition = hd_ortho_condition(ortho);
    const double rounding = 32 * DBL_EPSILON * condition;
    /* eight probes know one column to a quarter */
    const double ratio = condition / condition_of(r, n);
    assert_true(ratio > 0.4 && ratio < 2.0);
    check_kept(v, frame, hd_ortho_factor(ortho), n);
    for (int col = 0; col < n; col++) {
        const double stretch = hd_ortho_log_stretch(ortho)[col];
        CHECK_CLOSE(stretch, (double)logl(r[col * n + col]), rounding);
        CHECK_CLOSE(log(hd_ortho_factor(ortho)[col * (n + 1)]), stretch, 64 * DBL_EPSILON);
    }
    if (limits.defect < 0.1)
        assert_true(hd_ortho_defect_measured(ortho, frame, HD_NORM_DQ) < 32 * DBL_EPSILON);
    hd_exact size = 0.0L; /* of a dp half at most, dq halves have the length 1 */
    for (int k = 0; k < rows * n; k++) size = fmaxl(size, fabsl(q[k]));
    for (int row = 0; row < rows; row++)
        for (int col = 0; col < n; col++)
            CHECK_CLOSE(*frame_entry(frame, row, col), (double)q[row * n + col],
                        rounding * fmax(1.0, (double)size));
}

TEST(agrees_with_the_twin)
{
    const int sizes[][2] = {{1, 1}, {1, 2}, {5, 2}, {12, 17}, {12, 21}, {40, 70}, {60, 100}};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++)
        for (double spread = 0.0; spread <= 12.0; spread += 6.0) {
            check_against_twin(sizes[k][0], sizes[k][1], spread, LOOSE);
            check_against_twin(sizes[k][0], sizes[k][1], spread, TIGHT);
        }
}

/** One pass: never below what is measured, and not far above it [T7]. */
TEST(the_defect_is_foreseen)
{
    for (double spread = 2.0; spread <= 14.0; spread += 1.0) {
        MADE(hd_frame, frame, PARTICLES(60), 100, 7, 1);
        MADE(hd_ortho, ortho, 240, 100);
        lean(frame, spread);
        CHECK_OK(hd_ortho_step(ortho, frame, LOOSE));
        assert_int_equal(hd_ortho_passes(ortho), 1);
        const double measured = hd_ortho_defect_measured(ortho, frame, HD_NORM_DQ);
        assert_true(measured <= hd_ortho_defect(ortho) + 16 * DBL_EPSILON);
        assert_true(measured >= 1e-3 * hd_ortho_defect(ortho));
        assert_true(hd_ortho_defect_measured(ortho, frame, HD_NORM_FULL) > 0.5);
    }
}

/* ---- what is refused ----------------------------------------------------------------------- */

static hd_status step_of(hd_frame *frame, hd_ortho_limits limits)
{
    MADE(hd_ortho, ortho, hd_frame_rows(frame), hd_frame_vectors(frame));
    return hd_ortho_step(ortho, frame, limits);
}

/** Two vectors with the same dq half: different for the full norm. */
TEST(dependent_dq_halves_are_refused)
{
    for (int to = 1; to < 20; to += 6)
        for (int how = 0; how < 2; how++) {
            MADE(hd_frame, frame, PARTICLES(12), 20, 7, 1);
            for (int row = 0; row < 48; row++)
                if (row % 4 < 2) *frame_entry(frame, row, to) = *frame_entry(frame, row, 0);
            assert_int_equal(step_of(frame, how ? LOOSE : FULL), how ? HD_ILL_CONDITIONED : HD_OK);
        }
}

/** Wherever it stands: in a dp half no inner product meets it. */
TEST(what_is_no_number_is_refused)
{
    static const double values[] = {NAN, INFINITY, -INFINITY};
    for (int k = 0; k < 3; k++)
        for (int row = 4; row < 8; row++)
            for (int col = 0; col < 20; col++) {
                MADE(hd_frame, frame, PARTICLES(12), 20, 7, 1);
                *frame_entry(frame, row, col) = values[k];
                assert_int_equal(step_of(frame, LOOSE), HD_ILL_CONDITIONED);
            }
}

/* ---- a scene ------------------------------------------------------------------------------- */

/** One trajectory, the same vectors factored in the full norm and in others. */
typedef struct chain {
    forward_pass f; /**< in the full norm */
    hd_frame *frame;
    hd_ortho *ortho;
    int n;
    double *sum[2]; /**< [n], of ln R_ll: in the full norm, in the others */
    double condition[2], time;
} chain;

enum { DISKS = 24, WARMUP = 60, STEPS = 60 };
static const double INTERVAL = 0.8;

static void chain_step(chain *c, hd_ortho_limits other)
{
    forward_pass *f = &c->f;
    const double end = hd_trajectory_time(f->trajectory) + INTERVAL;
    CHECK_OK(trajectory_to(f->trajectory, f->log, end));
    CHECK_OK(hd_frame_replay(f->frame, f->log, 0.0, f->log->duration));
    CHECK_OK(hd_frame_replay(c->frame, f->log, 0.0, f->log->duration));
    CHECK_OK(hd_ortho_step(f->ortho, f->frame, FULL));
    CHECK_OK(hd_ortho_step(c->ortho, c->frame, other));
    for (int col = 0; col < c->n; col++) {
        c->sum[0][col] += hd_ortho_log_stretch(f->ortho)[col];
        c->sum[1][col] += hd_ortho_log_stretch(c->ortho)[col];
    }
    c->condition[0] += hd_ortho_condition(f->ortho);
    c->condition[1] += hd_ortho_condition(c->ortho);
    c->time += INTERVAL;
}

/** On the unstable space; both frames the same, orthonormal in the full norm. */
static chain chain_started(hd_boundary x, hd_boundary y)
{
    chain c = {0};
    c.f = forward_started(scene(.number = DISKS, .density = 0.7, .aspect = 1.0, .boundary[0] = x,
                                .boundary[1] = y, .seed = 3, .exponents = HD_EXPONENTS_POSITIVE),
                          5);
    c.n = forward_vectors(&c.f);
    for (int k = 0; k < WARMUP; k++) forward_interval(&c.f, INTERVAL);
    CHECK_OK(hd_ortho_step(c.f.ortho, c.f.frame, FULL));
    CHECK_OK(hd_frame_create(&c.frame, PARTICLES(DISKS), c.n, 1, 1));
    CHECK_OK(hd_ortho_create(&c.ortho, 4 * DISKS, c.n));
    for (int row = 0; row < 4 * DISKS; row++)
        for (int col = 0; col < c.n; col++)
            *frame_entry(c.frame, row, col) = *frame_entry(c.f.frame, row, col);
    for (int k = 0; k < 2; k++) c.sum[k] = calloc((size_t)c.n, sizeof *c.sum[k]);
    return c;
}

static void chain_free(chain *c)
{
    forward_pass_free(&c->f);
    hd_frame_free(c->frame);
    hd_ortho_free(c->ortho);
    free(c->sum[0]);
    free(c->sum[1]);
}

/** The largest difference of the sums, over what rounding is assumed to make [T6]. */
static double chain_difference(const chain *c)
{
    double worst = 0.0;
    for (int col = 0; col < c->n; col++) worst = fmax(worst, fabs(c->sum[1][col] - c->sum[0][col]));
    return worst;
}

/** Norms in turn, the last one full: the logarithms are those of the full norm [T5]. In one that
 * ends in the norm of dq they are not, but stay near. */
TEST(sums_are_those_of_the_full_norm)
{
    static const hd_boundary boundary[][2] = {{P, P}, {R, P}, {R, R}};
    for (int k = 0; k < 3; k++) {
        HELD(chain) c = chain_started(boundary[k][0], boundary[k][1]);
        double most = 0.0;
        for (int step = 1; step < STEPS; step++) {
            chain_step(&c, step % 5 == 0 ? FULL : step % 2 ? LOOSE : TIGHT);
            if (step % 5) most = fmax(most, chain_difference(&c));
        }
        chain_step(&c, FULL);
        const double rounding = 2 * 20 * 2 * DBL_EPSILON * (c.condition[0] + c.condition[1]);
        assert_true(rounding < 1e-6);
        assert_true(chain_difference(&c) <= rounding);
        assert_true(most > 1e-3 && most < 3.0);
    }
}

/** All steps in the norm of dq: conditions are smaller, exponents the same to a bounded part over
 * the time. */
TEST(conditions_are_smaller)
{
    HELD(chain) c = chain_started(P, P);
    for (int step = 0; step < 5 * STEPS; step++) chain_step(&c, LOOSE);
    assert_true(chain_difference(&c) < 3.0);
    assert_true(c.sum[0][c.n - 1] > 10.0);
    assert_true(c.condition[1] < 0.5 * c.condition[0]);
}
