/** The fields of a circle [T21]: against differences of their modulations, and at the wall. */
#define _XOPEN_SOURCE 700 /* jn */

#include "scene/container.h"
#include "testing.h"

/** Central differences: truncation of h^2 / 6 times a third derivative, and rounding over h. */
static const double STEP = 1e-5, DIFFERENCE = 1e-9;

static const double REACH = 8.0;

/** From the container's row; x and y from the centre. */
static void modulations_at(hd_modulation at[2], const hd_wave *wave, double x, double y)
{
    const double centre = REACH + 0.5;
    const hd_scene_def def = scene(.container = HD_CIRCLE, .number = 100,
                                   .density = 100.0 / (PI * centre * centre));
    const hd_container_row *circle = hd_container_of(&def);
    double own[HD_WAVE_OWN];
    circle->of_wave(&def, wave, own);
    circle->modulations(at, own, (double[2]){centre + x, centre + y});
}

static double modulation(const hd_wave *wave, int sine, double x, double y)
{
    const int m = wave->n[0];
    const double turned = m * atan2(y, x), r = hypot(x, y), k = wave->number;
    const double radial = jn(m, k * r) -
                          (wave->transverse.count > 0 ? jn(m, k * REACH) * pow(r / REACH, m) : 0.0);
    return radial * (sine ? sin(turned) : cos(turned));
}

TEST(gradients_are_those_of_the_modulations)
{
    for (int m = 0; m < 6; m++)
        for (int k = 0; k < 400; k++) {
            const hd_wave wave = {
                .n = {m, 1}, .number = 0.1 + 0.005 * k, .transverse = {k % 2, {0}}};
            const double r = k < 2 ? 1e-4 : REACH * fmod(0.618 * k, 1.0), x = r * cos(k),
                         y = r * sin(k);
            hd_modulation at[2];
            modulations_at(at, &wave, x, y);
            for (int sine = 0; sine < 2; sine++) {
                const double dx = modulation(&wave, sine, x + STEP, y) -
                                  modulation(&wave, sine, x - STEP, y);
                const double dy = modulation(&wave, sine, x, y + STEP) -
                                  modulation(&wave, sine, x, y - STEP);
                CHECK_CLOSE(at[sine].a, modulation(&wave, sine, x, y), 1e-14);
                CHECK_CLOSE(at[sine].x, dx / (2.0 * STEP), DIFFERENCE);
                CHECK_CLOSE(at[sine].y, dy / (2.0 * STEP), DIFFERENCE);
            }
        }
}

/** Of the first order there is a gradient at the centre, of none a quotient by 0. */
TEST(the_centre_is_a_place_like_others)
{
    for (int m = 0; m < 4; m++) {
        const hd_wave wave = {.n = {m, 1}, .number = 0.7};
        hd_modulation at[2];
        modulations_at(at, &wave, 0.0, 0.0);
        CHECK_CLOSE(at[0].a, m == 0, 0.0);
        CHECK_CLOSE(at[0].x, m == 1 ? 0.35 : 0.0, 1e-16);
        CHECK_CLOSE(at[0].y, 0.0, 0.0);
        CHECK_CLOSE(at[1].y, m == 1 ? 0.35 : 0.0, 1e-16);
    }
}

/** The flow of T at distance r and angle 0: through the wall, and along it. */
static void flow(const hd_wave *wave, double r, double along[2])
{
    hd_modulation at[2];
    modulations_at(at, wave, r, 0.0);
    along[0] = at[1].y;  /* of the sine */
    along[1] = -at[0].x; /* of the cosine */
}

/** At the roots of [T21] nothing goes through the wall, and r d/dr (u_theta / r) is 0 there. */
TEST(a_transverse_flow_slips_along_the_wall)
{
    static const double root[][3] = {
        {0, 5.13562, 8.41724}, {1, 3.05424, 6.70613}, {2, 4.61256, 8.15781}};
    for (int m = 0; m < 3; m++)
        for (int n = 1; n < 3; n++) {
            const hd_wave wave = {
                .n = {m, n}, .number = root[m][n] / REACH, .transverse = {1, {0}}};
            double here[2], before[2], after[2];
            flow(&wave, REACH, here);
            flow(&wave, REACH - STEP, before);
            flow(&wave, REACH + STEP, after);
            const double slope = (after[1] / (REACH + STEP) - before[1] / (REACH - STEP)) /
                                 (2.0 * STEP);
            CHECK_CLOSE(here[0], 0.0, 1e-15);
            assert_true(fabs(here[1]) > 0.02);
            CHECK_CLOSE(REACH * slope / here[1], 0.0, 1e-4);
        }
}

enum { DISKS = 90, ROWS = 2 * DISKS };

/** Disks all along the wall: no field but P has a component through it. */
TEST(nothing_goes_through_the_wall)
{
    const hd_scene_def def = scene(.container = HD_CIRCLE, .number = DISKS, .density = 0.6,
                                   .max_mode_number = 4);
    double box[2], q[ROWS], p[ROWS];
    hd_scene_box(&def, box);
    const double centre = 0.5 * box[0], reach = centre - 0.5;
    for (int j = 0; j < DISKS; j++) {
        q[2 * j] = centre + reach * cos(j);
        q[2 * j + 1] = centre + reach * sin(j);
        p[2 * j] = 0.1 * cos(3.0 * j);
        p[2 * j + 1] = 0.1 * sin(5.0 * j);
    }
    MADE(hd_fields, fields, &def);
    hd_fields_sample(fields, q, p);
    const int columns = hd_fields_columns(fields);
    assert_true(hd_fields_subspaces(fields) > 8);
    for (int j = 0; j < DISKS; j++) {
        const double *x = hd_fields_data(fields) + (size_t)(2 * j * hd_fields_stride(fields));
        const double *y = x + hd_fields_stride(fields);
        for (int s = 0; s < hd_fields_subspaces(fields); s++) {
            const hd_subspace *of = hd_fields_subspace(fields, s);
            for (int c = 0; c < of->modulations.count; c++) {
                const int column = of->column + c;
                const double normal = x[column] * cos(j) + y[column] * sin(j);
                CHECK_CLOSE(normal * hd_fields_norm(fields, column), 0.0, 1e-12);
            }
        }
        /* the null space: a rotation about the centre, nothing, the momenta */
        const double *null = x + columns - NULLS, *null_y = y + columns - NULLS;
        CHECK_CLOSE(null[0], -sin(j) / sqrt(DISKS), 1e-14);
        CHECK_CLOSE(null_y[0], cos(j) / sqrt(DISKS), 1e-14);
        CHECK_CLOSE(null[1], 0.0, 0.0);
        CHECK_CLOSE(null[2] * p[2 * j + 1], null_y[2] * p[2 * j], 1e-16);
    }
}

/** P is p times the modulation whose gradient L is, and T that gradient turned. */
TEST(fields_of_one_modulation)
{
    const hd_scene_def def = scene(.container = HD_CIRCLE, .number = DISKS, .density = 0.6,
                                   .max_mode_number = 3);
    MADE(hd_trajectory, tr, &def);
    double q[ROWS], p[ROWS];
    hd_trajectory_state(tr, q, p);
    MADE(hd_fields, fields, &def);
    hd_fields_sample(fields, q, p);
    for (int s = 0; s < hd_fields_subspaces(fields); s++) {
        const hd_subspace *of = hd_fields_subspace(fields, s);
        const bool t = of->kind == HD_MODE_T;
        assert_int_equal(of->modulations.count, of->wave.n[0] > 0 ? 2 : 1);
        assert_int_equal(of->dimension, of->modulations.count * (t ? 1 : 2));
        for (int j = 0; j < DISKS; j++) {
            const double *x = hd_fields_data(fields) + (size_t)(2 * j * hd_fields_stride(fields));
            const double *y = x + hd_fields_stride(fields);
            double own[HD_WAVE_OWN];
            hd_modulation at[2];
            hd_container_of(&def)->of_wave(&def, &of->wave, own);
            hd_container_of(&def)->modulations(at, own, q + 2 * j);
            for (int c = 0; c < of->modulations.count; c++) {
                const int column = of->column + c, pair = column + of->modulations.count;
                const double norm = hd_fields_norm(fields, column);
                CHECK_CLOSE(norm * x[column], t ? at[c].y : at[c].x, 1e-13);
                CHECK_CLOSE(norm * y[column], t ? -at[c].x : at[c].y, 1e-13);
                if (t) continue;
                const double momenta = hd_fields_norm(fields, pair);
                CHECK_CLOSE(momenta * x[pair], p[2 * j] * at[c].a, 1e-13);
                CHECK_CLOSE(momenta * y[pair], p[2 * j + 1] * at[c].a, 1e-13);
            }
        }
    }
}
