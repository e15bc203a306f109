/** The paper's 780 disks: steps of the small exponents at c_T k and c_L k, then the zeros [T9]. */
#include "testing.h"

#include "hdlyap/run.h"

/** The paper's fits are guides to the eye, +-3 %; one more for the finite time. */
static const double FIT = 0.04;
static const int POSITIVE = 1557; /* (4N - 6) / 2 */

typedef struct step {
    const char *name;
    int first, last; /**< Lyapunov indices, from 1 */
    int nx, ny, transverse;
} step;

static const step steps[] = {
    {"T(1,0)", 1556, 1557, 1, 0, 1}, {"T(0,1)", 1554, 1555, 0, 1, 1},
    {"LP(1,0)", 1550, 1553, 1, 0, 0}, {"T(1,1)", 1546, 1549, 1, 1, 1},
    {"LP(0,1)", 1542, 1545, 0, 1, 0},
};

static hd_run *paper_run(void)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.exponents = POSITIVE + 3; /* half of the six zeros too */
    scene.equilibration = 50.0;
    scene.warmup = 30.0;
    scene.duration = 60.0;
    hd_run *run;
    CHECK_OK(hd_run_create(&run, &scene, NULL, 0));
    while (hd_run_phase(run) != HD_FINISHED) CHECK_OK(hd_run_step(run));
    return run;
}

static double wave_number(const step *s, const hd_run *run)
{
    const double two_pi = 6.283185307179586;
    double box[2];
    hd_trajectory_box(hd_run_trajectory(run), box);
    return two_pi * hypot(s->nx / box[0], s->ny / box[1]);
}

static void check_step(const step *s, const hd_run *run)
{
    const double rho = 0.8, k = wave_number(s, run);
    const double c_l = 0.790 + 0.970 * rho + 0.785 * rho * rho + 6.24 * pow(rho, 4);
    const double c_t = 0.902 + 1.050 * rho - 0.053 * rho * rho + 3.85 * pow(rho, 4);
    const double want = (s->transverse ? c_t : c_l) * k;
    double mean = 0.0, error = 0.0;
    for (int l = s->first; l <= s->last; l++) {
        mean += hd_spectrum_exponent(hd_run_spectrum(run), l - 1) / (s->last - s->first + 1);
        error = fmax(error, hd_spectrum_std_error(hd_run_spectrum(run), l - 1));
    }
    print_message("%-8s %d-%d: %.4f +- %.4f, the paper's fit %.4f (%+.1f %%)\n", s->name, s->first,
                  s->last, mean, error, want, 100 * (mean / want - 1));
    assert_true(error > 0 && error < 0.01);
    CHECK_CLOSE(mean, want, FIT * want);
}

static void small_exponents_form_the_steps_of_the_paper(void **state)
{
    const hd_run *run = *state;
    for (size_t k = 0; k < sizeof steps / sizeof *steps; k++) check_step(&steps[k], run);
}

/** Within a step the exponents agree, between steps they do not. */
static void steps_are_flat_and_apart(void **state)
{
    const hd_spectrum *spectrum = hd_run_spectrum(*(hd_run *const *)state);
    for (size_t k = 0; k < sizeof steps / sizeof *steps; k++) {
        const double high = hd_spectrum_exponent(spectrum, steps[k].first - 1);
        const double low = hd_spectrum_exponent(spectrum, steps[k].last - 1);
        const double above = hd_spectrum_exponent(spectrum, steps[k].first - 2);
        assert_true(high - low < 0.5 * (above - high));
    }
}

/** ln(t) / t, to a factor of 2. */
static void the_zeros_vanish_like_ln_t_over_t(void **state)
{
    const hd_spectrum *spectrum = hd_run_spectrum(*(hd_run *const *)state);
    const double t = hd_spectrum_time(spectrum);
    for (int col = POSITIVE; col < POSITIVE + 3; col++)
        CHECK_CLOSE(hd_spectrum_exponent(spectrum, col), 0.0, 2.0 * log(t) / t);
}

/** dp = C dq, C > 0, for the modes of small positive exponents. */
static void the_halves_of_the_modes_are_parallel(void **state)
{
    static double cosine[1600], ratio[1600];
    hd_frame_halves(hd_run_frame(*(hd_run *const *)state), cosine, ratio);
    for (int l = 1542; l <= POSITIVE; l++) {
        assert_true(cosine[l - 1] > 0.98);
        assert_true(ratio[l - 1] > 0);
    }
}

static int setup(void **state)
{
    *state = paper_run();
    return 0;
}

static int teardown(void **state)
{
    hd_run_free(*state);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_exponents_form_the_steps_of_the_paper),
        cmocka_unit_test(steps_are_flat_and_apart),
        cmocka_unit_test(the_zeros_vanish_like_ln_t_over_t),
        cmocka_unit_test(the_halves_of_the_modes_are_parallel),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
