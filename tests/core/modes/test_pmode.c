/** L and P modes reconstructed from vectors that are a known rotation of the fields. */
#include <float.h>
#include <lapacke.h>
#include <string.h>

#include "testing.h"

#include "hdlyap/pmode.h"
#include "scenes.h"
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
static reconstruction reconstruction_create(int nx, int ny, bool on_lattice, double noise)
{
    hd_scene_def def = scene(.disks = DISKS, .density = 0.5, .aspect = 0.8, .seed = 8,
                             .max_mode_number = 1);
    reconstruction r = {.dimension = nx && ny ? 8 : 4};
    const double exponents[DIMENSION_MAX] = {1, 1, 1, 1, 1, 1, 1, 1};
    r.w = world_create(&def, r.dimension, 1);
    r.subspace = hd_fields_subspace(r.w.fields, world_subspace(&r.w, HD_MODE_LP, nx, ny));
    r.step = world_step(&r.w, HD_MODE_LP, nx, ny);
    if (on_lattice) lattice(&r.w);
    random_rotation(&r.w.random, r.turn, r.dimension);
    write_vectors(&r, noise);
    world_find(&r.w, exponents);
    assert_true(r.step->resolved && r.step->members == 1);
    CHECK_OK(hd_pmode_create(&r.pmode, DISKS));
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
        reconstruction r = reconstruction_create(nodes[k][0], nodes[k][1], true, 0.0);
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
        reconstruction_free(&r);
    }
}

/** At disks anywhere the fields are not orthonormal: vector m has length |B turn_m| before it gets
 * 1, so Q = (lengths) (turn), whose singular values are the lengths. */
TEST(lengths_are_the_distance_from_a_rotation)
{
    reconstruction r = reconstruction_create(1, 1, false, 0.0);
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
    reconstruction_free(&r);
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
            reconstruction r = reconstruction_create(nodes[k][0], nodes[k][1], on_lattice, 0.4);
            assert_true(reconstruct(&r));
            for (int c = 0; c < r.dimension; c++) check_field(&r, c);
            reconstruction_free(&r);
        }
}

/** Vectors of length sqrt(1 + noise^2) of which noise stands across: sin of the angle between. The
 * noise of 128 numbers is known to 6 %, and 4 of its 128 directions lie within. */
TEST(noise_raises_the_residual)
{
    const double noises[] = {0.01, 0.1, 0.5};
    for (int k = 0; k < 3; k++) {
        reconstruction r = reconstruction_create(1, 0, true, noises[k]);
        assert_true(reconstruct(&r));
        const double want = noises[k] / sqrt(1.0 + noises[k] * noises[k]);
        for (int c = 0; c < 4; c++) CHECK_CLOSE(hd_pmode_residual(r.pmode, c), want, 0.25 * want);
        assert_true(hd_pmode_rotation_distance(r.pmode) > 0.1 * noises[k] * noises[k]);
        reconstruction_free(&r);
    }
}

/* ---- division ------------------------------------------------------------------------------ */

static double mean_square(const double *p)
{
    double sum = 0.0;
    for (int row = 0; row < ROWS; row++) sum += p[row] * p[row] / ROWS;
    return sum;
}

/** P / p is A but for p^2 / (p^2 + eps): exactly so. */
TEST(divided_by_the_momenta_it_is_the_modulation)
{
    for (int k = 0; k < 6; k++) {
        reconstruction r = reconstruction_create(nodes[k % 3][0], nodes[k % 3][1], k > 2, 0.0);
        const int d = r.dimension / 2;
        const double eps = HD_PMODE_EPSILON * mean_square(r.w.p);
        double out[ROWS];
        assert_true(reconstruct(&r));
        for (int c = 0; c < d; c++) {
            hd_pmode_divide(r.pmode, out, d + c, r.w.p);
            for (int row = 0; row < ROWS; row++) {
                double a[3];
                modulation_at(&r.w.scene, a, &r.subspace->wave, r.subspace->modulations.bits[c],
                              r.w.q + row / 2 * 2);
                const double p2 = r.w.p[row] * r.w.p[row];
                CHECK_CLOSE(out[row], a[0] * p2 / (p2 + eps), 10.0 * ALGEBRA);
            }
        }
        reconstruction_free(&r);
    }
}

/** Momenta near zero, and at it: finite, and no larger than the noise there over 2 sqrt(eps). */
TEST(tiny_momenta_stay_finite)
{
    reconstruction r = reconstruction_create(1, 0, false, 0.0);
    double q[ROWS], p[ROWS], out[ROWS];
    memcpy(q, r.w.q, sizeof q);
    memcpy(p, r.w.p, sizeof p);
    for (int row = 0; row < 40; row++) p[row] = row % 4 == 3 ? 0.0 : pow(10.0, -0.5 * row);
    world_place(&r.w, q, p);
    write_vectors(&r, 0.2);
    world_look(&r.w);
    assert_true(reconstruct(&r));
    const double bound = 0.5 / sqrt(HD_PMODE_EPSILON * mean_square(p));
    for (int c = 0; c < 4; c++) {
        hd_pmode_divide(r.pmode, out, c, p);
        const double norm = hd_fields_norm(r.w.fields, r.subspace->column + c);
        for (int row = 0; row < ROWS; row++) {
            assert_true(isfinite(out[row]));
            assert_true(fabs(out[row]) <=
                        norm * fabs(hd_pmode_field(r.pmode, c)[row]) * bound * (1.0 + ALGEBRA));
        }
    }
    reconstruction_free(&r);
}

/* ---- what cannot be reconstructed ---------------------------------------------------------- */

TEST(only_lp_steps_of_their_own)
{
    reconstruction r = reconstruction_create(1, 0, true, 0.0);
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
    reconstruction_free(&r);
}
