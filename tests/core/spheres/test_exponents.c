/** Exponents of spheres: against the tangent dynamics in extended precision, and what must hold of
 * them exactly. */
#include "exact.h"
#include "runs.h"

static hd_scene_def few(int disks, int walls, int exponents, double duration)
{
    return scene_from(spheres_of(disks, 0.4, 0.9, 1.2, walls, 5), .exponents = exponents,
                      .equilibration = 20.0, .warmup = 20.0, .duration = duration, .threads = 1);
}

/** Each within the accuracy that was asked for; all of them, and those that follow from half. */
TEST(exponents_are_those_of_extended_precision)
{
    static const int kinds[] = {HD_EXPONENTS_ALL_INDEPENDENT, HD_EXPONENTS_ALL,
                                HD_EXPONENTS_POSITIVE};
    for (int k = 0; k < 3; k++)
        for (int disks = 2; disks <= 4; disks += 2)
            for (int walls = 0; walls < 8; walls += 7) {
                const hd_scene_def def = few(disks, walls, kinds[k], HD_SANITIZED ? 10.0 : 60.0);
                double want[24];
                OWNED(hd_run) *run = finished(def);
                const hd_spectrum *spectrum = hd_run_spectrum(run);
                exact_spectrum(&def, want);
                assert_true(want[0] > 0.1);
                for (int col = 0; col < hd_run_vectors(run); col++)
                    CHECK_CLOSE(hd_spectrum_exponent(spectrum, col), want[col], def.accuracy);
            }
}

/** lambda_l = -lambda_(6N + 1 - l), each carried by itself: finite times leave a number of order 1
 * over them, the starts' share. Volume is kept: all of them add up to nothing, but for rounding. */
TEST(opposite_exponents_and_their_sum)
{
    for (int walls = 0; walls < 8; walls += 7) {
        const hd_scene_def def = few(8, walls, HD_EXPONENTS_ALL_INDEPENDENT, 1000.0);
        OWNED(hd_run) *run = finished(def);
        const hd_spectrum *spectrum = hd_run_spectrum(run);
        double sum = 0.0;
        assert_int_equal(hd_run_vectors(run), 48);
        for (int col = 0; col < 48; col++) sum += hd_spectrum_exponent(spectrum, col);
        CHECK_CLOSE(sum, 0.0, 48 * def.accuracy);
        CHECK_WITHIN(hd_spectrum_pairing_error(spectrum), 0.0, 5.0 / def.duration);
        for (int col = 0; col < 24; col++)
            CHECK_CLOSE(hd_spectrum_exponent(spectrum, col) +
                            hd_spectrum_exponent(spectrum, 47 - col),
                        0.0, 5.0 / def.duration);
    }
}

/** Carried by themselves, and those that follow from half of them. */
TEST(halves_have_the_exponents_of_all)
{
    for (int walls = 0; walls < 8; walls += 5) {
        OWNED(hd_run) *half = finished(few(8, walls, HD_EXPONENTS_ALL, 500.0));
        OWNED(hd_run) *all = finished(few(8, walls, HD_EXPONENTS_ALL_INDEPENDENT, 500.0));
        assert_int_equal(hd_frame_vectors(hd_run_frame(half)), 24);
        assert_int_equal(hd_frame_vectors(hd_run_frame(all)), 48);
        check_same_exponents(half, all, 10.0 / 500.0); /* their starts differ: O(1) / t */
    }
}

/** Two, and two for each periodic direction; they fall as ln t / t, the others do not. */
TEST(each_boundary_has_its_zero_exponents)
{
    for (int walls = 0; walls < 8; walls++) {
        const hd_scene_def def = few(6, walls, HD_EXPONENTS_ALL, 1500.0);
        const int periodic = !(walls & 1) + !(walls & 2) + !(walls & 4),
                  expected = 2 + 2 * periodic;
        const double zero = 4.0 * log(def.duration) / def.duration;
        int count = 0;
        OWNED(hd_run) *run = finished(def);
        for (int col = 0; col < 36; col++)
            count += fabs(hd_spectrum_exponent(hd_run_spectrum(run), col)) < zero;
        assert_int_equal(count, expected);
        assert_int_equal(hd_scene_zero_exponents(&def), expected);
        assert_int_equal(hd_scene_positive_exponents(&def), (36 - expected) / 2);
    }
}
