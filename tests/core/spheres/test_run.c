/** Whole runs of spheres: the steps and the sound of a long box, what is kept and taken up again,
 * covariant vectors, threads. */
#include "kept.h"
#include "runs.h"
#include "same.h"

static const double Z = 3.0;

/** 128 spheres in a box of 4 : 1 : 1. */
static hd_scene_def long_box(void)
{
    return scene_from(box_of(128, 0.5, 0.25, 0.25, 0, 2), .equilibration = 20.0, .warmup = 60.0,
                      .duration = HD_SANITIZED ? 20.0 : 300.0, .threads = 1,
                      .observe = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES | HD_OBSERVE_T_PHASES |
                                 HD_OBSERVE_GAS | HD_OBSERVE_LOCALIZATION);
}

static int step_at(const hd_steps *steps, hd_mode_kind kind, int nx)
{
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (step->kind == kind && !step->conjugate && step->wave.n[0] == nx &&
            step->wave.n[1] == 0 && step->wave.n[2] == 0)
            return k;
    }
    fail_msg("no step (%d,0,0)", nx);
    return -1;
}

/** Four vectors of its own. */
static void check_step(const hd_run *run, hd_mode_kind kind, int nx, int col)
{
    const hd_step *step = hd_steps_step(hd_run_steps(run), step_at(hd_run_steps(run), kind, nx));
    assert_int_equal(step->expected, 4);
    assert_true(step->resolved);
    assert_int_equal(step->members, 1);
    assert_int_equal(step->count, 4);
    assert_int_equal(step->col, col);
    CHECK_WITHIN(step->multiplicity, 2.0, 4.0 + 1e-9);
    CHECK_CLOSE(step->wave.number, 2.0 * PI * nx / 16.0, 1e-12);
}

/** An LP pair moves with omega / k = P_xx / (rho sqrt(3 kT)), the pressure along its wave. */
static void check_sound(const hd_run *run)
{
    double omega, error;
    const hd_steps *steps = hd_run_steps(run);
    const int step = step_at(steps, HD_MODE_LP, 1);
    const hd_gas_means gas = hd_gas_read(hd_run_gas(run));
    assert_true(hd_phases_rate(hd_run_phases(run), step, &omega, &error));
    const double k = hd_steps_step(steps, step)->wave.number;
    const double factor = 1.0 / (0.5 * sqrt(3.0 * hd_gas_temperature(hd_run_scene(run))));
    const double want = factor * gas.pressure_of[0];
    print_message("omega/k %.4f +- %.4f, P_xx / (rho sqrt(3 kT)) %.4f\n", fabs(omega) / k,
                  error / k, want);
    assert_true(error > 0 && error < 0.05 * fabs(omega));
    CHECK_CLOSE(fabs(omega) / k, want, Z * hypot(error / k, factor * gas.pressure_of_error[0]));
}

/** The warm-up that a scene gets by itself, 3 / (0.05 c_T k), is that of the smallest step to 6 %.
 */
static void check_warmup(const hd_run *run)
{
    const hd_scene_def def = scene_from(*hd_run_scene(run), .warmup = HD_WARMUP_AUTO);
    const hd_steps *steps = hd_run_steps(run);
    const double want = 60.0 / hd_steps_step(steps, step_at(steps, HD_MODE_T, 1))->exponent;
    CHECK_CLOSE(hd_scene_warmup(&def), want, 0.06 * want);
}

/** Four vectors, in two pairs of a cosine and a sine: one pair for each direction across the wave.
 * A vector of four fields that it is made of: its weight is near their squares together. */
static void check_t_phases(const hd_run *run)
{
    const hd_phases *phases = hd_run_t_phases(run);
    const hd_steps *steps = hd_run_steps(run);
    const int step = step_at(steps, HD_MODE_T, 1);
    double squares = 0.0, weights = 0.0;
    int count = 0;
    for (int k = 0; k < hd_phases_count(phases); k++) {
        const hd_phase *phase = hd_phases_phase(phases, k);
        if (phase->step != step) continue;
        assert_int_equal(phase->modulation, count % 2 ? HD_SECOND : 0);
        squares += phase->a * phase->a + phase->b * phase->b;
        if (count++ % 2 == 0)
            weights += hd_modes_snapshot(hd_run_modes(run), hd_steps_step(steps, step)->subspace,
                                         HD_WEIGHT)[phase->col];
    }
    assert_int_equal(count, 8);
    CHECK_CLOSE(squares, weights, 0.1 * weights); /* fields overlap by some 1 / sqrt(N) */
}

TEST(a_long_box_has_its_steps_and_its_sound)
{
    OWNED(hd_run) *run = finished(long_box());
    const int n = hd_run_vectors(run);
    assert_int_equal(n, 3 * 128 - 4);
    if (HD_SANITIZED) return;
    check_step(run, HD_MODE_T, 1, n - 4);
    check_step(run, HD_MODE_LP, 1, n - 8);
    check_step(run, HD_MODE_T, 2, n - 12);
    check_sound(run);
    check_t_phases(run);
    check_warmup(run);
}

/* ---- kept ----------------------------------------------------------------------------------- */

static hd_scene_def short_run(int disks, int walls, int exponents, unsigned observe)
{
    return scene_from(box_of(disks, 0.5, 0.3, 0.4, walls, 7), .equilibration = 3.0, .warmup = 10.0,
                      .duration = 15.0, .threads = 1, .exponents = exponents, .observe = observe);
}

static void expect_uninterrupted(hd_scene_def def, int every)
{
    static const char PATH[] = "spheres.test";
    OWNED(hd_run) *alone = kept_run(def), *other = kept_run(def);
    int times = 0;
    do {
        kept_steps(alone, every);
        kept_steps(other, every);
        hd_run *resumed = kept_and_resumed(other, PATH, &def);
        hd_run_free(other);
        other = resumed;
        expect_same_state(alone, other);
        times++;
    } while (hd_run_stage(alone) != HD_FINISHED);
    assert_int_equal(hd_run_stage(other), HD_FINISHED);
    assert_true(times >= 3);
}

TEST(a_resumed_run_is_the_uninterrupted_one)
{
    expect_uninterrupted(short_run(24, 5, HD_EXPONENTS_ALL, KEPT_ALL), 9);
    expect_uninterrupted(short_run(60, 0, HD_EXPONENTS_POSITIVE, KEPT_ALL | HD_OBSERVE_FIELDS), 13);
    expect_uninterrupted(short_run(50, 7, HD_EXPONENTS_NONE, HD_OBSERVE_GAS), 2);
}

/** A box of another shape or with other ends is another run. */
TEST(the_third_direction_is_kept)
{
    static const char PATH[] = "spheres.test";
    char line[512] = "";
    const hd_scene_def def = short_run(24, 0, 4, 0);
    const hd_scene_def other[] = {scene_from(def, .aspect_z = 0.5),
                                  scene_from(def, .boundary[2] = R)};
    static const char *const name[] = {"aspect_z", "boundary_z"};
    OWNED(hd_run) *run = kept_run(def);
    CHECK_OK(hd_run_save(run, PATH, KEPT_LABEL, line, sizeof line));
    for (int k = 0; k < 2; k++) {
        hd_run *resumed = NULL;
        assert_int_equal(hd_run_resume(&resumed, PATH, &other[k], line, sizeof line), HD_REFUSED);
        assert_non_null(strstr(line, name[k]));
    }
}

/* ---- threads -------------------------------------------------------------------------------- */

/** The same events bit for bit, exponents as accurate as asked for. */
TEST(two_threads_give_what_one_gives)
{
    const hd_scene_def def = short_run(60, 4, HD_EXPONENTS_POSITIVE, HD_OBSERVE_STEPS);
    OWNED(hd_run) *one = finished(def), *two = finished(scene_from(def, .threads = 2));
    double q[2][180], p[2][180];
    assert_int_equal(hd_run_threads(two), 2);
    hd_trajectory_state(hd_run_trajectory(one), q[0], p[0]);
    hd_trajectory_state(hd_run_trajectory(two), q[1], p[1]);
    assert_memory_equal(q[0], q[1], sizeof q[0]);
    assert_memory_equal(p[0], p[1], sizeof p[0]);
    check_same_exponents(one, two, def.accuracy);
}

/* ---- covariant vectors ---------------------------------------------------------------------- */

/** They grow as the Gram-Schmidt vectors do over nearly the same time; the centre decays, by no
 * more than ln((window + transient) / transient) of each window, and lies in the exact null space.
 */
TEST(covariant_vectors_have_the_same_exponents)
{
    const hd_scene_def def = scene_from(
        box_of(6, 0.4, 1.0, 1.0, 0, 3), .exponents = HD_EXPONENTS_ALL, .warmup = 100.0,
        .duration = 700.0, .observe = HD_OBSERVE_COVARIANT, .covariant_window = 100.0,
        .covariant_transient = 100.0, .covariant_sampling = 10.0, .threads = 1);
    OWNED(hd_run) *run = finished(def);
    const hd_covariant *c = hd_run_covariant(run);
    const hd_spectrum *back = hd_covariant_read(c).spectrum, *forward = hd_run_spectrum(run);
    assert_int_equal(hd_covariant_read(c).windows, 6);
    for (int col = 0; col < 36; col++) {
        const double got = hd_spectrum_exponent(back, col),
                     want = hd_spectrum_exponent(forward, col);
        const double one = hd_spectrum_std_error(back, col);
        const bool central = col >= 14 && col < 22;
        assert_true(central || (one > 0 && one < 0.1));
        CHECK_CLOSE(got, want,
                    central ? log(2.0) / 100.0 + 5.0 * log(700.0) / 700.0
                            : Z * sqrt(2.0) * fmax(one, hd_spectrum_std_error(forward, col)));
    }
    CHECK_WITHIN(hd_covariant_read(c).null, 0.0, 1e-6);
    CHECK_WITHIN(hd_covariant_read(c).start_mismatch.centre, 0.0, 1e-6);
}

/** A cube that walls make too narrow for its spheres, a crystal; and a fluid. */
TEST(spheres_leave_their_places_in_a_fluid_alone)
{
    const struct {
        hd_scene_def scene;
        bool caged;
    } cases[] = {{box_of(16, 0.9, 1.0, 1.0, 6, 1), true},
                 {box_of(108, 1.1, 1.0, 1.0, 0, 1), true},
                 {box_of(32, 0.9, 1.0, 1.0, 0, 1), false}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        OWNED(hd_run) *run = finished(scene_from(cases[k].scene, .exponents = HD_EXPONENTS_NONE,
                                                 .equilibration = 50.0, .warmup = 0.0,
                                                 .duration = 50.0, .threads = 1));
        assert_int_equal(hd_run_is_caged(run), cases[k].caged);
    }
}
