/** What must hold of exponents exactly, of disks and of spheres; test_conditioning.c has their
 * values. */
#include "runs.h"

static hd_scene_def few(int disks, int walls, int exponents, double duration)
{
    return scene_from(box_of(disks, 0.4, 0.9, 1.2, walls, 5), .exponents = exponents,
                      .equilibration = 20.0, .warmup = 20.0, .duration = duration, .threads = 1);
}

/** lambda_l = -lambda_(2 DIM N + 1 - l), each carried by itself: finite times leave a number of
 * order 1 over them, the starts' share. Volume is kept: all of them add up to nothing, but for
 * rounding. */
TEST(opposite_exponents_and_their_sum)
{
    for (int walls = 0; walls < WALL_SETS; walls += ALL_WALLS) {
        const hd_scene_def def = few(8, walls, HD_EXPONENTS_ALL_INDEPENDENT, 1000.0);
        OWNED(hd_run) *run = finished(def);
        const hd_spectrum *spectrum = hd_run_spectrum(run);
        double sum = 0.0;
        const int n = hd_run_vectors(run);
        assert_int_equal(n, ROWS_OF_ONE * 8);
        for (int col = 0; col < n; col++) sum += hd_spectrum_exponent(spectrum, col);
        CHECK_CLOSE(sum, 0.0, n * def.accuracy);
        CHECK_WITHIN(hd_spectrum_sum_up(spectrum).pairing_error, 0.0, 5.0 / def.duration);
        for (int col = 0; col < n / 2; col++)
            CHECK_CLOSE(hd_spectrum_exponent(spectrum, col) +
                            hd_spectrum_exponent(spectrum, n - 1 - col),
                        0.0, 5.0 / def.duration);
    }
}

/** Carried by themselves, and those that follow from half of them. */
TEST(halves_have_the_exponents_of_all)
{
    for (int walls = 0; walls < WALL_SETS; walls += WALL_SETS / 2 + 1) {
        OWNED(hd_run) *half = finished(few(8, walls, HD_EXPONENTS_ALL, 500.0));
        OWNED(hd_run) *all = finished(few(8, walls, HD_EXPONENTS_ALL_INDEPENDENT, 500.0));
        assert_int_equal(hd_frame_vectors(hd_run_frame(half)), DIM * 8);
        assert_int_equal(hd_frame_vectors(hd_run_frame(all)), ROWS_OF_ONE * 8);
        check_same_exponents(half, all, 10.0 / 500.0); /* their starts differ: O(1) / t */
    }
}

/** Two, and two for each periodic direction; they fall as ln t / t, the others do not. */
TEST(each_boundary_has_its_zero_exponents)
{
    for (int walls = 0; walls < WALL_SETS; walls++) {
        const hd_scene_def def = few(6, walls, HD_EXPONENTS_ALL, 1500.0);
        const int periodic = DIM - (walls & 1) - (walls >> 1 & 1) - (walls >> 2 & 1),
                  expected = 2 + 2 * periodic;
        const double zero = 4.0 * log(def.duration) / def.duration;
        int count = 0;
        OWNED(hd_run) *run = finished(def);
        for (int col = 0; col < ROWS_OF_ONE * 6; col++)
            count += fabs(hd_spectrum_exponent(hd_run_spectrum(run), col)) < zero;
        assert_int_equal(count, expected);
        assert_int_equal(hd_scene_zero_exponents(&def), expected);
        assert_int_equal(hd_scene_positive_exponents(&def), (ROWS_OF_ONE * 6 - expected) / 2);
    }
}
