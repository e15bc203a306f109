/** Windows of covariant vectors, one after the other: their times, their room, what they lack. */
#include "windows.h"

enum { WARMUP = 400, LOOKS = 5, PER_LOOK = 8 };

/** Without gaps; each look is one of exactly one window. */
TEST(windows_follow_each_other)
{
    HELD(windows) w = windows_begun(windows_scene(4, P, P), WARMUP, WINDOWS_INTERVAL);
    const double begin = hd_trajectory_time(w.f.trajectory);
    for (int count = 1; count <= 8; count++) {
        windows_finish(&w, count);
        CHECK_CLOSE(hd_covariant_read(w.c).window_end, begin + 10.0 * count, 1e-9);
        CHECK_CLOSE(hd_trajectory_time(w.f.trajectory), begin + 10.0 * count + 20.0, 1e-9);
        CHECK_CLOSE(hd_spectrum_time(hd_covariant_read(w.c).spectrum), 10.0 * count, 1e-9);
        assert_int_equal(hd_covariant_read(w.c).splitting.samples, LOOKS * count);
    }
    assert_int_equal(hd_covariant_read(w.c).lost, 0);
}

/** A window goes on to a look, its transient from there to another one. */
TEST(looks_that_fall_elsewhere_shorten_nothing)
{
    const double transient[] = {3.0, 3e-6}; /* however much shorter than from look to look */
    for (int k = 0; k < 2; k++) {
        const hd_scene_def def = scene_from(windows_scene(4, P, P), .covariant_window = 5.0,
                                            .covariant_transient = transient[k],
                                            .covariant_sampling = 4.0);
        HELD(windows) w = windows_begun(def, WARMUP, WINDOWS_INTERVAL);
        const double begin = hd_trajectory_time(w.f.trajectory);
        for (int count = 1; count <= 4; count++) {
            windows_finish(&w, count);
            CHECK_CLOSE(hd_covariant_read(w.c).window_end, begin + 8.0 * count, 1e-9);
            CHECK_CLOSE(hd_trajectory_time(w.f.trajectory), begin + 8.0 * count + 4.0, 1e-9);
        }
        assert_int_equal(hd_covariant_read(w.c).lost, 0);
    }
}

/** Both give the growth of the same spaces over the same time. In the centre pairs of
 * vectors shear: on the way back a start grows with the time since, so over a window it has
 * ln((window + transient) / transient) to lose; the first three do not turn. */
static void check_exponent(const hd_covariant_results *r, const hd_spectrum *forward, int col,
                           int positive)
{
    const hd_spectrum *back = r->spectrum;
    const double one = hd_spectrum_std_error(forward, col), other = hd_covariant_std_error(r, col);
    const double exponent = hd_spectrum_exponent(back, col);
    const bool central = col >= positive && col < positive + 6; /* decays: no error may be known */
    assert_true(central || (one > 0 && other > 0 && one < 0.08 && other < 0.08));
    if (col >= positive + 3 && col < positive + 6)
        CHECK_CLOSE(exponent, -log(30.0 / 20.0) / 10.0,
                    0.003); /* the shear's own start is 1 time unit or so */
    else
        CHECK_CLOSE(exponent, hd_spectrum_exponent(forward, col),
                    central ? 1e-3 : 4.0 * hypot(one, other));
    CHECK_CLOSE(hd_spectrum_time(back) * (exponent - hd_spectrum_exponent(forward, col)),
                r->turned[col], 1e-9);
    const double statistical = hd_spectrum_std_error(back, col),
                 systematic = exponent - hd_spectrum_exponent(forward, col);
    if (statistical > 0)
        CHECK_CLOSE(other * other, statistical * statistical + systematic * systematic, 1e-12);
}

TEST(exponents_are_those_of_the_frame)
{
    HELD(windows) w = windows_begun(windows_scene(4, P, P), WARMUP, WINDOWS_INTERVAL);
    MADE(hd_spectrum, forward, 16, 16, 8, 0.0);
    for (int k = 1; hd_covariant_read(w.c).windows < 30; k++) {
        if (windows_forward(&w)) windows_back(&w);
        if (k * WINDOWS_INTERVAL > 300.0) continue; /* the last transient */
        hd_spectrum_add(forward, hd_ortho_log_stretch(w.f.ortho), WINDOWS_INTERVAL);
        if (k % PER_LOOK == 0) hd_spectrum_sample(forward);
    }
    const hd_covariant_results r = hd_covariant_read(w.c);
    for (int col = 0; col < 16; col++) check_exponent(&r, forward, col, 5);
}

/** Intervals a quarter as long as expected: the first window finds no room, the next ones do. */
TEST(a_window_without_room_is_lost_and_the_next_is_not)
{
    hd_scene_def scene = windows_scene(4, P, P);
    const size_t triangles = 8 * 16 * 17 / 2; /* bytes of one */
    HELD(windows) w = windows_begun(scene, WARMUP, 4.0 * WINDOWS_INTERVAL);
    windows_finish(&w, 5);
    assert_int_equal(hd_covariant_read(w.c).lost, 1);
    hd_covariant_clear(w.c, 0.0);
    assert_int_equal(hd_covariant_read(w.c).lost, 0);
    windows_free(&w);
    /* and its snapshots */
    scene.covariant_memory = 1e-9 * (80.0 * (double)triangles + 21.0 * 8 * 16 * 17);
    w = windows_begun(scene, WARMUP, 4.0 * WINDOWS_INTERVAL);
    for (int k = 0; k < 1000; k++) assert_false(windows_forward(&w));
    assert_true(hd_covariant_read(w.c).lost > 10);
}

/** Rounding turns a vector by eps condition. */
TEST(the_centre_is_the_null_space)
{
    const hd_boundary boundary[][2] = {{P, P}, {P, R}, {R, P}, {R, R}};
    for (int k = 0; k < 4; k++) {
        const hd_scene_def def = scene_from(windows_scene(6, boundary[k][0], boundary[k][1]),
                                            .covariant_transient = 60.0);
        HELD(windows) w = windows_begun(def, WARMUP, WINDOWS_INTERVAL);
        windows_finish(&w, 10);
        const double rounding = 16.0 * DBL_EPSILON * w.f.worst;
        CHECK_CLOSE(hd_covariant_read(w.c).null_most, 0.0, rounding);
        CHECK_CLOSE(hd_covariant_read(w.c).start_mismatch.centre, 0.0, rounding);
        CHECK_CLOSE(hd_covariant_read(w.c).start_mismatch.stable, 0.0, rounding);
        assert_true(hd_covariant_read(w.c).null >= 0 &&
                    hd_covariant_read(w.c).null <= hd_covariant_read(w.c).null_most);
    }
}

static windows after_transient(double transient)
{
    windows w = windows_begun(scene_from(windows_scene(4, P, P), .covariant_sampling = 0.5,
                                         .covariant_transient = transient),
                              WARMUP, WINDOWS_INTERVAL);
    windows_finish(&w, 3);
    return w;
}

/** exp(-gap t): the gap is 1.6 around the centre, and 0.3 to 0.6 between the unstable ones. */
TEST(too_short_a_transient_is_seen)
{
    const double transient[] = {0.5, 4.0, 16.0, 100.0};
    windows w[4];
    for (int k = 0; k < 4; k++) w[k] = after_transient(transient[k]);
    for (int k = 0; k + 1 < 4; k++) {
        const hd_covariant_mismatch met = hd_covariant_read(w[k].c).start_mismatch,
                                    longer = hd_covariant_read(w[k + 1].c).start_mismatch;
        const double rounding = 16.0 * DBL_EPSILON * w[k + 1].f.worst; /* where both have met */
        assert_true(longer.stable < fmax(met.stable, rounding) &&
                    longer.centre < fmax(met.centre, rounding));
        for (int col = 1; k > 0 && col < 5; col++) /* two random starts may lie near each other */
            assert_true(hd_covariant_read(w[k + 1].c).start_mismatch_each[col] <
                        hd_covariant_read(w[k].c).start_mismatch_each[col]);
    }
    const hd_covariant_mismatch none = hd_covariant_read(w[0].c).start_mismatch,
                                met = hd_covariant_read(w[3].c).start_mismatch;
    assert_true(none.most > 0.1 && none.centre > 0.1 && none.stable > 0.1);
    assert_true(hd_covariant_read(w[0].c).null_most > 0.1);
    CHECK_CLOSE(met.centre, 0.0, 16.0 * DBL_EPSILON * w[3].f.worst);
    CHECK_CLOSE(met.stable, 0.0, 16.0 * DBL_EPSILON * w[3].f.worst);
    for (int col = 0; col < 16; col++) {
        const double apart = hd_covariant_read(w[3].c).start_mismatch_each[col];
        assert_true(apart <= met.most);
        if (col < 5 || col > 10) CHECK_CLOSE(apart, 0.0, 16.0 * DBL_EPSILON * w[3].f.worst);
    }
    assert_true(met.most > 0.1); /* vectors of equal exponents do not meet */
    for (int k = 0; k < 4; k++) windows_free(&w[k]);
}

/** The first vector alone; the positive half; into the centre; through it; all. */
TEST(any_number_of_vectors_will_do)
{
    for (int disks = 2; disks <= 5; disks++) {
        hd_scene_def scene = windows_scene(disks, P, P);
        const int positive = 2 * disks - 3;
        for (int n = 1; n <= 4 * disks; n++) {
            scene.exponents = n;
            HELD(windows) w = windows_begun(scene, WARMUP, WINDOWS_INTERVAL);
            windows_finish(&w, 2);
            const bool centre = n >= positive + 6;
            assert_int_equal(hd_covariant_read(w.c).splitting.has_spaces, n > positive + 6);
            assert_int_equal(hd_covariant_read(w.c).null_most >= 0, centre);
            assert_int_equal(hd_covariant_read(w.c).start_mismatch.centre >= 0, centre);
            assert_int_equal(hd_covariant_read(w.c).start_mismatch.stable >= 0, n > positive + 6);
            assert_true(hd_covariant_read(w.c).start_mismatch.most >= 0);
        }
    }
}

/** A way back that was given up in the middle of its window leaves nothing: what follows is what a
 * new one finds. */
TEST(a_window_given_up_leaves_nothing)
{
    hd_scene_def scene = scene_from(windows_scene(4, P, P), .covariant_transient = 120.0,
                                    .covariant_sampling = 0.5);
    HELD(windows) w = windows_begun(scene, WARMUP, WINDOWS_INTERVAL);
    while (!windows_forward(&w)) {
    }
    for (int k = 0; k < 120 * 4 + 39; k++)
        CHECK_OK(hd_covariant_step(w.c)); /* one interval of the window is left */
    const double now = hd_trajectory_time(w.f.trajectory);
    const int done = (int)(now / WINDOWS_INTERVAL + 0.5);
    hd_covariant_clear(w.c, now);
    CHECK_OK(hd_covariant_begin(w.c, now, WINDOWS_INTERVAL));
    HELD(windows) fresh = windows_begun(scene, done, WINDOWS_INTERVAL);
    windows_finish(&w, 2);
    windows_finish(&fresh, 2);
    for (int col = 0; col < 16; col++) {
        if (col > 3 && col < 11)
            continue; /* between equal exponents each start has vectors of its own */
        CHECK_CLOSE(hd_spectrum_exponent(hd_covariant_read(w.c).spectrum, col),
                    hd_spectrum_exponent(hd_covariant_read(fresh.c).spectrum, col), 1e-9);
        if (col == 15) break;
        CHECK_CLOSE(hd_covariant_read(w.c).order[0].violations[col],
                    hd_covariant_read(fresh.c).order[0].violations[col], 1e-12);
    }
}
