/** Denormals, exact zeros, single samples, constant series, odd intervals of time: no such number
 * reaches a result. */
#include "published.h"
#include "rotating.h"
#include "runs.h"

enum { DISKS = 40, ROWS = 2 * DISKS, VECTORS = 4 };

/** Weights: sums of 2N terms over Gram matrices of condition 10. */
static const double ALGEBRA = 10.0 * ROWS * DBL_EPSILON;

typedef struct weights {
    double of[64][VECTORS];
    double cosine[VECTORS], ratio[VECTORS];
} weights;

/** The dq halves times of_dq, and dp halves like them; the whole is not of length 1. */
static void write_halves(world *w, double (*dq)[ROWS], double of_dq, double of_dp)
{
    double *v = hd_frame_data(w->frame);
    for (int row = 0; row < ROWS; row++)
        for (int col = 0; col < VECTORS; col++) {
            const int at = (4 * (row / 2) + row % 2) * hd_frame_stride(w->frame) + col;
            v[at] = of_dq * dq[col][row];
            v[at + 2 * hd_frame_stride(w->frame)] = of_dp * (dq[col][row] + 0.1 * (row % 3));
        }
}

static weights measure(world *w)
{
    weights out = {0};
    CHECK_OK(hd_modes_measure(w->modes, hd_frame_columns(w->frame), w->q, w->p));
    hd_frame_halves(w->frame, out.cosine, out.ratio);
    for (int s = 0; s < hd_fields_subspaces(w->fields); s++)
        for (int col = 0; col < VECTORS; col++)
            out.of[s][col] = hd_modes_snapshot(w->modes, s, HD_WEIGHT)[col];
    return out;
}

static void check_normal(double x) { assert_true(x == 0.0 || (isfinite(x) && fabs(x) >= DBL_MIN)); }

/** As they were, or none; of halves too small for their squares nothing is known. */
static void check_weights(const world *w, const weights *got, const weights *want, bool small)
{
    for (int s = 0; s < hd_fields_subspaces(w->fields); s++)
        for (int col = 0; col < VECTORS; col++) {
            check_normal(got->of[s][col]);
            CHECK_CLOSE(got->of[s][col], small ? 0.0 : want->of[s][col], ALGEBRA);
        }
    for (int col = 0; col < VECTORS; col++) {
        if (!isnan(got->ratio[col])) check_normal(got->ratio[col]);
        if (small) {
            assert_true(isnan(got->cosine[col]));
            continue;
        }
        check_normal(got->cosine[col]);
        CHECK_CLOSE(got->cosine[col], want->cosine[col], ALGEBRA);
    }
}

/** Down to 1e-140 a half counts as any other; below the square root of the smallest numbers it is
 * none. */
TEST(a_tiny_dq_half_has_its_weights_or_none)
{
    const hd_scene_def def = scene(.disks = DISKS, .density = 0.5, .aspect = 0.8, .seed = 3,
                                   .max_mode_number = 1);
    HELD(world) w = world_create(def, VECTORS, 1);
    static double dq[VECTORS][ROWS];
    for (int col = 0; col < VECTORS; col++) {
        for (int row = 0; row < ROWS; row++) dq[col][row] = 0.05 * random_normal(&w.random);
        world_add_field(&w, dq[col], col, 0.5);
    }
    write_halves(&w, dq, 1.0, 1.0);
    const weights want = measure(&w);
    for (int digits = 0; digits <= 330; digits += 2) {
        write_halves(&w, dq, pow(10.0, -digits), 1.0);
        const weights got = measure(&w);
        if (digits <= 140 || digits >= 156) check_weights(&w, &got, &want, digits >= 156);
        for (int col = 0; col < VECTORS; col++)
            for (int s = 0; s < hd_fields_subspaces(w.fields); s++)
                assert_true(got.of[s][col] <= 1.0 + ALGEBRA);
    }
}

/** The same for dp, of which no weight knows. */
TEST(a_tiny_dp_half_changes_no_weight)
{
    const hd_scene_def def = scene(.disks = DISKS, .density = 0.5, .aspect = 0.8, .boundary[1] = R,
                                   .seed = 3, .max_mode_number = 1);
    HELD(world) w = world_create(def, VECTORS, 1);
    static double dq[VECTORS][ROWS];
    for (int col = 0; col < VECTORS; col++) world_add_field(&w, dq[col], col, 0.5);
    write_halves(&w, dq, 1.0, 1.0);
    const weights want = measure(&w);
    for (int digits = 0; digits <= 330; digits += 2) {
        write_halves(&w, dq, 1.0, pow(10.0, -digits));
        const weights got = measure(&w);
        for (int col = 0; col < VECTORS; col++) {
            for (int s = 0; s < hd_fields_subspaces(w.fields); s++)
                CHECK_CLOSE(got.of[s][col], want.of[s][col], 0.0);
            if (isnan(got.cosine[col])) {
                assert_true(digits > 140);
                continue;
            }
            assert_true(fabs(got.cosine[col]) <= 1.0 + ALGEBRA);
            check_normal(got.cosine[col]);
            check_normal(got.ratio[col]);
        }
    }
}

/** Denormal entries among normal ones: as if they were zero. */
TEST(denormal_entries_are_zeros)
{
    const hd_scene_def def = scene(.disks = DISKS, .density = 0.5, .aspect = 0.8, .seed = 3,
                                   .max_mode_number = 1);
    HELD(world) w = world_create(def, VECTORS, 1);
    static double dq[2][VECTORS][ROWS];
    for (int col = 0; col < VECTORS; col++) world_add_field(&w, dq[0][col], col, 0.5);
    for (int col = 0; col < VECTORS; col++)
        for (int row = col; row < ROWS; row += 5) dq[0][col][row] = 0.0;
    memcpy(dq[1], dq[0], sizeof dq[1]);
    for (int col = 0; col < VECTORS; col++)
        for (int row = col; row < ROWS; row += 5) dq[1][col][row] = row % 2 ? 4e-324 : -1e-310;
    weights got[2];
    for (int k = 0; k < 2; k++) {
        write_halves(&w, dq[k], 1.0, 1.0);
        got[k] = measure(&w);
    }
    for (int s = 0; s < hd_fields_subspaces(w.fields); s++)
        for (int col = 0; col < VECTORS; col++) {
            CHECK_CLOSE(got[1].of[s][col], got[0].of[s][col], 0.0);
            check_normal(got[1].of[s][col]);
        }
}

/** Zero variance: the error is zero, or not known while there are too few samples. */
TEST(constant_series_have_no_error)
{
    static const double values[] = {0.0, 1.0, -3.7, 1e-300, 1e-12, 1e12};
    enum { SERIES = sizeof values / sizeof *values };
    MADE(hd_spectrum, spectrum, 8, SERIES, 0.0);
    for (int samples = 1; samples <= 300; samples++) {
        hd_spectrum_add(spectrum, values, 1.0);
        hd_spectrum_sample(spectrum);
        for (int col = 0; col < SERIES; col++) {
            const double error = hd_spectrum_std_error(spectrum, col);
            CHECK_CLOSE(error, samples < HD_SPECTRUM_BLOCKS_MIN ? -1.0 : 0.0,
                        DBL_EPSILON * fabs(values[col]));
            CHECK_CLOSE(hd_spectrum_exponent(spectrum, col), values[col],
                        samples * DBL_EPSILON * fabs(values[col]));
        }
    }
}

/** The exponents of a step and their fit, all alike at all times; a phase that does not move. */
TEST(constant_steps_and_phases_have_no_error)
{
    HELD(rotating) r = pairs(2);
    double exponents[2 * VECTORS_MAX];
    exponents_flat(exponents, 0, hd_frame_vectors(r.w.frame), 2.4);
    for (int t = 0; t < 200; t++) {
        world_stretch(&r.w, exponents);
        hd_steps_find(r.w.steps, r.w.spectrum);
        turn(&r, 0.0);
        check_normal(r.step->std_error);
        const hd_dispersion fit = hd_steps_dispersion(r.w.steps, r.w.spectrum, HD_MODE_LP);
        check_normal(fit.c.value);
        check_normal(fit.c.error);
        const hd_velocity v = hd_phases_velocity(r.phases);
        check_normal(v.v);
        check_normal(v.v_error);
        for (int k = 0; k < hd_phases_count(r.phases); k++) {
            const hd_phase *phase = hd_phases_phase(r.phases, k);
            check_normal(phase->omega);
            check_normal(phase->omega_error);
        }
    }
    CHECK_CLOSE(r.step->std_error, 0.0, 4.0 * DBL_EPSILON);
    CHECK_CLOSE(hd_phases_velocity(r.phases).v, 0.0, ROUNDING);
}

/** Before anything is known, and at every report. */
static void check_reports(hd_scene_def scene)
{
    OWNED(hd_run) *run = created(scene);
    check_published(run);
    while (going_on(run))
        if (hd_run_report_due(run)) check_published(run);
    CHECK_CLOSE(hd_run_time(run), scene.equilibration + scene.warmup + scene.duration,
                1e-12 * hd_run_time(run));
}

/** One vector, the positive half and all of them; reports far more often than collisions, far less
 * often than the run lasts, at no multiple of it; no equilibration, no warm-up, hardly any
 * duration. */
TEST(odd_intervals_publish_only_numbers)
{
    static const double intervals[] = {1e-4, 0.37, 1.0, 7.7, 1e6}, durations[] = {1e-3, 1.0, 10.3};
    static const int exponents[] = {1, HD_EXPONENTS_POSITIVE, HD_EXPONENTS_ALL};
    for (int i = 0; i < 5; i++)
        for (int d = 0; d < 3; d++)
            for (int e = 0; e < 3; e++)
                for (int start = 0; start < 2; start++) {
                    if (durations[d] / intervals[i] > 2e4)
                        continue; /* a report each 1e-4 of 1 is enough */
                    check_reports(
                        scene(.disks = 16, .density = 0.5, .aspect = 0.1,
                              .boundary[1] = start ? R : P, .seed = 2, .exponents = exponents[e],
                              .equilibration = start ? 0.05 : 0.0, .warmup = start ? 0.05 : 0.0,
                              .duration = durations[d], .report_interval = intervals[i],
                              .observe = 31, .threads = 1));
                }
}
