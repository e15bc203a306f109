/** Whole runs of disks of two kinds: the spectrum of a reference, zeros for each boundary, steps in
 * a long box, and two kinds that are alike. */
#include "runs.h"

static hd_scene_def mixture(hd_scene_def def, double fraction, double diameter, double mass)
{
    return with_second(scene_from(def, .equilibration = 50.0, .threads = 1), fraction, diameter,
                       mass);
}

/** By a program that shares nothing with the core: O(N^2) events, plain coordinates, Gram-Schmidt;
 * values and standard errors of the rate of all pairs, and of the nine exponents that are positive
 * (six of 24 vanish). */
typedef struct known {
    double mass, rate[2], exponent[9][2];
} known;

static const known of_a_mixture = {3.0,
                                   {5.255, 0.006},
                                   {{2.0598, 0.0019},
                                    {1.6768, 0.0019},
                                    {1.3931, 0.0022},
                                    {1.1856, 0.0018},
                                    {1.0301, 0.0014},
                                    {0.9047, 0.0013},
                                    {0.7976, 0.0014},
                                    {0.7088, 0.0014},
                                    {0.6330, 0.0015}}};

/** 2e6 time units. Three light disks among three that are 1000 times as heavy: five exponents of
 * light ones, as many as they have free momenta in the frame of the others, less the energy, and
 * four of heavy ones. */
static const known of_a_bath = {1000.0,
                                {3.979, 0.0045},
                                {{2.2497, 0.0025},
                                 {1.6100, 0.0018},
                                 {1.1919, 0.0014},
                                 {0.8991, 0.0011},
                                 {0.6685, 0.0008},
                                 {0.06279, 0.00005},
                                 {0.05589, 0.00006},
                                 {0.05098, 0.00005},
                                 {0.04712, 0.00005}}};

/** rate_error: of collisions of a run; largest: relative error of an exponent. */
static void expect_known(const known *want, double rate_error, double largest)
{
    OWNED(hd_run) *run = finished(
        mixture(scene(.number = 6, .density = 0.3, .aspect = 1.0, .duration = 1e5, .seed = 4), 0.5,
                1.3, want->mass));
    const hd_totals totals = hd_trajectory_totals(hd_run_trajectory(run));
    assert_int_equal(hd_run_vectors(run), 9);
    for (int col = 0; col < 9; col++) {
        const double *value = want->exponent[col];
        const double error = hd_spectrum_std_error(hd_run_spectrum(run), col);
        CHECK_WITHIN(error, 0.0, largest * value[0]);
        CHECK_CLOSE(hd_spectrum_exponent(hd_run_spectrum(run), col), value[0],
                    4.0 * hypot(error, value[1]));
    }
    CHECK_CLOSE((double)totals.collisions / totals.time, want->rate[0],
                4.0 * hypot(want->rate[1], rate_error));
}

/** 5e5 collisions, each known as well as one of two independent ones at the most: 0.0075. */
TEST(the_spectrum_is_that_of_another_program) { expect_known(&of_a_mixture, 0.0075, 0.004); }

/** The energy of the light ones, and with it all rates, changes slowly: the other program's error
 * of the rate in a time 20 times as short. */
TEST(light_ones_among_heavy_ones) { expect_known(&of_a_bath, 0.02, 0.01); }

/** All carried by themselves: the volume stays, opposite ones add up to what the random start
 * leaves over the time, and zeros fall as ln(T) / T. */
static void expect_zeros(hd_scene_def def, int zeros)
{
    const double duration = 2000.0;
    OWNED(hd_run) *run = finished(scene_from(mixture(def, 0.5, 1.3, 3),
                                             .exponents = HD_EXPONENTS_ALL_INDEPENDENT,
                                             .warmup = 100.0, .duration = duration));
    const hd_spectrum *s = hd_run_spectrum(run);
    const int all = 4 * def.number;
    double volume = 0.0;
    for (int col = 0; col < all; col++) {
        const double exponent = hd_spectrum_exponent(s, col),
                     opposite = hd_spectrum_exponent(s, all - 1 - col);
        const bool vanishes = col >= (all - zeros) / 2 && col < (all + zeros) / 2;
        volume += exponent;
        CHECK_CLOSE(exponent + opposite, 0.0, 60.0 / duration);
        if (vanishes)
            CHECK_CLOSE(exponent, 0.0, 2.0 * log(duration) / duration);
        else
            CHECK_WITHIN(fabs(exponent), 0.05, 10.0);
    }
    CHECK_CLOSE(volume, 0.0, all * 1e-8);
}

TEST(zeros_of_each_boundary)
{
    expect_zeros(scene_of(6, 0.3, 1.0, P, P, 5), 6);
    expect_zeros(scene_of(6, 0.3, 1.0, R, P, 5), 4);
    expect_zeros(scene_of(6, 0.3, 1.0, R, R, 5), 2);
    expect_zeros(scene(.container = HD_CIRCLE, .number = 6, .density = 0.3, .seed = 5), 4);
}

static const hd_step *longest(const hd_run *run, hd_mode_kind kind)
{
    const hd_steps *steps = hd_run_steps(run);
    return hd_steps_step(steps, hd_steps_lowest(steps, kind));
}

/** T(0,1) with two and LP(0,1) with four exponents, and a gap above them; their weights add up to
 * 4.8 (4.4 of disks of one kind). Fields that were not weighted by the roots of the masses 1 and 10
 * would have ((1 + sqrt 10) / 2)^2 / 5.5 = 0.79 of that. */
TEST(steps_of_a_long_box)
{
    OWNED(hd_run) *run = finished(
        mixture(scene(.number = 64, .density = 0.4, .aspect = 8.0, .observe = HD_OBSERVE_STEPS,
                      .warmup = 300.0, .duration = 3000.0, .seed = 3),
                0.5, 0.8, 10.0));
    const hd_spectrum *s = hd_run_spectrum(run);
    const int n = hd_run_vectors(run);
    const hd_step *t = longest(run, HD_MODE_T), *lp = longest(run, HD_MODE_LP);
    assert_true(n == 125 && t->resolved && lp->resolved);
    assert_int_equal(t->expected, 2);
    assert_int_equal(lp->expected, 4);
    assert_true(t->col >= n - 6 && lp->col >= n - 6);
    CHECK_WITHIN(t->multiplicity + lp->multiplicity, 4.5, 6.0);
    assert_true(hd_spectrum_exponent(s, n - 7) > 1.7 * hd_spectrum_exponent(s, n - 6));
    assert_true(hd_spectrum_exponent(s, n - 6) < 1.3 * hd_spectrum_exponent(s, n - 1));
}

/** A second kind that is as the first, which another code moves from another start. */
TEST(kinds_that_are_alike)
{
    const hd_scene_def one = scene(.number = 10, .density = 0.5, .aspect = 1.0,
                                   .equilibration = 50.0, .threads = 1, .duration = 2e4, .seed = 6);
    OWNED(hd_run) *alike = finished(one), *two = finished(with_second(one, 0.5, 1.0, 1.0));
    assert_int_equal(hd_run_vectors(alike), hd_run_vectors(two));
    for (int col = 0; col < hd_run_vectors(alike); col++) {
        const hd_spectrum *a = hd_run_spectrum(alike), *b = hd_run_spectrum(two);
        const double error = hypot(hd_spectrum_std_error(a, col), hd_spectrum_std_error(b, col));
        CHECK_CLOSE(hd_spectrum_exponent(a, col), hd_spectrum_exponent(b, col), 4.0 * error);
        assert_true(error < 0.02);
    }
}
