/** The dispersion relation of steps with given exponents and errors, against an independent fit. */
#include <float.h>
#include <lapacke.h>

#include "testing.h"

#include "scenes.h"
#include "synthetic.h"

enum { DISKS = 60, VECTORS = 30, NODES_MAX = 4 };
static const hd_mode_kind kinds[] = {HD_MODE_T, HD_MODE_LP};
/** c and c2 of the truth [T12]. */
static const double truth[2][2] = {{1.41, 0.09}, {1.42, 0.55}};
/** Normal equations of four points within a factor 4: condition below 1e3, its square times
 * rounding. */
static const double ALGEBRA = 1e6 * 10.0 * DBL_EPSILON;

static double lambda(int kind, double k) { return truth[kind][0] * k + truth[kind][1] * k * k; }

/** A channel of T(n,0) and LP(n,0), n = 1 .. nodes; exponents [VECTORS] of the truth. */
static world channel(double *exponents, int nodes)
{
    hd_scene_def def = scene_in_box(DISKS, 80.0, 1.5, HD_PERIODIC, HD_PERIODIC, 6);
    def.max_mode_number = nodes;
    world w = world_create(&def, VECTORS, 1);
    exponents_falling(&w, exponents);
    int col = VECTORS;
    for (int n = 1; n <= nodes; n++)
        for (int kind = 0; kind < 2; kind++) {
            const int s = world_subspace(&w, kinds[kind], n, 0), d = world_dimension(&w, s);
            col -= d;
            world_span(&w, col, &s, 1, 0.05);
            exponents_flat(exponents, col, d,
                           lambda(kind, hd_fields_subspace(w.fields, s)->wave.number));
        }
    world_look(&w);
    return w;
}

/** Samples with white noise, of this relative size, of all vectors of a step together. */
static void feed(world *w, const double *exponents, double noise, int samples)
{
    hd_spectrum_clear(w->spectrum);
    hd_steps_clear(w->steps);
    for (int t = 0; t < samples; t++) {
        double sample[VECTORS], move = 0.0;
        for (int col = 0; col < VECTORS; col++) {
            if (col == 0 || exponents[col] != exponents[col - 1])
                move = noise * random_normal(&w->random);
            sample[col] = exponents[col] * (1.0 + move);
        }
        world_stretch(w, sample);
    }
    hd_steps_find(w->steps, w->spectrum);
}

static void exact_data_give_the_truth(void **state)
{
    (void)state;
    double exponents[VECTORS];
    for (int nodes = 2; nodes <= NODES_MAX; nodes++) {
        world w = channel(exponents, nodes);
        feed(&w, exponents, 0.0, 1);
        for (int kind = 0; kind < 2; kind++) {
            const hd_dispersion d = hd_steps_dispersion(w.steps, w.spectrum, kinds[kind]);
            assert_int_equal(d.points, nodes);
            CHECK_CLOSE(d.c, truth[kind][0], ALGEBRA);
            CHECK_CLOSE(d.c2, truth[kind][1], ALGEBRA);
            CHECK_CLOSE(d.c_error, -1.0, 0.0); /* one sample tells none */
            CHECK_CLOSE(d.c2_error, -1.0, 0.0);
            CHECK_CLOSE(d.misfit, -1.0, 0.0);
        }
        world_free(&w);
    }
}

static void one_point_gives_c_alone(void **state)
{
    (void)state;
    double exponents[VECTORS];
    world w = channel(exponents, 1);
    const double k = world_step(&w, HD_MODE_T, 1, 0)->wave.number;
    hd_dispersion d = hd_steps_dispersion(w.steps, w.spectrum, HD_MODE_T); /* none yet */
    assert_int_equal(d.points, 0);
    assert_int_equal(d.terms, 0);
    CHECK_CLOSE(d.k_max, 0.0, 0.0);
    CHECK_CLOSE(d.c, 0.0, 0.0);
    CHECK_CLOSE(d.c_error, -1.0, 0.0);
    CHECK_CLOSE(d.c2_error, -1.0, 0.0);
    feed(&w, exponents, 0.0, 1);
    d = hd_steps_dispersion(w.steps, w.spectrum, HD_MODE_T);
    assert_int_equal(d.points, 1);
    assert_int_equal(d.terms, 1);
    CHECK_CLOSE(d.k_min, k, 0.0);
    CHECK_CLOSE(d.k_max, k, 0.0);
    CHECK_CLOSE(d.c, lambda(0, k) / k, ALGEBRA);
    CHECK_CLOSE(d.c2, 0.0, 0.0);
    CHECK_CLOSE(d.c_error, -1.0, 0.0);
    feed(&w, exponents, 0.1, 64);
    d = hd_steps_dispersion(w.steps, w.spectrum, HD_MODE_T);
    const hd_step *step = world_step(&w, HD_MODE_T, 1, 0);
    CHECK_CLOSE(d.c, step->exponent / k, ALGEBRA);
    CHECK_CLOSE(d.c_error, step->std_error / k, ALGEBRA);
    CHECK_CLOSE(d.c2_error, -1.0, 0.0);
    world_free(&w);
}

/* ---- against an independent fit ------------------------------------------------------------ */

typedef struct data {
    int points, parameters;
    double k[8], exponent[8], error[8];
} data;

static data data_of(const world *w, hd_mode_kind kind, int parameters)
{
    data d = {.parameters = parameters};
    for (int i = 0; i < hd_steps_count(w->steps); i++) {
        const hd_step *step = hd_steps_step(w->steps, i);
        if (step->kind != kind || !step->resolved) continue;
        d.k[d.points] = step->wave.number;
        d.exponent[d.points] = step->exponent;
        d.error[d.points++] = step->std_error > 0 ? step->std_error : 1.0;
    }
    return d;
}

/** Least squares by QR; returns chi^2. */
static double solve(const data *d, double out[2])
{
    double a[2 * 8], b[8], chi2 = 0.0;
    for (int i = 0; i < d->points; i++) {
        a[i] = d->k[i] / d->error[i];
        a[d->points + i] = d->k[i] * d->k[i] / d->error[i];
        b[i] = d->exponent[i] / d->error[i];
    }
    assert_int_equal(LAPACKE_dgels(LAPACK_COL_MAJOR, 'N', d->points, d->parameters, 1, a, d->points,
                                   b, d->points),
                     0);
    out[0] = b[0];
    out[1] = d->parameters > 1 ? b[1] : 0.0;
    for (int i = d->parameters; i < d->points; i++) chi2 += b[i] * b[i];
    return chi2;
}

/** What the fit says that it stands on. */
static void check_basis(const hd_dispersion *got, const data *d)
{
    double k_min = d->k[0], k_max = d->k[0];
    for (int i = 1; i < d->points; i++) {
        k_min = fmin(k_min, d->k[i]);
        k_max = fmax(k_max, d->k[i]);
    }
    assert_int_equal(got->terms, d->parameters);
    CHECK_CLOSE(got->k_min, k_min, 0.0);
    CHECK_CLOSE(got->k_max, k_max, 0.0);
}

static void check_against_twin(const world *w, hd_mode_kind kind, int parameters)
{
    const data d = data_of(w, kind, parameters);
    const hd_dispersion got = hd_steps_dispersion(w->steps, w->spectrum, kind);
    const int freedom = d.points - parameters;
    double best[2];
    const double chi2 = solve(&d, best), misfit = freedom > 0 ? sqrt(chi2 / freedom) : -1.0;
    check_basis(&got, &d);
    CHECK_CLOSE(got.c, best[0], ALGEBRA * fabs(best[0]));
    CHECK_CLOSE(got.c2, best[1], ALGEBRA);
    CHECK_CLOSE(got.misfit, misfit, 1e-6 * fabs(misfit) + 1e-10); /* of exact points: rounding */
}

static void fits_are_those_of_least_squares(void **state)
{
    (void)state;
    double exponents[VECTORS];
    for (int nodes = 2; nodes <= NODES_MAX; nodes++) {
        world w = channel(exponents, nodes);
        for (int repeat = 0; repeat < 20; repeat++) {
            feed(&w, exponents, 0.05, 64);
            for (int kind = 0; kind < 2; kind++) check_against_twin(&w, kinds[kind], 2);
        }
        world_free(&w);
    }
}

/** Steps off the curve by 5 %, of errors of 0.1 %: the fit is as certain as before, and says that
 * it does not fit. */
static void misfits_are_told_from_errors(void **state)
{
    (void)state;
    double exponents[VECTORS];
    world w = channel(exponents, NODES_MAX);
    for (int n = 1; n <= NODES_MAX; n++)
        for (int kind = 0; kind < 2; kind++) {
            const int s = world_subspace(&w, kinds[kind], n, 0), d = world_dimension(&w, s);
            const double off = n % 2 ? 1.05 : 0.95;
            for (int col = VECTORS - 1; col >= 0; col--)
                if (exponents[col] == lambda(kind, hd_fields_subspace(w.fields, s)->wave.number)) {
                    exponents_flat(exponents, col - d + 1, d, exponents[col] * off);
                    break;
                }
        }
    for (int kind = 0; kind < 2; kind++) {
        feed(&w, exponents, 0.01, 64);
        check_against_twin(&w, kinds[kind], 2);
        const hd_dispersion d = hd_steps_dispersion(w.steps, w.spectrum, kinds[kind]);
        assert_true(d.misfit > 20.0);
        assert_true(d.c_error > 0 && d.c_error < 0.01); /* not 5 % of 1.4 */
    }
    world_free(&w);
}

/** Fluctuations of the fit over many repetitions in units of the stated errors. */
static void errors_are_honest(void **state)
{
    (void)state;
    enum { REPEATS = 300 };
    double exponents[VECTORS], square[2][2] = {{0.0}};
    world w = channel(exponents, NODES_MAX);
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        feed(&w, exponents, 0.05, 256);
        for (int kind = 0; kind < 2; kind++) {
            const hd_dispersion d = hd_steps_dispersion(w.steps, w.spectrum, kinds[kind]);
            assert_int_equal(d.points, NODES_MAX);
            square[kind][0] += pow((d.c - truth[kind][0]) / d.c_error, 2.0) / REPEATS;
            square[kind][1] += pow((d.c2 - truth[kind][1]) / d.c2_error, 2.0) / REPEATS;
        }
    }
    for (int kind = 0; kind < 2; kind++) {
        print_message("rms deviation of c %.2f, of c2 %.2f errors\n", sqrt(square[kind][0]),
                      sqrt(square[kind][1]));
        for (int m = 0; m < 2;
             m++) /* 300 numbers: 4 %; errors from 64 blocks or fewer: some more */
            CHECK_CLOSE(sqrt(square[kind][m]), 1.03, 0.15);
    }
    world_free(&w);
}

/* ---- which steps count --------------------------------------------------------------------- */

static void unresolved_steps_do_not_count(void **state)
{
    (void)state;
    double exponents[VECTORS];
    world w = channel(exponents, NODES_MAX);
    exponents[VECTORS - 10] *= 3.0; /* of LP(2,0), in 18 .. 21 */
    feed(&w, exponents, 0.0, 1);
    assert_false(world_step(&w, HD_MODE_LP, 2, 0)->resolved);
    const hd_dispersion d = hd_steps_dispersion(w.steps, w.spectrum, HD_MODE_LP);
    assert_int_equal(d.points, 3);
    CHECK_CLOSE(d.c, truth[1][0], ALGEBRA);
    const data left = data_of(&w, HD_MODE_LP, 2);
    check_basis(&d, &left);
    assert_int_equal(hd_steps_dispersion(w.steps, w.spectrum, HD_MODE_T).points, 4);
    world_free(&w);
}

/** T(1,0) and T(0,1) of a square box: one wave number. */
static void equal_wave_numbers_are_one_point(void **state)
{
    (void)state;
    for (int nodes = 0; nodes < 2; nodes++) {
        hd_scene_def def = scene_of(100, 0.5, 1.0, HD_PERIODIC, HD_PERIODIC, 4);
        double exponents[VECTORS];
        if (nodes == 0) def.max_wave_number = hd_wave_component(&def, 0, 1);
        def.max_mode_number = nodes;
        world w = world_create(&def, VECTORS, 1);
        exponents_falling(&w, exponents);
        const int both[] = {world_subspace(&w, HD_MODE_T, 1, 0),
                            world_subspace(&w, HD_MODE_T, 0, 1)};
        const double k = hd_fields_subspace(w.fields, both[0])->wave.number;
        world_span(&w, 26, both, 2, 0.0);
        exponents_flat(exponents, 26, 4, lambda(0, k));
        if (nodes == 1) {
            const int s = world_subspace(&w, HD_MODE_T, 1, 1);
            world_span(&w, 20, &s, 1, 0.0);
            exponents_flat(exponents, 20, 4, lambda(0, sqrt(2.0) * k));
        }
        world_look(&w);
        feed(&w, exponents, 0.02, 64);
        const hd_dispersion d = hd_steps_dispersion(w.steps, w.spectrum, HD_MODE_T);
        assert_int_equal(d.points, 1 + nodes);
        check_against_twin(&w, HD_MODE_T, 1 + nodes);
        const double of_step = world_step(&w, HD_MODE_T, 1, 0)->std_error / k;
        if (nodes == 0) CHECK_CLOSE(d.c_error, of_step, 1e-3 * of_step); /* both are one set */
        world_free(&w);
    }
}

/** Steps of the negative half are the same steps once more. */
static void conjugate_steps_do_not_count(void **state)
{
    (void)state;
    hd_scene_def def = scene_in_box(DISKS, 80.0, 1.5, HD_PERIODIC, HD_PERIODIC, 6);
    def.max_mode_number = 1;
    static double exponents[4 * DISKS];
    world w = world_create(&def, 4 * DISKS, 1);
    for (int col = 0; col < 4 * DISKS; col++) exponents[col] = 3.0 - col / 40.0;
    const int s = world_subspace(&w, HD_MODE_T, 1, 0);
    world_span(&w, 4 * DISKS - 20, &s, 1, 0.0);
    exponents_flat(exponents, 4 * DISKS - 20, 2, -0.1);
    world_look(&w);
    world_stretch(&w, exponents);
    hd_steps_find(w.steps, w.spectrum);
    assert_true(hd_steps_step(w.steps, 3 + s)->resolved);
    assert_true(hd_steps_step(w.steps, 3 + s)->conjugate);
    assert_int_equal(hd_steps_dispersion(w.steps, w.spectrum, HD_MODE_T).points, 0);
    world_free(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exact_data_give_the_truth),
        cmocka_unit_test(one_point_gives_c_alone),
        cmocka_unit_test(fits_are_those_of_least_squares),
        cmocka_unit_test(misfits_are_told_from_errors),
        cmocka_unit_test(errors_are_honest),
        cmocka_unit_test(unresolved_steps_do_not_count),
        cmocka_unit_test(equal_wave_numbers_are_one_point),
        cmocka_unit_test(conjugate_steps_do_not_count),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
