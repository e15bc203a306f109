/** Averages that a row tells of its states: what they are means of, how well their errors are
 * known, who sees them, and what is refused. */
#include "hamiltonians.h"
#include "kept.h"

/* ---- rows that tell ------------------------------------------------------------------------ */

enum { KINETIC, POTENTIAL, VIRIAL, CONSTANT, TOLD };
static const hd_average told[] = {{"kinetic", "energy"}, {"bonds", "energy"}, {"virial", ""},
                                  {"constant", ""},      {"e_5", ""},         {"e_6", ""},
                                  {"e_7", ""},           {"e_8", ""},         {"e_9", ""}};

/** Of the chain, per particle: kinetic and potential energy; half of the sum of d V'(d), whose mean
 * is that of the kinetic energy [virial theorem]; a number that is always .1. */
static void measure_chain(const hd_scene_def *scene, const double *q, const double *p,
                          double *value)
{
    const int n = scene->number;
    value[KINETIC] = value[POTENTIAL] = value[VIRIAL] = 0.0;
    for (int i = 0; i < n; i++) {
        const double d = q[(i + 1) % n] - q[i], bent = scene->own[BETA].real * d * d;
        value[KINETIC] += 0.5 * p[i] * p[i] / n;
        value[POTENTIAL] += d * d * (0.5 + 0.25 * bent) / n;
        value[VIRIAL] += 0.5 * d * d * (1.0 + bent) / n;
    }
    value[CONSTANT] = 0.1;
}

static hd_dynamics telling(void)
{
    hd_dynamics row = of_chain;
    row.average = told;
    row.averages = TOLD;
    row.measure = measure_chain;
    return row;
}

static hd_scene_def scene_with(const hd_dynamics *row, double duration)
{
    return scene_from(chain_scene(8, 1, 0.03), .dynamics = row, .exponents = HD_EXPONENTS_NONE,
                      .warmup = 0.0, .duration = duration, .observe = HD_OBSERVE_AVERAGES);
}

static hd_mean mean_of(const hd_run *run, int k)
{
    return hd_averages_read(hd_run_averages(run), k);
}

/** Both say the same, to the bit. */
static void expect_same(const hd_run *a, const hd_run *b)
{
    CHECK_CLOSE(hd_averages_time(hd_run_averages(a)), hd_averages_time(hd_run_averages(b)), 0.0);
    for (int k = 0; k < TOLD; k++) {
        CHECK_CLOSE(mean_of(a, k).mean, mean_of(b, k).mean, 0.0);
        CHECK_CLOSE(mean_of(a, k).std_error, mean_of(b, k).std_error, 0.0);
    }
}

/* ---- means --------------------------------------------------------------------------------- */

/** Those of the particles by themselves, four looks in 1 / growth = 5 time units. The sums of 800
 * numbers are right to 800 DBL_EPSILON of them. */
TEST(means_are_those_of_the_states)
{
    const hd_dynamics row = telling();
    const hd_scene_def scene = scene_with(&row, 1000.0);
    OWNED(hd_run) *run = finished(scene);
    MADE(hd_trajectory, tr, &scene);
    double q[8], p[8], value[TOLD], sum[TOLD] = {0.0};
    const int looks = 800;
    for (int look = 1; look <= looks; look++) {
        CHECK_OK(hd_trajectory_extend(tr, NULL, scene.equilibration + 1.25 * look));
        hd_trajectory_state(tr, q, p);
        measure_chain(&scene, q, p, value);
        for (int k = 0; k < TOLD; k++) sum[k] += value[k];
    }
    assert_int_equal(hd_averages_count(hd_run_averages(run)), TOLD);
    CHECK_CLOSE(hd_averages_time(hd_run_averages(run)), 1000.0, 0.0);
    for (int k = 0; k < TOLD; k++) {
        const double rounding = looks * DBL_EPSILON * sum[k] / looks;
        CHECK_CLOSE(mean_of(run, k).mean, sum[k] / looks, rounding);
        assert_string_equal(mean_of(run, k).name, told[k].name);
        assert_string_equal(mean_of(run, k).unit, told[k].unit);
    }
}

/** The energy, 10 for each particle, is kept to what is asked; half of the virial has the mean of
 * the kinetic energy. What is constant is known exactly. */
TEST(means_are_what_theory_says)
{
    const hd_dynamics row = telling();
    const hd_scene_def scene = scene_with(&row, 20000.0);
    OWNED(hd_run) *run = finished(scene);
    const hd_mean kinetic = mean_of(run, KINETIC), bonds = mean_of(run, POTENTIAL),
                  virial = mean_of(run, VIRIAL), constant = mean_of(run, CONSTANT);
    CHECK_CLOSE(kinetic.mean + bonds.mean, 10.0,
                10.0 * hd_trajectory_energy(hd_run_trajectory(run)).most);
    CHECK_CLOSE(kinetic.mean, virial.mean, 4.0 * hypot(kinetic.std_error, virial.std_error));
    CHECK_WITHIN(kinetic.std_error, 1e-3, 0.02 * kinetic.mean);
    CHECK_CLOSE(constant.mean, 0.1, 0.0);
    CHECK_CLOSE(constant.std_error, 0.0, 0.0);
}

/** chi^2 of 15 degrees of freedom, for each number: within 99.9 %. */
TEST(errors_are_the_scatter_of_runs)
{
    enum { SEEDS = 16 };
    const hd_dynamics row = telling();
    double mean[TOLD] = {0.0}, chi2[TOLD] = {0.0};
    hd_mean found[SEEDS][TOLD];
    for (int seed = 0; seed < SEEDS; seed++) {
        OWNED(hd_run) *run = finished(scene_from(
            scene_with(&row, 4000.0), .seed = (uint64_t)seed + 1, .equilibration = 200.0));
        for (int k = 0; k < TOLD; k++) mean[k] += (found[seed][k] = mean_of(run, k)).mean / SEEDS;
    }
    for (int k = KINETIC; k <= VIRIAL; k++) {
        for (int seed = 0; seed < SEEDS; seed++)
            chi2[k] += pow((found[seed][k].mean - mean[k]) / found[seed][k].std_error, 2);
        CHECK_WITHIN(chi2[k], 3.5, 37.7);
    }
}

/* ---- who sees them ------------------------------------------------------------------------- */

/** Whether vectors are carried, whoever watches, however often is reported. */
TEST(looks_do_not_depend_on_intervals)
{
    const hd_dynamics row = telling();
    hd_scene_def scene = scene_with(&row, 300.0);
    OWNED(hd_run) *alone = finished(scene);
    OWNED(hd_run) *watched = created(scene);
    hd_run_watch(watched, 0.37);
    finish(watched);
    expect_same(watched, alone);
    scene.exponents = HD_EXPONENTS_ALL;
    scene.report_interval = 7.0;
    OWNED(hd_run) *carrying = finished(scene);
    expect_same(carrying, alone);
    hd_run_observe(carrying, 0);
    expect_same(carrying, alone);
}

/** In the middle between two looks, and before the first one. */
TEST(a_resumed_run_goes_on_to_the_same_bits)
{
    const hd_dynamics row = telling();
    const hd_scene_def scene = scene_with(&row, 300.0);
    const double times[] = {5.0, scene.equilibration + 0.4, 121.3};
    OWNED(hd_run) *whole = finished(scene);
    for (int k = 0; k < 3; k++) {
        OWNED(hd_run) *run = created(scene), *resumed = NULL;
        hd_run_watch(run, 0.1);
        until_time(run, times[k]);
        const bytes kept = kept_bytes(run);
        CHECK_OK(kept_read(&resumed, &kept, &scene, NULL, 0));
        free(kept.data);
        expect_same(finish(resumed), whole);
    }
}

TEST(averages_begin_anew)
{
    const hd_dynamics row = telling();
    OWNED(hd_run) *run = created(scene_with(&row, 1000.0));
    CHECK_CLOSE(hd_averages_time(hd_run_averages(run)), 0.0, 0.0);
    assert_true(isnan(mean_of(run, 0).mean) && mean_of(run, 0).std_error < 0);
    until_time(run, 900.0);
    assert_true(mean_of(run, 0).std_error > 0);
    CHECK_OK(hd_run_reset_average(run));
    assert_true(isnan(mean_of(run, 0).mean) && mean_of(run, 0).std_error < 0);
    finish(run);
    CHECK_WITHIN(hd_averages_time(hd_run_averages(run)), 998.75, 1000.0);
}

TEST(counts_of_results_have_them)
{
    const hd_dynamics row = telling();
    for (int asked = 0; asked < 2; asked++) {
        const hd_scene_def scene = scene_from(scene_with(&row, 300.0),
                                              .observe = asked ? HD_OBSERVE_AVERAGES : 0);
        OWNED(hd_run) *run = created(scene);
        assert_int_equal(hd_result_counts_of(&scene, run).averages, asked ? TOLD : 0);
    }
    assert_true(hd_observe_of(&row) & HD_OBSERVE_AVERAGES);
    assert_false(hd_observe_of(&of_chain) & HD_OBSERVE_AVERAGES);
    assert_int_equal(hd_observe_of(&hd_disks_row), HD_OBSERVE_ALL);
}

/* ---- targets ------------------------------------------------------------------------------- */

TEST(a_target_names_them)
{
    const hd_dynamics row = telling();
    OWNED(hd_run) *run = finished(
        scene_from(scene_with(&row, 1e5), .target = (hd_text){"kinetic 2%, constant: 0.1"}));
    const hd_mean kinetic = mean_of(run, KINETIC);
    const hd_target_progress progress = hd_run_cost(run).target;
    assert_true(hd_run_time(run) < 2e4);
    CHECK_WITHIN(kinetic.std_error, 1e-3, 0.02 * kinetic.mean);
    assert_string_equal(progress.name, "kinetic");
    CHECK_CLOSE(progress.error, kinetic.std_error, 0.0);
    CHECK_CLOSE(progress.value, kinetic.mean, 0.0);
}

/* ---- what is refused ----------------------------------------------------------------------- */

static void refused(hd_scene_def scene, const char *line)
{
    char message[1024] = "";
    hd_run *run;
    assert_int_equal(hd_run_create(&run, &scene, message, sizeof message), HD_REFUSED);
    assert_string_equal(message, line);
}

TEST(what_nobody_tells_is_refused_by_name)
{
    const hd_dynamics row = telling();
    const char *untold = "target = kinetic 1%: must be without kinetic: averages is not among the "
                         "observables";
    refused(scene_with(&of_chain, 300.0),
            "observables = averages: must not be given with particles "
            "= chain, whose row of dynamics tells no averages");
    refused(scene(.observe = HD_OBSERVE_AVERAGES),
            "observables = averages: must not be given with particles = disks, whose row of "
            "dynamics tells no averages");
    refused(scene_from(scene_with(&row, 300.0), .observe = 0, .target = (hd_text){"kinetic 1%"}),
            untold);
    refused(scene_from(scene_with(&row, 300.0), .target = (hd_text){"kinetics 1%"}),
            "target = kinetics 1%: must be quantities with their errors, as lambda_max 0.01, c_T "
            "1%, up to 16 out of smallest, lambda_max, lambda(index), h_KS, exponent_sum, "
            "kaplan_yorke, collision_rate, pressure, temperature, potential_energy, shear_stress, "
            "velocity_low, velocity_high, divergence, T(nx,ny,nz), LP(nx,ny,nz), c_T, c_L, v, "
            "omega(nx,ny,nz), kinetic, bonds, virial, constant");
}

/** Of the row, by whatever is made of it. */
static void wrong(const hd_dynamics *row, const char *line)
{
    char message[256] = "";
    assert_int_equal(hd_dynamics_check(row, message, sizeof message), HD_REFUSED);
    assert_string_equal(message, line);
    refused(hd_scene_def_of(row), line);
}

#define WRONG(line, ...)                                                                           \
    do {                                                                                           \
        hd_average some[TOLD];                                                                     \
        hd_dynamics row = telling();                                                               \
        memcpy(some, told, sizeof some);                                                           \
        row.average = some;                                                                        \
        __VA_ARGS__;                                                                               \
        wrong(&row, line);                                                                         \
    } while (0)

TEST(members_are_refused_by_name)
{
    WRONG("averages = -1: must be from 0 to 8", row.averages = -1);
    WRONG("averages = 9: must be from 0 to 8", row.averages = 9; row.average = told);
    WRONG("average: must not be NULL with averages = 4", row.average = NULL);
    WRONG("measure: must not be NULL with averages", row.measure = NULL);
    WRONG("measure: must be NULL without averages", row.averages = 0);
    WRONG("average[2].name: must not be NULL", some[2].name = NULL);
    WRONG("average[2].unit: must not be NULL; \"\" is none", some[2].unit = NULL);
    WRONG("average[1].name = kinetic: must not be that of average[0]", some[1].name = "kinetic");
    WRONG("average[1].name = beta: must not be that of a parameter", some[1].name = "beta");
    WRONG("average[1].name = density: must not be that of a parameter", some[1].name = "density");
    for (int k = 0; k < 4; k++) {
        static const char *const names[] = {"", "2d", "a b", "a_name_that_is_of_32_characters_"};
        char line[128];
        snprintf(line, sizeof line,
                 "average[0].name = %s: must be a letter, then letters, digits and _, at most 31",
                 names[k]);
        WRONG(line, some[0].name = names[k]);
    }
}

TEST(names_of_other_quantities_are_refused)
{
    const char *const names[] = {"temperature", "Lambda_Max", "c_T"};
    for (int k = 0; k < 3; k++) {
        const hd_average some[] = {{names[k], ""}};
        hd_dynamics row = telling();
        row.average = some;
        row.averages = 1;
        char line[128];
        snprintf(line, sizeof line,
                 "average[0].name = %s: must not be that of a quantity of targets", names[k]);
        refused(scene_with(&row, 300.0), line);
    }
}

/* ---- rows that lie ------------------------------------------------------------------------- */

static void measure_nan(const hd_scene_def *scene, const double *q, const double *p, double *value)
{
    measure_chain(scene, q, p, value);
    value[VIRIAL] = NAN;
}

static void measure_half(const hd_scene_def *scene, const double *q, const double *p, double *value)
{
    double all[TOLD];
    measure_chain(scene, q, p, all);
    memcpy(value, all, 2 * sizeof *all);
}

static void measure_more(const hd_scene_def *scene, const double *q, const double *p, double *value)
{
    measure_chain(scene, q, p, value);
    value[TOLD] = 0.0;
}

static void measure_and_count(const hd_scene_def *scene, const double *q, const double *p,
                              double *value)
{
    static int calls;
    measure_chain(scene, q, p, value);
    value[KINETIC] += calls++;
}

/** Differences and squares of such numbers may be beyond the largest double. */
static void measure_huge(const hd_scene_def *scene, const double *q, const double *p, double *value)
{
    measure_chain(scene, q, p, value);
    value[VIRIAL] = 1.7e308;
}

/** A number that is not finite, is not written, or whose means would not be finite, ends the run
 * with its name. */
TEST(numbers_that_are_none_end_the_run)
{
    hd_dynamics row = telling();
    for (int k = 0; k < 3; k++) {
        row.measure = k == 0 ? measure_nan : k == 1 ? measure_half : measure_huge;
        OWNED(hd_run) *run = created(scene_with(&row, 300.0));
        hd_status status = HD_OK;
        while (status == HD_OK && hd_run_stage(run) != HD_FINISHED) status = hd_run_advance(run);
        assert_int_equal(status, HD_DYNAMICS_FAULT);
        char line[128];
        snprintf(line, sizeof line, "measure: virial is %s at 21.25: must be from -1e100 to 1e100",
                 k == 2 ? "1.7e+308" : "nan");
        assert_string_equal(hd_run_fault(run), line);
    }
}

TEST(the_test_of_a_row_asks_for_them)
{
    static const struct {
        void (*measure)(const hd_scene_def *, const double *, const double *, double *);
        const char *line;
    } rows[] = {{measure_chain, ""},
                {measure_nan, "measure: virial is nan, and then nan of the same state: must be "
                              "from -1e100 to 1e100, and follow from the state alone"},
                {measure_half, "measure: virial is 1.5, and then 2.5 of the same state: must be "
                               "from -1e100 to 1e100, and follow from the state alone"},
                {measure_more, "measure: must not write more than averages = 4 numbers"},
                {measure_and_count, "measure: kinetic is "}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        hd_dynamics row = telling();
        char message[256] = "";
        row.measure = rows[k].measure;
        const hd_scene_def scene = scene_with(&row, 300.0);
        const hd_status status = hd_dynamics_test(&row, &scene, message, sizeof message);
        assert_int_equal(status, k == 0 ? HD_OK : HD_REFUSED);
        if (strncmp(message, rows[k].line, strlen(rows[k].line)) != 0)
            assert_string_equal(message, rows[k].line);
    }
}
