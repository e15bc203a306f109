/** Standard errors of series whose true error is known: first-order autoregressive ones. */
#include "testing.h"

#include "blocks.h"
#include "random.h"

enum { SERIES = 2000, WARM_UP = 300 };

/** Root mean square of (mean of the series) / (its estimated error); 1 for an honest error. */
static double spread(double memory, int samples, uint64_t seed)
{
    static double x[SERIES], sample[SERIES], sum[SERIES];
    hd_random random = hd_random_seeded(seed, 0);
    hd_blocks blocks;
    double square = 0.0;
    CHECK_OK(hd_blocks_create(&blocks, SERIES));
    for (int k = 0; k < SERIES; k++) x[k] = sum[k] = 0.0;
    for (int t = -WARM_UP; t < samples; t++) {
        for (int k = 0; k < SERIES; k++) {
            x[k] = memory * x[k] + hd_random_symmetric(&random) + hd_random_symmetric(&random);
            sample[k] = x[k];
            if (t >= 0) sum[k] += x[k] / samples;
        }
        if (t >= 0) hd_blocks_add(&blocks, sample);
    }
    for (int k = 0; k < SERIES; k++) square += pow(sum[k] / hd_blocks_std_error(&blocks, k), 2.0);
    hd_blocks_clear(&blocks);
    return sqrt(square / SERIES);
}

/** Whether the series is white, slow (correlation time 4.5 or 20) or anticorrelated. Where it is at
 *  least 25 correlation times long; the noise of 8 blocks alone makes the ratio 1.15 (Student's t). */
static void errors_see_the_correlation_time(void **state)
{
    (void)state;
    static const struct { double memory; int samples; } cases[] = {
        {0.0, 64}, {0.0, 500}, {0.0, 4096}, {0.8, 128}, {0.8, 1000}, {0.8, 4096},
        {0.95, 512}, {0.95, 4096}, {-0.6, 64}, {-0.6, 512}, {-0.6, 4096}};
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
    hd_blocks blocks;
    double sample[1];
    CHECK_OK(hd_blocks_create(&blocks, 1));
    for (int k = 0; k < 15; k++) {
        sample[0] = k % 3;
        hd_blocks_add(&blocks, sample);
        assert_true(hd_blocks_std_error(&blocks, 0) < 0);
    }
    sample[0] = 1.0;
    hd_blocks_add(&blocks, sample);
    assert_true(hd_blocks_std_error(&blocks, 0) > 0);
    hd_blocks_restart(&blocks);
    assert_true(hd_blocks_std_error(&blocks, 0) < 0);
    hd_blocks_clear(&blocks);
}

static void a_constant_has_error_zero(void **state)
{
    (void)state;
    hd_blocks blocks;
    double sample[2];
    CHECK_OK(hd_blocks_create(&blocks, 2));
    for (int k = 0; k < 100; k++) {
        sample[0] = 3.0;
        sample[1] = k % 2 ? 1.0 : -1.0; /* blocks of two agree exactly */
        hd_blocks_add(&blocks, sample);
    }
    CHECK_CLOSE(hd_blocks_std_error(&blocks, 0), 0.0, 0.0);
    assert_true(hd_blocks_std_error(&blocks, 1) >= 0);
    hd_blocks_clear(&blocks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_see_the_correlation_time),
        cmocka_unit_test(few_samples_give_no_error),
        cmocka_unit_test(a_constant_has_error_zero),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
