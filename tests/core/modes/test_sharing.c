/** Steps in one set: the same exponent, or vectors that still mix. */
#include "places.h"

enum { FIRST = 40, EACH = 4, SAMPLES = 256 };

/** T(1,1) and LP(0,1) in columns 40 to 47, all turned at random: the exponents of the first four
 * are above those of the others by `gap`. */
static world mixed(double *exponents, double gap)
{
    world w = world_create(scene_of_places(0.8), VECTORS, 1);
    const int both[] = {subspace_of(&w, 4), subspace_of(&w, 3)};
    exponents_falling(&w, exponents);
    exponents_flat(exponents, FIRST, EACH, 0.4 + 0.5 * gap);
    exponents_flat(exponents, FIRST + EACH, EACH, 0.4 - 0.5 * gap);
    world_span(&w, FIRST, both, 2, 0.0);
    world_look(&w);
    return w;
}

/** So many samples that scatter by `noise`, of one time unit each; then the steps. */
static void go_on(world *w, const double *exponents, double noise, int samples)
{
    double sample[VECTORS];
    for (int t = 0; t < samples; t++) {
        for (int col = 0; col < VECTORS; col++)
            sample[col] = exponents[col] + noise * (((t + col) * 37) % 64 / 32.0 - 63.0 / 64.0);
        world_stretch(w, sample);
    }
    hd_steps_find(w->steps, w->spectrum);
}

static void check_sharing(double gap, double noise, int samples, hd_sharing expected)
{
    double exponents[VECTORS];
    HELD(world) w = mixed(exponents, gap);
    go_on(&w, exponents, noise, samples);
    for (int k = 3; k <= 4; k++) {
        const hd_step *step = step_of(&w, k);
        assert_int_equal(step->members, 2);
        assert_int_equal(step->sharing, expected);
        assert_true(samples < 16 ? step->gap_error < 0 : step->gap_error >= 0);
        CHECK_CLOSE(step->gap, gap, fmax(3.0 * step->gap_error, 1e-12) + (samples < 16));
        CHECK_CLOSE(step->own_part, 0.5, 0.35); /* of four vectors each, mixed at random */
    }
}

/** The frame is as old as warm-up (91, that of the scene) and averages: 347 time units. */
TEST(exponents_and_time_tell)
{
    check_sharing(0.0, 0.02, 8, HD_SHARING_UNKNOWN); /* no errors yet */
    check_sharing(0.0, 1.5, SAMPLES, HD_SHARING_UNKNOWN);
    check_sharing(0.0, 0.02, SAMPLES, HD_SHARING_COINCIDENT);
    check_sharing(0.02, 0.02, SAMPLES, HD_SHARING_MIXING);
    check_sharing(0.05, 0.02, SAMPLES, HD_SHARING_BLENDED);
}

/** That of the scene, whose default is not a number: half of it is enough to part. */
TEST(a_warmup_that_nobody_gave_counts)
{
    const hd_scene_def def = scene_of_places(0.8);
    assert_true(def.warmup == HD_WARMUP_AUTO);
    check_sharing(10.0 / (0.5 * hd_scene_warmup(&def) + SAMPLES), 0.02, SAMPLES,
                  HD_SHARING_BLENDED);
}

TEST(who_is_alone_shares_nothing)
{
    double exponents[VECTORS];
    HELD(world) w = steps_in_place(exponents, 0.0);
    world_look(&w);
    go_on(&w, exponents, 0.02, SAMPLES);
    for (int k = 0; k < PLACES; k++) {
        const hd_step *step = step_of(&w, k);
        assert_int_equal(step->sharing, HD_SHARING_ALONE);
        CHECK_CLOSE(step->own_part, 1.0, 0.0);
        CHECK_CLOSE(step->gap, 0.0, 0.0);
        CHECK_CLOSE(step->gap_error, 0.0, 0.0);
    }
}

/** Vectors that do not mix lie in their own columns: T, then LP; so the part tells how far they
 * have parted. */
TEST(own_columns_follow_the_exponents)
{
    double exponents[VECTORS];
    HELD(world) w = mixed(exponents, 0.02);
    const int t = subspace_of(&w, 4), lp = subspace_of(&w, 3);
    world_span(&w, FIRST, &t, 1, 0.0);
    world_span(&w, FIRST + EACH, &lp, 1, 0.0);
    for (int v = 0; v < EACH; v++) world_turn(&w, FIRST + v, FIRST + EACH + v, 0.6);
    hd_modes_clear(w.modes);
    world_look(&w);
    go_on(&w, exponents, 0.02, SAMPLES);
    assert_int_equal(step_of(&w, 4)->members, 2);
    for (int k = 3; k <= 4; k++) CHECK_CLOSE(step_of(&w, k)->own_part, pow(cos(0.6), 2.0), 0.1);
}

/** Weight of a subspace in columns from `first` on, beyond that of random vectors. */
static double found_in(const world *w, int subspace, int first)
{
    const double *weight = hd_modes_average(w->modes, subspace, HD_WEIGHT);
    double sum = -EACH * 2.0 * EACH / (4.0 * DISKS);
    for (int v = 0; v < EACH; v++) sum += weight[first + v];
    return sum;
}

/** About eight random vectors are near, too: a weight of 0.02 +- 0.014 each, up to 0.08 away. */
static const double RANDOM = 3e-4;

/** What mixing adds to the errors of T(1,1) and LP(0,1), in sets of their own, whose exponents are
 * 0.4 +- gap / 2 and whose vectors are turned into each other by this angle. */
static void check_mixing(double gap, double angle, bool near)
{
    double exponents[VECTORS], error[2][2];
    HELD(world) w = mixed(exponents, gap);
    const int subspace[2] = {subspace_of(&w, 4), subspace_of(&w, 3)};
    for (int turned = 0; turned < 2; turned++) {
        for (int k = 0; k < 2; k++) world_span(&w, FIRST + k * EACH, &subspace[k], 1, 0.0);
        for (int v = 0; v < EACH && turned; v++) world_turn(&w, FIRST + v, FIRST + EACH + v, angle);
        hd_modes_clear(w.modes);
        hd_spectrum_clear(w.spectrum);
        world_look(&w);
        go_on(&w, exponents, 0.02, SAMPLES);
        for (int k = 0; k < 2; k++) {
            assert_int_equal(step_of(&w, 4 - k)->sharing, HD_SHARING_ALONE);
            error[turned][k] = step_of(&w, 4 - k)->std_error;
            assert_true(error[turned][k] > 0.0);
        }
    }
    for (int k = 0; k < 2; k++) {
        const double own = found_in(&w, subspace[k], FIRST + k * EACH);
        const double other = found_in(&w, subspace[k], FIRST + (1 - k) * EACH);
        const double mixing = near ? gap * other / (own + other) / sqrt(3.0) : 0.0;
        const double added = sqrt(pow(error[1][k], 2.0) - pow(error[0][k], 2.0));
        print_message("  %.5f of %.5f, found %.2f and %.2f\n", added, mixing, own, other);
        CHECK_CLOSE(added, mixing, RANDOM);
        CHECK_CLOSE(step_of(&w, 4 - k)->mixing, mixing, RANDOM);
    }
}

/** A step whose fields lie in columns of another one, too, has the exponent of its columns, or that
 * of its fields; half of the difference is an error. */
TEST(mixing_with_near_exponents_is_an_error)
{
    check_mixing(0.06, 0.4, true);
    check_mixing(0.06, 0.3, true);
    check_mixing(0.2, 0.4, false); /* more than a fifth apart: far */
}

TEST(time_counts_from_when_they_came_together)
{
    double exponents[VECTORS];
    HELD(world) w = mixed(exponents, 0.0);
    go_on(&w, exponents, 0.02, 20);
    CHECK_CLOSE(step_of(&w, 4)->set_time, 0.0, 0.0);
    go_on(&w, exponents, 0.02, 30);
    CHECK_CLOSE(step_of(&w, 4)->set_time, 30.0, 1e-9);
    const int t = subspace_of(&w, 4), lp = subspace_of(&w, 3); /* they part */
    world_span(&w, FIRST, &t, 1, 0.0);
    world_span(&w, FIRST + EACH, &lp, 1, 0.0);
    hd_modes_clear(w.modes);
    world_look(&w);
    go_on(&w, exponents, 0.02, 7);
    assert_int_equal(step_of(&w, 4)->sharing, HD_SHARING_ALONE);
    CHECK_CLOSE(step_of(&w, 4)->set_time, 0.0, 0.0);
    go_on(&w, exponents, 0.02, 5);
    CHECK_CLOSE(step_of(&w, 4)->set_time, 5.0, 1e-9);
    hd_steps_clear(w.steps); /* as averages begin anew */
    hd_spectrum_clear(w.spectrum);
    go_on(&w, exponents, 0.02, 3);
    CHECK_CLOSE(step_of(&w, 4)->set_time, 0.0, 0.0);
    hd_steps_clear(w.steps);
    assert_int_equal(step_of(&w, 4)->sharing, HD_SHARING_ALONE);
}
