/** Zero modes, conjugate steps, errors and changes of steps whose truth is known. */
#include "places.h"

enum { ALL_MAX = 4 * DISKS };

static void write_zero(world *w, int col, int null, bool of_dp)
{
    double half[2][2 * DISKS] = {{0.0}};
    world_add_field(w, half[of_dp], hd_fields_columns(w->fields) - NULLS + null, 1.0);
    world_write(w, col, half[0], half[1]);
}

/** Zeros begin at (4N - Z) / 2; the frame ends `carried` columns later. */
static void check_partial_zeros(hd_boundary x, hd_boundary y, int zeros, int carried)
{
    const int first = (4 * 20 - zeros) / 2;
    static double exponents[ALL_MAX];
    const hd_scene_def def = scene(.number = 20, .density = 0.5, .aspect = 0.8, .boundary[0] = x,
                                   .boundary[1] = y, .seed = 4, .max_mode_number = 1);
    HELD(world) w = world_create(def, first + carried, 1);
    exponents_falling(&w, exponents);
    for (int k = 0; k < carried; k++) write_zero(&w, first + k, NULL_P, k % 2);
    world_find(&w, exponents);
    const hd_step *step = hd_steps_step(w.steps, hd_fields_subspaces(w.fields));
    assert_int_equal(step->kind, HD_MODE_ZERO);
    assert_int_equal(step->expected, zeros);
    if (carried == 0) {
        check_unresolved(step);
    } else {
        assert_true(step->resolved);
        assert_int_equal(step->col, first);
        assert_int_equal(step->count, carried < zeros ? carried : zeros);
        CHECK_CLOSE(step->multiplicity, step->count, ROUNDING);
        assert_int_equal(hd_steps_of_vector(w.steps, first), hd_fields_subspaces(w.fields));
    }
}

TEST(zero_modes_stand_in_the_middle)
{
    for (int carried = 0; carried < 3; carried++) {
        check_partial_zeros(P, P, 6, carried);
        check_partial_zeros(P, R, 4, carried);
        check_partial_zeros(R, R, 2, carried);
    }
    check_partial_zeros(R, R, 2, 5);
}

TEST(noise_in_the_middle_is_no_zero_mode)
{
    static double exponents[ALL_MAX];
    const hd_scene_def def = scene(.number = 20, .density = 0.5, .aspect = 0.8, .seed = 4,
                                   .max_mode_number = 1);
    HELD(world) w = world_create(def, 40, 1);
    exponents_falling(&w, exponents);
    world_find(&w, exponents);
    check_unresolved(hd_steps_step(w.steps, hd_fields_subspaces(w.fields)));
    write_zero(&w, 37, HD_NULL_X, true); /* one and a part of three */
    write_zero(&w, 38, HD_NULL_Y, true);
    hd_modes_clear(w.modes);
    world_find(&w, exponents);
    const hd_step *step = hd_steps_step(w.steps, hd_fields_subspaces(w.fields));
    assert_true(step->resolved);
    assert_int_equal(hd_steps_of_vector(w.steps, 38), hd_fields_subspaces(w.fields));
    assert_int_equal(hd_steps_of_vector(w.steps, 39), -1);
}

/** Column that mirrors another. */
static int mirror(int col, int count) { return 4 * DISKS - col - count; }

TEST(all_vectors_have_conjugate_steps)
{
    static double exponents[ALL_MAX];
    HELD(world) w = world_create(scene_of_places(0.8), 4 * DISKS, 1);
    for (int col = 0; col < 4 * DISKS; col++) exponents[col] = 3.0 - 6.0 * col / (4 * DISKS);
    for (int k = 0; k < PLACES; k++) {
        const int s = subspace_of(&w, k), count = places[k].count;
        const int col = 137 + places[k].col; /* up to the zeros at 197 */
        world_span(&w, col, &s, 1, 0.1);
        world_span(&w, mirror(col, count), &s, 1, 0.1);
        exponents_flat(exponents, col, count, places[k].exponent);
        exponents_flat(exponents, mirror(col, count), count, -places[k].exponent);
    }
    for (int k = 0; k < 6; k++) write_zero(&w, 197 + k, k / 2, k % 2);
    exponents_flat(exponents, 197, 6, 0.0);
    world_find(&w, exponents);
    assert_int_equal(hd_steps_count(w.steps), 2 * PLACES + 1);
    for (int k = 0; k < PLACES; k++) {
        const hd_step *step = step_of(&w, k);
        const hd_step *conjugate = hd_steps_step(w.steps, subspace_of(&w, k) + PLACES + 1);
        check_step(step, 137 + places[k].col, places[k].count, 1, places[k].exponent);
        check_step(conjugate, mirror(step->col, step->count), step->count, 1, -places[k].exponent);
        assert_true(conjugate->conjugate && !step->conjugate);
        assert_int_equal(conjugate->subspace, step->subspace);
        assert_int_equal(hd_steps_of_vector(w.steps, conjugate->col),
                         subspace_of(&w, k) + PLACES + 1);
    }
    check_step(hd_steps_step(w.steps, PLACES), 197, 6, 1, 0.0);
    CHECK_CLOSE(hd_steps_step(w.steps, PLACES)->multiplicity, 6.0, ROUNDING);
}

enum { SAMPLES = 256, REPEATS = 10 };

/** Relative size of the fluctuations of one sample. */
static const double SIZE = 0.05;
/** Errors of white noise come from 64 blocks, or half as many, each known to 1 / sqrt(62); 6 steps,
 * REPEATS times; 3 sigma. */
static const double KNOWN_TO = 3.0 * 0.127 / 7.7;

/** How the vectors of a step move: as one, each by itself, or every second against the others. */
typedef enum motion { TOGETHER, ALONE, OPPOSITE } motion;

static void add_samples(world *w, const double *exponents, motion how, int samples)
{
    double sample[VECTORS];
    for (int t = 0; t < samples; t++) {
        double move = 0.0;
        for (int col = VECTORS - 1; col >= 0; col--) { /* all steps begin at an even column */
            if (how == ALONE || col % 4 == 3) move = random_normal(&w->random);
            const double sign = how == OPPOSITE && col % 2 ? -1.0 : 1.0;
            sample[col] = exponents[col] * (1.0 + SIZE * sign * move);
        }
        world_stretch(w, sample);
    }
    hd_steps_find(w->steps, w->spectrum);
}

/** The square of the stated error of step k without what mixing adds to it. */
static double sampling_square(const world *w, int k)
{
    const hd_step *step = step_of(w, k);
    return step->std_error * step->std_error - step->mixing * step->mixing;
}

/** Root mean square of (that error) / (exponent SIZE / sqrt(samples)), over the steps and REPEATS.
 */
static double error_of(motion how)
{
    double exponents[VECTORS], square = 0.0;
    HELD(world) w = steps_in_place(exponents, 0.0);
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        hd_spectrum_clear(w.spectrum);
        hd_steps_clear(w.steps);
        world_find(&w, exponents);
        hd_spectrum_clear(w.spectrum);
        add_samples(&w, exponents, how, SAMPLES);
        for (int k = 0; k < PLACES; k++) {
            assert_true(step_of(&w, k)->resolved);
            square += sampling_square(&w, k) * SAMPLES / pow(places[k].exponent, 2.0);
        }
    }
    return sqrt(fabs(square) / REPEATS / PLACES) / SIZE;
}

/** The error of a mean is known exactly; steps of 2, 4 and 8 vectors, which move in fours. */
TEST(errors_know_what_moves_together)
{
    const double d[] = {2, 4, 2, 4, 4, 8};
    double alone = 0.0, fours = 0.0;
    for (int k = 0; k < PLACES; k++) {
        alone += 1.0 / d[k] / PLACES;
        fours += fmin(4.0 / d[k], 1.0) / PLACES;
    }
    const double got[] = {error_of(TOGETHER), error_of(ALONE), error_of(OPPOSITE)};
    CHECK_CLOSE(got[0], sqrt(fours), KNOWN_TO * sqrt(fours));
    CHECK_CLOSE(got[1], sqrt(alone), KNOWN_TO * sqrt(alone));
    CHECK_CLOSE(got[2], 0.0, sqrt(ROUNDING)); /* a difference of squares */
}

TEST(few_samples_give_no_error)
{
    double exponents[VECTORS];
    HELD(world) w = steps_in_place(exponents, 0.0);
    world_find(&w, exponents);
    add_samples(&w, exponents, ALONE, 14); /* and the one of find */
    assert_true(step_of(&w, 0)->std_error < 0);
    add_samples(&w, exponents, ALONE, 1);
    assert_true(step_of(&w, 0)->std_error > 0);
}

/** A set is one of columns: its error is that of all the time, also of before it was found. */
TEST(new_sets_know_the_whole_time)
{
    double exponents[VECTORS];
    HELD(world) w = steps_in_place(exponents, 0.0);
    world_find(&w, exponents);
    add_samples(&w, exponents, ALONE, SAMPLES);
    const double before = step_of(&w, 5)->std_error;
    for (int back = 0; back < 2; back++) { /* five of LP(1,1)'s eight leave it and come back */
        for (int v = 0; v < 5; v++) world_turn(&w, 36 + v, 7 * v, back ? -1.3 : 1.3);
        hd_modes_clear(w.modes);
        world_look(&w);
        hd_steps_find(w.steps, w.spectrum);
        assert_int_equal(step_of(&w, 5)->resolved, back);
    }
    CHECK_CLOSE(step_of(&w, 5)->std_error, before, 0.02 * before); /* shares are 1 but for 1 % */
}

TEST(what_is_flat_no_more_is_not_resolved)
{
    double exponents[VECTORS];
    HELD(world) w = steps_in_place(exponents, 0.0);
    hd_steps_find(w.steps, w.spectrum); /* nothing is known yet */
    check_unresolved(step_of(&w, 0));
    world_find(&w, exponents);
    assert_true(step_of(&w, 1)->resolved);
    exponents[52] *= 100.0; /* LP(1,0) is flat no more */
    world_find(&w, exponents);
    check_unresolved(step_of(&w, 1));
}

TEST(clear_forgets_everything)
{
    double exponents[VECTORS];
    HELD(world) w = steps_in_place(exponents, 0.0);
    world_find(&w, exponents);
    for (int t = 0; t < 20; t++) world_stretch(&w, exponents);
    hd_steps_find(w.steps, w.spectrum);
    assert_true(step_of(&w, 0)->std_error >= 0);
    hd_steps_clear(w.steps);
    for (int k = 0; k < hd_steps_count(w.steps); k++) check_unresolved(hd_steps_step(w.steps, k));
    for (int col = 0; col < VECTORS; col++) assert_int_equal(hd_steps_of_vector(w.steps, col), -1);
    hd_spectrum_clear(w.spectrum);
    world_find(&w, exponents);
    check_step(step_of(&w, 0), 58, 2, 1, 0.2);
    assert_true(step_of(&w, 0)->std_error < 0);
}

/** Of a set the first step is shown, none of the negative half, and the lowest is by its exponent.
 */
TEST(what_is_shown_and_what_is_lowest)
{
    double exponents[VECTORS];
    world w = steps_in_place(exponents, 0.0);
    assert_int_equal(hd_steps_lowest(w.steps, HD_MODE_T), -1);
    assert_false(hd_steps_is_shown(w.steps, 0));
    world_find(&w, exponents);
    const int lowest[] = {hd_steps_lowest(w.steps, HD_MODE_T),
                          hd_steps_lowest(w.steps, HD_MODE_LP)};
    int shown = 0, sets = 0;
    for (int k = 0; k < hd_steps_count(w.steps); k++) {
        const hd_step *step = hd_steps_step(w.steps, k);
        const bool wave = step->kind != HD_MODE_ZERO, found = step->resolved && wave;
        shown += hd_steps_is_shown(w.steps, k);
        if (found && step->set + 1 > sets) sets = step->set + 1;
        if (hd_steps_is_shown(w.steps, k)) assert_true(found && !step->conjugate);
        if (!found || step->conjugate) continue;
        const hd_step *least = hd_steps_step(w.steps, lowest[step->kind == HD_MODE_LP]);
        assert_int_equal(least->kind, step->kind);
        assert_true(least->exponent <= step->exponent);
    }
    assert_true(lowest[0] >= 0 && lowest[1] >= 0);
    assert_true(shown > 0 && shown <= sets);
    world_free(&w);
}
