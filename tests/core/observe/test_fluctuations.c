/** Diffusion of exponents: of triangles whose diagonals fluctuate as is known, and of disks. */
#include "base/random.h"
#include "hdlyap/fluctuations.h"
#include "kept.h"
#include "runs.h"

enum { N = 8 };
/** Of 8 + 3 numbers of each of 100 seeds, whose errors are themselves known to 10 %: 4.5 errors. */
static const double FAR = 4.5;

/** What is fed by hand. */
typedef struct world {
    hd_scene_def scene;
    hd_spectrum *spectrum;
    hd_observing with;
    hd_fluctuations *f;
} world;

static void world_free(world *w)
{
    hd_fluctuations_row.free(w->f);
    hd_spectrum_free(w->spectrum);
}

static world begun(double block)
{
    hd_status status;
    world w = {0};
    w.scene = scene(.number = 10, .exponents = N, .observe = HD_OBSERVE_FLUCTUATIONS);
    CHECK_OK(hd_spectrum_create(&w.spectrum, 40, N, N, 0.0));
    w.with = (hd_observing){.scene = &w.scene, .vectors = N, .carried = N, .block = block};
    w.f = hd_fluctuations_row.create(&w.with, &status);
    CHECK_OK(status);
    hd_fluctuations_row.clear(w.f, NULL);
    return w;
}

static void add(world *w, const double *log_stretch, double dt)
{
    hd_spectrum_add(w->spectrum, log_stretch, dt);
    hd_spectrum_sample(w->spectrum);
    hd_fluctuations_row.add(w->f, &(hd_moment){.spectrum = w->spectrum});
}

/** About normal, of variance 1. */
static double normal(hd_random *random)
{
    double sum = 0.0;
    for (int k = 0; k < 12; k++) sum += 0.5 * hd_random_symmetric(random);
    return sum;
}

/** ln diag R of a column: rate dt + sqrt(dt) (together x + alone y_l) + tremble (z_l - z_l of
 * before): D_lm = together_l together_m + [l = m] alone_l^2. */
static const double TOGETHER[N] = {0.0, 0.3, 0.3, 0.3, 0.5, -0.2, -0.2, 0.2};
static const double ALONE[N] = {1.0, 0.4, 0.4, 0.4, 0.2, 0.8, 0.8, 0.0};
static const double TREMBLE[N] = {0.0, 0.0, 0.2, 0.2, 0.0, 0.1, 0.1, 0.4};

static double known(int a, int b)
{
    return TOGETHER[a] * TOGETHER[b] + (a == b ? ALONE[a] * ALONE[a] : 0.0);
}

static void grow(world *w, uint64_t seed, int samples)
{
    hd_random random = hd_random_seeded(seed, 0);
    double before[N] = {0.0}, growth[N];
    for (int k = 0; k < samples; k++) {
        const double dt = 1.0 + 0.3 * hd_random_symmetric(&random), x = normal(&random);
        for (int col = 0; col < N; col++) {
            const double now = normal(&random);
            growth[col] = (3.0 - col) * dt + TREMBLE[col] * (now - before[col]) +
                          sqrt(dt) * (TOGETHER[col] * x + ALONE[col] * normal(&random));
            before[col] = now;
        }
        add(w, growth, dt);
    }
}

/** In errors, of what is known. */
static double off(hd_diffusion d, double want)
{
    return d.error > 0 ? (d.value - want) / d.error : NAN;
}

/** Columns 1 2 3, 5 6 and 7. */
static const hd_step_columns STEPS = {
    .count = 3, .columns = {3, 2, 1}, .own = {{1, 2, 3}, {5, 6}, {7}}};
static double mean_known(int a, int b)
{
    double sum = 0.0;
    int pairs = 0;
    for (int i = 0; i < STEPS.columns[a]; i++) {
        for (int j = 0; j < STEPS.columns[b]; j++) {
            if (a == b && i == j) continue;
            sum += known(STEPS.own[a][i], STEPS.own[b][j]);
            pairs++;
        }
    }
    return sum / pairs;
}

static const int PAIR[][2] = {{0, 0}, {0, 1}, {1, 0}, {1, 1}, {0, 2}, {1, 2}};
enum { PAIRS = sizeof PAIR / sizeof *PAIR, SEEDS = 100, EACH = N + PAIRS };

/** What is found is what is known within errors, and these are as large as they should be: a
 * column of variance D has some sqrt(10 / K), and is off by about its error. */
TEST(what_is_known_is_found)
{
    double squares[EACH] = {0.0};
    int unknown = 0;
    for (uint64_t seed = 0; seed < SEEDS; seed++) {
        HELD(world) w = begun(0.0);
        grow(&w, seed, 4096);
        for (int k = 0; k < EACH; k++) {
            const int *pair = PAIR[k < N ? 0 : k - N];
            const hd_diffusion d = k < N
                                       ? hd_fluctuations_diffusion(w.f, k)
                                       : hd_fluctuations_covariance(w.f, &STEPS, pair[0], pair[1]);
            const double z = off(d, k < N ? known(k, k) : mean_known(pair[0], pair[1]));
            if (isnan(z) && ++unknown) continue;
            if (k < N - 1) CHECK_WITHIN(d.error / known(k, k), 0.03, 0.45);
            CHECK_CLOSE(z, 0.0, FAR);
            squares[k] += z * z / SEEDS;
        }
    }
    for (int k = 0; k < EACH; k++) CHECK_WITHIN(sqrt(squares[k]), 0.8, 1.2);
    assert_true(unknown <= EACH * SEEDS / 50);
}

TEST(pairs_are_the_same_from_either_side)
{
    HELD(world) w = begun(0.0);
    grow(&w, 1, 1024);
    const hd_diffusion a = hd_fluctuations_covariance(w.f, &STEPS, 0, 1),
                       b = hd_fluctuations_covariance(w.f, &STEPS, 1, 0);
    CHECK_CLOSE(a.value, b.value, 1e-14);
    CHECK_CLOSE(hd_fluctuations_reversed(w.f, 0, &STEPS, 0, 1),
                hd_fluctuations_reversed(w.f, 0, &STEPS, 1, 0), 0.0);
}

/** Rates of 1 from column to column; within a step all pairs, in order of their columns. */
TEST(pairs_of_steps_change_order)
{
    HELD(world) w = begun(0.0);
    for (int k = 0; k < 8; k++) {
        double growth[N];
        for (int col = 0; col < N; col++) growth[col] = -col;
        if (k % 2 == 0) growth[6] = -1.5; /* ahead of 2 3, 5 */
        if (k % 4 == 0) growth[1] = -2.5; /* behind 2 */
        add(&w, growth, 1.0);
    }
    /* 6 ahead of 2, 3 in four of 8, of 1 in two of them: 10 of 8 * 6 */
    CHECK_CLOSE(hd_fluctuations_reversed(w.f, 0, &STEPS, 0, 1), 10.0 / 48.0, 1e-14);
    CHECK_CLOSE(hd_fluctuations_reversed(w.f, 0, &STEPS, 0, 0), 2.0 / 24.0, 1e-14);
    CHECK_CLOSE(hd_fluctuations_reversed(w.f, 0, &STEPS, 1, 1), 4.0 / 8.0, 1e-14);
    assert_true(isnan(hd_fluctuations_reversed(w.f, 0, &STEPS, 2, 2)));
    assert_true(hd_fluctuations_covariance(w.f, &STEPS, 2, 2).error < 0);
}

/** Too few times; or all of them shorter than growth remembers. */
TEST(limits_are_unknown_at_first)
{
    const int samples[] = {127, 128};
    for (int k = 0; k < 2; k++) {
        HELD(world) w = begun(0.0);
        int unknown = 0;
        grow(&w, 5, samples[k]);
        for (int col = 0; col < N; col++) unknown += hd_fluctuations_diffusion(w.f, col).error < 0;
        assert_true(k == 0 ? unknown == N : unknown < N);
        CHECK_CLOSE(k == 0 ? hd_fluctuations_diffusion(w.f, 0).value : 0.0, 0.0, 0.0);
    }
    HELD(world) slow = begun(40.0);
    grow(&slow, 5, 1024);
    assert_true(hd_fluctuations_diffusion(slow.f, 0).error < 0);
    grow(&slow, 6, 16384);
    CHECK_CLOSE(off(hd_fluctuations_diffusion(slow.f, 0), known(0, 0)), 0.0, FAR);
    assert_true(hd_fluctuations_diffusion(slow.f, 0).error > 0.1); /* of 512 times */
}

/** A sample that ends after nobody has looked for a while is none. */
TEST(a_gap_is_left_out)
{
    HELD(world) w = begun(0.0);
    const double growth[N] = {1.0}, much[N] = {1000.0};
    for (int k = 0; k < 3; k++) add(&w, growth, 1.0);
    hd_fluctuations_row.resume(w.f, NULL);
    add(&w, much, 50.0);
    for (int k = 0; k < 3; k++) add(&w, growth, 1.0);
    assert_int_equal(hd_fluctuations_order(w.f, 0).count, 6);
    assert_int_equal(hd_fluctuations_order(w.f, 1).count, 2);
    CHECK_CLOSE(hd_fluctuations_order(w.f, 0).time, 1.0, 1e-14);
    CHECK_CLOSE(hd_fluctuations_variance(w.f, 0, 0), 0.0, 1e-9);
}

/* ---- disks ---------------------------------------------------------------------------------- */

static hd_scene_def disks(int exponents, uint64_t seed, double duration)
{
    return scene(.number = 8, .density = 0.5, .seed = seed, .exponents = exponents,
                 .observe = HD_OBSERVE_FLUCTUATIONS, .equilibration = 20.0, .warmup = 50.0,
                 .duration = duration, .threads = 1);
}

/** Each is carried by itself: exponents are opposite in pairs, and so is all of their growth but
 * for what is bounded. Two seeds agree; and D is what their standard errors come from [T8]. */
TEST(disks_diffuse_alike)
{
    OWNED(hd_run) *run = finished(disks(HD_EXPONENTS_ALL_INDEPENDENT, 1, 8000.0));
    OWNED(hd_run) *other = finished(disks(HD_EXPONENTS_ALL_INDEPENDENT, 2, 8000.0));
    const hd_fluctuations *f = hd_run_fluctuations(run), *g = hd_run_fluctuations(other);
    double squares = 0.0;
    for (int col = 0; col < 13; col++) { /* positive ones */
        const hd_diffusion a = hd_fluctuations_diffusion(f, col),
                           pair = hd_fluctuations_diffusion(f, 31 - col),
                           b = hd_fluctuations_diffusion(g, col);
        const double stated = hd_spectrum_std_error(hd_run_spectrum(run), col);
        assert_true(a.error > 0 && pair.error > 0 && b.error > 0);
        CHECK_CLOSE(pair.value, a.value, hypot(a.error, pair.error));
        CHECK_CLOSE(b.value, a.value, FAR * hypot(a.error, b.error));
        CHECK_WITHIN(stated * stated * 8000.0 / a.value, 0.4, 2.0);
        squares += pow((b.value - a.value) / hypot(a.error, b.error), 2.0) / 13.0;
    }
    CHECK_WITHIN(sqrt(squares), 0.3, 2.0);
    for (int col = 13; col < 19; col++) { /* vanishing ones do not diffuse */
        const hd_diffusion d = hd_fluctuations_diffusion(f, col);
        if (d.error >= 0) CHECK_CLOSE(d.value, 0.0, 0.05 * hd_fluctuations_diffusion(f, 0).value);
    }
}

/** All that a run says of exponents are the same bits, and nothing is orthonormalised more often,
 * unless a time is asked for that is shorter. */
TEST(it_costs_no_orthonormalisation)
{
    hd_scene_def with = disks(HD_EXPONENTS_POSITIVE, 3, 200.0), without = with, often = with;
    without.observe = 0;
    often.fluctuation_time = 0.25;
    OWNED(hd_run) *a = finished(with), *b = finished(without), *c = finished(often);
    assert_null(hd_run_fluctuations(b));
    check_same_exponents(a, b, 0.0);
    assert_int_equal(hd_run_cost(a).orthonormalisations, hd_run_cost(b).orthonormalisations);
    assert_true(hd_run_cost(c).orthonormalisations > hd_run_cost(a).orthonormalisations);
    CHECK_CLOSE(hd_fluctuations_order(hd_run_fluctuations(c), 0).time, 0.25, 1e-3);
    assert_true(hd_fluctuations_order(hd_run_fluctuations(a), 0).time > 0.5);
    assert_int_equal(hd_fluctuations_order(hd_run_fluctuations(c), 0).count, 800);
}

/** The first samples of a run are short; stretches are as long as its later samples all the same.
 */
TEST(stretches_of_one_length_are_alike)
{
    const hd_scene_def scene = disks(HD_EXPONENTS_POSITIVE, 3, 0.0);
    OWNED(hd_run) *run = until(created(scene), HD_AVERAGING);
    const double sample = hd_agenda_sample_grown(&run->agenda), from = hd_run_time(run);
    int samples = 0;
    while (hd_run_time(run) < from + 20.0 * sample) {
        const double before = run->agenda.sample_begin;
        CHECK_OK(hd_run_advance(run));
        samples += run->agenda.sample_begin > before;
    }
    const hd_order_over shortest = hd_fluctuations_order(hd_run_fluctuations(run), 0);
    assert_true(samples > 30);
    assert_in_range(shortest.count, 18, 22);
    CHECK_CLOSE(shortest.time, sample, 0.1 * sample);
}

/** Samples of phases that nobody asks for are not taken. */
TEST(phases_that_are_not_asked_for_cost_nothing)
{
    hd_scene_def scene = disks(HD_EXPONENTS_POSITIVE, 3, 100.0);
    scene.fluctuation_time = 1.0;
    OWNED(hd_run) *a = finished(scene);
    scene.phase_interval = 0.1;
    OWNED(hd_run) *b = finished(scene);
    assert_int_equal(hd_run_cost(a).orthonormalisations, hd_run_cost(b).orthonormalisations);
}

/** Pairs that follow from each other do so bit for bit. */
TEST(a_half_that_follows_diffuses_as_the_other)
{
    OWNED(hd_run) *run = finished(disks(HD_EXPONENTS_ALL, 4, 400.0));
    const hd_fluctuations *f = hd_run_fluctuations(run);
    for (int col = 0; col < 16; col++)
        CHECK_CLOSE(hd_fluctuations_variance(f, 0, 31 - col), hd_fluctuations_variance(f, 0, col),
                    0.0);
}

/** Own columns of steps, in the order of these; no zero modes. */
TEST(steps_have_their_columns)
{
    hd_scene_def channel = scene(.number = 40, .density = 0.5, .aspect = 0.08, .threads = 1,
                                 .exponents = HD_EXPONENTS_ALL, .equilibration = 20.0,
                                 .warmup = 50.0, .duration = 100.0,
                                 .observe = HD_OBSERVE_STEPS | HD_OBSERVE_FLUCTUATIONS);
    OWNED(hd_run) *run = finished(channel);
    const hd_steps *steps = hd_run_steps(run);
    const hd_step_columns of = hd_fluctuations_steps(hd_run_fluctuations(run), steps);
    int last = -1, columns = 0, want = 0;
    assert_true(of.count >= 2);
    for (int k = 0; k < of.count; k++) {
        const hd_step *step = hd_steps_step(steps, of.step[k]);
        assert_true(step->resolved && !step->conjugate && step->kind != HD_MODE_ZERO);
        assert_true(of.own[k][0] > last);
        last = of.own[k][0];
        columns += of.columns[k];
        for (int i = 0; i < of.columns[k]; i++)
            assert_int_equal(hd_steps_of_vector(steps, of.own[k][i]), of.step[k]);
    }
    for (int col = 0; col < 77; col++) {
        const int step = hd_steps_of_vector(steps, col);
        want += step >= 0 && hd_steps_step(steps, step)->kind != HD_MODE_ZERO;
    }
    assert_int_equal(columns, want);
}

TEST(times_longer_than_the_run_are_refused)
{
    char message[200] = "";
    hd_scene_def scene = disks(HD_EXPONENTS_POSITIVE, 1, 10.0);
    scene.fluctuation_time = 10.5;
    assert_int_equal(hd_scene_check(&scene, message, sizeof message), HD_REFUSED);
    assert_string_equal(message, "fluctuation_time = 10.5: must be at most duration = 10");
    scene.observe = 0;
    CHECK_OK(hd_scene_check(&scene, message, sizeof message));
    scene.observe = HD_OBSERVE_FLUCTUATIONS;
    scene.duration = 0.0;
    CHECK_OK(hd_scene_check(&scene, message, sizeof message));
}
