/** Tracks of vectors that change places, come and go, or begin anew. */
#include "rotating.h"

TEST(exchanges_do_not_break_the_tracks)
{
    const double rates[] = {0.0, 0.7, -2.0};
    for (int d = 1; d <= 4; d *= 2)
        for (int k = 0; k < 3; k++) {
            HELD(rotating) r = pairs(d);
            for (int t = 0; t < 120; t++) {
                if (t >= 10 && t % 3 == 0)
                    exchange(&r, t % (2 * d), (t + 1) % (2 * d), t % 2 ? -1.0 : 1.0);
                if (t == 40) r.sign[0] *= -1.0;
                turn(&r, rates[k]);
                check_columns(&r);
            }
            assert_true(check_tracks(&r, 120 * rates[k], 120.0, 120.0 * ROUNDING) >= 2 * d);
        }
}

/** Vector 1 leaves the fields for so many samples. */
static rotating interrupted(int d, double omega, int samples)
{
    rotating r = pairs_of(d, 400); /* noise has |z|^2 = 1/400: 0.05 once in 5e8 */
    for (int t = 0; t < 30; t++) turn(&r, omega);
    r.strength[1] = 0.0;
    for (int t = 0; t < samples; t++) {
        turn(&r, omega);
        assert_int_equal(phase_of(&r, 1, 0)->state, HD_PHASE_WEAK);
        CHECK_CLOSE(phase_of(&r, 1, 0)->time, t < 16 ? 30.0 : 0.0, 0.0);
        assert_int_equal(phase_of(&r, 1, 0)->col, r.column[1]);
    }
    r.strength[1] = 1.0;
    turn(&r, omega);
    assert_int_equal(phase_of(&r, 1, 0)->state, HD_PHASE_TRACKED);
    assert_int_equal(phase_of(&r, 1, 0)->col, r.column[1]);
    assert_true(strength_of(phase_of(&r, 1, 0)) >= WEAK);
    return r;
}

/** All vectors jump by 0.85 rad now and then: further from where they were than from each other. */
TEST(jumps_are_no_exchanges)
{
    for (int d = 1; d <= 4; d *= 2) {
        HELD(rotating) r = pairs(d);
        double angle = 0.0;
        for (int t = 0; t < 120; t++) {
            const double jump = t < 10 ? 0.0 : t % 8 == 0 ? 0.85 : t % 8 == 4 ? -0.85 : 0.0;
            angle += 0.7 + jump;
            turn(&r, 0.7 + jump);
            check_columns(&r);
        }
        assert_true(check_tracks(&r, angle, 120.0, 120.0 * ROUNDING) >= 2 * d);
    }
}

TEST(short_absences_keep_the_count_of_turns)
{
    for (int d = 1; d <= 2; d++)
        for (int samples = 1; samples <= 15; samples += 2) {
            HELD(rotating) r = interrupted(d, 1.3, samples);
            const double time = 31.0 + samples;
            const int all = d == 1 ? 2 : 4;
            CHECK_CLOSE(phase_of(&r, 1, 0)->time, time, 0.0);
            for (int t = 0; t < 5; t++) turn(&r, 1.3);
            assert_true(check_tracks(&r, 1.3 * (time + 5.0), time + 5.0, 100.0 * ROUNDING) >= all);
        }
}

TEST(long_absences_begin_anew)
{
    for (int d = 1; d <= 2; d++) {
        HELD(rotating) r = interrupted(d, 1.3, 20);
        CHECK_CLOSE(phase_of(&r, 1, 0)->time, 0.0, 0.0);
        CHECK_CLOSE(phase_of(&r, 0, 0)->time, 51.0, 0.0); /* the other one goes on */
        turn(&r, 1.3);
        CHECK_CLOSE(phase_of(&r, 1, 0)->time, 1.0, 0.0);
        CHECK_CLOSE(phase_of(&r, 1, 0)->omega, 1.3, ROUNDING);
        assert_true(phase_of(&r, 1, 0)->omega_error < 0);
    }
}

/** Nothing but noise for a while: the rate of the whole step is not spoiled. */
TEST(absence_of_all_vectors_is_survived)
{
    HELD(rotating) r = pairs_of(1, 400);
    for (int t = 0; t < 50; t++) turn(&r, 1.3);
    r.strength[0] = r.strength[1] = 0.0;
    for (int t = 0; t < 5; t++) turn(&r, 1.3);
    r.strength[0] = r.strength[1] = 1.0;
    for (int t = 0; t < 5; t++) turn(&r, 1.3);
    assert_int_equal(check_tracks(&r, 1.3 * 60, 60.0, 100.0 * ROUNDING), 2);
    CHECK_CLOSE(hd_phases_velocity(r.phases).v, 1.3 / r.step->wave.number, 100.0 * ROUNDING);
}

static void check_all(const rotating *r, hd_phase_state state, double time)
{
    for (int v = 0; v < 2 * r->d; v++)
        for (int c = 0; c < r->d; c++) {
            assert_int_equal(phase_of(r, v, c)->state, state);
            CHECK_CLOSE(phase_of(r, v, c)->time, time, 0.0);
        }
}

TEST(unresolved_steps_are_not_followed)
{
    HELD(rotating) r = pairs(1);
    double exponents[2] = {2.4, 0.8};
    for (int t = 0; t < 20; t++) turn(&r, 0.5);
    check_all(&r, HD_PHASE_TRACKED, 20.0);
    hd_spectrum_clear(r.w.spectrum);
    world_stretch(&r.w, exponents);
    hd_steps_find(r.w.steps, r.w.spectrum);
    assert_false(r.step->resolved);
    for (int t = 0; t < 3; t++) {
        turn(&r, 0.5);
        check_all(&r, HD_PHASE_UNRESOLVED, 0.0);
        assert_int_equal(phase_of(&r, 0, 0)->col, -1);
        assert_true(phase_of(&r, 0, 0)->omega_error < 0);
        assert_int_equal(hd_phases_velocity(r.phases).phases, 0);
    }
    find(&r, 2.4);
    turn(&r, 0.5);
    check_all(&r, HD_PHASE_TRACKED, 0.0);
    turn(&r, -0.5); /* nothing is left of the old rate */
    check_all(&r, HD_PHASE_TRACKED, 1.0);
    CHECK_CLOSE(phase_of(&r, 0, 0)->omega, -0.5, ROUNDING);
}

/** The same step in other columns. */
TEST(another_set_is_followed_anew)
{
    const hd_scene_def def = scene_from(scene_in_box(30, 40.0, 1.5, R, P, 9), .max_mode_number = 1);
    HELD(rotating) r = rotating_create(def, HD_MODE_LP, 1, 0, 6, 2.4);
    assert_int_equal(r.step->col, 4);
    for (int t = 0; t < 20; t++) turn(&r, 0.5);
    check_all(&r, HD_PHASE_TRACKED, 20.0);
    world_noise(&r.w);
    world_span(&r.w, 1, (const int[]){r.step->subspace}, 1, 0.0);
    hd_modes_clear(r.w.modes);
    world_look(&r.w);
    find(&r, 2.4);
    assert_int_equal(r.step->col, 1);
    for (int m = 0; m < 2; m++) r.column[m] = 1 + m;
    turn(&r, 0.5);
    check_all(&r, HD_PHASE_TRACKED, 0.0);
    assert_int_equal(phase_of(&r, 1, 0)->col, 2);
}

/** Samples at other distances, as pieces of a schedule that changes: a slow step, for which 12.5
 * time units would do without any knowledge of its rate, goes on; known, twice the mean distance
 * and a third more will. Far shorter ones count, too: what came before them is not forgotten. */
TEST(pieces_of_any_length_go_on)
{
    const double lengths[] = {1.0,       2.0, 4.0, 8.0, 12.5, 7.0,  0.6 * 7.0,
                              0.4 * 7.0, 7.0, 5.0, 2.5, 0.1,  0.01, 12.5};
    HELD(rotating) r = pairs(1);
    double time = 0.0;
    find(&r, 0.2);
    for (size_t k = 0; k < sizeof lengths / sizeof *lengths; k++)
        for (int t = 0; t < (k == 0 ? 20 : 4); t++) {
            r.dt = lengths[k];
            turn(&r, 0.2);
            time += r.dt;
            check_all(&r, HD_PHASE_TRACKED, r.time);
        }
    assert_int_equal(check_tracks(&r, 0.2 * time, time, time * ROUNDING), 2);
    CHECK_CLOSE(phase_of(&r, 0, 0)->omega, 0.2, ROUNDING);
    CHECK_CLOSE(hd_phases_velocity(r.phases).v, 0.2 / r.step->wave.number, ROUNDING);
    r.dt = 1.01 / 0.75 * hd_phases_sampling(r.phases, r.w.steps);
    assert_true(r.dt > 12.6);
    turn(&r, 0.2);
    check_all(&r, HD_PHASE_COARSE, 0.0);
    r.dt = 1.0;
    turn(&r, 0.2);
    check_all(&r, HD_PHASE_TRACKED, 1.0);
}

TEST(clear_begins_anew)
{
    HELD(rotating) r = pairs(1);
    for (int t = 0; t < 20; t++) turn(&r, 0.5);
    hd_phases_clear(r.phases);
    check_all(&r, HD_PHASE_UNRESOLVED, 0.0);
    turn(&r, 0.5);
    check_all(&r, HD_PHASE_TRACKED, 0.0);
}

/** 1.25 lambda dt above pi: no phase, at no sample, until the samples are close enough; a and b are
 * known. Three samples do not tell the rate. */
TEST(coarse_samples_are_said_to_be)
{
    HELD(rotating) r = pairs(1);
    for (int t = 0; t < 3; t++) turn(&r, 0.5);
    find(&r, 1.01 * PI / 1.25);
    for (int t = 0; t < 6; t++) {
        turn(&r, 0.5);
        check_all(&r, HD_PHASE_COARSE, 0.0);
        assert_int_equal(phase_of(&r, 1, 0)->col, r.column[1]);
        assert_true(strength_of(phase_of(&r, 1, 0)) > 0.5);
        assert_true(phase_of(&r, 0, 0)->omega_error < 0);
    }
    find(&r, 0.99 * PI / 1.25);
    turn(&r, 0.5);
    turn(&r, 0.5);
    assert_int_equal(phase_of(&r, 0, 0)->state, HD_PHASE_TRACKED);
    CHECK_CLOSE(phase_of(&r, 0, 0)->omega, 0.5, ROUNDING);
    find(&r, 1.01 * PI / 1.25);
    turn(&r, 0.5);
    hd_steps_clear(r.w.steps); /* nothing is resolved: neither tracked nor coarse */
    turn(&r, 0.5);
    check_all(&r, HD_PHASE_UNRESOLVED, 0.0);
}
