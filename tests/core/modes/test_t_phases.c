/** Phases of T steps: where their waves stand. */
#include "rotating.h"

/** The code is that of the LP phases: what turns is seen to. */
TEST(a_turn_would_be_seen)
{
    enum { SAMPLES = 60 };
    for (int d = 1; d <= 2; d++)
        for (double omega = -0.4; omega < 0.5; omega += 0.4) {
            HELD(rotating) r = t_pairs(d);
            for (int k = 0; k < SAMPLES; k++) turn(&r, omega);
            assert_true(check_tracks(&r, omega * SAMPLES, SAMPLES, SAMPLES * ROUNDING) >= 2 * d);
            CHECK_CLOSE(phase_of(&r, 0, 0)->omega, omega, ROUNDING);
            CHECK_CLOSE(phase_of(&r, 0, 0)->omega_error, 0.0, ROUNDING);
        }
}

/** dq of curl A of a cosine along x, displaced by s, and of the function of y with these bits. */
static void write_wave(rotating *r, int col, double s, unsigned bits)
{
    double dq[ROWS_MAX], at[2], a[3];
    for (int j = 0; j < r->w.scene.number; j++) {
        at[0] = r->w.q[2 * j] - s;
        at[1] = r->w.q[2 * j + 1];
        modulation_at(&r->w.scene, a, &r->step->wave, bits, at);
        dq[2 * j] = a[2];
        dq[2 * j + 1] = -a[1];
    }
    world_write_mode(&r->w, col, dq, 1.0);
}

/** A wave that stands at s has the phase k s: fields have norms that differ by some percent. */
static void check_place(int d, double part)
{
    const double NORMS = 0.15;
    HELD(rotating) r = t_pairs(d);
    const double k = r.step->wave.k[0], s = part / k;
    for (int m = 0; m < 2 * d; m++)
        write_wave(&r, r.step->col + m, m % 2 ? s : s - 0.5 * PI / k, m / 2 ? HD_SIN_Y : 0);
    CHECK_OK(hd_modes_measure(r.w.modes, hd_frame_columns(r.w.frame), r.w.q, r.w.p));
    hd_phases_clear(r.phases);
    hd_phases_add(r.phases, r.w.steps, 1.0);
    for (int m = 0; m < 2 * d; m++) {
        const hd_phase *phase = phase_of(&r, m, m / 2);
        assert_int_equal(phase->state, HD_PHASE_TRACKED);
        CHECK_CLOSE(remainder(phase->phase - part + (m % 2 ? 0.0 : 0.5 * PI), 2.0 * PI), 0.0,
                    NORMS);
    }
}

TEST(the_phase_is_where_the_wave_stands)
{
    for (int d = 1; d <= 2; d++)
        for (double part = -3.0; part < 3.1; part += 0.75) check_place(d, part);
}

/** Vectors outside, pairs inside, of all T steps; the cosine's modulation. A single field has no
 * phase. */
static void check_order(hd_boundary x, hd_boundary y, int count)
{
    const hd_scene_def def = scene(.number = 60, .density = 0.5, .aspect = 0.8, .boundary[0] = x,
                                   .boundary[1] = y, .seed = 9, .max_mode_number = 1);
    HELD(world) w = world_create(def, 10, 1);
    int index = 0;
    MADE(hd_phases, phases, w.steps, HD_MODE_T);
    assert_int_equal(hd_phases_count(phases), count);
    for (int k = 0; k < hd_steps_count(w.steps); k++) {
        const hd_step *step = hd_steps_step(w.steps, k);
        if (step->kind != HD_MODE_T || step->expected == 1) continue;
        const int sine = x == P && step->wave.n[0] > 0 ? HD_SIN_X : HD_SIN_Y;
        const hd_modulations m = hd_fields_subspace(w.fields, step->subspace)->modulations;
        for (int v = 0; v < step->expected; v++)
            for (int c = 0; c < m.count; c++) {
                if (m.bits[c] & sine) continue;
                const hd_phase *phase = hd_phases_phase(phases, index++);
                assert_int_equal(phase->step, k);
                assert_int_equal(phase->modulation, m.bits[c]);
                assert_int_equal(phase->state, HD_PHASE_UNRESOLVED);
            }
    }
    assert_int_equal(index, count);
}

TEST(phases_lie_in_order)
{
    check_order(P, P, 2 + 2 + 8); /* (0,1), (1,0), (1,1) */
    check_order(P, R, 2);         /* (1,0) has none, (0,1) one field, (1,1) a pair */
    check_order(R, P, 2);
    check_order(R, R, 0);
}

/** Phases that diffuse, all of the step alike: no rotation, and D as it was put in. */
TEST(diffusion_is_measured_and_nothing_turns)
{
    enum { REPEATS = 80, SAMPLES = 300 };
    const double D = 0.004;
    HELD(rotating) r = t_pairs(1);
    double off = 0.0, stated = 0.0, sum = 0.0, square = 0.0, of_error = 0.0;
    r.dt = 0.5;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        begin(&r);
        for (int t = 0; t < SAMPLES; t++) {
            const double step = sqrt(2.0 * D * r.dt) * random_normal(&r.w.random);
            for (int m = 0; m < 2; m++) r.angle[m][0] += step;
            turn(&r, 0.0);
        }
        double error;
        const hd_phase *phase = phase_of(&r, 0, 0);
        const double got = hd_phases_diffusion(r.phases, r.first, &error);
        assert_true(error > 0);
        off += pow(phase->omega, 2.0) / REPEATS;
        stated += phase->omega_error / REPEATS;
        sum += got / REPEATS;
        square += pow(got - D, 2.0) / REPEATS;
        of_error += error / REPEATS;
    }
    CHECK_CLOSE(sqrt(off) / stated, 1.0, 0.3); /* 8 % from 80 repetitions */
    CHECK_CLOSE(sum, D, 4.0 * of_error / sqrt(REPEATS));
    CHECK_CLOSE(sqrt(square) / of_error, 1.0, 0.3);
}

TEST(without_blocks_there_is_no_diffusion)
{
    HELD(rotating) r = t_pairs(1);
    double error = 0.0;
    for (int t = 1; t < 16; t++) {
        turn(&r, 0.0);
        assert_true(hd_phases_diffusion(r.phases, r.first, &error) < 0 && error < 0);
    }
    turn(&r, 0.0);
    CHECK_CLOSE(hd_phases_diffusion(r.phases, r.first, &error), 0.0, ROUNDING);
    CHECK_CLOSE(error, 0.0, ROUNDING);
}
