/** Targets: how they are read, what can never be reached, and that a run ends where the errors that
 * it states are first as small as asked for. */
#include "runs.h"

/** A box of some waves, whose T(1,0) and LP(1,0) stand alone. */
static hd_scene_def long_box(void)
{
    return scene(.number = 60, .density = 0.7, .aspect = 0.25, .equilibration = 5.0, .warmup = 60.0,
                 .threads = 1, .duration = 20000.0,
                 .observe = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES | HD_OBSERVE_GAS);
}

static hd_scene_def aiming(hd_scene_def def, const char *target)
{
    snprintf(def.target.line, HD_TEXT, "%s", target);
    return def;
}

static void expect_refused(const hd_scene_def *def, const char *word)
{
    char message[512] = "";
    assert_int_equal(hd_target_check(def, message, sizeof message), HD_REFUSED);
    if (!strstr(message, word)) fail_msg("\"%s\" does not say \"%s\"", message, word);
    assert_int_equal(strncmp(message, "target = ", 9), 0);
    hd_run *run = NULL; /* and nothing is begun */
    assert_int_equal(hd_run_create(&run, def, message, sizeof message), HD_REFUSED);
    assert_null(run);
}

TEST(texts_are_read_or_refused)
{
    static const char *const good[] = {"",
                                       "  ",
                                       "lambda_max 0.01",
                                       "LAMBDA_MAX: 1e-3 %",
                                       " c_t 2% ,T( 1, 0) 0.5%,LP(1,0)0.2 ",
                                       "lambda(3) 2",
                                       "omega(1,0) 5%, h_ks 1%, collision_rate 1%, pressure 0.1"};
    static const char *const bad[] = {
        "0.01",    "lambda_max",  "lambda_max 0", "lambda_max -1",     "lambda_max nan",
        "c_T inf", "c_T 1%,",     ",c_T 1%",      "c_T 1% c_L 1%",     "T 1%",
        "T(1) 1%", "T(1,0,0) 1%", "T(1,0 1%",     "T(-1,0) 1%",        "lambda_maximum 1",
        "c_T 1%%", "v = 1",       "c_T 1%;",      "T(9999999999,0) 1%"};
    for (size_t k = 0; k < sizeof good / sizeof *good; k++) {
        const hd_scene_def def = aiming(long_box(), good[k]);
        if (hd_target_check(&def, NULL, 0) != HD_OK) fail_msg("%s is refused", good[k]);
    }
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        const hd_scene_def def = aiming(long_box(), bad[k]);
        expect_refused(&def, "must be quantities with their errors");
    }
    hd_scene_def many = aiming(long_box(), "");
    for (int k = 0; k < 17; k++) strcat(many.target.line, k ? ", v 1%" : "v 1%");
    expect_refused(&many, "up to 16 out of smallest, lambda_max");
}

TEST(what_is_never_known_is_refused_by_name)
{
    static const struct {
        const char *target, *word;
    } rows[] = {{"v 2%, T(9,0) 1%", "must be without T(9,0): it is not among the waves"},
                {"T(0,5) 1%", "must be without T(0,5): it is not among the waves"},
                {"omega(9,1) 1%", "must be without omega(9,1): it is not among the waves"},
                {"lambda(118) 1",
                 "it is the exponent of a zero mode, which is 0"}, /* 117 of 120 are positive */
                {"lambda(0) 1", "from 1 to 117"},
                {"smallest 1%",
                 "without smallest: it is several exponents, so its error must be without %"},
                {"c_T 0.01%", "short edges leave"},
                {"v 1%", "short edges leave"}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        hd_scene_def def = aiming(long_box(), rows[k].target);
        if (strstr(rows[k].word, "zero mode")) def.exponents = HD_EXPONENTS_ALL;
        expect_refused(&def, rows[k].word);
    }
    hd_scene_def wide = aiming(long_box(), "v 1%"); /* the box that it is advised to be does */
    char message[512];
    assert_int_equal(hd_target_check(&wide, message, sizeof message), HD_REFUSED);
    const char *advised = strstr(message, "less with aspect = ");
    assert_non_null(advised);
    wide.aspect = strtod(advised + strlen("less with aspect = "), NULL);
    assert_true(wide.aspect > 0.25 && wide.aspect < 1.0);
    assert_int_equal(hd_target_check(&wide, NULL, 0), HD_OK);
    wide = aiming(long_box(), "v 2%"); /* a shape is not enough */
    wide.boundary[0] = wide.boundary[1] = HD_REFLECTING;
    wide.aspect = 1.0;
    const int before = wide.number;
    assert_int_equal(hd_target_check(&wide, message, sizeof message), HD_REFUSED);
    advised = strstr(message, "less with number = ");
    assert_non_null(advised);
    wide.number = atoi(advised + strlen("less with number = "));
    assert_in_range(wide.number, before + 1, 10 * before);
    assert_int_equal(hd_target_check(&wide, NULL, 0), HD_OK);
    hd_scene_def blind = aiming(long_box(), "v 2%");
    blind.observe = HD_OBSERVE_STEPS;
    expect_refused(&blind, "must be without v: lp_phases is not among the observables");
    blind = aiming(blind, "pressure 1%");
    expect_refused(&blind, "must be without pressure: gas is not among the observables");
    blind = aiming(scene_from(long_box(), .observe = HD_OBSERVE_GAS), "temperature 1%");
    expect_refused(&blind,
                   "must be without temperature: all energy of disks is kinetic, and fixed");
    blind = aiming(blind, "potential_energy 1%");
    expect_refused(&blind, "must be without potential_energy: all energy of disks is kinetic");
    blind = aiming(blind, "c_L 1%");
    expect_refused(&blind, "must be without c_L: steps is not among the observables");
    blind = aiming(scene_from(blind, .exponents = HD_EXPONENTS_NONE), "lambda_max 1");
    expect_refused(&blind, "must be without lambda_max: exponents = none");
}

/* ---- where it ends --------------------------------------------------------------------------- */

static int step_named(const hd_steps *steps, hd_mode_kind kind)
{
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (step->kind == kind && step->resolved && step->wave.n[0] == 1 && step->wave.n[1] == 0)
            return k;
    }
    return -1;
}

static double of(double error, double value) { return error >= 0 ? error / fabs(value) : INFINITY; }

static double of_step(const hd_run *run, hd_mode_kind kind)
{
    const int k = step_named(hd_run_steps(run), kind);
    if (k < 0) return INFINITY;
    const hd_step *step = hd_steps_step(hd_run_steps(run), k);
    return of(step->std_error, step->exponent);
}

static double of_slope(const hd_run *run, hd_mode_kind kind)
{
    const hd_dispersion d = hd_steps_dispersion(hd_run_steps(run), hd_run_spectrum(run), kind);
    return d.points > 0 ? of(d.c.error, d.c.value) : INFINITY;
}

static double of_omega(const hd_run *run)
{
    double omega, error;
    const int k = step_named(hd_run_steps(run), HD_MODE_LP);
    const bool known = k >= 0 && hd_phases_rate(hd_run_phases(run), k, &omega, &error);
    return known ? of(error, omega) : INFINITY;
}

enum { LAMBDA_MAX, LAMBDA, H_KS, T, LP, C_T, C_L, V, OMEGA, RATE, PRESSURE };

/** Relative error, as whoever reads the run sees it; INFINITY while not known. */
static double stated(const hd_run *run, int what)
{
    const hd_spectrum *s = hd_run_spectrum(run);
    const hd_gas_means gas = hd_gas_read(hd_run_gas(run));
    const hd_velocity v = hd_phases_velocity(hd_run_phases(run));
    switch (what) {
    case LAMBDA_MAX: return of(hd_spectrum_std_error(s, 0), hd_spectrum_exponent(s, 0));
    case LAMBDA: return of(hd_spectrum_std_error(s, 9), hd_spectrum_exponent(s, 9));
    case H_KS: return of(hd_spectrum_sum_up(s).ks_entropy_error, hd_spectrum_sum_up(s).ks_entropy);
    case T: return of_step(run, HD_MODE_T);
    case LP: return of_step(run, HD_MODE_LP);
    case C_T: return of_slope(run, HD_MODE_T);
    case C_L: return of_slope(run, HD_MODE_LP);
    case V: return v.phases > 0 ? of(v.v_error, v.v) : INFINITY;
    case OMEGA: return of_omega(run);
    case RATE: return of(gas.collision_rate_error, gas.collision_rate);
    default: return of(gas.pressure_error, gas.pressure);
    }
}

/** Not at any report before, and with the first one at which it is. */
static void expect_end(const char *name, int what, double percent)
{
    char target[64];
    snprintf(target, sizeof target, "%s %g%%", name, percent);
    OWNED(hd_run) *run = until(created(aiming(long_box(), target)), HD_AVERAGING);
    int before = 0;
    while (going_on(run)) {
        if (!hd_run_report_due(run) || hd_run_stage(run) == HD_FINISHED) continue;
        before++;
        if (stated(run, what) <= 0.01 * percent) fail_msg("%s goes on", name);
    }
    const hd_target_progress end = hd_run_cost(run).target;
    print_message("%s after %.0f: %.3g%% of %g%%\n", name, hd_run_time(run) - 65.0,
                  100.0 * stated(run, what), percent);
    assert_true(before > 2 && hd_run_time(run) < 65.0 + 19999.0);
    assert_true(stated(run, what) <= 0.01 * percent);
    assert_string_equal(end.name, name);
    assert_true(end.reached);
    CHECK_CLOSE(end.error / fabs(end.value), stated(run, what), 1e-12);
    CHECK_CLOSE(end.wanted, 0.01 * percent * fabs(end.value), 1e-12);
    CHECK_CLOSE(end.left, 0.0, 0.0);
}

TEST(each_quantity_ends_the_run)
{
    static const struct {
        const char *name;
        double percent;
    } rows[] = {[LAMBDA_MAX] = {"lambda_max", 0.5},
                [LAMBDA] = {"lambda(10)", 0.5},
                [H_KS] = {"h_KS", 0.2},
                [T] = {"T(1,0)", 0.4},
                [LP] = {"LP(1,0)", 1.5},
                [C_T] = {"c_T", 1.5},
                [C_L] = {"c_L", 2.0},
                [V] = {"v", 1.5},
                [OMEGA] = {"omega(1,0)", 1.0},
                [RATE] = {"collision_rate", 0.2},
                [PRESSURE] = {"pressure", 0.3}};
    for (int what = 0; what <= PRESSURE; what++)
        expect_end(rows[what].name, what, rows[what].percent);
}

/** A run without end states errors early enough to stop near 1 %, not far below. */
TEST(a_large_error_ends_it_soon)
{
    for (uint64_t seed = 1; seed <= 4; seed++) {
        const hd_scene_def def = scene_from(long_box(), .observe = 0, .duration = 0.0,
                                            .exponents = 4, .seed = seed);
        OWNED(hd_run) *run = finished(aiming(def, "lambda_max 1%"));
        const hd_spectrum *s = hd_run_spectrum(run);
        const double error = of(hd_spectrum_std_error(s, 0), hd_spectrum_exponent(s, 0));
        print_message("%.2f%% after %.0f\n", 100.0 * error, hd_run_time(run) - 65.0);
        CHECK_WITHIN(error, 0.007, 0.01);
    }
}

/** All of them; the farthest one is named on the way. */
TEST(the_farthest_of_several_is_told)
{
    OWNED(hd_run) *run = until(
        created(aiming(long_box(), "pressure 50%, lambda_max 50%, h_KS 0.2%")), HD_AVERAGING);
    hd_target_progress at = hd_run_cost(run).target;
    assert_true(at.error < 0 && at.wanted < 0 && isinf(at.left) && !at.reached);
    assert_true(hd_run_cost(run).progress < 0.1);
    while (!(at.error > 0)) CHECK_OK(hd_run_advance(run)), at = hd_run_cost(run).target;
    assert_string_equal(at.name, "h_KS");
    CHECK_CLOSE(at.wanted, 0.002 * hd_spectrum_sum_up(hd_run_spectrum(run)).ks_entropy, 1e-9);
    CHECK_CLOSE(at.left, (hd_run_time(run) - 65.0) * (pow(at.error / at.wanted, 2.0) - 1.0),
                1e-6 * at.left);
    finish(run);
    assert_true(stated(run, H_KS) <= 0.002);
}

/** What averaging takes away is not all: the rest is known, and nothing is predicted. */
TEST(what_stays_open_is_told)
{
    OWNED(hd_run) *run = finished(aiming(scene_from(long_box(), .duration = 3000.0), "c_L 1.4%"));
    const hd_target_progress at = hd_run_cost(run).target;
    print_message("c_L open %.3g, wanted %.3g, error %.3g\n", at.open, at.wanted, at.error);
    CHECK_CLOSE(hd_run_time(run), 3065.0, 1e-6);
    assert_true(at.open > at.wanted && at.error > at.open && isinf(at.left) && !at.reached);
    const hd_dispersion l = hd_steps_dispersion(hd_run_steps(run), hd_run_spectrum(run),
                                                HD_MODE_LP);
    const double falls = pow(l.c_sampling_error, 2.0) - pow(l.c_mixing, 2.0);
    CHECK_CLOSE(at.error * at.error - at.open * at.open, falls, 1e-6 * falls);
    assert_true(l.c_mixing > 0);
}

/** Of a step it is what mixing adds. */
TEST(mixing_stays_open)
{
    OWNED(hd_run) *run = finished(
        aiming(scene_from(long_box(), .duration = 1000.0), "LP(1,0) 0.001%"));
    const hd_target_progress at = hd_run_cost(run).target;
    const int k = step_named(hd_run_steps(run), HD_MODE_LP);
    CHECK_CLOSE(at.open, hd_steps_step(hd_run_steps(run), k)->mixing, 0.0);
    assert_true(at.open > at.wanted && at.error > at.open && isinf(at.left));
}

/** Without vectors the gas alone ends it. */
TEST(a_trajectory_ends_by_its_gas)
{
    OWNED(hd_run) *run = finished(
        aiming(scene_from(long_box(), .exponents = HD_EXPONENTS_NONE, .observe = HD_OBSERVE_GAS),
               "collision_rate 0.5%"));
    const hd_gas_means gas = hd_gas_read(hd_run_gas(run));
    assert_true(gas.collision_rate_error > 0);
    assert_true(gas.collision_rate_error <= 0.005 * gas.collision_rate && gas.time < 19000.0);
}

/** Whoever looks at nothing else: the stages that a target needs go on. */
TEST(what_nobody_looks_at_is_observed_for_the_target)
{
    OWNED(hd_run) *run = until(created(aiming(long_box(), "T(1,0) 2%")), HD_AVERAGING);
    hd_run_observe(run, 0);
    finish(run);
    assert_true(hd_run_time(run) < 65.0 + 19000.0 && of_step(run, HD_MODE_T) <= 0.02);
}
