/** Rates, errors and velocity of vectors that turn at a known rate. */
#include "rotating.h"

/* ---- clean rotation ------------------------------------------------------------------------ */

static void check_rate(int d, double omega)
{
    enum { SAMPLES = 60 };
    HELD(rotating) r = pairs(d);
    for (int k = 0; k < SAMPLES; k++) turn(&r, omega);
    assert_true(check_tracks(&r, omega * SAMPLES, SAMPLES, SAMPLES * ROUNDING) >= 2 * d);
    for (int v = 0; v < 2 * d; v++)
        for (int c = 0; c < d; c++) {
            const hd_phase *phase = phase_of(&r, v, c);
            assert_int_equal(phase->step, r.step->subspace);
            assert_int_equal(phase->col, r.step->col + v);
            if (phase->state != HD_PHASE_TRACKED) continue;
            CHECK_CLOSE(remainder(phase->phase - atan2(phase->b, phase->a), 2.0 * PI), 0.0,
                        SAMPLES * ROUNDING);
            CHECK_CLOSE(phase->omega, omega, ROUNDING);
            CHECK_CLOSE(phase->omega_error, 0.0, ROUNDING);
        }
}

TEST(a_rotation_gives_its_omega_back)
{
    const double rates[] = {0.0, 0.003, 0.4, 0.5 * PI, 0.9 * PI};
    for (int d = 1; d <= 4; d *= 2)
        for (int k = 0; k < 5; k++) {
            check_rate(d, rates[k]);
            check_rate(d, -rates[k]);
        }
}

/** With dt of its own and disks that move; 16 samples before an error is known. */
TEST(time_is_what_it_is_told)
{
    HELD(rotating) r = pairs(2);
    r.dt = 0.25;
    for (int k = 1; k <= 40; k++) {
        world_move(&r.w, 0.1);
        turn(&r, -1.7);
        const hd_phase *phase = phase_of(&r, 0, 0);
        CHECK_CLOSE(phase->time, 0.25 * k, ROUNDING);
        CHECK_CLOSE(phase->omega, -1.7, 1e3 * ROUNDING / k);
        assert_true(k < 16 ? phase->omega_error < 0 : phase->omega_error >= 0);
    }
}

/** Vectors outside, pairs inside, all LP steps one after the other. */
TEST(phases_lie_in_order)
{
    const hd_scene_def def = scene(.number = 60, .density = 0.5, .aspect = 0.8, .boundary[1] = R,
                                   .seed = 9, .max_mode_number = 1);
    HELD(world) w = world_create(def, 10, 1);
    double rate, error;
    MADE(hd_phases, phases, w.steps, HD_MODE_LP);
    int index = 0;
    for (int k = 0; k < hd_steps_count(w.steps); k++) {
        const hd_step *step = hd_steps_step(w.steps, k);
        if (step->kind != HD_MODE_LP) continue;
        const hd_modulations m = hd_fields_subspace(w.fields, step->subspace)->modulations;
        for (int v = 0; v < step->expected; v++)
            for (int c = 0; c < m.count; c++) {
                const hd_phase *phase = hd_phases_phase(phases, index++);
                assert_int_equal(phase->step, k);
                assert_int_equal(phase->modulation, m.bits[c]);
                assert_int_equal(phase->state, HD_PHASE_UNRESOLVED);
                assert_int_equal(phase->col, -1);
                assert_true(phase->omega_error < 0);
            }
    }
    assert_int_equal(hd_phases_count(phases), index);
    assert_int_equal(hd_phases_velocity(phases).phases, 0);
    CHECK_CLOSE(hd_phases_velocity(phases).k_max, 0.0, 0.0);
    assert_true(hd_phases_velocity(phases).v_error < 0);
    for (int k = 0; k < hd_steps_count(w.steps); k++)
        assert_false(hd_phases_rate(phases, k, &rate, &error));
}

/* ---- noise --------------------------------------------------------------------------------- */

typedef struct honesty {
    double omega, velocity; /**< rms deviation over mean stated error */
} honesty;

/** Phases with white noise, or that diffuse by this much a sample; one for each vector. */
static honesty honesty_of(double white, double diffusing, int samples)
{
    enum { REPEATS = 100 };
    const double omega = 1.1;
    HELD(rotating) r = pairs(1);
    double off[2] = {0.0}, stated[2] = {0.0}, before[VECTORS_MAX];
    const double k = r.step->wave.number;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        begin(&r);
        for (int m = 0; m < 2; m++) before[m] = 0.0;
        for (int t = 0; t < samples; t++) {
            for (int m = 0; m < 2; m++) {
                const double now = white * random_normal(&r.w.random);
                r.angle[m][0] += now - before[m] + diffusing * random_normal(&r.w.random);
                before[m] = now;
            }
            turn(&r, omega);
        }
        double rate, error;
        const hd_phase *phase = phase_of(&r, 0, 0);
        const hd_velocity v = hd_phases_velocity(r.phases);
        assert_true(hd_phases_rate(r.phases, phase->step, &rate, &error)); /* of the only step */
        CHECK_CLOSE(v.v, fabs(rate) / k, ROUNDING);
        CHECK_CLOSE(v.v_sampling_error, error / k, ROUNDING);
        assert_int_equal(phase->state, HD_PHASE_TRACKED);
        assert_int_equal(v.phases, 2);
        off[0] += pow(phase->omega - omega, 2.0) / REPEATS;
        off[1] += pow(v.v - omega / k, 2.0) / REPEATS;
        stated[0] += phase->omega_error / REPEATS;
        stated[1] += v.v_sampling_error / REPEATS;
    }
    return (honesty){sqrt(off[0]) / stated[0], sqrt(off[1]) / stated[1]};
}

/** Regression and error are made for it: 100 repetitions know the ratio to 7 %, 16 to 31 blocks
 * their mean error to 3 % below; the samples beyond the last whole block to 10 %. */
TEST(errors_of_diffusing_phases_are_honest)
{
    const int samples[] = {60, 400};
    for (int k = 0; k < 2; k++) {
        const honesty h = honesty_of(0.0, 0.2, samples[k]);
        CHECK_CLOSE(h.omega, 1.0, 0.25);
        CHECK_CLOSE(h.velocity, 1.0, 0.25);
    }
}

/** Both at once, as LP modes do. */
TEST(errors_of_trembling_phases_are_never_too_small)
{
    const honesty white = honesty_of(0.1, 0.0, 400), both = honesty_of(0.1, 0.1, 400);
    /* regression over n samples: sqrt(12 / n); stated half of sqrt(1.2) sqrt(2 blocks) of 25
     * blocks. v: 1 / sqrt(50) */
    CHECK_CLOSE(white.omega, 0.045, 0.25 * 0.045);
    CHECK_CLOSE(white.velocity, 0.14, 0.4 * 0.14);
    CHECK_CLOSE(both.omega, 0.9, 0.3);
    CHECK_CLOSE(both.velocity, 0.9, 0.3);
}

/** Turns by 0.9 pi, and noise that would cross over without a prediction. */
TEST(predictions_unwrap_far_turns)
{
    enum { SAMPLES = 400 };
    const double omega = 0.9 * PI, noise = 0.15;
    HELD(rotating) r = pairs(2);
    double before = 0.0;
    for (int t = 0; t < SAMPLES; t++) {
        const double now = t < 5 ? 0.0 : noise * random_normal(&r.w.random);
        for (int m = 0; m < 4; m++)
            for (int c = 0; c < 2; c++) r.angle[m][c] += now - before;
        before = now;
        turn(&r, omega);
    }
    assert_true(check_tracks(&r, omega * SAMPLES, SAMPLES, 5.0 * noise) >= 4);
    CHECK_CLOSE(hd_phases_velocity(r.phases).v * r.step->wave.number, omega, 5.0 * noise / SAMPLES);
}

/* ---- velocity ------------------------------------------------------------------------------ */

/** Vectors that turn the slower the more of them lies in the fields, as at low density: what their
 * whole turns on average is less than their phases show. */
TEST(strength_that_goes_with_the_rate_is_no_bias)
{
    enum { SAMPLES = 400 };
    const double omega = 0.7, unevenness = 0.4;
    HELD(rotating) r = pairs(1);
    for (int t = 0; t < SAMPLES; t++) {
        for (int m = 0; m < 2; m++) {
            const double phase = atan2(r.im[m][0], r.re[m][0]) + r.angle[m][0];
            r.angle[m][0] += omega * unevenness * cos(2.0 * phase);
            r.strength[m] = 0.75 - 0.2 * cos(2.0 * phase);
        }
        turn(&r, omega);
    }
    /* only the ends count, which what is no field turns by less than this */
    const double end = 0.5, mean = 0.5 * (r.angle[0][0] + r.angle[1][0]) / SAMPLES;
    CHECK_CLOSE(hd_phases_velocity(r.phases).v * r.step->wave.number, mean, 2.0 * end / SAMPLES);
}

/** LP(1,0) and LP(2,0) of a channel, at rates of their own. */
typedef struct channel {
    world w;
    hd_phases *phases;
    double k[2], phase[2][2], before[2];
} channel;

static channel channel_create(void)
{
    const hd_scene_def def = scene_from(scene_in_box(40, 50.0, 1.5, R, R, 9), .max_mode_number = 2);
    channel ch = {.w = world_create(def, 4, 1)};
    const double exponents[4] = {1.6, 1.6, 0.8, 0.8};
    CHECK_OK(hd_phases_create(&ch.phases, ch.w.steps, HD_MODE_LP));
    for (int n = 0; n < 2; n++) {
        const int s = world_subspace(&ch.w, HD_MODE_LP, n + 1, 0);
        ch.k[n] = hd_fields_subspace(ch.w.fields, s)->wave.number;
        world_span(&ch.w, 2 - 2 * n, &s, 1, 0.0);
    }
    world_look(&ch.w);
    world_stretch(&ch.w, exponents);
    hd_steps_find(ch.w.steps, ch.w.spectrum);
    for (int n = 0; n < 2; n++) assert_true(world_step(&ch.w, HD_MODE_LP, n + 1, 0)->resolved);
    return ch;
}

/** Relative error of v because of the walls of this box: that of the relation of LP. */
static double box_error_of(const channel *ch)
{
    const double error = hd_relation_of(&ch->w.scene, HD_MODE_LP).box_error;
    assert_true(error > 0.25 / 1.5);
    return error;
}

static void channel_free(channel *ch)
{
    hd_phases_free(ch->phases);
    world_free(&ch->w);
}

static void channel_show(channel *ch, double time)
{
    for (int n = 0; n < 2; n++)
        for (int m = 0; m < 2; m++) {
            const int s = world_subspace(&ch->w, HD_MODE_LP, n + 1, 0);
            const int column = hd_fields_subspace(ch->w.fields, s)->column;
            double dq[ROWS_MAX] = {0.0};
            world_add_field(&ch->w, dq, column, cos(ch->phase[n][m]));
            world_add_field(&ch->w, dq, column + 1, sin(ch->phase[n][m]));
            world_write_mode(&ch->w, 2 - 2 * n + m, dq, 1.0);
        }
    CHECK_OK(hd_modes_measure(ch->w.modes, hd_frame_columns(ch->w.frame), ch->w.q, ch->w.p));
    hd_phases_add(ch->phases, ch->w.steps, time);
}

/** omega[n] of both vectors, diffusing together. */
static hd_velocity velocity_of(channel *ch, const double omega[2], const double noise[2])
{
    hd_phases_clear(ch->phases);
    for (int n = 0; n < 2; n++) ch->phase[n][0] = 0.0, ch->phase[n][1] = 0.5 * PI;
    for (int t = 0; t < 200; t++) {
        channel_show(ch, t);
        for (int n = 0; n < 2; n++) {
            const double step = omega[n] + noise[n] * random_normal(&ch->w.random);
            for (int m = 0; m < 2; m++) ch->phase[n][m] += step;
        }
    }
    return hd_phases_velocity(ch->phases);
}

/** Weighted: one step is known ten times as well as the other, so the mean is as good as that one.
 */
TEST(velocity_is_the_weighted_mean_of_the_steps)
{
    enum { REPEATS = 100 };
    HELD(channel) ch = channel_create();
    const double v = 3.0, noise[2] = {0.015, 0.15};
    double square = 0.0, stated = 0.0;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        const double sense = repeat % 2 ? -1.0 : 1.0; /* |omega| counts */
        const double omega[2] = {sense * v * ch.k[0], v * ch.k[1]};
        const hd_velocity got = velocity_of(&ch, omega, noise);
        assert_int_equal(got.phases, 4);
        square += pow(got.v - v, 2.0) / REPEATS;
        stated += got.v_sampling_error / REPEATS;
        const double own = got.v_sampling_error * fmax(1.0, got.misfit);
        CHECK_CLOSE(got.v_error, hypot(own, box_error_of(&ch) * got.v), ROUNDING);
    }
    const double best = noise[0] / sqrt(200.0) / ch.k[0];
    CHECK_CLOSE(sqrt(square) / stated, 1.0, 0.25); /* 7 % from 100 repetitions */
    CHECK_CLOSE(sqrt(square) / best, 1.0, 0.25);
}

/** Two steps turn against each other and stray together: what one gains, the other loses. */
TEST(the_error_of_the_velocity_knows_which_way_steps_turn)
{
    HELD(channel) ch = channel_create();
    for (int n = 0; n < 2; n++) ch.phase[n][0] = 0.0, ch.phase[n][1] = 0.5 * PI;
    for (int t = 0; t < 200; t++) {
        channel_show(&ch, t);
        const double stray = 0.01 * random_normal(&ch.w.random);
        for (int n = 0; n < 2; n++)
            for (int m = 0; m < 2; m++) ch.phase[n][m] += ch.k[n] * ((n == 0 ? 3.0 : -3.0) + stray);
    }
    double rate, error;
    const hd_velocity v = hd_phases_velocity(ch.phases);
    assert_true(hd_phases_rate(ch.phases, world_subspace(&ch.w, HD_MODE_LP, 1, 0), &rate, &error));
    CHECK_CLOSE(v.v, 3.0, ROUNDING);
    CHECK_WITHIN(v.v_sampling_error, 0.0, 1e-3 * error / ch.k[0]);
}

/** One that was lost for a while has turned in few of the blocks: 61 are there, 8 are its own. */
TEST(a_step_that_comes_late_knows_its_error_late)
{
    HELD(channel) ch = channel_create();
    const double lost[4] = {3.2, 1.6, 0.8, 0.8}, found[4] = {1.6, 1.6, 0.8, 0.8};
    double rate, error[2];
    for (int t = 0; t < 70; t++) {
        if (t == 60 || t == 61) {
            hd_spectrum_clear(ch.w.spectrum);
            world_stretch(&ch.w, t == 60 ? lost : found);
            hd_steps_find(ch.w.steps, ch.w.spectrum);
            assert_int_equal(world_step(&ch.w, HD_MODE_LP, 2, 0)->resolved, t == 61);
        }
        channel_show(&ch, t);
        for (int n = 0; n < 2; n++)
            for (int m = 0; m < 2; m++) ch.phase[n][m] += 3.0 * ch.k[n];
    }
    for (int n = 0; n < 2; n++)
        assert_true(hd_phases_rate(ch.phases, world_subspace(&ch.w, HD_MODE_LP, n + 1, 0), &rate,
                                   &error[n]));
    assert_true(error[0] >= 0 && error[1] < 0);
}

/** Steps that contradict each other by 0.5, of errors of 0.001 / sqrt(200) and more: then the error
 * of v is what they contradict each other by. */
TEST(contradictions_are_a_misfit)
{
    HELD(channel) ch = channel_create();
    const double noise[2] = {0.001 * ch.k[0], 0.001 * ch.k[1]};
    const double omega[2] = {3.0 * ch.k[0], 3.5 * ch.k[1]};
    const hd_velocity v = velocity_of(&ch, omega, noise);
    double rate[2], error[2];
    for (int n = 0; n < 2; n++) {
        const int s = world_subspace(&ch.w, HD_MODE_LP, n + 1, 0);
        assert_true(hd_phases_rate(ch.phases, s, &rate[n], &error[n]));
        rate[n] /= ch.k[n];
        error[n] /= ch.k[n];
    }
    assert_true(v.v > 3.0 && v.v < 3.5);
    assert_true(v.v_sampling_error > 0 && v.v_sampling_error < 0.001);
    /* chi^2 of two steps, w1 w2 / (w1 + w2) (v1 - v2)^2, over one freedom; a small difference of
       squares: some hundred times their rounding */
    const double misfit = fabs(rate[0] - rate[1]) / hypot(error[0], error[1]);
    assert_true(misfit > 1000.0);
    CHECK_CLOSE(v.misfit, misfit, 1e3 * DBL_EPSILON * misfit);
    /* of independent steps w^(-1/2), w = w1 + w2; errors of the steps are known to 15 % each */
    const double alone = 1.0 / hypot(1.0 / error[0], 1.0 / error[1]);
    const double own = sqrt(pow(v.v_error, 2.0) - pow(box_error_of(&ch) * v.v, 2.0));
    CHECK_CLOSE(own, misfit * alone, 0.4 * misfit * alone);
    CHECK_WITHIN(own, 0.1, 0.4);
    CHECK_CLOSE(v.k_min, ch.k[0], 0.0);
    CHECK_CLOSE(v.k_max, ch.k[1], 0.0);
}

TEST(sampling_follows_the_largest_exponent)
{
    HELD(channel) ch = channel_create();
    CHECK_CLOSE(hd_phases_sampling(ch.phases, ch.w.steps), 0.75 * PI / (1.25 * 1.6), ROUNDING);
    hd_spectrum_clear(ch.w.spectrum);
    world_stretch(&ch.w, (const double[]){1.6, 1.6, 2.0, 2.0});
    hd_steps_find(ch.w.steps, ch.w.spectrum);
    CHECK_CLOSE(hd_phases_sampling(ch.phases, ch.w.steps), 0.75 * PI / (1.25 * 2.0), ROUNDING);
    hd_steps_clear(ch.w.steps);
    assert_true(isinf(hd_phases_sampling(ch.phases, ch.w.steps)));
}

/** LP(1,0) and LP(0,1) of a square box share their set and turn alike: each still has a rate. */
TEST(shared_sets_turn_too)
{
    hd_scene_def def = scene_of(60, 0.5, 1.0, R, R, 9);
    def.max_wave_number = hd_wave_component(&def, 0, 1);
    HELD(world) w = world_create(def, 4, 1);
    MADE(hd_phases, phases, w.steps, HD_MODE_LP);
    const int both[] = {world_subspace(&w, HD_MODE_LP, 1, 0), world_subspace(&w, HD_MODE_LP, 0, 1)};
    double rotation[16], exponents[4] = {0.8, 0.8, 0.8, 0.8};
    world_span(&w, 0, both, 2, 0.0);
    world_look(&w);
    world_stretch(&w, exponents);
    hd_steps_find(w.steps, w.spectrum);
    assert_int_equal(hd_steps_step(w.steps, both[0])->members, 2);
    random_rotation(&w.random, rotation, 4);
    for (int t = 0; t <= 50; t++) {
        for (int m = 0; m < 4; m++) {
            double dq[ROWS_MAX] = {0.0};
            for (int s = 0; s < 2; s++) {
                const int column = hd_fields_subspace(w.fields, both[s])->column;
                const double *z = rotation + 4 * m + 2 * s, c = cos(0.6 * t), i = sin(0.6 * t);
                world_add_field(&w, dq, column, c * z[0] - i * z[1]);
                world_add_field(&w, dq, column + 1, i * z[0] + c * z[1]);
            }
            world_write_mode(&w, m, dq, 1.0);
        }
        CHECK_OK(hd_modes_measure(w.modes, hd_frame_columns(w.frame), w.q, w.p));
        hd_phases_add(phases, w.steps, t);
    }
    /* other subspaces of the set overlap by N^(-1/2): coefficients are off by as much, at a fixed
     * phase */
    for (int k = 0; k < hd_phases_count(phases); k++) {
        const hd_phase *phase = hd_phases_phase(phases, k);
        if (phase->state != HD_PHASE_TRACKED || phase->time < 50.0) continue;
        CHECK_CLOSE(phase->omega, 0.6, 0.02);
    }
    CHECK_CLOSE(hd_phases_velocity(phases).v, 0.6 / hd_wave_component(&def, 0, 1), 0.1);
    assert_true(hd_phases_velocity(phases).phases >= 2);
}
