/** Vectors of an LP step that are sampled as seldom as the phases allow: what the rate is known for
 * [T13]. */
#include "modes/phases.h"
#include "modes/phase_predictor.h"
#include "rotating.h"

/** Of `pairs`: 0.75 pi / (1.25 lambda), lambda = 2.4. */
static const double UNSEEN = 0.75 / (1.25 * 2.4) * 3.14159265358979323846;
/** Phases may be off by this before samples come closer [rad]. */
static const double OFF = 0.4;

/* ---- the estimate alone -------------------------------------------------------------------- */

/** Phases that diffuse, seen every `dt[k % count]`. */
static hd_phase_predictor foreseen(hd_random *random, double diffusion, const double *dt, int count,
                                   int samples)
{
    hd_phase_predictor f;
    hd_phase_predictor_clear(&f, 2);
    for (int k = 0; k < 5; k++) hd_phase_predictor_turn(&f, 1.3 * dt[k % count], dt[k % count]);
    for (int k = 0; k < samples; k++) {
        const double now = dt[k % count];
        const double miss = sqrt(diffusion * now) * random_normal(random);
        hd_phase_predictor_sample(&f, now);
        for (int t = 0; t < 8; t++) hd_phase_predictor_miss(&f, miss, now, 0.5);
        hd_phase_predictor_turn(&f, 1.3 * now + miss, now);
    }
    return f;
}

/** OFF^2 / D, or a bound: 1, then twice the mean distance, in the end 10 times what needs no
 * prediction. A hundred samples know D to 15 %. */
TEST(diffusion_says_how_far)
{
    hd_random random = hd_random_seeded(5, 0);
    const double dt[] = {2.0};
    const struct {
        double diffusion, expected;
    } cases[] = {{0.0, 4.0},
                 {OFF * OFF / 8.0, 4.0},
                 {OFF * OFF / 3.0, 3.0},
                 {OFF * OFF / 1.8, 1.8},
                 {OFF * OFF / 0.5, 1.0},
                 {1.5 * OFF * OFF, 1.0}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        const hd_phase_predictor f = foreseen(&random, cases[k].diffusion, dt, 1, 2000);
        CHECK_CLOSE(f.omega, 1.3, 0.05);
        CHECK_CLOSE(hd_phase_predictor_sampling(&f, 1.0), cases[k].expected,
                    0.5 * cases[k].expected);
        CHECK_CLOSE(fmin(hd_phase_predictor_sampling(&f, 0.3), 3.0), fmin(cases[k].expected, 3.0),
                    1.2);
        assert_true(hd_phase_predictor_sampling(&f, 0.3) <= 3.0 &&
                    hd_phase_predictor_gap(&f, 0.3) <= 6.3);
        assert_true(hd_phase_predictor_gap(&f, 1.0) >=
                    4.0 / 3.0 * hd_phase_predictor_sampling(&f, 1.0));
    }
}

/** What diffuses is foreseen alike from samples at any distances, many short ones included. */
TEST(distances_make_no_difference)
{
    hd_random random = hd_random_seeded(6, 0);
    const double all[][6] = {{3.0, 3.0, 3.0, 3.0, 3.0, 3.0},
                             {2.1, 4.9, 4.6, 0.3, 3.0, 1.0},
                             {4.0, 0.01, 0.02, 0.01, 0.02, 0.01}};
    for (int k = 0; k < 3; k++) {
        double mean = 0.0;
        for (int repeat = 0; repeat < 50; repeat++) {
            const hd_phase_predictor f = foreseen(&random, OFF * OFF / 4.0, all[k], 6, 300);
            mean += hd_phase_predictor_sampling(&f, 0.6) / 50.0;
        }
        CHECK_CLOSE(mean, 4.0, 0.4); /* 2 % statistics, 4 % bias of 1 / D, 3 % error of omega */
    }
}

/** Long ones count as much as they are long. */
TEST(the_rate_is_a_mean_over_time)
{
    hd_phase_predictor f;
    hd_phase_predictor_clear(&f, 2);
    hd_phase_predictor_turn(&f, 1.0, 1.0);
    hd_phase_predictor_turn(&f, 9.0, 3.0);
    CHECK_CLOSE(f.omega, 2.5, 1e-14);
}

/** What a file keeps goes on as if it had not been kept. */
TEST(a_file_keeps_all)
{
    HELD(rotating) r = pairs(2);
    for (int k = 0; k < 80; k++) {
        r.dt = hd_phases_sampling(r.phases, r.w.steps);
        turn(&r, k % 2 ? 2.0 : 2.1);
    }
    MADE(hd_phases, read, r.w.steps, HD_MODE_LP);
    FILE *file = tmpfile();
    assert_non_null(file);
    hd_archive out = hd_archive_writer(file);
    hd_phases_archive(r.phases, &out, INFINITY);
    CHECK_OK(hd_archive_end(&out));
    rewind(file);
    hd_archive in = hd_archive_reader(file, out.bytes);
    hd_phases_archive(read, &in, INFINITY);
    CHECK_OK(hd_archive_end(&in));
    fclose(file);
    const double sampling = hd_phases_sampling(r.phases, r.w.steps);
    assert_true(sampling > 1.5 * UNSEEN);
    CHECK_CLOSE(hd_phases_sampling(read, r.w.steps), sampling, 0.0);
}

/* ---- what the rate is good for ------------------------------------------------------------- */

/** Goes on by r->dt, its phases diffusing together: vectors of a frame stay orthogonal. */
static void diffuse(rotating *r, double omega, double diffusion)
{
    const double miss = sqrt(diffusion * r->dt) * random_normal(&r->w.random);
    for (int m = 0; m < 2 * r->d; m++)
        for (int c = 0; c < r->d; c++) r->angle[m][c] += miss;
    turn(r, omega);
}

static double sampling(const rotating *r) { return hd_phases_sampling(r->phases, r->w.steps); }

/** Phases that are not where their vectors have turned to since t = 0. */
static int slips(const rotating *r)
{
    int count = 0;
    for (int m = 0; m < 2 * r->d; m++)
        for (int c = 0; c < r->d; c++) {
            const hd_phase *phase = phase_of(r, m, c);
            if (phase->state != HD_PHASE_TRACKED || phase->time < r->time) continue;
            const double start = atan2(r->im[m][c], r->re[m][c]);
            count += fabs(phase->phase - start - r->angle[m][c]) > PI;
        }
    return count;
}

/** As far apart as the phases allow: 2.7 radians are what goes without a prediction. */
TEST(a_learnt_rate_unwraps_two_turns)
{
    const double omega = 2.6;
    for (int d = 1; d <= 2; d++) {
        HELD(rotating) r = pairs(d);
        double longest = 0.0;
        for (int k = 0; k < 2000; k++) {
            r.dt = fmin(sampling(&r), 4.0 * PI / omega);
            assert_true(r.dt <= UNSEEN || k >= 20);
            longest = fmax(longest, r.dt);
            diffuse(&r, omega, 0.01); /* 0.22 in two turns */
            assert_int_equal(slips(&r), 0);
        }
        const hd_velocity v = hd_phases_velocity(r.phases);
        const double k = r.step->wave.number;
        CHECK_CLOSE(longest, 4.0 * PI / omega, 1e-12);
        CHECK_CLOSE(phase_of(&r, 0, 0)->time, r.time, 0.0);
        assert_true(v.v_sampling_error > 0 && v.v_sampling_error < 0.01 * v.v);
        CHECK_CLOSE(v.v, omega / k, 4.0 * v.v_sampling_error);
        CHECK_CLOSE(phase_of(&r, 0, 0)->omega, omega, 4.0 * phase_of(&r, 0, 0)->omega_error);
    }
}

/** Never more than 2 from one sample to the next, and nothing before twenty are known. */
TEST(what_is_not_known_is_not_foreseen)
{
    HELD(rotating) r = pairs(1);
    double before = UNSEEN;
    for (int k = 0; k < 200; k++) {
        const double now = sampling(&r);
        CHECK_CLOSE(k < 20 ? now : UNSEEN, UNSEEN, 1e-12);
        assert_true(now <= 2.0 * before * (1.0 + 1e-12));
        before = r.dt = now;
        diffuse(&r, 2.0, 0.0);
    }
    CHECK_CLOSE(before, 10.0 * UNSEEN, 1e-12);
    hd_phases_clear(r.phases);
    CHECK_CLOSE(sampling(&r), UNSEEN, 1e-12);
    hd_steps_clear(r.w.steps);
    assert_true(isinf(sampling(&r)));
}

/** Mean distance of samples that come as late as they may, after the first 200. */
static double mean_distance(rotating *r, double diffusion)
{
    double sum = 0.0;
    for (int k = 0; k < 500; k++) {
        r->dt = sampling(r);
        diffuse(r, 1.9, diffusion);
        if (k >= 200) sum += r->dt / 300.0;
    }
    return sum;
}

/** Off by pi / 5 rms; and back and forth. */
TEST(scatter_brings_samples_together)
{
    const double parts[] = {6.0, 3.0, 1.8, 0.3, 5.0};
    HELD(rotating) r = pairs(2);
    for (int k = 0; k < 5; k++) {
        const double expected = parts[k] * UNSEEN, got = mean_distance(&r, OFF * OFF / expected);
        CHECK_CLOSE(got, fmax(expected, UNSEEN), 0.25 * expected + 0.1 * UNSEEN);
    }
}

/** A sample a third later than foreseen is too late, and what has been learnt is gone. */
TEST(late_samples_begin_anew)
{
    HELD(rotating) r = pairs(1);
    for (int k = 0; k < 60; k++) {
        r.dt = sampling(&r);
        diffuse(&r, 2.0, OFF * OFF / (4.0 * UNSEEN));
    }
    r.dt = 1.32 * sampling(&r);
    diffuse(&r, 2.0, 0.0);
    assert_int_equal(phase_of(&r, 0, 0)->state, HD_PHASE_TRACKED);
    assert_true(sampling(&r) > 1.5 * UNSEEN);
    r.dt = 1.35 * sampling(&r);
    diffuse(&r, 2.0, 0.0);
    assert_int_equal(phase_of(&r, 0, 0)->state, HD_PHASE_COARSE);
    CHECK_CLOSE(sampling(&r), UNSEEN, 1e-12);
    r.dt = UNSEEN;
    diffuse(&r, 2.0, 0.0);
    assert_int_equal(phase_of(&r, 0, 0)->state, HD_PHASE_TRACKED);
    CHECK_CLOSE(phase_of(&r, 0, 0)->time, UNSEEN, 1e-12);
}

/* ---- any distances ------------------------------------------------------------------------- */

/** Rms deviation over mean stated error, of omega and v. */
static void check_honesty(const double *dt, int count, double *omega_ratio, double *v_ratio)
{
    enum { REPEATS = 100, SAMPLES = 240 };
    const double omega = 1.7, diffusion = 0.05;
    HELD(rotating) r = pairs(1);
    double off[2] = {0.0}, stated[2] = {0.0};
    const double k = r.step->wave.number;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        begin(&r);
        for (int t = 0; t < SAMPLES; t++) {
            r.dt = fmin(dt[t % count], sampling(&r));
            diffuse(&r, omega, diffusion);
        }
        assert_int_equal(slips(&r), 0);
        const hd_phase *phase = phase_of(&r, 0, 0);
        const hd_velocity v = hd_phases_velocity(r.phases);
        off[0] += pow(phase->omega - omega, 2.0) / REPEATS;
        off[1] += pow(v.v - omega / k, 2.0) / REPEATS;
        stated[0] += phase->omega_error / REPEATS;
        stated[1] += v.v_sampling_error / REPEATS;
    }
    *omega_ratio = sqrt(off[0]) / stated[0];
    *v_ratio = sqrt(off[1]) / stated[1];
}

/** 100 repetitions know the ratio to 7 %, 16 to 31 blocks their mean error to 3 %. */
TEST(errors_are_true_at_any_distances)
{
    const double all[][4] = {{3.0, 3.0, 3.0, 3.0}, {2.1, 4.9, 4.6, 0.3}, {0.4, 0.1, 3.7, 0.5}};
    for (int k = 0; k < 3; k++) {
        double omega, v;
        check_honesty(all[k], 4, &omega, &v);
        CHECK_CLOSE(omega, 1.0, 0.25);
        CHECK_CLOSE(v, 1.0, 0.2);
    }
}

/** A vector that is weak in every other sample is not begun anew by the short ones in between. */
TEST(short_samples_do_not_shorten_absences)
{
    HELD(rotating) r = pairs_of(1, 400);
    for (int k = 0; k < 100; k++) {
        r.dt = k < 30 ? UNSEEN : k % 2 ? 0.02 : fmin(2.5, sampling(&r));
        r.strength[1] = k > 40 && k % 4 < 2 ? 0.0 : 1.0;
        diffuse(&r, 1.3, 0.0);
        assert_int_equal(slips(&r), 0);
    }
    CHECK_CLOSE(phase_of(&r, 1, 0)->time, r.time, 1e-9);
}

/** Of far turns, with signs: as many samples apart as the phases allow. */
TEST(exchanges_within_two_turns_are_followed)
{
    for (int d = 1; d <= 4; d *= 2) {
        HELD(rotating) r = pairs(d);
        for (int t = 0; t < 200; t++) {
            if (t >= 20 && t % 2)
                exchange(&r, t % (2 * d), (t + 1) % (2 * d), t % 4 == 1 ? -1.0 : 1.0);
            r.dt = fmin(sampling(&r), 4.0 * PI / 2.6);
            turn(&r, 2.6);
            check_columns(&r);
        }
        assert_int_equal(slips(&r), 0);
        assert_true(check_tracks(&r, 2.6 * r.time, r.time, 2e3 * ROUNDING) >= 2 * d);
    }
}

/* ---- a rate that changes ------------------------------------------------------------------- */

/** Number of phases that lose turns, or are begun anew, while the next 100 samples are taken. */
static int lost_turns(rotating *r, double omega)
{
    double off[VECTORS_MAX];
    int lost = 0;
    for (int m = 0; m < 2 * r->d; m++) off[m] = phase_of(r, m, 0)->phase - r->angle[m][0];
    for (int k = 0; k < 100; k++) {
        r->dt = sampling(r);
        diffuse(r, omega, OFF * OFF / (6.0 * UNSEEN));
    }
    for (int m = 0; m < 2 * r->d; m++)
        lost += strength_of(phase_of(r, m, 0)) >= WEAK &&
                fabs(phase_of(r, m, 0)->phase - r->angle[m][0] - off[m]) > PI;
    return lost;
}

/** Turns are not lost for ever: samples come as close as without a prediction, and 400 later no
 * phase is lost or begun anew any more. (One that turns back as fast is not found again: quarters
 * of a turn look like exchanges.) */
TEST(a_rate_that_jumps_is_found_again)
{
    const double omega = 1.2, jumps[] = {-1.5, -1.2, -0.9, -0.7, -0.4, -0.2, 0.2,
                                         0.3,  0.5,  0.7,  0.8,  0.9,  1.1,  1.3};
    for (size_t k = 0; k < sizeof jumps / sizeof *jumps; k++) {
        HELD(rotating) r = pairs(2);
        for (int t = 0; t < 200; t++) {
            r.dt = sampling(&r);
            diffuse(&r, omega, OFF * OFF / (6.0 * UNSEEN));
        }
        double shortest = r.dt;
        assert_true(shortest > 3.0 * UNSEEN);
        for (int t = 0; t < 400; t++) {
            r.dt = sampling(&r);
            shortest = fmin(shortest, r.dt);
            diffuse(&r, omega + jumps[k], OFF * OFF / (6.0 * UNSEEN));
        }
        const int lost = lost_turns(&r, omega + jumps[k]);
        assert_int_equal(lost, 0);
        assert_true(shortest < 1.1 * UNSEEN);
    }
}
