/** Weights of vectors that are known mixtures of fields, against least squares vector by vector. */
#include <lapacke.h>
#include "synthetic.h"

enum { DISKS = 100, ROWS = 2 * DISKS, DIMENSION_MAX = 8 };

/** Gram matrices of these states have eigenvalues between 0.3 and 2: rounding of 2N terms, times
 * ten. */
static const double ALGEBRA = 10.0 * ROWS * DBL_EPSILON / 0.3;

static hd_scene_def dense(hd_boundary x, hd_boundary y)
{
    return scene(.number = DISKS, .density = 0.5, .aspect = 0.8, .boundary[0] = x, .boundary[1] = y,
                 .seed = 3, .max_mode_number = 2);
}

/* ---- independent least squares ------------------------------------------------------------- */

/** What one vector is in one subspace. */
typedef struct fit {
    double weight, weight_l, weight_p, c[DIMENSION_MAX];
} fit;

/** |sum of c_a field_a|^2 over the columns [from, to) of s. */
static double part(const world *w, const hd_subspace *s, const double *c, int from, int to)
{
    double sum[ROWS] = {0.0}, square = 0.0;
    for (int a = from; a < to; a++) world_add_field(w, sum, s->column + a, c[a]);
    for (int row = 0; row < world_rows(w); row++) square += sum[row] * sum[row];
    return square;
}

/** The solution of least norm; directions below 1e-3 of the largest are left out, as [T11]. */
static fit fit_of(const world *w, int subspace, int col)
{
    const hd_subspace *s = hd_fields_subspace(w->fields, subspace);
    const int rows = world_rows(w), d = s->dimension;
    double a[ROWS * DIMENSION_MAX] = {0.0}, b[ROWS], dp[ROWS], value[DIMENSION_MAX], norm = 0.0;
    fit f = {0};
    int rank;
    world_read(w, col, b, dp);
    for (int row = 0; row < rows; row++) norm += b[row] * b[row];
    for (int row = 0; row < rows; row++) b[row] /= sqrt(norm);
    for (int c = 0; c < d; c++) world_add_field(w, a + c * rows, s->column + c, 1.0);
    assert_int_equal(
        LAPACKE_dgelsd(LAPACK_COL_MAJOR, rows, d, 1, a, rows, b, rows, value, 1e-3, &rank), 0);
    memcpy(f.c, b, (size_t)d * sizeof *b);
    f.weight = part(w, s, f.c, 0, d);
    if (s->kind != HD_MODE_LP) return f;
    f.weight_l = part(w, s, f.c, 0, d / 2);
    f.weight_p = part(w, s, f.c, d / 2, d);
    return f;
}

static void check_fit(const world *w, int s, int col, double tolerance)
{
    const fit want = fit_of(w, s, col);
    CHECK_CLOSE(hd_modes_snapshot(w->modes, s, HD_WEIGHT)[col], want.weight, tolerance);
    CHECK_CLOSE(hd_modes_snapshot(w->modes, s, HD_WEIGHT_L)[col], want.weight_l, tolerance);
    CHECK_CLOSE(hd_modes_snapshot(w->modes, s, HD_WEIGHT_P)[col], want.weight_p, tolerance);
    const int column = hd_fields_subspace(w->fields, s)->column;
    for (int c = 0; c < world_dimension(w, s); c++)
        CHECK_CLOSE(hd_modes_coefficients(w->modes, column + c)[col], want.c[c], tolerance);
}

static void check_all_fits(const world *w, double tolerance)
{
    for (int s = 0; s < hd_fields_subspaces(w->fields); s++)
        for (int col = 0; col < hd_frame_vectors(w->frame); col++) check_fit(w, s, col, tolerance);
}

/** Every column: all fields at random, and as much noise. */
static void write_mixtures(world *w)
{
    for (int col = 0; col < hd_frame_vectors(w->frame); col++) {
        double dq[ROWS], dp[ROWS];
        for (int row = 0; row < world_rows(w); row++) {
            dq[row] = 0.2 * random_normal(&w->random);
            dp[row] = random_normal(&w->random);
        }
        for (int c = 0; c < hd_fields_columns(w->fields) - NULLS; c++)
            world_add_field(w, dq, c, random_normal(&w->random));
        world_write(w, col, dq, dp);
    }
}

/** Nothing of one look is left in the next. */
TEST(weights_are_those_of_least_squares)
{
    for (int k = 0; k < 4; k++) {
        HELD(world) w = world_create(dense(k & 1 ? R : P, k & 2 ? R : P), 10, 1);
        for (int again = 0; again < 3; again++, world_move(&w, 1.0)) {
            write_mixtures(&w);
            world_look(&w);
            check_all_fits(&w, ALGEBRA);
        }
    }
}

/* ---- fields that the disks do not tell apart ----------------------------------------------- */

/** Momenta all alike along x: P of cos is L of sin, and the L of waves along y alone is left. Rank
 * 4 of 8. */
static void momenta_alike(world *w)
{
    double q[ROWS], p[ROWS];
    memcpy(q, w->q, sizeof q);
    for (int row = 0; row < ROWS; row++) p[row] = row % 2 == 0;
    world_place(w, q, p);
}

/** The same but for a part of 5 %: eigenvalues of some 1e-3, which are there; or of 1e-5: not there
 * [T11]. */
static void momenta_nearly_alike(world *w, double part)
{
    double q[ROWS], p[ROWS];
    memcpy(q, w->q, sizeof q);
    for (int row = 0; row < ROWS; row++) p[row] = (row % 2 == 0) + part * w->p[row];
    world_place(w, q, p);
}

static void momenta_distinct(world *w) { momenta_nearly_alike(w, 0.05); }
static void momenta_indistinct(world *w) { momenta_nearly_alike(w, 1e-5); }

/** Disks on two lines, where the sines along x vanish. */
static void disks_on_nodes(world *w)
{
    double q[ROWS], p[ROWS], box[2];
    hd_scene_box(&w->scene, box);
    memcpy(q, w->q, sizeof q);
    memcpy(p, w->p, sizeof p);
    for (int j = 0; j < DISKS; j++) q[2 * j] = j % 2 ? 0.5 * box[0] : 0.0;
    world_place(w, q, p);
}

static void disks_at_rest(world *w)
{
    const double none[ROWS] = {0.0};
    double q[ROWS];
    memcpy(q, w->q, sizeof q);
    world_place(w, q, none);
}

TEST(fields_that_coincide_count_once)
{
    void (*const arrange[])(world *) = {momenta_alike, momenta_distinct, momenta_indistinct,
                                        disks_on_nodes, disks_at_rest};
    const double CONDITION[] = {1.0, 1e3, 1e5, 1.0,
                                1.0}; /* 1 / eigenvalue; 1e-5 of overlap left out */
    for (int k = 0; k < 5; k++) {
        HELD(world) w = world_create(dense(P, P), 6, 1);
        arrange[k](&w);
        write_mixtures(&w);
        world_look(&w);
        check_all_fits(&w, CONDITION[k] * ALGEBRA);
        for (int s = 0; s < hd_fields_subspaces(w.fields); s++)
            for (int col = 0; col < 6; col++)
                assert_true(hd_modes_snapshot(w.modes, s, HD_WEIGHT)[col] < 1.0);
    }
}

/** 8 disks: eight fields in 16 dimensions. */
TEST(few_disks)
{
    const hd_scene_def def = scene(.number = 8, .density = 0.3, .aspect = 1.0, .seed = 2,
                                   .max_mode_number = 1);
    HELD(world) w = world_create(def, 12, 1);
    write_mixtures(&w);
    world_look(&w);
    check_all_fits(&w, 100.0 * ALGEBRA); /* less well conditioned */
}

/* ---- the null space ------------------------------------------------------------------------ */

/** half[f] times null field f. */
static void add_null(const world *w, double *out, const double half[NULLS])
{
    const int null = hd_fields_columns(w->fields) - NULLS;
    for (int f = 0; f < NULLS; f++) world_add_field(w, out, null + f, half[f]);
}

static void write_null(world *w, const double of_dq[NULLS], const double of_dp[NULLS], double noise)
{
    double dq[ROWS], dp[ROWS];
    for (int row = 0; row < ROWS; row++) {
        dq[row] = noise * random_normal(&w->random);
        dp[row] = noise * random_normal(&w->random);
    }
    add_null(w, dq, of_dq);
    add_null(w, dp, of_dp);
    world_write(w, 0, dq, dp);
    world_look(w);
}

static void check_null(const world *w, double x, double y, double p)
{
    CHECK_CLOSE(hd_modes_null_snapshot(w->modes, HD_NULL_X)[0], x, ALGEBRA);
    CHECK_CLOSE(hd_modes_null_snapshot(w->modes, HD_NULL_Y)[0], y, ALGEBRA);
    CHECK_CLOSE(hd_modes_null_snapshot(w->modes, NULL_P)[0], p, ALGEBRA);
}

TEST(zero_modes_have_their_parts)
{
    HELD(world) w = world_create(dense(P, P), 1, 1);
    const double none[NULLS] = {0.0};
    for (int f = 0; f < NULLS; f++) {
        double one[NULLS] = {0.0};
        one[f] = -2.0;
        write_null(&w, one, none, 0.0);
        check_null(&w, f == 0, f == 1, f == 2);
        write_null(&w, none, one, 0.0);
        check_null(&w, f == 0, f == 1, f == 2);
    }
    write_null(&w, (const double[]){1, 2, 2}, (const double[]){0, 0, 0}, 0.0);
    check_null(&w, 1.0 / 9.0, 4.0 / 9.0, 4.0 / 9.0);
    write_null(&w, (const double[]){1, -1, 0}, (const double[]){1, 0, 1}, 0.0);
    check_null(&w, 0.5, 0.25, 0.25);
}

/** A vector without a dq half is nobody's, but may be a zero mode. */
TEST(momenta_alone_have_no_weight)
{
    HELD(world) w = world_create(dense(P, P), 1, 1);
    write_null(&w, (const double[]){0, 0, 0}, (const double[]){1, 0, 0}, 0.0);
    for (int s = 0; s < hd_fields_subspaces(w.fields); s++)
        CHECK_CLOSE(hd_modes_snapshot(w.modes, s, HD_WEIGHT)[0], 0.0, 0.0);
}

/** Behind walls only dq = p and dp = p. */
TEST(walls_take_uniform_motion_away)
{
    for (int k = 1; k < 4; k++) {
        HELD(world) w = world_create(dense(k & 1 ? R : P, k & 2 ? R : P), 1, 1);
        write_null(&w, (const double[]){0, 0, 1}, (const double[]){0, 0, 1}, 0.0);
        CHECK_CLOSE(hd_modes_null_snapshot(w.modes, NULL_P)[0], 1.0, ALGEBRA);
        write_null(&w, (const double[]){0, 0, 0}, (const double[]){0, 0, 0}, 1.0);
        if (k & 1) CHECK_CLOSE(hd_modes_null_snapshot(w.modes, HD_NULL_X)[0], 0.0, 0.0);
        if (k & 2) CHECK_CLOSE(hd_modes_null_snapshot(w.modes, HD_NULL_Y)[0], 0.0, 0.0);
        if (!(k & 1)) assert_true(hd_modes_null_snapshot(w.modes, HD_NULL_X)[0] > 0.0);
    }
}

/* ---- averages, threads, bad numbers -------------------------------------------------------- */

TEST(averages_are_means_of_snapshots)
{
    enum { SAMPLES = 7, VECTORS = 9 };
    const double MEAN = SAMPLES * DBL_EPSILON;
    HELD(world) w = world_create(dense(P, R), VECTORS, 1);
    const int s = world_subspace(&w, HD_MODE_LP, 1, 1);
    double sum[VECTORS][HD_WEIGHTS] = {{0.0}}, null[VECTORS] = {0.0};
    CHECK_CLOSE(hd_modes_average(w.modes, s, HD_WEIGHT)[0], 0.0, 0.0);
    for (int k = 0; k < SAMPLES; k++, world_move(&w, 0.3)) {
        write_mixtures(&w);
        world_look(&w);
        for (int col = 0; col < VECTORS; col++) {
            for (int which = 0; which < HD_WEIGHTS; which++)
                sum[col][which] += hd_modes_snapshot(w.modes, s, (hd_weight)which)[col] / SAMPLES;
            null[col] += hd_modes_null_snapshot(w.modes, NULL_P)[col] / SAMPLES;
        }
    }
    assert_int_equal(hd_modes_samples(w.modes), SAMPLES);
    for (int col = 0; col < VECTORS; col++) {
        for (int which = 0; which < HD_WEIGHTS; which++)
            CHECK_CLOSE(hd_modes_average(w.modes, s, (hd_weight)which)[col], sum[col][which], MEAN);
        CHECK_CLOSE(hd_modes_null_average(w.modes, NULL_P)[col], null[col], MEAN);
    }
    hd_modes_clear(w.modes);
    assert_int_equal(hd_modes_samples(w.modes), 0);
    CHECK_CLOSE(hd_modes_average(w.modes, s, HD_WEIGHT)[3], 0.0, 0.0);
    world_look(&w);
    CHECK_CLOSE(hd_modes_average(w.modes, s, HD_WEIGHT)[3],
                hd_modes_snapshot(w.modes, s, HD_WEIGHT)[3], MEAN);
}

TEST(two_threads_see_the_same)
{
    enum { VECTORS = 300 };
    const hd_scene_def def = dense(P, P);
    HELD(world) one = world_create(def, VECTORS, 1), two = world_create(def, VECTORS, 2);
    world_look(&one);
    world_look(&two);
    for (int col = 0; col < VECTORS; col++) {
        for (int s = 0; s < hd_fields_subspaces(one.fields); s++)
            CHECK_CLOSE(hd_modes_snapshot(two.modes, s, HD_WEIGHT)[col],
                        hd_modes_snapshot(one.modes, s, HD_WEIGHT)[col], ALGEBRA);
    }
}

TEST(what_is_not_finite_is_refused)
{
    enum { VECTORS = 5 };
    HELD(world) w = world_create(dense(P, P), VECTORS, 1);
    const double bad[] = {NAN, INFINITY};
    for (int k = 0; k < 2; k++)
        for (int half = 0; half < 2; half++) {
            world_noise(&w);
            const size_t at = (size_t)(4 * 17 + 2 * half) * (size_t)hd_frame_stride(w.frame) + 3;
            hd_frame_data(w.frame)[at] = bad[k];
            assert_int_equal(hd_modes_measure(w.modes, hd_frame_columns(w.frame), w.q, w.p),
                             HD_NOT_FINITE);
        }
    world_noise(&w);
    CHECK_OK(hd_modes_measure(w.modes, hd_frame_columns(w.frame), w.q, w.p));
}
