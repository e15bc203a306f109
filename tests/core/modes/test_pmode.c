/** L and P modes reconstructed from vectors that are a known rotation of the fields. */
#include <lapacke.h>
#include "synthetic.h"

enum { DISKS = 64, ROWS = 2 * DISKS, DIMENSION_MAX = 8 };

/** Sums of 2N terms of order 1 / 2N, times a few operations; Gram matrices are of condition 1
 * to 10. */
static const double ALGEBRA = 10.0 * ROWS * DBL_EPSILON;

/** One LP step in a frame of its own. */
typedef struct reconstruction {
    world w;
    const hd_subspace *subspace;
    const hd_step *step;
    int dimension;
    hd_pmode *pmode;
    double turn[DIMENSION_MAX * DIMENSION_MAX]; /**< rows vectors, columns fields */
} reconstruction;

/** A square lattice with momenta that alternate from row to row: all LP fields are orthonormal
 * there. */
static void lattice(world *w)
{
    double q[ROWS], p[ROWS], box[2];
    hd_scene_box(&w->scene, box);
    for (int j = 0; j < DISKS; j++) {
        const double sign = j / 8 % 2 ? -1.0 : 1.0;
        q[2 * j] = (j % 8 + 0.3) / 8.0 * box[0];
        q[2 * j + 1] = (j / 8 + 0.1) / 8.0 * box[1];
        p[2 * j] = 1.3 * sign;
        p[2 * j + 1] = -0.6 * sign;
    }
    world_place(w, q, p);
}

/** Vector m: row m of a rotation times the fields, and noise of this length. */
static void write_vectors(reconstruction *r, double noise)
{
    for (int m = 0; m < r->dimension; m++) {
        double dq[ROWS];
        for (int row = 0; row < ROWS; row++)
            dq[row] = noise / sqrt(ROWS) * random_normal(&r->w.random);
        for (int c = 0; c < r->dimension; c++)
            world_add_field(&r->w, dq, r->subspace->column + c, r->turn[m * r->dimension + c]);
        world_write_mode(&r->w, m, dq, 0.7);
    }
}

/** LP(1,0), LP(0,1) or LP(1,1): 4 vectors, or 8. */
static reconstruction reconstruction_of(int nx, int ny, bool on_lattice, double noise)
{
    reconstruction r = {.dimension = nx && ny ? 8 : 4};
    const double exponents[DIMENSION_MAX] = {1, 1, 1, 1, 1, 1, 1, 1};
    const hd_scene_def def = scene(.number = DISKS, .density = 0.5, .aspect = 0.8, .seed = 8,
                                   .max_mode_number = 1);
    r.w = world_create(def, r.dimension, 1);
    r.subspace = hd_fields_subspace(r.w.fields, world_subspace(&r.w, HD_MODE_LP, nx, ny));
    r.step = world_step(&r.w, HD_MODE_LP, nx, ny);
    if (on_lattice) lattice(&r.w);
    random_rotation(&r.w.random, r.turn, r.dimension);
    write_vectors(&r, noise);
    world_find(&r.w, exponents);
    assert_true(r.step->resolved && r.step->members == 1);
    CHECK_OK(hd_pmode_create(&r.pmode, &def));
    return r;
}

static bool reconstruct(reconstruction *r)
{
    return hd_pmode_reconstruct(r->pmode, r->step, r->w.modes, hd_frame_columns(r->w.frame));
}

static void reconstruction_free(reconstruction *r)
{
    hd_pmode_free(r->pmode);
    world_free(&r->w);
}

static const int nodes[][2] = {{1, 0}, {0, 1}, {1, 1}};

/* ---- exact rotations ----------------------------------------------------------------------- */

TEST(a_rotation_is_found)
{
    for (int k = 0; k < 3; k++) {
        HELD(reconstruction) r = reconstruction_of(nodes[k][0], nodes[k][1], true, 0.0);
        const int n = r.dimension;
        assert_true(reconstruct(&r));
        assert_int_equal(hd_pmode_pairs(r.pmode), n / 2);
        CHECK_CLOSE(hd_pmode_rotation_distance(r.pmode), 0.0, ALGEBRA);
        for (int c = 0; c < n; c++) {
            CHECK_CLOSE(hd_pmode_residual(r.pmode, c), 0.0, ALGEBRA);
            double field[ROWS] = {0.0};
            world_add_field(&r.w, field, r.subspace->column + c, 1.0);
            for (int row = 0; row < ROWS; row++)
                CHECK_CLOSE(hd_pmode_field(r.pmode, c)[row], field[row], ALGEBRA);
        }
    }
}

/** At disks anywhere the fields are not orthonormal: vector m has length |B turn_m| before it gets
 * 1, so Q = (lengths) (turn), whose singular values are the lengths. */
TEST(lengths_are_the_distance_from_a_rotation)
{
    HELD(reconstruction) r = reconstruction_of(1, 1, false, 0.0);
    double distance = 0.0;
    assert_true(reconstruct(&r));
    for (int m = 0; m < 8; m++) {
        double dq[ROWS] = {0.0}, length = 0.0;
        for (int c = 0; c < 8; c++)
            world_add_field(&r.w, dq, r.subspace->column + c, r.turn[8 * m + c]);
        for (int row = 0; row < ROWS; row++) length += dq[row] * dq[row];
        length = sqrt(length);
        distance = fmax(distance, fabs(length - 1.0));
        for (int c = 0; c < 8; c++) {
            CHECK_CLOSE(hd_pmode_residual(r.pmode, c), 0.0, ALGEBRA);
        }
    }
    assert_true(distance > 0.02); /* order N^(-1/2) */
    CHECK_CLOSE(hd_pmode_rotation_distance(r.pmode), distance, ALGEBRA);
}

/* ---- noise --------------------------------------------------------------------------------- */

/** Field c by QR least squares from the normalised dq halves: coefficients, and its distance. */
static void check_field(const reconstruction *r, int c)
{
    const int n = r->dimension;
    double psi[DIMENSION_MAX * ROWS] = {0.0}, dp[ROWS], field[ROWS] = {0.0}, best[ROWS] = {0.0},
                               off = 0.0;
    for (int m = 0; m < n; m++) {
        world_read(&r->w, m, psi + m * ROWS, dp);
        for (int row = 0; row < ROWS; row++) /* dp = 0.7 dq, together 1 */
            psi[m * ROWS + row] *= sqrt(1.0 + 0.7 * 0.7);
    }
    double copy[DIMENSION_MAX * ROWS];
    memcpy(copy, psi, sizeof copy);
    world_add_field(&r->w, field, r->subspace->column + c, 1.0);
    double q[ROWS];
    memcpy(q, field, sizeof q);
    assert_int_equal(LAPACKE_dgels(LAPACK_COL_MAJOR, 'N', ROWS, n, 1, copy, ROWS, q, ROWS), 0);
    for (int m = 0; m < n; m++) {
        for (int row = 0; row < ROWS; row++) best[row] += q[m] * psi[m * ROWS + row];
    }
    for (int row = 0; row < ROWS; row++) {
        CHECK_CLOSE(hd_pmode_field(r->pmode, c)[row], best[row], ALGEBRA);
        off += pow(field[row] - best[row], 2.0);
    }
    CHECK_CLOSE(hd_pmode_residual(r->pmode, c), sqrt(off), ALGEBRA);
}

TEST(modes_are_those_of_least_squares)
{
    for (int k = 0; k < 3; k++)
        for (int on_lattice = 0; on_lattice < 2; on_lattice++) {
            HELD(reconstruction) r = reconstruction_of(nodes[k][0], nodes[k][1], on_lattice, 0.4);
            assert_true(reconstruct(&r));
            for (int c = 0; c < r.dimension; c++) check_field(&r, c);
        }
}

/* ---- division ------------------------------------------------------------------------------ */

static double mean_square(const double *p)
{
    double sum = 0.0;
    for (int row = 0; row < ROWS; row++) sum += p[row] * p[row] / ROWS;
    return sum;
}

/** Vectors that are the fields: every P mode divided by the momenta is A p^2 / (p^2 + eps), at each
 * component. */
static void check_divided(reconstruction *r, const double *p, double tolerance)
{
    const double eps = HD_PMODE_EPSILON * mean_square(p);
    const int d = r->dimension / 2;
    double out[ROWS];
    assert_true(reconstruct(r));
    for (int c = 0; c < d; c++) {
        hd_pmode_divide(r->pmode, out, d + c, p);
        for (int row = 0; row < ROWS; row++) {
            double a[3];
            modulation_at(&r->w.scene, a, &r->subspace->wave, r->subspace->modulations.bits[c],
                          r->w.q + row / 2 * 2);
            const double p2 = p[row] * p[row];
            CHECK_CLOSE(out[row], a[0] * p2 / (p2 + eps), tolerance);
            if (p[row] == 0.0) CHECK_CLOSE(out[row], 0.0, 0.0);
            assert_true(out[row] == 0.0 || fabs(out[row]) >= DBL_MIN);
        }
    }
}

TEST(divided_by_the_momenta_it_is_the_modulation)
{
    for (int k = 0; k < 6; k++) {
        HELD(reconstruction) r = reconstruction_of(nodes[k % 3][0], nodes[k % 3][1], k > 2, 0.0);
        check_divided(&r, r.w.p, 10.0 * ALGEBRA);
    }
}

/* ---- disks at rest, or nearly -------------------------------------------------------------- */

/** p / (p^2 + eps) is up to 1 / 2 sqrt(eps). */
static double divided_known(const double *p)
{
    return ALGEBRA * (1.0 + 0.5 / sqrt(HD_PMODE_EPSILON * mean_square(p)));
}

/** Puts the disks where they are with these momenta, and looks. */
static void look(reconstruction *s, const double *p, double noise)
{
    double q[ROWS];
    memcpy(q, s->w.q, sizeof q);
    world_place(&s->w, q, p);
    write_vectors(s, noise);
    CHECK_OK(hd_modes_measure(s->w.modes, hd_frame_columns(s->w.frame), s->w.q, s->w.p));
}

/** One component of one momentum after the other, from 1 down to 1e-12 and to 0. */
TEST(tiny_components_are_finite_and_the_rest_is_right)
{
    HELD(reconstruction) s = reconstruction_of(1, 0, false, 0.0);
    double moving[ROWS];
    memcpy(moving, s.w.p, sizeof moving);
    for (int digits = 0; digits <= 13; digits++)
        for (int row = 0; row < ROWS; row += 7) {
            double p[ROWS];
            memcpy(p, moving, sizeof p);
            p[row] = digits <= 12 ? copysign(pow(10.0, -digits), p[row]) : 0.0;
            look(&s, p, 0.0);
            check_divided(&s, p, divided_known(p));
        }
}

/** One, a quarter, half and all but eight of the disks at rest. */
TEST(disks_at_rest_are_finite_and_the_rest_is_right)
{
    static const int resting[] = {1, 16, 32, 56};
    HELD(reconstruction) s = reconstruction_of(1, 0, false, 0.0);
    double moving[ROWS];
    memcpy(moving, s.w.p, sizeof moving);
    for (size_t k = 0; k < sizeof resting / sizeof *resting; k++) {
        double p[ROWS];
        memcpy(p, moving, sizeof p);
        memset(p, 0, 2 * (size_t)resting[k] * sizeof *p);
        look(&s, p, 0.0);
        check_divided(&s, p, divided_known(p));
    }
}

/** Noise in the vectors, which a disk at rest has too, is not blown up: the mode there times p /
 * (p^2 + eps) is nothing at p = 0, and falls with p below sqrt(eps). At the other disks all is as
 * if the disk moved on. */
TEST(noise_is_not_blown_up_where_a_disk_rests)
{
    HELD(reconstruction) s = reconstruction_of(1, 0, false, 0.0);
    double p[ROWS], out[ROWS];
    memcpy(p, s.w.p, sizeof p);
    for (int digits = 4; digits <= 13; digits++) {
        p[0] = p[1] = digits <= 12 ? pow(10.0, -digits) : 0.0;
        look(&s, p, 0.3);
        assert_true(reconstruct(&s));
        for (int c = 0; c < s.dimension; c++) {
            hd_pmode_divide(s.pmode, out, c, p);
            const double eps = HD_PMODE_EPSILON * mean_square(p);
            const double norm = hd_fields_norm(s.w.fields, s.subspace->column + c);
            for (int row = 0; row < ROWS; row++) {
                const double field = norm * hd_pmode_field(s.pmode, c)[row];
                CHECK_CLOSE(out[row], field * p[row] / (p[row] * p[row] + eps),
                            8.0 * DBL_EPSILON * fabs(out[row]));
                if (row < 2) assert_true(fabs(out[row]) <= fabs(field) * p[row] / eps);
            }
        }
    }
}

/** One disk alone moves: the P fields of both modulations are the same but for a factor, the
 * vectors dependent but for rounding. Refused, or finite fields that still are combinations of the
 * vectors; how far from a rotation is told. */
TEST(one_moving_disk_is_refused_or_finite)
{
    HELD(reconstruction) s = reconstruction_of(1, 0, false, 0.0);
    double p[ROWS] = {0.0}, out[ROWS];
    p[6] = 1.0, p[7] = -0.5;
    look(&s, p, 0.0);
    if (reconstruct(&s)) {
        assert_true(hd_pmode_rotation_distance(s.pmode) > 0.5);
        for (int c = 0; c < s.dimension; c++) {
            hd_pmode_divide(s.pmode, out, c, p);
            for (int row = 0; row < ROWS; row++) assert_true(isfinite(out[row]));
        }
    }
}

TEST(without_momenta_there_is_no_p_mode)
{
    HELD(reconstruction) s = reconstruction_of(1, 0, false, 0.0);
    const double p[ROWS] = {0.0};
    look(&s, p, 0.0);
    assert_false(reconstruct(&s));
}

/* ---- what cannot be reconstructed ---------------------------------------------------------- */

TEST(only_lp_steps_of_their_own)
{
    HELD(reconstruction) r = reconstruction_of(1, 0, true, 0.0);
    hd_step step = *r.step;
    step.kind = HD_MODE_T;
    assert_false(hd_pmode_reconstruct(r.pmode, &step, r.w.modes, hd_frame_columns(r.w.frame)));
    step = *r.step;
    step.resolved = false;
    assert_false(hd_pmode_reconstruct(r.pmode, &step, r.w.modes, hd_frame_columns(r.w.frame)));
    step = *r.step;
    step.members = 2;
    assert_false(hd_pmode_reconstruct(r.pmode, &step, r.w.modes, hd_frame_columns(r.w.frame)));
    assert_true(reconstruct(&r));
    memcpy(r.turn + 4, r.turn, 4 * sizeof *r.turn); /* two vectors alike */
    write_vectors(&r, 0.0);
    assert_false(reconstruct(&r));
}
