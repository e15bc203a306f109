/** Runs of all 4N exponents, half of them carried, beside runs that carry each. */
#include "runs.h"

static hd_scene_def few(int exponents, hd_boundary x, hd_boundary y)
{
    return scene(.number = 10, .density = 0.5, .aspect = 0.9, .boundary[0] = x, .boundary[1] = y,
                 .seed = 3, .exponents = exponents, .equilibration = 20.0, .warmup = 200.0,
                 .duration = 400.0, .threads = 1);
}

TEST(exponents_pair_by_construction)
{
    OWNED(hd_run) *run = finished(few(HD_EXPONENTS_ALL, P, R));
    const hd_spectrum *s = hd_run_spectrum(run);
    assert_int_equal(hd_run_vectors(run), 40);
    assert_int_equal(hd_frame_vectors(hd_run_frame(run)), 20);
    assert_true(hd_spectrum_sum_up(s).pairing_error == 0.0);
    for (int col = 0; col < 20; col++) {
        assert_true(hd_spectrum_std_error(s, col) == hd_spectrum_std_error(s, 39 - col));
        assert_true(hd_spectrum_local(s, col) == -hd_spectrum_local(s, 39 - col));
    }
}

/** One does not know where the other's frame began: what both averaged forgets that like 1 / t. */
TEST(exponents_are_those_of_vectors_carried_each)
{
    const hd_scene_def one = few(HD_EXPONENTS_ALL, P, P),
                       other = few(HD_EXPONENTS_ALL_INDEPENDENT, P, P);
    OWNED(hd_run) *half = finished(one), *whole = finished(other);
    check_same_exponents(half, whole, 4.0 / one.duration);
}

/** Known at reports: all 4N, orthonormal. */
TEST(all_vectors_are_known_where_they_are_measured)
{
    OWNED(hd_run) *run = finished(
        scene_from(few(HD_EXPONENTS_ALL, P, P), .observe = HD_OBSERVE_STEPS | HD_OBSERVE_MODES));
    const hd_columns v = hd_run_vectors_now(run);
    double cosine[40], ratio[40];
    assert_int_equal(v.count, 40);
    for (int a = 0; a < 40; a++)
        for (int b = 0; b <= a; b++) {
            double sum = 0.0;
            for (int row = 0; row < 40; row++)
                sum += v.data[row * v.stride + a] * v.data[row * v.stride + b];
            CHECK_CLOSE(sum, a == b, 1e-5); /* of a measured state, and of isotropy */
        }
    hd_run_dq_dp(run, cosine, ratio);
    for (int col = 0; col < 40; col++) CHECK_CLOSE(cosine[col], -cosine[39 - col], 0.0);
}

static hd_scene_def windowed(int exponents, hd_boundary x, hd_boundary y)
{
    return scene_from(few(exponents, x, y), .observe = HD_OBSERVE_COVARIANT,
                      .covariant_window = 40.0, .covariant_transient = 120.0,
                      .covariant_sampling = 5.0);
}

/** Between an exponent and its neighbours: parts along them are gone like exp(-gap t). */
static double gap(const hd_run *run, int col)
{
    const hd_spectrum *s = hd_run_spectrum(run);
    double least = INFINITY;
    for (int k = col - 1; k <= col + 1; k++)
        if (k >= 0 && k < 40 && k != col)
            least = fmin(least, fabs(hd_spectrum_exponent(s, k) - hd_spectrum_exponent(s, col)));
    return least;
}

/** Spaces do not depend on where frames began: what is left of that is far below rounding, which
 * is 40 eps condition, over a small angle. */
static void check_spaces(hd_run *half, hd_run *whole)
{
    const hd_covariant *one = hd_run_covariant(half), *other = hd_run_covariant(whole);
    const double rounding = 400.0 * DBL_EPSILON * half->carrier.rounding.condition_max;
    const hd_splitting_results a = hd_covariant_read(one).splitting,
                               b = hd_covariant_read(other).splitting;
    const double met = 1e-3; /* exp(-0.08 * 120) = 7e-5, and growth fluctuates */
    int good = 0;
    assert_int_equal(hd_covariant_read(one).windows, 7);
    assert_int_equal(hd_covariant_read(other).windows, 7);
    assert_int_equal(a.samples, b.samples);
    for (hd_pair_of_spaces pair = 0; pair < HD_PAIRS_OF_SPACES; pair++) {
        const hd_angle_of_spaces *found = &a.angle[pair], *want = &b.angle[pair];
        CHECK_CLOSE(found->least, want->least, rounding);
        CHECK_CLOSE(found->mean, want->mean, rounding);
        CHECK_CLOSE(found->mean_of_all, want->mean_of_all, rounding);
    }
    CHECK_CLOSE(hd_covariant_read(one).null_most, 0.0, rounding);
    assert_true(hd_covariant_read(one).start_mismatch.stable < 1e-9);
    for (int col = 0; col < 40; col++) {
        if (gap(half, col) < 0.08) continue;
        good++;
        CHECK_CLOSE(hd_spectrum_exponent(hd_covariant_read(one).spectrum, col),
                    hd_spectrum_exponent(hd_covariant_read(other).spectrum, col), met);
        CHECK_CLOSE(hd_covariant_read(one).widths[col], hd_covariant_read(other).widths[col], met);
    }
    assert_true(good >= 8);
}

TEST(covariant_vectors_are_those_of_vectors_carried_each)
{
    for (int b = 0; b < 4; b++) {
        const hd_boundary x = b & 1 ? R : P, y = b & 2 ? R : P;
        const hd_scene_def one = windowed(HD_EXPONENTS_ALL, x, y),
                           other = windowed(HD_EXPONENTS_ALL_INDEPENDENT, x, y);
        OWNED(hd_run) *half = finished(one), *whole = finished(other);
        check_spaces(half, whole);
    }
}

/** v += part J w of two vectors that do not grow, so that it stays; in the frame's order of rows.
 */
static void disturb(hd_frame *frame, double part)
{
    const size_t stride = (size_t)hd_frame_stride(frame);
    double *v = hd_frame_data(frame) + hd_frame_vectors(frame) - 2;
    for (int row = 0; row < hd_frame_rows(frame); row++) {
        const double turned = row % 4 < 2 ? v[(size_t)(row + 2) * stride + 1]
                                          : -v[(size_t)(row - 2) * stride + 1];
        v[(size_t)row * stride] += part * turned;
    }
}

/** Then the frame is made isotropic again, which the triangle before it knows nothing of. */
TEST(a_window_begins_anew_where_isotropy_is_lost)
{
    const hd_scene_def def = scene_from(windowed(HD_EXPONENTS_ALL, P, P), .accuracy = 1e-10);
    OWNED(hd_run) *run = until(created(def), HD_AVERAGING);
    until_time(run, hd_run_time(run) + 20.0);
    while (run->carrier.record->duration > 0) CHECK_OK(hd_run_advance(run));
    disturb(run->carrier.frame, 1e-4);
    finish(run);
    const double rounding = 400.0 * DBL_EPSILON * run->carrier.rounding.condition_max;
    assert_true(rounding < 1e-6);
    assert_int_equal(hd_covariant_read(hd_run_covariant(run)).windows, 6); /* of 7 */
    CHECK_CLOSE(hd_covariant_read(hd_run_covariant(run)).null_most, 0.0, rounding);
}
