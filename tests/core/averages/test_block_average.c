/** Standard errors of series whose true error is known: first-order autoregressive ones. */
#include "testing.h"

#include "averages/block_average.h"
#include "base/random.h"

enum { SERIES = 2000, WARM_UP = 300 };

/** Root mean square of (mean of the series) / (its estimated error); 1 for an honest error. */
static double spread(double memory, int samples, uint64_t seed)
{
    static double x[SERIES], sample[SERIES], sum[SERIES];
    hd_random random = hd_random_seeded(seed, 0);
    hd_block_average blocks;
    double square = 0.0;
    CHECK_OK(hd_block_average_create(&blocks, SERIES));
    for (int k = 0; k < SERIES; k++) x[k] = sum[k] = 0.0;
    for (int t = -WARM_UP; t < samples; t++) {
        for (int k = 0; k < SERIES; k++) {
            x[k] = memory * x[k] + hd_random_symmetric(&random) + hd_random_symmetric(&random);
            sample[k] = x[k];
            if (t >= 0) sum[k] += x[k] / samples;
        }
        if (t >= 0) hd_block_average_add(&blocks, sample);
    }
    for (int k = 0; k < SERIES; k++)
        square += pow(sum[k] / hd_block_average_std_error(&blocks, k), 2.0);
    hd_block_average_clear(&blocks);
    return sqrt(square / SERIES);
}

/** Whether the series is white, slow (correlation time 4.5 or 20) or anticorrelated. Where it is at
 * least 25 correlation times long; the noise of 8 blocks alone makes the ratio 1.15 (Student's t).
 */
static void errors_see_the_correlation_time(void **state)
{
    (void)state;
    static const struct {
        double memory;
        int samples;
    } cases[] = {{0.0, 64},   {0.0, 500},   {0.0, 4096}, {0.8, 128},  {0.8, 1000}, {0.8, 4096},
                 {0.95, 512}, {0.95, 4096}, {-0.6, 64},  {-0.6, 512}, {-0.6, 4096}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const double ratio = spread(cases[k].memory, cases[k].samples, 17 + k);
        print_message("memory %5.2f, %4d samples: rms deviation %.2f errors\n", cases[k].memory,
                      cases[k].samples, ratio);
        assert_true(ratio > 0.80 && ratio < 1.25);
    }
}

static void few_samples_give_no_error(void **state)
{
    (void)state;
    hd_block_average blocks;
    double sample[1];
    CHECK_OK(hd_block_average_create(&blocks, 1));
    for (int k = 0; k < 15; k++) {
        sample[0] = k % 3;
        hd_block_average_add(&blocks, sample);
        assert_true(hd_block_average_std_error(&blocks, 0) < 0);
    }
    sample[0] = 1.0;
    hd_block_average_add(&blocks, sample);
    assert_true(hd_block_average_std_error(&blocks, 0) > 0);
    hd_block_average_restart(&blocks);
    assert_true(hd_block_average_std_error(&blocks, 0) < 0);
    hd_block_average_clear(&blocks);
}

static void a_constant_has_error_zero(void **state)
{
    (void)state;
    hd_block_average blocks;
    double sample[2];
    CHECK_OK(hd_block_average_create(&blocks, 2));
    for (int k = 0; k < 100; k++) {
        sample[0] = 3.0;
        sample[1] = k % 2 ? 1.0 : -1.0; /* blocks of two agree exactly */
        hd_block_average_add(&blocks, sample);
    }
    CHECK_CLOSE(hd_block_average_std_error(&blocks, 0), 0.0, 0.0);
    assert_true(hd_block_average_std_error(&blocks, 1) >= 0);
    hd_block_average_clear(&blocks);
}

static void means_are_those_of_all_samples(void **state)
{
    (void)state;
    hd_block_average blocks;
    CHECK_OK(hd_block_average_create(&blocks, 2));
    CHECK_CLOSE(hd_block_average_mean(&blocks, 1), 0.0, 0.0);
    for (int k = 1; k <= 37; k++) {
        hd_block_average_add(&blocks, (double[]){k, -2.0});
        CHECK_CLOSE(hd_block_average_mean(&blocks, 0), (k + 1) / 2.0, 1e-14 * k);
        CHECK_CLOSE(hd_block_average_mean(&blocks, 1), -2.0, 0.0);
    }
    hd_block_average_restart(&blocks);
    CHECK_CLOSE(hd_block_average_mean(&blocks, 0), 0.0, 0.0);
    hd_block_average_add(&blocks, (double[]){5.0, 1.0});
    CHECK_CLOSE(hd_block_average_mean(&blocks, 0), 5.0, 0.0);
    hd_block_average_clear(&blocks);
}

/** Of a series +1, -1, ..: single samples have an error, pairs none; 16 pairs need 32 samples. */
static void the_longest_blocks_of_16_are_asked(void **state)
{
    (void)state;
    hd_block_average blocks;
    CHECK_OK(hd_block_average_create(&blocks, 1));
    for (int k = 1; k <= 64; k++) {
        hd_block_average_add(&blocks, (double[]){k % 2 ? 1.0 : -1.0});
        const double error = hd_block_average_long_error(&blocks, 0);
        const double mean = k % 2 ? 1.0 / k : 0.0;
        if (k < 16)
            assert_true(error < 0);
        else if (k < 32)
            CHECK_CLOSE(error, sqrt((1.0 - mean * mean) / (k - 1)), 1e-14);
        else
            CHECK_CLOSE(error, 0.0, 0.0);
    }
    hd_block_average_clear(&blocks);
}

/** Increments of something: white numbers of which each moves on by the next (1), or that only
 * tremble (0). Root mean squares of the deviation of the mean, and of the error stated. */
static void increments(double out[2], double diffusing, int samples, uint64_t seed)
{
    static double before[SERIES], sample[SERIES];
    hd_random random = hd_random_seeded(seed, 0);
    hd_block_average blocks;
    CHECK_OK(hd_block_average_create(&blocks, SERIES));
    for (int k = 0; k < SERIES; k++) before[k] = hd_random_symmetric(&random);
    for (int t = 0; t < samples; t++) {
        for (int k = 0; k < SERIES; k++) {
            const double now = hd_random_symmetric(&random);
            sample[k] = now - (1.0 - diffusing) * before[k];
            before[k] = now;
        }
        hd_block_average_add(&blocks, sample);
    }
    out[0] = out[1] = 0.0;
    for (int k = 0; k < SERIES; k++) {
        out[0] += pow(hd_block_average_mean(&blocks, k), 2.0) / SERIES;
        out[1] += pow(hd_block_average_long_error(&blocks, k), 2.0) / SERIES;
    }
    out[0] = sqrt(out[0]);
    out[1] = sqrt(out[1]);
    hd_block_average_clear(&blocks);
}

/** Numbers of variance 1/3. Diffusing: sqrt(1/3n), and so it is stated. Trembling: the mean is off
 * by sqrt(2/3) / n; stated is sqrt(blocks) of that, which falls like 1/n too. 2000 series know each
 * to 2 %; blocks beyond a whole number of the longest are not asked (samples are powers of two). */
static void long_errors_fall_as_fast_as_the_increments_allow(void **state)
{
    (void)state;
    const double KNOWN_TO = 0.06;
    for (int samples = 64; samples <= 1024; samples *= 4) {
        double got[2];
        increments(got, 1.0, samples, 3);
        const double diffusing = sqrt(1.0 / 3.0 / samples), trembling = sqrt(2.0 / 3.0) / samples;
        CHECK_CLOSE(got[0], diffusing, KNOWN_TO * diffusing);
        CHECK_CLOSE(got[1], diffusing, KNOWN_TO * diffusing);
        increments(got, 0.0, samples, 4);
        CHECK_CLOSE(got[0], trembling, KNOWN_TO * trembling);
        CHECK_CLOSE(got[1], 4.0 * trembling, KNOWN_TO * 4.0 * trembling); /* 16 blocks */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_see_the_correlation_time),
        cmocka_unit_test(few_samples_give_no_error),
        cmocka_unit_test(a_constant_has_error_zero),
        cmocka_unit_test(means_are_those_of_all_samples),
        cmocka_unit_test(the_longest_blocks_of_16_are_asked),
        cmocka_unit_test(long_errors_fall_as_fast_as_the_increments_allow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
