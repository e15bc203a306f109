/** Maps that are not symplectic: a thermostatted ring in a field, whose exponents are known in sum
 * and in pairs. */
#include "hdlyap/dynamics_test.h"
#include "isokinetic.h"
#include "kept.h"
#include "runs.h"

enum { ROWS = 2 * RING, UNSTABLE = 2, CENTRE = 2 }; /* in this field */

static hd_scene_def ring_of(const hd_dynamics *row, double duration)
{
    hd_scene_def scene = hd_scene_def_of(row);
    scene.number = RING;
    scene.own[0].real = 1.2;
    scene.equilibration = 50.0;
    scene.warmup = 200.0;
    scene.duration = duration;
    scene.threads = 1;
    return scene;
}

static hd_scene_def with_windows(const hd_dynamics *row)
{
    return scene_from(ring_of(row, 2500.0), .warmup = 300.0, .observe = HD_OBSERVE_COVARIANT,
                      .covariant_window = 200.0, .covariant_transient = 300.0,
                      .covariant_sampling = 5.0);
}

static double exponent_of(const hd_run *run, int col)
{
    return hd_spectrum_exponent(hd_run_spectrum(run), col);
}

static bool vanishes(int col) { return col >= UNSTABLE && col < UNSTABLE + CENTRE; }

TEST(its_functions_do_what_they_say)
{
    char message[256] = "";
    const hd_scene_def scene = ring_of(&of_ring, 1.0);
    const hd_status status = hd_dynamics_test(&of_ring, &scene, message, sizeof message);
    assert_string_equal(message, "");
    CHECK_OK(status);
}

static double halved(const void *state) { return 0.5 * ring_diverged(state); }

TEST(a_wrong_divergence_is_found)
{
    char message[256] = "";
    hd_dynamics row = of_ring;
    row.divergence = halved;
    const hd_scene_def scene = ring_of(&row, 1.0);
    assert_int_equal(hd_dynamics_test(&row, &scene, message, sizeof message), HD_REFUSED);
    assert_true(strstr(message, "divergence: must be the logarithm of the volume that maps carry"));
}

static void forgetful(void *state, hd_archive *file)
{
    const double diverged = ring_diverged(state);
    ring_archive(state, file);
    ((driven *)state)->x.diverged = diverged;
}

TEST(a_forgotten_divergence_is_found)
{
    char message[256] = "";
    hd_dynamics row = of_ring;
    row.archive = forgetful;
    const hd_scene_def scene = ring_of(&row, 1.0);
    assert_int_equal(hd_dynamics_test(&row, &scene, message, sizeof message), HD_REFUSED);
    assert_true(strstr(message, "differ in totals, divergence or fingerprint"));
}

/** What is asked for holds; without it, all. */
TEST(all_exponents_are_computed_by_default)
{
    const hd_scene_def scene = ring_of(&of_ring, 1.0);
    assert_int_equal(scene.exponents, HD_EXPONENTS_ALL);
    assert_int_equal(hd_scene_counts(&scene).carried, ROWS);
}

/** A sum over the averaged time T is off by a few / T where vectors and null modes begin and end.
 * RK4 is off by PACE^4 = 2e-7. */
TEST(the_sum_is_the_divergence_and_pairs_are_parts_of_it)
{
    const double duration = 4000.0, few = 4.0 / duration;
    OWNED(hd_run) *run = finished(ring_of(&of_ring, duration));
    const hd_spectrum_sums sums = hd_spectrum_sum_up(hd_run_spectrum(run));
    const double alpha = -hd_run_divergence(run) / (RING - 1);
    CHECK_WITHIN(alpha, 0.3, 0.45);
    CHECK_CLOSE(sums.exponent_sum, hd_run_divergence(run), 1e-6);
    CHECK_WITHIN(sums.exponent_sum_error, 0.005, 0.1);
    CHECK_CLOSE(hd_run_divergence_error(run), sums.exponent_sum_error, 1e-6);
    for (int l = 0; l < RING - 1; l++) { /* without the two that vanish */
        const int m = ROWS - 1 - l, first = l < UNSTABLE ? l : l + CENTRE;
        CHECK_CLOSE(exponent_of(run, first) + exponent_of(run, m), -alpha, few);
    }
    double positive = 0.0;
    for (int col = 0; col < ROWS; col++) {
        if (vanishes(col)) CHECK_CLOSE(exponent_of(run, col), 0.0, 2.0 * log(duration) / duration);
        positive += fmax(exponent_of(run, col), 0.0);
    }
    CHECK_CLOSE(sums.ks_entropy, positive, 1e-14);
    assert_true(sums.pairing_error < 0);
    const double worst = fmax(hd_spectrum_std_error(hd_run_spectrum(run), 0),
                              hd_spectrum_std_error(hd_run_spectrum(run), 1));
    CHECK_WITHIN(hd_run_cost(run).std_error, worst, INFINITY); /* of the positive ones */
}

/* ---- a plain loop -------------------------------------------------------------------------- */

static const double OFF = 1e-7; /* distance of two trajectories */
enum { EACH = 10 };             /* time steps from one Gram-Schmidt to the next */

/** Product of two vectors. */
static double dot(const ring *a, const ring *b)
{
    double sum = 0.0;
    for (int i = 0; i < RING; i++) sum += a->q[i] * b->q[i] + a->p[i] * b->p[i];
    return sum;
}

/** Gram-Schmidt; adds the logarithms of the lengths. */
static void orthonormalise(ring *v, double *grown)
{
    for (int a = 0; a < ROWS; a++) {
        for (int k = 0; k < 2 * a; k++) v[a] = ring_moved(&v[a], &v[k % a], -dot(&v[a], &v[k % a]));
        const double length = sqrt(dot(&v[a], &v[a]));
        v[a] = ring_moved(&v[a], &v[a], 1.0 / length - 1.0);
        grown[a] += log(length);
    }
}

/** Exponents, of trajectories nearby alone: without tangent maps. */
static void plain_loop(const hd_scene_def *scene, double exponent[ROWS])
{
    void *state;
    ring v[ROWS] = {0};
    const int until = (int)(scene->duration / (EACH * PACE)),
              first = (int)(scene->warmup / (EACH * PACE));
    CHECK_OK(ring_create(&state, scene));
    CHECK_OK(ring_advance(state, NULL, scene->equilibration));
    HEAP driven *c = state;
    for (int a = 0; a < ROWS; a++) *(a < RING ? &v[a].q[a] : &v[a].p[a - RING]) = 1.0;
    for (int k = -first; k < until; k++) {
        ring x = c->x, at[4];
        push of[4];
        if (k == 0) memset(exponent, 0, ROWS * sizeof *exponent);
        for (int step = 0; step < EACH; step++) ring_step(&x, c->field, at, of);
        for (int a = 0; a < ROWS; a++) {
            ring other = ring_moved(&c->x, &v[a], OFF);
            for (int step = 0; step < EACH; step++) ring_step(&other, c->field, at, of);
            v[a] = ring_moved(&other, &x, -1.0);
            v[a] = ring_moved(&v[a], &v[a], 1.0 / OFF - 1.0);
        }
        c->x = x;
        orthonormalise(v, exponent);
    }
    for (int a = 0; a < ROWS; a++) exponent[a] /= until * EACH * PACE;
}

/** Of the same trajectory. Differences of neighbours are off by their distance, and some tens of
 * times it by curvature, each time; the two that vanish part from each other as slowly as 1 / T. */
TEST(exponents_are_those_of_a_plain_loop)
{
    const hd_scene_def scene = scene_from(ring_of(&of_ring, 1000.0), .warmup = 600.0);
    double exponent[ROWS] = {0};
    OWNED(hd_run) *run = finished(scene);
    plain_loop(&scene, exponent);
    for (int col = 0; col < ROWS; col++)
        CHECK_CLOSE(exponent_of(run, col), exponent[col],
                    vanishes(col) ? 1.0 / scene.duration : 40.0 * OFF / (EACH * PACE));
}

/* ---- covariant vectors --------------------------------------------------------------------- */

static void check_spaces(const hd_run *run)
{
    const hd_covariant_results found = hd_covariant_read(hd_run_covariant(run));
    assert_int_equal(found.unstable, UNSTABLE);
    assert_int_equal(found.centre, CENTRE);
    assert_true(found.windows > 3 && found.splitting.has_spaces);
    CHECK_WITHIN(found.start_mismatch.centre, 0.0, 1e-2);
    CHECK_WITHIN(found.start_mismatch.stable, 0.0, 1e-2);
    if (hd_dynamics_of(hd_run_scene(run))->null_vectors) CHECK_WITHIN(found.null_most, 0.0, 1e-4);
    for (int pair = 0; pair < HD_PAIRS_OF_SPACES; pair++)
        CHECK_WITHIN(found.splitting.angle[pair].mean, 0.01, PI / 2);
    for (int col = 0; col < ROWS; col++) /* the last window has not ended */
        CHECK_CLOSE(hd_spectrum_exponent(found.spectrum, col), exponent_of(run, col), 0.03);
    CHECK_CLOSE(hd_spectrum_sum_up(found.spectrum).ks_entropy,
                hd_spectrum_sum_up(hd_run_spectrum(run)).ks_entropy, 0.03);
}

/** Two positive ones, two zeros, four negative ones: not in pairs around zero. The row says how
 * many vanish, or their errors do. */
TEST(covariant_vectors_count_signs)
{
    hd_dynamics silent = of_ring;
    OWNED(hd_run) *run = finished(with_windows(&of_ring));
    check_spaces(run);
    silent.zero_exponents = NULL;
    silent.null_vectors = NULL;
    OWNED(hd_run) *counting = finished(with_windows(&silent));
    check_spaces(counting);
}

#define PATH "isokinetic.ckpt"

TEST(a_resumed_run_has_its_spaces_and_its_divergence)
{
    const hd_scene_def scene = with_windows(&of_ring);
    OWNED(hd_run) *run = created(scene);
    until_time(run, 1500.0);
    OWNED(hd_run) *resumed = kept_and_resumed(run, PATH, &scene);
    check_spaces(finish(resumed));
    (void)finish(run);
    CHECK_CLOSE(hd_run_divergence(resumed), hd_run_divergence(run), 0.0);
    const hd_covariant_results a = hd_covariant_read(hd_run_covariant(run)),
                               b = hd_covariant_read(hd_run_covariant(resumed));
    for (int pair = 0; pair < HD_PAIRS_OF_SPACES; pair++)
        CHECK_CLOSE(b.splitting.angle[pair].least, a.splitting.angle[pair].least, 1e-3);
    (void)remove(PATH);
}
