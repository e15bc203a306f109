/** Sums, samples and what is derived from them, on numbers small enough to do by hand. */
#include "testing.h"

TEST(means_are_weighted_by_time)
{
    MADE(hd_spectrum, s, 4, 2, 2, 0.0);
    CHECK_CLOSE(hd_spectrum_exponent(s, 0), 0.0, 0.0);
    hd_spectrum_add(s, (const double[]){2.0, -1.0}, 0.5);
    hd_spectrum_add(s, (const double[]){4.0, 0.0}, 1.5);
    CHECK_CLOSE(hd_spectrum_time(s), 0.0, 0.0); /* the sample has not ended */
    CHECK_CLOSE(hd_spectrum_sample_time(s), 2.0, 0.0);
    hd_spectrum_sample(s);
    CHECK_CLOSE(hd_spectrum_time(s), 2.0, 0.0);
    CHECK_CLOSE(hd_spectrum_sample_time(s), 0.0, 0.0);
    CHECK_CLOSE(hd_spectrum_exponent(s, 0), 3.0, 0.0);
    CHECK_CLOSE(hd_spectrum_exponent(s, 1), -0.5, 0.0);
    CHECK_CLOSE(hd_spectrum_exponent(s, 0), 3.0, 0.0);
    CHECK_CLOSE(hd_spectrum_sum_up(s).ks_entropy, 2.5, 0.0);
    CHECK_CLOSE(hd_spectrum_sum_up(s).pairing_error, -1.0, 0.0);
    assert_true(hd_spectrum_std_error(s, 0) < 0);
    hd_spectrum_add(s, (const double[]){0.5, 1.0}, 2.0);
    hd_spectrum_add(s, (const double[]){0.5, 0.0}, 0.0); /* another norm at the same time */
    hd_spectrum_sample(s);
    CHECK_CLOSE(hd_spectrum_exponent(s, 0), 7.0 / 4.0, 0.0);
    hd_spectrum_add(s, (const double[]){100.0, 100.0}, 1.0); /* a sample that does not end */
    hd_spectrum_clear(s);
    CHECK_CLOSE(hd_spectrum_time(s) + hd_spectrum_exponent(s, 0), 0.0, 0.0);
    hd_spectrum_add(s, (const double[]){3.0, 1.0}, 0.5);
    hd_spectrum_sample(s);
    CHECK_CLOSE(hd_spectrum_exponent(s, 0), 6.0, 0.0);
}

static void expect_no_local(const hd_spectrum *s)
{
    CHECK_CLOSE(hd_spectrum_sum_up(s).local_time, 0.0, 0.0);
    for (int col = 0; col < 2; col++) assert_true(isnan(hd_spectrum_local(s, col)));
}

/** Each sample is told once, together with those that have ended since the last time. */
TEST(local_exponents_are_of_the_samples_since)
{
    MADE(hd_spectrum, s, 4, 2, 2, 0.0);
    hd_spectrum_add(s, (const double[]){6.0, -1.0}, 2.0);
    expect_no_local(s); /* no sample has ended */
    hd_spectrum_sample(s);
    CHECK_CLOSE(hd_spectrum_local(s, 0), 3.0, 0.0);
    CHECK_CLOSE(hd_spectrum_local(s, 1), -0.5, 0.0);
    CHECK_CLOSE(hd_spectrum_sum_up(s).local_time, 2.0, 0.0);
    hd_spectrum_local_restart(s);
    hd_spectrum_add(s, (const double[]){1.0, 1.0}, 2.0);
    expect_no_local(s);
    hd_spectrum_sample(s);
    hd_spectrum_add(s, (const double[]){4.0, 1.0}, 0.5);
    hd_spectrum_sample(s);
    CHECK_CLOSE(hd_spectrum_local(s, 0), 2.0, 0.0);
    CHECK_CLOSE(hd_spectrum_sum_up(s).local_time, 2.5, 0.0);
    hd_spectrum_clear(s);
    expect_no_local(s);
}

TEST(all_exponents_show_the_pairing_error)
{
    MADE(hd_spectrum, s, 4, 4, 2, 0.0);
    hd_spectrum_add(s, (const double[]){3.0, 1.0, -1.25, -3.0}, 1.0);
    hd_spectrum_sample(s);
    CHECK_CLOSE(hd_spectrum_sum_up(s).pairing_error, 0.25, 0.0);
    CHECK_CLOSE(hd_spectrum_sum_up(s).ks_entropy, 4.0, 0.0);
}

/** Whether some of the others computed too are above 0 by chance: the sum is that of a run which
 * computes the positive ones alone, and so is its error. */
TEST(the_entropy_is_a_sum_by_number)
{
    MADE(hd_spectrum, all, 8, 8, 2, 0.0);
    MADE(hd_spectrum, half, 8, 2, 2, 0.0);
    MADE(hd_spectrum, first, 8, 1, 2, 0.0);
    for (int k = 0; k < 64; k++) {
        const double x = (k * 37 % 64) / 64.0, y = 0.01 * ((k * 23 % 64) / 64.0 - 0.6), z = 0.02;
        const double log_stretch[] = {3.0 + x, y, z, z, -z, -z, -y, -3.0 - x};
        hd_spectrum *const of[] = {all, half, first};
        for (int s = 0; s < 3; s++) {
            hd_spectrum_add(of[s], log_stretch, 1.0);
            hd_spectrum_sample(of[s]);
        }
    }
    const hd_spectrum_sums some = hd_spectrum_sum_up(half), every = hd_spectrum_sum_up(all);
    assert_true(hd_spectrum_exponent(all, 1) < 0 && some.ks_entropy_error > 0);
    CHECK_CLOSE(some.ks_entropy, hd_spectrum_exponent(all, 0) + hd_spectrum_exponent(all, 1),
                1e-14);
    CHECK_CLOSE(every.ks_entropy, some.ks_entropy, 0.0);
    CHECK_CLOSE(every.ks_entropy_error, some.ks_entropy_error, 0.0);
    CHECK_CLOSE(hd_spectrum_sum_up(first).ks_entropy, hd_spectrum_exponent(all, 0), 0.0);
}

/** Alternating series: mean and naive error known; the error must shrink, not the mean. */
TEST(the_error_is_that_of_the_samples)
{
    MADE(hd_spectrum, s, 4, 1, 2, 0.0);
    for (int k = 0; k < 64; k++) { /* de Bruijn-like: no memory at any length */
        const double x = (k * 37 % 64) / 64.0;
        hd_spectrum_add(s, &x, 0.5);
        hd_spectrum_sample(s);
    }
    CHECK_CLOSE(hd_spectrum_exponent(s, 0), 63.0 / 64.0, 1e-14);
    assert_true(hd_spectrum_std_error(s, 0) > 0 && hd_spectrum_std_error(s, 0) < 0.2);
}

/** 64 samples of 0.5 that fluctuate about these means. */
static void fill(hd_spectrum *s, const double mean[2])
{
    for (int k = 0; k < 64; k++) {
        const double off = 0.1 * ((k * 37 % 64) / 63.0 - 0.5);
        hd_spectrum_add(s, (const double[]){0.5 * (mean[0] + off), 0.5 * (mean[1] + off)}, 0.5);
        hd_spectrum_sample(s);
    }
}

/** ln(1 + 9) - 0.1 * 9 as it begins, more than ln(1 + 41) - 0.1 * 41 as it ends; and -0.01 at its
 * end. A zero mode is far behind an exponent of 1. What was clear of them has no such part. */
TEST(zero_modes_may_have_the_place_of_a_small_exponent)
{
    const struct {
        double exponent, age, bias;
    } cases[] = {{0.1, 9.0, (log(10.0) - 0.9) / 32.0},
                 {-0.01, 9.0, (log(42.0) - 0.41) / 32.0},
                 {0.0, 0.0, log(33.0) / 32.0},
                 {1.0, 9.0, 0.0}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        MADE(hd_spectrum, plain, 4, 2, 2, 0.0);
        MADE(hd_spectrum, s, 4, 2, 2, 0.0);
        const double mean[2] = {2.0, cases[k].exponent};
        const hd_part sum[2] = {{0, 3.0}, {1, -2.0}};
        hd_spectrum_begin(s, cases[k].age);
        fill(plain, mean);
        assert_true(hd_spectrum_std_error(s, 1) < 0); /* not known remains so */
        fill(s, mean);
        CHECK_CLOSE(hd_spectrum_std_error(s, 0), hd_spectrum_std_error(plain, 0), 1e-15);
        CHECK_CLOSE(hd_spectrum_std_error(s, 1),
                    hypot(hd_spectrum_std_error(plain, 1), cases[k].bias), 1e-9);
        CHECK_CLOSE(hd_spectrum_error_of_sum(s, sum, 2),
                    hypot(hd_spectrum_error_of_sum(plain, sum, 2), 2.0 * cases[k].bias), 1e-9);
        hd_spectrum_clear(s);
        fill(s, mean);
        CHECK_CLOSE(hd_spectrum_std_error(s, 1), hd_spectrum_std_error(plain, 1), 0.0);
    }
}

static void expect_signs(const hd_spectrum *s, int zero, int positive, int vanish)
{
    const hd_signs signs = hd_spectrum_signs(s, zero);
    assert_int_equal(signs.positive, positive);
    assert_int_equal(signs.zero, vanish);
}

/** Where theory says how many vanish, by value; else by 4 errors, at most 4 * .001 sqrt(2/3) / 8
 * = 4e-4. */
TEST(signs_are_counted_without_pairs)
{
    MADE(hd_spectrum, s, 6, 6, 6, 0.0);
    expect_signs(s, 2, 0, 0);
    for (int k = 0; k < 63; k++) {
        const double off = 0.001 * (k % 3 - 1);
        hd_spectrum_add(s,
                        (const double[]){0.5 + off, 0.002 + off, 0.0002 + off, -0.0001 + off,
                                         -0.3 + off, -0.7 + off},
                        1.0);
        hd_spectrum_sample(s);
        if (k == 3) expect_signs(s, -1, 0, 0); /* errors are not known */
    }
    expect_signs(s, 2, 2, 2);
    expect_signs(s, 3, 1, 3);
    expect_signs(s, 0, 3, 0);
    expect_signs(s, 6, 0, 0); /* no others are computed */
    expect_signs(s, -1, 2, 2);
    CHECK_CLOSE(hd_spectrum_sum_up(s).exponent_sum, 0.5021 - 1.0, 1e-12);
    CHECK_CLOSE(hd_spectrum_sum_up(s).pairing_error, -1.0, 0.0);
    CHECK_CLOSE(hd_spectrum_sum_up(s).ks_entropy, 0.5022, 1e-12);
}

/** Samples of these exponents, from the age 10 to 74. */
static void carry(hd_spectrum *s, const double exponents[6])
{
    hd_spectrum_begin(s, 10.0);
    for (int k = 0; k < 64; k++) {
        hd_spectrum_add(s, exponents, 1.0);
        hd_spectrum_sample(s);
    }
}

/** A zero mode has grown by up to ln(1 + 74) = 4.3, an exponent of .058; and of six vectors out of
 * twelve none need be zero modes. */
TEST(what_may_be_zero_modes_is_counted_with_them)
{
    static const double damped[] = {0.5, 0.001, 0.0002, -0.057, -0.3, -0.7},
                        fast[] = {0.5, 0.001, 0.0002, -0.060, -0.3, -0.7},
                        slow[] = {0.5, 0.057, 0.0002, -0.001, -0.3, -0.7},
                        above[] = {0.9, 0.8, 0.7, 0.6, 0.5, 0.4};
    MADE(hd_spectrum, s, 6, 6, 6, 0.0);
    MADE(hd_spectrum, half, 12, 6, 12, 0.0);
    carry(s, damped);
    expect_signs(s, 2, 1, 3);
    carry(s, fast);
    expect_signs(s, 2, 1, 2);
    carry(s, slow);
    expect_signs(s, 2, 1, 3);
    carry(half, above);
    expect_signs(half, 2, 6, 0);
    carry(half, damped);
    expect_signs(half, 2, 1, 3);
}

/** Zero variance: the error is zero, or not known while there are too few samples. */
TEST(constant_series_have_no_error)
{
    static const double values[] = {0.0, 1.0, -3.7, 1e-300, 1e-12, 1e12};
    enum { SERIES = sizeof values / sizeof *values };
    MADE(hd_spectrum, spectrum, 8, SERIES, 4, 0.0);
    for (int samples = 1; samples <= 300; samples++) {
        hd_spectrum_add(spectrum, values, 1.0);
        hd_spectrum_sample(spectrum);
        for (int col = 0; col < SERIES; col++) {
            const double rounding = DBL_EPSILON * fabs(values[col]);
            CHECK_CLOSE(hd_spectrum_std_error(spectrum, col),
                        samples < HD_SPECTRUM_BLOCKS_MIN ? -1.0 : 0.0, rounding);
            CHECK_CLOSE(hd_spectrum_exponent(spectrum, col), values[col], samples * rounding);
        }
    }
}
