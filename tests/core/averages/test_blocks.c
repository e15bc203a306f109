/** Standard errors of series whose true error is known, alone and in sums. */
#include "testing.h"
#include "averages/blocks.h"
#include "base/random.h"

enum { SERIES = 2000, WARM_UP = 300 };
/** Sums of a few hundred numbers near 1. */
static const double ROUNDING = 1e-12;

static double white(hd_random *random)
{
    return hd_random_symmetric(random) + hd_random_symmetric(random);
}

static double error_of(const hd_blocks *blocks, int series)
{
    return hd_blocks_error(blocks, &(hd_part){series, 1.0}, 1);
}

/* ---- memory -------------------------------------------------------------------------------- */

typedef struct verdict {
    double spread; /**< root mean square of (mean of the series) / (its estimated error) */
    double known;  /**< part of the series that state an error */
} verdict;

/** Of SERIES first-order autoregressive series. */
static verdict judge(double memory, int samples, uint64_t seed)
{
    static double x[SERIES], sum[SERIES];
    hd_random random = hd_random_seeded(seed, 0);
    hd_blocks blocks;
    double square = 0.0, known = 0.0;
    CHECK_OK(hd_blocks_create(&blocks, SERIES, 0.0));
    for (int k = 0; k < SERIES; k++) x[k] = sum[k] = 0.0;
    for (int t = -WARM_UP; t < samples; t++) {
        for (int k = 0; k < SERIES; k++) {
            x[k] = memory * x[k] + white(&random);
            if (t >= 0) sum[k] += x[k] / samples;
        }
        if (t >= 0) hd_blocks_add(&blocks, x, 1.0);
    }
    for (int k = 0; k < SERIES; k++) {
        const double error = error_of(&blocks, k);
        if (error < 0) continue;
        known += 1.0 / SERIES;
        square += pow(sum[k] / error, 2.0) / SERIES;
    }
    hd_blocks_clear(&blocks);
    return (verdict){sqrt(square / known), known};
}

/** Whether the series is white, slow (correlation time 1.5, 4.5 or 20) or anticorrelated; where it
 * is at least 13 independent numbers long. The noise of 16 blocks alone makes the ratio 1.07. */
TEST(errors_see_the_memory)
{
    static const struct {
        double memory;
        int samples;
    } cases[] = {{0.0, 20},    {0.0, 64},   {0.0, 500},   {0.0, 4096}, {0.3, 100},
                 {0.5, 64},    {0.8, 128},  {0.8, 1000},  {0.8, 4096}, {0.95, 512},
                 {0.95, 4096}, {-0.6, 512}, {-0.6, 4096}, {-0.9, 4096}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const verdict v = judge(cases[k].memory, cases[k].samples, 17 + k);
        CHECK_WITHIN(v.spread, 0.80, 1.25);
        CHECK_WITHIN(v.known, 0.75, 1.0 + 1e-9);
    }
}

/** Increments of something: white numbers of which each moves on by the next (1), or that only
 * tremble (0). Root mean squares of the deviation of the mean, and of the error stated. */
static void increments(double out[2], double diffusing, int samples, uint64_t seed)
{
    static double before[SERIES], sample[SERIES], sum[SERIES];
    hd_random random = hd_random_seeded(seed, 0);
    hd_blocks blocks;
    CHECK_OK(hd_blocks_create(&blocks, SERIES, 0.0));
    for (int k = 0; k < SERIES; k++) before[k] = hd_random_symmetric(&random), sum[k] = 0.0;
    for (int t = 0; t < samples; t++) {
        for (int k = 0; k < SERIES; k++) {
            const double now = hd_random_symmetric(&random);
            sample[k] = now - (1.0 - diffusing) * before[k];
            sum[k] += sample[k] / samples;
            before[k] = now;
        }
        hd_blocks_add(&blocks, sample, 1.0);
    }
    out[0] = out[1] = 0.0;
    for (int k = 0; k < SERIES; k++) {
        out[0] += pow(sum[k], 2.0) / SERIES;
        out[1] += pow(error_of(&blocks, k), 2.0) / SERIES;
    }
    out[0] = sqrt(out[0]);
    out[1] = sqrt(out[1]);
    hd_blocks_clear(&blocks);
}

/** Numbers of variance 1/3. Diffusing: sqrt(1/3n), and so it is stated. Trembling: the mean is off
 * by sqrt(2/3) / n; stated is, from 24 to 47 blocks, 4 to 7 times that, as [T8] says. */
TEST(errors_of_what_only_trembles_are_too_large)
{
    const double KNOWN_TO = 0.06; /* 2000 series know each to 2 % */
    for (int samples = 256; samples <= 4096; samples *= 4) {
        double got[2];
        increments(got, 1.0, samples, 3);
        const double diffusing = sqrt(1.0 / 3.0 / samples), trembling = sqrt(2.0 / 3.0) / samples;
        CHECK_CLOSE(got[0], diffusing, KNOWN_TO * diffusing);
        CHECK_CLOSE(got[1], diffusing, KNOWN_TO * diffusing);
        increments(got, 0.0, samples, 4);
        CHECK_CLOSE(got[0], trembling, KNOWN_TO * trembling);
        assert_true(got[1] > 4.5 * trembling && got[1] < 7.5 * trembling);
    }
}

/** Numbers of variance 1/3 of which each takes the one before away: a sum has variance 2/3, however
 * long its block, memory is -1/2, and a quarter of the variance is left, half of the error. */
TEST(errors_of_turns_know_what_trembles)
{
    enum { SAMPLES = 1000, REPEATS = 400 };
    const double KNOWN_TO =
        0.1; /* memory is known to 1/4 in each repeat; what is beyond its least is cut off */
    hd_random random = hd_random_seeded(11, 0);
    double stated = 0.0, blocks_left = 0.0;
    for (int k = 0; k < REPEATS; k++) {
        hd_blocks blocks;
        double before = 0.0;
        CHECK_OK(hd_blocks_create(&blocks, 1, 0.0));
        for (int t = 0; t < SAMPLES; t++) {
            const double now = hd_random_symmetric(&random);
            hd_blocks_add(&blocks, &(double){now - before}, 1.0);
            before = now;
        }
        stated += hd_blocks_error_of_turns(&blocks) / REPEATS;
        blocks_left = blocks.count;
        hd_blocks_clear(&blocks);
    }
    while (blocks_left >= 2 * HD_SPECTRUM_BLOCKS_MIN) blocks_left = floor(blocks_left / 2.0);
    const double want = 0.5 * sqrt(blocks_left * 2.0 / 3.0) / SAMPLES;
    CHECK_CLOSE(stated / want, 1.0, KNOWN_TO);
}

/** Samples are not laid out for blocks: a little less than the least weight is one. */
TEST(nearly_a_block_is_one)
{
    hd_blocks blocks;
    CHECK_OK(hd_blocks_create(&blocks, 1, 2.0));
    for (int k = 0; k < HD_SPECTRUM_BLOCKS_MIN; k++)
        hd_blocks_add(&blocks, &(double){k % 3}, 0.93 * 2.0);
    assert_int_equal(blocks.count, HD_SPECTRUM_BLOCKS_MIN);
    hd_blocks_clear(&blocks);
}

/** Turns 0, 1, .. 15, each of which says what the next one will be: that does not count. */
TEST(errors_of_turns_know_nothing_else)
{
    enum { SAMPLES = HD_SPECTRUM_BLOCKS_MIN };
    const double n = SAMPLES, squares = n * (n * n - 1.0) / 12.0;
    hd_blocks blocks;
    CHECK_OK(hd_blocks_create(&blocks, 1, 0.0));
    for (int k = 0; k < SAMPLES; k++) hd_blocks_add(&blocks, &(double){k}, 1.0);
    CHECK_CLOSE(hd_blocks_error_of_turns(&blocks), sqrt(squares * n / (n - 1.0)) / n, ROUNDING);
    hd_blocks_clear(&blocks);
}

/* ---- what is known ------------------------------------------------------------------------- */

TEST(few_samples_give_no_error)
{
    hd_blocks blocks;
    CHECK_OK(hd_blocks_create(&blocks, 1, 0.0));
    for (int k = 0; k < HD_SPECTRUM_BLOCKS_MIN - 1; k++) {
        hd_blocks_add(&blocks, &(double){k % 3}, 1.0);
        CHECK_CLOSE(error_of(&blocks, 0), -1.0, 0.0);
    }
    hd_blocks_add(&blocks, &(double){1.0}, 1.0);
    assert_true(error_of(&blocks, 0) > 0);
    hd_blocks_restart(&blocks);
    CHECK_CLOSE(error_of(&blocks, 0), -1.0, 0.0);
    hd_blocks_clear(&blocks);
}

/** Blocks that have grown long are as short as the first ones again: errors are known as soon. */
TEST(a_restart_begins_with_short_blocks)
{
    hd_blocks blocks;
    CHECK_OK(hd_blocks_create(&blocks, 1, 2.0));
    for (int k = 0; k < 100 * HD_BLOCKS_MAX; k++) hd_blocks_add(&blocks, &(double){k % 3}, 1.0);
    assert_true(blocks.length > 2.0);
    hd_blocks_restart(&blocks);
    for (int k = 0; k < 2 * HD_SPECTRUM_BLOCKS_MIN; k++)
        hd_blocks_add(&blocks, &(double){k % 3}, 1.0);
    CHECK_CLOSE(blocks.length, 2.0, 0.0);
    assert_true(error_of(&blocks, 0) > 0);
    hd_blocks_clear(&blocks);
}

/** A first sample that is cut short, by a report, makes its block longer, but not all others. */
TEST(an_odd_first_sample_lengthens_no_other_block)
{
    hd_blocks blocks;
    CHECK_OK(hd_blocks_create(&blocks, 1, 1.0));
    hd_blocks_add(&blocks, &(double){1.0}, 0.8);
    for (int k = 0; k < HD_SPECTRUM_BLOCKS_MIN; k++) hd_blocks_add(&blocks, &(double){k % 3}, 1.0);
    assert_int_equal(blocks.count, HD_SPECTRUM_BLOCKS_MIN);
    CHECK_CLOSE(blocks.weight[0], 1.8, 1e-12);
    hd_blocks_clear(&blocks);
}

/** A ramp: each block says what the next one will be. */
TEST(a_memory_as_long_as_the_series_gives_no_error)
{
    for (int samples = 16; samples < 1000; samples += 61) {
        hd_blocks blocks;
        CHECK_OK(hd_blocks_create(&blocks, 1, 0.0));
        for (int k = 0; k < samples; k++) hd_blocks_add(&blocks, &(double){k}, 1.0);
        CHECK_CLOSE(error_of(&blocks, 0), -1.0, 0.0);
        hd_blocks_clear(&blocks);
    }
}

/** Of 16 blocks two waves are remembered too well, by 0.9 of each, three by 0.5. */
TEST(blocks_that_remember_much_give_no_error)
{
    for (int waves = 2; waves <= 3; waves++) {
        double x[HD_SPECTRUM_BLOCKS_MIN];
        for (int k = 0; k < HD_SPECTRUM_BLOCKS_MIN; k++)
            x[k] = cos(2.0 * PI * waves * (k + 0.5) / HD_SPECTRUM_BLOCKS_MIN);
        const double error = hd_deviations_error(x, HD_SPECTRUM_BLOCKS_MIN, 0.0);
        assert_true(waves == 2 ? error == -1.0 : error > 0);
    }
}

/** In few blocks and in many: unknown is something else. */
TEST(what_is_no_number_has_no_error)
{
    for (int samples = 20; samples <= 200; samples += 90) {
        hd_blocks blocks;
        CHECK_OK(hd_blocks_create(&blocks, 1, 0.0));
        for (int k = 0; k < samples; k++)
            hd_blocks_add(&blocks, &(double){k == 7 ? NAN : 1.0}, 1.0);
        assert_true(isnan(error_of(&blocks, 0)));
        assert_true(isnan(hd_blocks_error_of_turns(&blocks)));
        hd_blocks_clear(&blocks);
    }
}

/* ---- sums ---------------------------------------------------------------------------------- */

/** x; y = -x; z, as large and on its own: what is added up knows what goes together. */
TEST(sums_know_what_goes_together)
{
    enum { SAMPLES = 96 * 64 + 1 }; /* 48 blocks and a sample */
    static const struct {
        hd_part part[3];
        double of_white; /**< error in those of one white series */
    } sums[] = {{{{0, 1.0}, {1, 1.0}, {2, 0.0}}, 0.0},
                {{{0, 1.0}, {1, -1.0}, {2, 0.0}}, 2.0},
                {{{0, 1.0}, {1, 0.0}, {2, 1.0}}, M_SQRT2},
                {{{0, 0.5}, {1, -0.5}, {2, 2.0}}, 2.2360679774997897}};
    hd_random random = hd_random_seeded(5, 0);
    hd_blocks blocks;
    CHECK_OK(hd_blocks_create(&blocks, 3, 0.0));
    for (int k = 0; k < SAMPLES; k++) {
        const double x = white(&random), z = white(&random);
        hd_blocks_add(&blocks, (double[]){x, -x, z}, 0.25);
    }
    const double one = sqrt(2.0 / 3.0 / SAMPLES) / 0.25; /* per weight */
    for (size_t k = 0; k < sizeof sums / sizeof *sums; k++)
        CHECK_CLOSE(hd_blocks_error(&blocks, sums[k].part, 3), sums[k].of_white * one,
                    ROUNDING + 0.25 * sums[k].of_white * one); /* 48 blocks: 10 % */
    hd_blocks_clear(&blocks);
}

/** Samples of different weights: a mean per weight of exactly 2 has no error. */
TEST(means_are_per_weight)
{
    hd_blocks blocks;
    CHECK_OK(hd_blocks_create(&blocks, 1, 0.0));
    for (int k = 0; k < 77; k++) {
        const double weight = 1.0 + k % 5 + (k > 40 ? 3.0 : 0.0);
        hd_blocks_add(&blocks, &(double){2.0 * weight}, weight);
    }
    CHECK_CLOSE(error_of(&blocks, 0), 0.0, ROUNDING);
    hd_blocks_clear(&blocks);
}

/* ---- blocks -------------------------------------------------------------------------------- */

/** They hold everything but for the block that is being filled, and are equally long. */
TEST(blocks_hold_the_whole_history)
{
    hd_blocks blocks;
    CHECK_OK(hd_blocks_create(&blocks, 1, 2.5));
    int most = 0;
    for (int k = 1; k <= 5000; k++) {
        hd_blocks_add(&blocks, &(double){k}, 1.0);
        double sum = 0.0, weight = 0.0;
        for (int b = 0; b < blocks.count; b++) {
            sum += hd_blocks_sum(&blocks, b)[0];
            weight += blocks.weight[b];
            CHECK_CLOSE(blocks.weight[b], blocks.weight[0], 0.0);
            CHECK_CLOSE(blocks.weight[b], fmax(blocks.length, 3.0), 0.0); /* 3 samples at least */
        }
        CHECK_CLOSE(sum, weight * (weight + 1.0) / 2.0, 0.0);
        assert_true(k - weight < blocks.length || blocks.count == 0);
        assert_true(k < 3 * 48 || blocks.count >= 48);
        if (blocks.count > most) most = blocks.count;
    }
    assert_int_equal(most, HD_BLOCKS_MAX - 1);
    hd_blocks_clear(&blocks);
}

TEST(a_series_can_be_forgotten)
{
    hd_blocks blocks;
    CHECK_OK(hd_blocks_create(&blocks, 2, 2.0));
    for (int k = 0; k < 21; k++) hd_blocks_add(&blocks, (double[]){k, 1.0}, 1.0);
    hd_blocks_forget(&blocks, 0);
    hd_blocks_add(&blocks, (double[]){0.0, 1.0}, 1.0); /* the end of a block that had begun */
    assert_int_equal(blocks.count, 11);
    for (int k = 0; k < blocks.count; k++) {
        CHECK_CLOSE(hd_blocks_sum(&blocks, k)[0], 0.0, 0.0);
        CHECK_CLOSE(hd_blocks_sum(&blocks, k)[1], 2.0, 0.0);
    }
    hd_blocks_clear(&blocks);
}
