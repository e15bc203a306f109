/** P modes where disks are at rest, or nearly: finite there, and right everywhere else. */
#include <float.h>
#include <string.h>

#include "testing.h"

#include "hdlyap/pmode.h"
#include "scenes.h"
#include "synthetic.h"

enum { DISKS = 64, ROWS = 2 * DISKS, DIMENSION = 4 };

/** Sums of 2N terms of order 1 / 2N, times a few operations; Gram matrices are of condition 1
 * to 10. */
static const double ALGEBRA = 10.0 * ROWS * DBL_EPSILON;

/** LP(1,0) alone in its frame. */
typedef struct lp_step {
    world w;
    const hd_step *step;
    const hd_subspace *subspace;
    hd_pmode *pmode;
    double turn[DIMENSION * DIMENSION];
} lp_step;

static void write_vectors(lp_step *s, double noise)
{
    for (int m = 0; m < DIMENSION; m++) {
        double dq[ROWS];
        for (int row = 0; row < ROWS; row++)
            dq[row] = noise / sqrt(ROWS) * random_normal(&s->w.random);
        for (int c = 0; c < DIMENSION; c++)
            world_add_field(&s->w, dq, s->subspace->column + c, s->turn[m * DIMENSION + c]);
        world_write_mode(&s->w, m, dq, 0.7);
    }
}

static lp_step lp_step_create(void)
{
    const double exponents[DIMENSION] = {1, 1, 1, 1};
    hd_scene_def def = scene(.disks = DISKS, .density = 0.5, .aspect = 0.8, .seed = 8,
                             .max_mode_number = 1);
    lp_step s = {.w = world_create(&def, DIMENSION, 1)};
    s.subspace = hd_fields_subspace(s.w.fields, world_subspace(&s.w, HD_MODE_LP, 1, 0));
    s.step = world_step(&s.w, HD_MODE_LP, 1, 0);
    random_rotation(&s.w.random, s.turn, DIMENSION);
    write_vectors(&s, 0.0);
    world_find(&s.w, exponents);
    assert_true(s.step->resolved);
    CHECK_OK(hd_pmode_create(&s.pmode, DISKS));
    return s;
}

static void lp_step_free(lp_step *s)
{
    hd_pmode_free(s->pmode);
    world_free(&s->w);
}

/** Puts the disks where they are with these momenta, and looks. */
static void look(lp_step *s, const double *p, double noise)
{
    double q[ROWS];
    memcpy(q, s->w.q, sizeof q);
    world_place(&s->w, q, p);
    write_vectors(s, noise);
    CHECK_OK(hd_modes_measure(s->w.modes, hd_frame_columns(s->w.frame), s->w.q, s->w.p));
}

static double mean_square(const double *p)
{
    double sum = 0.0;
    for (int row = 0; row < ROWS; row++) sum += p[row] * p[row] / ROWS;
    return sum;
}

/** Vectors that are the fields: every P mode divided by the momenta is A p^2 / (p^2 + eps), at each
 * component. */
static double check_divided(lp_step *s, const double *p)
{
    const double eps = HD_PMODE_EPSILON * mean_square(p);
    double worst = 0.0;
    assert_true(hd_pmode_reconstruct(s->pmode, s->step, s->w.modes, hd_frame_columns(s->w.frame)));
    for (int c = 0; c < DIMENSION / 2; c++) {
        double out[ROWS];
        hd_pmode_divide(s->pmode, out, DIMENSION / 2 + c, p);
        for (int row = 0; row < ROWS; row++) {
            double a[3];
            modulation_at(&s->w.scene, a, &s->subspace->wave, s->subspace->modulations.bits[c],
                          s->w.q + row / 2 * 2);
            /* p / (p^2 + eps) is up to 1 / 2 sqrt(eps) */
            const double tolerance = ALGEBRA * (1.0 + 0.5 / sqrt(eps));
            const double want = a[0] * p[row] * p[row] / (p[row] * p[row] + eps);
            CHECK_CLOSE(out[row], want, tolerance);
            worst = fmax(worst, fabs(out[row] - want) / tolerance);
            if (p[row] == 0.0) CHECK_CLOSE(out[row], 0.0, 0.0);
            assert_true(out[row] == 0.0 || fabs(out[row]) >= DBL_MIN);
        }
    }
    return worst;
}

/** One component of one momentum after the other, from 1 down to 1e-12 and to 0. */
TEST(tiny_components_are_finite_and_the_rest_is_right)
{
    lp_step s = lp_step_create();
    double moving[ROWS], worst = 0.0;
    memcpy(moving, s.w.p, sizeof moving);
    for (int digits = 0; digits <= 13; digits++)
        for (int row = 0; row < ROWS; row += 7) {
            double p[ROWS];
            memcpy(p, moving, sizeof p);
            p[row] = digits <= 12 ? copysign(pow(10.0, -digits), p[row]) : 0.0;
            look(&s, p, 0.0);
            worst = fmax(worst, check_divided(&s, p));
        }
    print_message("266 states, off by up to %.2g of what is allowed\n", worst);
    lp_step_free(&s);
}

/** One, a quarter, half and all but eight of the disks at rest. */
TEST(disks_at_rest_are_finite_and_the_rest_is_right)
{
    static const int resting[] = {1, 16, 32, 56};
    lp_step s = lp_step_create();
    double moving[ROWS];
    memcpy(moving, s.w.p, sizeof moving);
    for (size_t k = 0; k < sizeof resting / sizeof *resting; k++) {
        double p[ROWS];
        memcpy(p, moving, sizeof p);
        memset(p, 0, 2 * (size_t)resting[k] * sizeof *p);
        look(&s, p, 0.0);
        print_message("%d of 64 disks at rest: off by up to %.2g of what is allowed\n", resting[k],
                      check_divided(&s, p));
    }
    lp_step_free(&s);
}

/** Noise in the vectors, which a disk at rest has too, is not blown up: the mode there times p /
 * (p^2 + eps) is nothing at p = 0, and falls with p below sqrt(eps). At the other disks all is as
 * if the disk moved on. */
TEST(noise_is_not_blown_up_where_a_disk_rests)
{
    lp_step s = lp_step_create();
    double p[ROWS], out[ROWS];
    memcpy(p, s.w.p, sizeof p);
    for (int digits = 4; digits <= 13; digits++) {
        p[0] = p[1] = digits <= 12 ? pow(10.0, -digits) : 0.0;
        look(&s, p, 0.3);
        assert_true(hd_pmode_reconstruct(s.pmode, s.step, s.w.modes, hd_frame_columns(s.w.frame)));
        for (int c = 0; c < DIMENSION; c++) {
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
    lp_step_free(&s);
}

/** One disk alone moves: the P fields of both modulations are the same but for a factor, the
 * vectors dependent but for rounding. Refused, or finite fields that still are combinations of the
 * vectors; how far from a rotation is told. */
TEST(one_moving_disk_is_refused_or_finite)
{
    lp_step s = lp_step_create();
    double p[ROWS] = {0.0}, out[ROWS];
    p[6] = 1.0, p[7] = -0.5;
    look(&s, p, 0.0);
    if (hd_pmode_reconstruct(s.pmode, s.step, s.w.modes, hd_frame_columns(s.w.frame))) {
        assert_true(hd_pmode_rotation_distance(s.pmode) > 0.5);
        for (int c = 0; c < DIMENSION; c++) {
            hd_pmode_divide(s.pmode, out, c, p);
            for (int row = 0; row < ROWS; row++) assert_true(isfinite(out[row]));
        }
    }
    lp_step_free(&s);
}

TEST(without_momenta_there_is_no_p_mode)
{
    lp_step s = lp_step_create();
    const double p[ROWS] = {0.0};
    look(&s, p, 0.0);
    assert_false(hd_pmode_reconstruct(s.pmode, s.step, s.w.modes, hd_frame_columns(s.w.frame)));
    lp_step_free(&s);
}
