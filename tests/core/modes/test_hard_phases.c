/** Phases at the edge of what can be unwrapped: right, or said not to be known. */
#include "rotating.h"

typedef struct verdict {
    int tracked, coarse;
    double worst; /**< deviation of a tracked phase from the truth [rad] */
} verdict;

/** A step that turns by `angle` between samples while its exponent says that it may turn by `most`,
 * all its vectors trembling together. A tracked phase is right to the trembling; a coarse one
 * states no rate. */
static verdict follow(int d, double angle, double most, double noise)
{
    enum { SAMPLES = 40 };
    HELD(rotating) r = pairs(d);
    verdict v = {0};
    double before = 0.0, total = 0.0;
    find(&r, most / 1.25);
    begin(&r);
    for (int t = 0; t < SAMPLES; t++) {
        const double now = noise * random_normal(&r.w.random);
        total += angle + now - before;
        turn(&r, angle + now - before);
        before = now;
    }
    for (int slot = 0; slot < 2 * d; slot++)
        for (int c = 0; c < d; c++) {
            const hd_phase *phase = phase_of(&r, slot, c);
            const double start = atan2(r.im[slot][c], r.re[slot][c]);
            v.coarse += phase->state == HD_PHASE_COARSE;
            if (phase->state == HD_PHASE_COARSE) assert_true(phase->omega_error < 0);
            if (phase->state != HD_PHASE_TRACKED || phase->time < SAMPLES) continue;
            v.tracked++;
            v.worst = fmax(v.worst, fabs(phase->phase - start - total));
            CHECK_CLOSE(phase->omega, angle, 0.1 * noise + ROUNDING);
        }
    const hd_velocity velocity = hd_phases_velocity(r.phases);
    if (v.coarse) assert_int_equal(velocity.phases, 0);
    if (velocity.phases > 0)
        CHECK_CLOSE(velocity.v * r.step->wave.number, fabs(angle), 0.1 * noise + ROUNDING);
    return v;
}

/** v / c_L is 1.14 at most, 1.25 is allowed for: whatever the rate below that, up to pi between
 * samples it is tracked, from pi on it is coarse. */
TEST(turns_up_to_pi_are_tracked_and_coarse_beyond)
{
    static const double parts[] = {0.5,    0.75,  0.9,  0.97, 0.999, 0.9999,
                                   1.0001, 1.001, 1.03, 1.25, 2.0,   3.9};
    static const double ratios[] = {-1.25, -1.14, -0.5, 0.0, 0.5, 1.0, 1.14, 1.25};
    for (int d = 1; d <= 2; d++)
        for (size_t k = 0; k < sizeof parts / sizeof *parts; k++)
            for (size_t m = 0; m < sizeof ratios / sizeof *ratios; m++) {
                const double most = parts[k] * PI;
                const verdict v = follow(d, ratios[m] / 1.25 * most, most, 0.0);
                assert_true(parts[k] < 1.0 ? v.coarse == 0 : v.tracked == 0);
                assert_true(v.tracked + v.coarse >= 2 * d);
                CHECK_CLOSE(v.worst, 0.0, 100.0 * ROUNDING);
            }
}

/** v / c_L as measured, of the 1.25 that is allowed for. */
static const double FASTEST = 1.14 / 1.25;

/** Returns how many tracks there are. */
static int check_noise(double most, double fastest)
{
    int tracked = 0;
    for (int d = 1; d <= 2; d++)
        for (int m = -5; m <= 5; m++) {
            const verdict v = follow(d, m / 5.0 * fastest * most, most, 0.1);
            assert_int_equal(v.coarse, 0);
            CHECK_CLOSE(v.worst, 0.0, 100.0 * ROUNDING);
            tracked += v.tracked;
        }
    return tracked;
}

/** A run samples every 0.75 pi at most; 5 % more for exponents that are not yet known. From 0.95 pi
 * on, which no measured velocity reaches before it is called coarse, the first samples could fall
 * on the other side of pi. */
TEST(noise_does_not_lose_turns)
{
    assert_true(check_noise(1.05 * 0.75 * PI, 1.0) + check_noise(0.999 * PI, FASTEST) >= 120);
}

/** Two vectors change places, and one of them its sign, within steps that turn as far as a run lets
 * them. */
TEST(exchanges_within_far_turns_are_followed)
{
    static const double parts[] = {-0.95, -0.75, -0.6, 0.6, 0.75, 0.95};
    for (int d = 1; d <= 4; d *= 2)
        for (size_t k = 0; k < sizeof parts / sizeof *parts; k++) {
            HELD(rotating) r = pairs(d);
            for (int t = 0; t < 60; t++) {
                if (t >= 10) exchange(&r, t % (2 * d), (t + 1) % (2 * d), t % 2 ? -1.0 : 1.0);
                turn(&r, parts[k] * PI);
                check_columns(&r);
            }
            assert_true(check_tracks(&r, 60 * parts[k] * PI, 60.0, 60.0 * ROUNDING) >= 2 * d);
        }
}

/** A sign flip of every vector at every second sample, alone or all at once. */
TEST(sign_flips_do_not_turn_a_phase)
{
    for (int d = 1; d <= 4; d *= 2)
        for (int together = 0; together < 2; together++) {
            HELD(rotating) r = pairs(d);
            for (int t = 0; t < 60; t++) {
                for (int v = 0; t >= 10 && v < 2 * d; v++)
                    if (together ? t % 2 == 0 : t % (2 * d) == v) r.sign[v] *= -1.0;
                turn(&r, 0.7 * PI);
            }
            assert_true(check_tracks(&r, 60 * 0.7 * PI, 60.0, 60.0 * ROUNDING) >= 2 * d);
        }
}

/** The amplitude of one pair, in all vectors, times this. */
static void scale_pair(rotating *r, int c, double re[][PAIRS_MAX], double im[][PAIRS_MAX],
                       double factor)
{
    for (int m = 0; m < 2 * r->d; m++) {
        r->re[m][c] = factor * re[m][c];
        r->im[m][c] = factor * im[m][c];
    }
}

static int strong_tracks(const rotating *r, int c)
{
    int strong = 0;
    for (int v = 0; v < 2 * r->d; v++) strong += strength_of(phase_of(r, v, c)) >= WEAK;
    return strong;
}

/** Pair 0 fades away and comes back; `gone` samples it is nothing but rounding. Its phase is then
 * what it would have been, or begun anew; the other pair does not notice. */
static void check_vanishing_pair(int gone, double omega)
{
    enum { FADING = 4, GAP_MAX = 16 }; /* samples of absence that are bridged [T13] */
    HELD(rotating) r = pairs(2);
    double re[VECTORS_MAX][PAIRS_MAX], im[VECTORS_MAX][PAIRS_MAX];
    memcpy(re, r.re, sizeof re);
    memcpy(im, r.im, sizeof im);
    for (int t = 0; t < 20; t++) turn(&r, omega);
    for (int t = 0; t < 2 * FADING + gone; t++) {
        const int from_end = 2 * FADING + gone - 1 - t, near = t < from_end ? t : from_end;
        scale_pair(&r, 0, re, im, near < FADING ? 1.0 - (near + 1.0) / FADING : 0.0);
        turn(&r, omega);
        for (int v = 0; v < 4; v++) {
            const hd_phase *phase = phase_of(&r, v, 0);
            assert_true(isfinite(phase->phase) && isfinite(phase->omega));
            if (near >= FADING - 1) assert_int_equal(phase->state, HD_PHASE_WEAK);
        }
    }
    scale_pair(&r, 0, re, im, 1.0);
    for (int t = 0; t < 20; t++) turn(&r, omega);
    const double time = 40.0 + 2 * FADING + gone;
    const int strong[2] = {strong_tracks(&r, 0), strong_tracks(&r, 1)};
    const int whole = check_tracks(&r, omega * time, time, time * ROUNDING);
    assert_true(strong[0] >= 2 && strong[1] >= 2);
    assert_true(gone + 2 * FADING > GAP_MAX || whole == strong[0] + strong[1]);
    assert_true(gone <= GAP_MAX || whole == strong[1]);
    for (int k = 0; k < 8; k++) {
        const hd_phase *phase = phase_of(&r, k / 2, k % 2);
        if (phase->state == HD_PHASE_TRACKED && phase->time > 1.0)
            CHECK_CLOSE(phase->omega, omega, ROUNDING);
    }
    CHECK_CLOSE(hd_phases_velocity(r.phases).v * r.step->wave.number, fabs(omega), ROUNDING);
}

TEST(a_pair_that_vanishes_comes_back_with_its_turns)
{
    for (int gone = 1; gone <= 25; gone += gone == 8 ? 9 : 1)
        for (int sense = -1; sense <= 1; sense += 2) {
            check_vanishing_pair(gone, sense * 0.3);
            check_vanishing_pair(gone, sense * 0.75 * PI);
        }
}
