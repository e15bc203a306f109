/** Numbers of other people, exact identities, and what must vanish: the whole pipeline at once.
 * Statistical tolerances are Z combined standard errors at a fixed seed: the outcome is
 * reproducible. */
#include "runs.h"

static const double Z = 3.0;
/** Of the averaged times: sanitizers see the same in less, errors grow as they must. */
static const double PART = HD_SANITIZED ? 0.1 : 1.0;

static hd_scene_def small_scene(int disks, double density, double aspect)
{
    return scene(.number = disks, .density = density, .aspect = aspect, .equilibration = 200.0,
                 .warmup = 200.0, .threads = 1);
}

/** Measured against published, each with its standard error. */
static void check_published(const hd_spectrum *spectrum, int col, double value, double value_error)
{
    const double error = hd_spectrum_std_error(spectrum, col);
    assert_true(error > 0 && error < 0.01 * value);
    CHECK_CLOSE(hd_spectrum_exponent(spectrum, col), value, Z * hypot(error, value_error));
}

/** Against independent codes; their standard errors are given beside their numbers. */
TEST(nine_disks_have_the_published_exponents)
{
    OWNED(hd_run) *run = finished(
        scene_from(small_scene(9, 0.5, 0.8660), .duration = PART * 60000.0));
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    assert_int_equal(hd_run_vectors(run), 15);
    check_published(spectrum, 0, 3.2989, 0.0017);
    check_published(spectrum, 14, 1.2521, 0.0006);
    double variance =
        0.0; /* of the sum, as if independent: an upper limit is not needed at Z = 3 */
    for (int col = 0; col < 15; col++) variance += pow(hd_spectrum_std_error(spectrum, col), 2.0);
    CHECK_CLOSE(hd_spectrum_sum_up(spectrum).ks_entropy / 9, 3.450,
                Z * hypot(sqrt(variance) / 9, 0.001));
}

TEST(sixteen_disks_have_the_published_exponents)
{
    OWNED(hd_run) *run = finished(
        scene_from(small_scene(16, 0.7, 0.8660), .duration = PART * 30000.0));
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    check_published(spectrum, 0, 5.0031, 0.0019);
    check_published(spectrum, hd_run_vectors(run) - 1, 2.1705, 0.0009);
    CHECK_CLOSE(hd_spectrum_sum_up(spectrum).ks_entropy / 16, 5.905,
                Z * hypot(0.002 / sqrt(PART), 0.001));
}

/** All sixteen exponents; the published values carry no error, their last digit stands for one. */
TEST(four_disks_have_five_positive_and_six_zero_exponents)
{
    static const double published[] = {3.3464, 2.7869, 2.3272, 1.9337, 1.5986};
    hd_scene_def scene = scene_from(small_scene(4, 0.5, 1.0), .exponents = HD_EXPONENTS_ALL,
                                    .duration = PART * 200000.0);
    OWNED(hd_run) *run = finished(scene);
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    for (int col = 0; col < 5; col++) check_published(spectrum, col, published[col], 0.0015);
    for (int col = 5; col < 11; col++)
        CHECK_CLOSE(hd_spectrum_exponent(spectrum, col), 0.0,
                    2.0 * log(scene.duration) / scene.duration);
}
