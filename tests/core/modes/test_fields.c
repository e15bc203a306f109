/** Sampled fields against differences of the modulations, and against what a T, L or P field must
 * be. */
#include "synthetic.h"
#include "modes/fields.h"

enum { DISKS = 60, ROWS = 2 * DISKS };
/** Step of central differences, about the cube root of the rounding. */
static const double STEP = 1e-5;
/** |k| of the scenes below; third derivatives are below its cube. */
static const double K_MAX = 2.0;
/** Truncation k^3 h^2 / 6 of a function of size 1 (k times that for fields, which are of size k),
 * and rounding (phases up to 50) over h, some ten times each. */
static const double DIFFERENCE = 10.0 * (8.0 * 1e-10 / 6.0 + 50.0 * DBL_EPSILON / 1e-5);

typedef struct sample {
    hd_scene_def scene;
    double box[2], q[ROWS], p[ROWS];
    hd_fields *fields;
} sample;

/** Disks anywhere that a centre can reach, overlapping or not. */
static sample sampled(hd_boundary x, hd_boundary y, int max_mode_number)
{
    sample s = {.scene = scene_of(DISKS, 0.45, 0.8, x, y, 1)};
    hd_random random = hd_random_seeded(5, 0);
    s.scene.max_mode_number = max_mode_number;
    hd_scene_box(&s.scene, s.box);
    for (int row = 0; row < ROWS; row++) {
        const double margin = s.scene.boundary[row % 2] == R ? 0.5 : 0.0;
        const double u = 0.5 * (1.0 + hd_random_symmetric(&random));
        s.q[row] = margin + u * (s.box[row % 2] - 2.0 * margin);
        s.p[row] = hd_random_symmetric(&random);
    }
    CHECK_OK(hd_fields_create(&s.fields, &s.scene));
    hd_fields_sample(s.fields, s.q, s.p);
    return s;
}

/** As sampled, before a column got norm 1. */
static double raw(const hd_fields *fields, int row, int column)
{
    const size_t at = (size_t)row * (size_t)hd_fields_stride(fields) + (size_t)column;
    return hd_fields_norm(fields, column) * hd_fields_data(fields)[at];
}

/** For every modulation c of every subspace, in every boundary. */
typedef void (*modulation_check)(sample *s, const hd_subspace *subspace, int c);

static void for_all(modulation_check check)
{
    for (int k = 0; k < 4; k++) {
        sample s = sampled(k & 1 ? R : P, k & 2 ? R : P, 2);
        for (int i = 0; i < hd_fields_subspaces(s.fields); i++) {
            const hd_subspace *subspace = hd_fields_subspace(s.fields, i);
            assert_true(subspace->wave.number < K_MAX);
            for (int c = 0; c < subspace->modulations.count; c++) check(&s, subspace, c);
        }
        hd_fields_free(s.fields);
    }
}

/* ---- against the definition ---------------------------------------------------------------- */

static double modulation(const sample *s, const hd_subspace *m, int c, double x, double y)
{
    double out[3];
    modulation_at(&s->scene, out, &m->wave, m->modulations.bits[c], (const double[]){x, y});
    return out[0];
}

/** A, dA/dx, dA/dy by central differences. */
static void derivatives(double out[3], const sample *s, const hd_subspace *m, int c,
                        const double *q)
{
    out[0] = modulation(s, m, c, q[0], q[1]);
    out[1] = (modulation(s, m, c, q[0] + STEP, q[1]) - modulation(s, m, c, q[0] - STEP, q[1])) /
             (2.0 * STEP);
    out[2] = (modulation(s, m, c, q[0], q[1] + STEP) - modulation(s, m, c, q[0], q[1] - STEP)) /
             (2.0 * STEP);
}

static void check_definition(sample *s, const hd_subspace *m, int c)
{
    const int column = m->column + c, pair = column + m->modulations.count;
    for (int j = 0; j < DISKS; j++) {
        double a[3];
        derivatives(a, s, m, c, s->q + 2 * j);
        const bool t = m->kind == HD_MODE_T;
        CHECK_CLOSE(raw(s->fields, 2 * j, column), t ? a[2] : a[1], DIFFERENCE);
        CHECK_CLOSE(raw(s->fields, 2 * j + 1, column), t ? -a[1] : a[2], DIFFERENCE);
        if (t) continue;
        for (int d = 0; d < 2; d++) /* P = p A: a few roundings */
            CHECK_CLOSE(raw(s->fields, 2 * j + d, pair), s->p[2 * j + d] * a[0],
                        100.0 * DBL_EPSILON);
    }
}

TEST(fields_are_those_of_their_modulations) { for_all(check_definition); }

/** The same far away: one box further. */
static void check_period(sample *s, const hd_subspace *m, int c)
{
    double moved[ROWS], before[ROWS];
    for (int d = 0; d < 2; d++) {
        if (s->scene.boundary[d] != P) continue;
        for (int row = 0; row < ROWS; row++) before[row] = raw(s->fields, row, m->column + c);
        for (int row = 0; row < ROWS; row++) moved[row] = s->q[row] + (row % 2 == d) * s->box[d];
        hd_fields_sample(s->fields, moved, s->p);
        for (int row = 0; row < ROWS; row++)
            CHECK_CLOSE(raw(s->fields, row, m->column + c), before[row],
                        200.0 * DBL_EPSILON * K_MAX); /* phases up to 50 */
        hd_fields_sample(s->fields, s->q, s->p);
    }
}

TEST(fields_have_the_period_of_the_box) { for_all(check_period); }

/* ---- columns ------------------------------------------------------------------------------- */

static double square(const hd_fields *fields, int column)
{
    double sum = 0.0;
    for (int row = 0; row < ROWS; row++)
        sum += pow(
            hd_fields_data(fields)[(size_t)row * (size_t)hd_fields_stride(fields) + (size_t)column],
            2.0);
    return sum;
}

static const double NORM = ROWS * DBL_EPSILON;

TEST(columns_have_norm_1)
{
    for (int k = 0; k < 4; k++) {
        const sample s = sampled(k & 1 ? R : P, k & 2 ? R : P, 2);
        const int null = hd_fields_columns(s.fields) - NULLS;
        for (int c = 0; c < null; c++) {
            CHECK_CLOSE(square(s.fields, c), 1.0, NORM);
            assert_true(hd_fields_norm(s.fields, c) > 0.1); /* order sqrt(N/8), k sqrt(N/8) */
        }
        CHECK_CLOSE(square(s.fields, null + HD_NULL_X), k & 1 ? 0.0 : 1.0, NORM);
        CHECK_CLOSE(square(s.fields, null + HD_NULL_Y), k & 2 ? 0.0 : 1.0, NORM);
        CHECK_CLOSE(square(s.fields, null + NULL_P), 1.0, NORM);
        hd_fields_free(s.fields);
    }
}

/** Uniform along a periodic direction, and the momenta. */
TEST(null_fields)
{
    for (int k = 0; k < 4; k++) {
        const sample s = sampled(k & 1 ? R : P, k & 2 ? R : P, 1);
        const int null = hd_fields_columns(s.fields) - NULLS;
        for (int row = 0; row < ROWS; row++) {
            CHECK_CLOSE(raw(s.fields, row, null + HD_NULL_X), row % 2 == 0 && !(k & 1), NORM);
            CHECK_CLOSE(raw(s.fields, row, null + HD_NULL_Y), row % 2 == 1 && !(k & 2), NORM);
            CHECK_CLOSE(raw(s.fields, row, null + NULL_P), s.p[row], NORM);
        }
        hd_fields_free(s.fields);
    }
}

/** Sines at disks that all sit on their nodes: zero, not NaN, and well again afterwards. */
TEST(a_field_that_vanishes_stays_zero)
{
    sample s = sampled(P, P, 1);
    double q[ROWS] = {0.0};
    hd_fields_sample(s.fields, q, s.p);
    const hd_subspace *pairs = hd_fields_subspace(s.fields, 1);
    assert_int_equal(pairs->kind, HD_MODE_LP);
    assert_int_equal(pairs->modulations.bits[1], HD_SIN_X);
    CHECK_CLOSE(hd_fields_norm(s.fields, pairs->column), 0.0, 0.0); /* L of cos */
    CHECK_CLOSE(square(s.fields, pairs->column), 0.0, 0.0);
    CHECK_CLOSE(square(s.fields, pairs->column + 1), 1.0, NORM); /* L of sin */
    CHECK_CLOSE(square(s.fields, pairs->column + 2), 1.0, NORM); /* P of cos */
    CHECK_CLOSE(square(s.fields, pairs->column + 3), 0.0, 0.0);  /* P of sin */
    hd_fields_sample(s.fields, s.q, s.p);
    for (int c = 0; c < 4; c++) CHECK_CLOSE(square(s.fields, pairs->column + c), 1.0, NORM);
    hd_fields_free(s.fields);
}

/** All subspaces side by side in ascending k, T before LP, then the null fields; none of dimension
 * 0. */
TEST(columns_lie_in_order)
{
    for (int k = 0; k < 4; k++) {
        const sample s = sampled(k & 1 ? R : P, k & 2 ? R : P, 2);
        int column = 0;
        for (int i = 0; i < hd_fields_subspaces(s.fields); i++) {
            const hd_subspace *now = hd_fields_subspace(s.fields, i);
            const hd_subspace *before = i > 0 ? hd_fields_subspace(s.fields, i - 1) : NULL;
            assert_true(now->kind == HD_MODE_T || now->kind == HD_MODE_LP);
            assert_int_equal(now->column, column);
            assert_true(now->dimension > 0);
            assert_int_equal(now->dimension,
                             now->modulations.count * (now->kind == HD_MODE_LP ? 2 : 1));
            column += now->dimension;
            if (before && before->wave.number == now->wave.number)
                assert_true(before->kind == HD_MODE_T && now->kind == HD_MODE_LP);
            else
                assert_true(!before || before->wave.number < now->wave.number);
        }
        assert_int_equal(hd_fields_columns(s.fields), column + NULLS);
        assert_true(hd_fields_stride(s.fields) >= column + NULLS);
        hd_fields_free(s.fields);
    }
}

/** 8 waves of 2 nodes: 6 T(n) of 4 and so on [T10]. */
TEST(dimensions_add_up)
{
    const int want[] = {4 * (2 + 4) + 4 * (4 + 8), 2 * (1 + 2) + 2 * 2 + 4 * (2 + 4),
                        2 * (1 + 2) + 2 * 2 + 4 * (2 + 4), 4 * 2 + 4 * (1 + 2)};
    for (int k = 0; k < 4; k++) {
        const sample s = sampled(k & 1 ? R : P, k & 2 ? R : P, 2);
        int extra = 0; /* mixed: LP along the periodic direction has 4, not 2 */
        if (k == 1 || k == 2) extra = 2 * 2;
        assert_int_equal(hd_fields_columns(s.fields) - NULLS, want[k] + extra);
        hd_fields_free(s.fields);
    }
}

/** However many there are. */
TEST(fields_are_counted_wave_by_wave)
{
    const hd_scene_def def = scene(.number = 1000000, .density = 0.9, .max_wave_number = 0.5);
    const int waves = hd_waves(&def, NULL, 0);
    HEAP hd_wave *wave = calloc((size_t)waves, sizeof *wave);
    assert_true(waves > 4096);
    assert_int_equal(hd_waves(&def, wave, waves), waves);
    double columns = 0.0, phases = 0.0;
    for (int k = 0; k < waves; k++) {
        columns += wave[k].transverse.count + 2.0 * wave[k].pairs.count;
        phases += 2.0 * wave[k].pairs.count * wave[k].pairs.count;
    }
    const hd_fields_count count = hd_fields_count_of(&def);
    CHECK_CLOSE(count.columns, columns, 0.0);
    CHECK_CLOSE(count.lp_phases, phases, 0.0);
    CHECK_CLOSE(count.subspaces, 2.0 * waves, 0.0);
}
