/** Widths of a run's vectors: those of a slow twin, only while somebody looks. */
#include "runs.h"

enum { DISKS = 40, VECTORS_MAX = 4 * DISKS, SAMPLES_MAX = 1000 };

static hd_scene_def scene_with(int exponents, unsigned observe)
{
    return scene(.number = DISKS, .density = 0.6, .aspect = 0.4, .seed = 6, .exponents = exponents,
                 .observe = observe, .equilibration = 5.0, .warmup = 20.0, .duration = 120.0,
                 .threads = 2);
}

/** Of one column. */
static double entropy_of(hd_columns v, int col)
{
    double sum = 0.0;
    for (int disk = 0; disk < DISKS; disk++) {
        double part = 0.0;
        for (int row = 4 * disk; row < 4 * disk + 4; row++)
            part += pow(v.data[(size_t)row * (size_t)v.stride + (size_t)col], 2.0);
        if (part > 0) sum += part * log(part);
    }
    return -sum;
}

/** Every time that the run has measured. */
typedef struct twin {
    int samples;
    double entropy[SAMPLES_MAX][VECTORS_MAX];
} twin;

static void expect_as(const twin *t, hd_localization *shape, int n)
{
    const double rounding = 1e-12;
    for (int col = 0; col < n; col++) {
        double mean = 0.0;
        for (int k = 0; k < t->samples; k++) mean += t->entropy[k][col] / t->samples;
        CHECK_CLOSE(hd_localization_widths(shape)[col], exp(mean) / DISKS, rounding);
        CHECK_CLOSE(hd_localization_width_now(shape, col),
                    exp(t->entropy[t->samples - 1][col]) / DISKS, rounding);
    }
}

/** With half of the vectors carried, those of the other half too: they are seen with the modes. */
TEST(widths_are_those_of_the_vectors)
{
    static twin t;
    static const int exponents[] = {HD_EXPONENTS_POSITIVE, 7, HD_EXPONENTS_ALL,
                                    HD_EXPONENTS_ALL_INDEPENDENT};
    for (size_t k = 0; k < sizeof exponents / sizeof *exponents; k++) {
        OWNED(hd_run) *run = created(
            scene_with(exponents[k], HD_OBSERVE_LOCALIZATION | HD_OBSERVE_MODES));
        hd_localization *shape = hd_run_localization(run);
        const int n = hd_run_vectors(run);
        t.samples = 0;
        while (going_on(run)) {
            if (hd_localization_samples(shape) == t.samples) continue;
            assert_true(hd_localization_samples(shape) == t.samples + 1 && t.samples < SAMPLES_MAX);
            const hd_columns v = hd_run_vectors_now(run);
            for (int col = 0; col < n; col++) t.entropy[t.samples][col] = entropy_of(v, col);
            t.samples++;
        }
        assert_true(t.samples >= 16);
        expect_as(&t, shape, n);
    }
}

/** Widths of independent runs scatter as their errors say. */
TEST(errors_are_those_of_seeds)
{
    enum { SEEDS = 40 };
    static double width[SEEDS][VECTORS_MAX];
    double stated = 0.0, square = 0.0;
    int n = 0;
    for (int seed = 0; seed < SEEDS; seed++) {
        OWNED(hd_run) *run = finished(
            scene(.number = 8, .density = 0.4, .aspect = 0.5, .seed = (uint64_t)seed + 1,
                  .observe = HD_OBSERVE_LOCALIZATION, .exponents = HD_EXPONENTS_POSITIVE,
                  .warmup = 20.0, .duration = 200.0));
        hd_localization *shape = hd_run_localization(run);
        n = hd_run_vectors(run);
        for (int col = 0; col < n; col++) {
            const double error = hd_localization_width_error(shape, col);
            assert_true(error > 0);
            width[seed][col] = hd_localization_widths(shape)[col];
            stated += error * error / SEEDS;
        }
    }
    for (int col = 0; col < n; col++) {
        double mean = 0.0;
        for (int seed = 0; seed < SEEDS; seed++) mean += width[seed][col] / SEEDS;
        for (int seed = 0; seed < SEEDS; seed++)
            square += pow(width[seed][col] - mean, 2.0) / (SEEDS - 1);
    }
    CHECK_CLOSE(sqrt(square / stated), 1.0, 0.15);
}

/** Nothing is measured, and the exponents are those of a run that was not asked. */
TEST(nothing_is_measured_while_nobody_looks)
{
    const hd_scene_def asked = scene_with(HD_EXPONENTS_POSITIVE, HD_OBSERVE_LOCALIZATION),
                       plain = scene_with(HD_EXPONENTS_POSITIVE, 0);
    OWNED(hd_run) *run = created(asked), *other = created(plain);
    assert_null(hd_run_localization(other));
    hd_run_observe(run, 0);
    while (going_on(run)) CHECK_OK(hd_run_advance(other));
    assert_true(hd_localization_samples(hd_run_localization(run)) == 0);
    check_same_exponents(run, other, 0.0);
}
