/** Random runs, changed, reset, kept and taken up again at random steps, beside themselves without
 * an interruption.
 *
 *   test_resume [RUNS [FIRST]]    so many of them, the first one of this seed; for hours, too */
#include "draw.h"
#include "kept.h"
#include "run/run_state.h"
#include "same.h"

enum { RUNS = HD_SANITIZED ? 30 : 120, RUNS_OF_SECOND_TIER = 300, STEPS = 400 };

/** Enough of disks without exponents, which take some 1e5 in a step. */
static const uint64_t EVENTS = 300000;
/** Of an end that is ahead by no more than this, see agenda.c. */
static const double ROUNDING = 64.0 * DBL_EPSILON;

/** The same run twice, one of them taken up again now and then. */
typedef struct twins {
    hd_run *alone, *other;
    double watch_interval;
    int watch_first;
} twins;

/* ---- random scenes ------------------------------------------------------------------------- */

/** Far beyond any duration, too. */
static double drawn_report_interval(hd_random *random)
{
    return chance(random, 0.6) ? log_uniform(random, 0.05, 10.0) : log_uniform(random, 10.0, 1e12);
}

/** Quantities that a scene may have, or not. */
static hd_text drawn_target(hd_random *random)
{
    static const char *const names[] = {"smallest", "lambda_max", "h_KS",     "T(1,0)", "c_T",
                                        "c_L",      "v",          "pressure", "LP(0,1)"};
    hd_text text = {""};
    for (int k = chance(random, 0.5) ? 0 : 1 + one_of(random, 2); k > 0; k--) {
        const size_t length = strlen(text.line);
        const int name = chance(random, 0.5) ? 0 : one_of(random, 9);
        snprintf(text.line + length, HD_TEXT - length, "%s%s %.3g%s", length > 0 ? ", " : "",
                 names[name], log_uniform(random, 1e-3, 1.0), name && k % 2 ? "%" : "");
    }
    return text;
}

/** Of so many disks. */
static int drawn_exponents(hd_random *random, int disks)
{
    static const int words[] = {HD_EXPONENTS_NONE, HD_EXPONENTS_POSITIVE, HD_EXPONENTS_POSITIVE,
                                HD_EXPONENTS_ALL, HD_EXPONENTS_ALL_INDEPENDENT};
    return chance(random, 0.7) ? words[one_of(random, 5)] : 1 + one_of(random, 4 * disks);
}

static unsigned drawn_observables(hd_random *random, const hd_scene_def *def)
{
    const unsigned any = (unsigned)one_of(random, HD_OBSERVE_ALL + 1);
    if (def->exponents == HD_EXPONENTS_NONE) return any & HD_OBSERVE_GAS;
    if (chance(random, 0.1)) return any | HD_OBSERVE_COVARIANT;
    return chance(random, 0.6) ? any & ~(unsigned)HD_OBSERVE_COVARIANT : 0;
}

/** Another kind of particles than disks in a rectangle, now and then. */
static void draw_particles(hd_scene_def *def, hd_random *random)
{
    const int kind = one_of(random, 2 * (HD_PARTICLES_END - 1));
    if (kind == 0 || kind >= HD_PARTICLES_END) return;
    const hd_scene_def core = {.particles = (hd_particles)kind};
    const hd_scene_def own = hd_scene_def_of(hd_dynamics_of(&core));
    def->particles = own.particles;
    memcpy(def->own, own.own, sizeof def->own);
    if (!hd_dynamics_of(def)->step) return;
    def->boundary[0] = def->boundary[1] = P;
    def->aspect = 1.0;
    def->density = log_uniform(random, 0.1, 0.7);
}

static hd_scene_def drawn(hd_random *random)
{
    hd_scene_def def = scene(.number = 2 + (int)(28.0 * pow(uniform(random), 2.0)),
                             .density = log_uniform(random, 0.02, 0.9),
                             .aspect = log_uniform(random, 0.1, 10.0));
    for (int d = 0; d < 2; d++) def.boundary[d] = (hd_boundary)one_of(random, 2);
    if (chance(random, 0.15))
        def = scene(.container = HD_CIRCLE, .number = def.number, .density = def.density);
    else
        draw_particles(&def, random);
    def.seed = (uint64_t)one_of(random, 1 << 30);
    def.exponents = drawn_exponents(random, def.number);
    def.observe = drawn_observables(random, &def);
    if (def.container == HD_CIRCLE)
        def.observe &= ~(unsigned)(HD_OBSERVE_HYDRO | HD_OBSERVE_STRUCTURE);
    def.equilibration = chance(random, 0.3) ? 0.0 : log_uniform(random, 0.1, 10.0);
    def.warmup = chance(random, 0.2) ? 0.0 : log_uniform(random, 0.1, 10.0);
    def.duration = chance(random, 0.3) ? 0.0 : log_uniform(random, 0.5, 300.0);
    def.report_interval = drawn_report_interval(random);
    def.target = drawn_target(random);
    if (chance(random, 0.2)) def.interval = log_uniform(random, 0.05, 5.0);
    if (chance(random, 0.3)) def.accuracy = log_uniform(random, 1e-10, 1e-3);
    def.threads = 1;
    if (!(def.observe & HD_OBSERVE_COVARIANT)) return def;
    def.covariant_window = log_uniform(random, 1.0, 5.0);
    def.covariant_transient = log_uniform(random, 1.0, 5.0);
    def.covariant_sampling = log_uniform(random, 0.3, def.covariant_window);
    def.warmup = def.covariant_transient;
    def.duration = log_uniform(random, 1.0, 4.0) * (def.covariant_window + def.covariant_transient);
    def.target = (hd_text){""};
    return def;
}

static hd_scene_def drawn_possible(hd_random *random)
{
    hd_scene_def def = drawn(random);
    while (hd_scene_check(&def, NULL, 0) != HD_OK || hd_target_check(&def, NULL, 0) != HD_OK)
        def = drawn(random);
    return def;
}

/* ---- what is asked of both ----------------------------------------------------------------- */

/** As the node does when it begins, and again when it is started anew. */
static void tell(const twins *t, hd_run *run) { hd_run_watch(run, t->watch_interval); }

/** Also shorter than it may be, as short as it can be, and to the end that is ahead. */
static double drawn_duration(hd_random *random, const hd_run *run)
{
    const double least = fmax(0.0, hd_run_change_time(run) - run->agenda.start);
    const double more = chance(random, 0.5) ? 0.0 : log_uniform(random, 1e-12, 50.0);
    switch (one_of(random, 4)) {
    case 0: return 0.0;
    case 1: return uniform(random) * least;
    case 2: return fmax(hd_run_scene(run)->duration, least) + more;
    default: return least + more;
    }
}

static hd_text drawn_value(hd_random *random, const hd_parameter *row, const hd_run *run)
{
    hd_text text;
    if (row->kind == HD_PARAMETER_TEXT) return drawn_target(random);
    const bool reports = strcmp(row->name, "report_interval") == 0,
               fields = strcmp(row->name, "field_interval") == 0;
    snprintf(text.line, HD_TEXT, "%.17g",
             fields    ? log_uniform(random, 0.1, 100.0)
             : reports ? drawn_report_interval(random)
                       : drawn_duration(random, run));
    return text;
}

/** Another value for one of the live parameters, or what is refused alike. */
static void change(twins *t, hd_random *random)
{
    int count;
    const hd_parameter *row = hd_scene_parameters(&count);
    for (int live = one_of(random, 4); !row->live || live-- > 0; row++) continue;
    const hd_text value = drawn_value(random, row, t->alone);
    char line[2][256] = {"", ""};
    assert_int_equal(hd_run_change(t->alone, row, value.line, line[0], sizeof line[0]),
                     hd_run_change(t->other, row, value.line, line[1], sizeof line[1]));
    assert_string_equal(line[0], line[1]);
}

static void ask(twins *t, hd_random *random)
{
    hd_run *const both[] = {t->alone, t->other};
    const int what = one_of(random, 8);
    const unsigned observed = (unsigned)one_of(random, HD_OBSERVE_ALL + 1);
    if (what > 2) change(t, random);
    for (int k = 0; k < 2; k++) {
        if (what == 0) tell(t, both[k]);
        if (what == 1) CHECK_OK(hd_run_reset_average(both[k]));
        if (what == 2) hd_run_observe(both[k], observed);
    }
}

/** By the scene that was kept, or by the same one given again. */
static void take_up(twins *t, bool same_scene)
{
    const hd_scene_def scene = *hd_run_scene(t->other);
    char line[512] = "";
    CHECK_OK(hd_run_settle(t->other)); /* as hd_run_save does */
    const bytes kept = kept_bytes(t->other);
    hd_run_free(t->other);
    if (kept_read(&t->other, &kept, same_scene ? &scene : NULL, line, sizeof line) != HD_OK)
        fail_msg("%s", line);
    free(kept.data);
    tell(t, t->other);
}

/* ---- one beside the other ------------------------------------------------------------------ */

static void expect_same_step(const twins *t)
{
    const hd_run *a = t->alone, *b = t->other;
    CHECK_CLOSE(hd_run_time(a), hd_run_time(b), 0.0);
    assert_int_equal(hd_run_stage(a), hd_run_stage(b));
    assert_int_equal(hd_run_report_due(a), hd_run_report_due(b));
    assert_int_equal(hd_run_fields_due(a), hd_run_fields_due(b));
    assert_int_equal(hd_trajectory_totals(hd_run_trajectory(a)).collisions,
                     hd_trajectory_totals(hd_run_trajectory(b)).collisions);
}

/** A run has ended at its end, or where its target was reached. */
static void expect_ended(const hd_run *run)
{
    const double end = hd_run_time(run);
    assert_true(hd_run_report_due(run));
    if (hd_run_cost(run).target.reached) return;
    CHECK_CLOSE(end, run->agenda.start + hd_run_scene(run)->duration, ROUNDING * end);
}

static bool is_under_way(const twins *t)
{
    const hd_trajectory *disks = hd_run_trajectory(t->alone);
    return hd_run_stage(t->alone) != HD_FINISHED &&
           hd_trajectory_totals(disks).collisions + hd_trajectory_totals(disks).wall_events <
               EVENTS;
}

static void step_on(const twins *t, hd_run *run)
{
    CHECK_OK(hd_run_advance(run));
    if (t->watch_interval < INFINITY && t->watch_first < hd_run_vectors(run))
        CHECK_OK(hd_run_measure(run, t->watch_first));
}

static void go_on(twins *t, hd_random *random)
{
    const double often = log_uniform(random, 0.003, 0.3), kept = log_uniform(random, 0.003, 0.3);
    for (int step = 0; step < STEPS && is_under_way(t); step++) {
        if (chance(random, often)) ask(t, random);
        if (chance(random, kept)) take_up(t, chance(random, 0.5));
        step_on(t, t->alone);
        step_on(t, t->other);
        expect_same_step(t);
    }
    if (hd_run_stage(t->alone) == HD_FINISHED) expect_ended(t->alone);
    expect_same_state(t->alone, t->other);
    take_up(t, true); /* what has ended stays ended */
    expect_same_state(t->alone, t->other);
}

/** To the next report; kept now and then, if there is a generator. */
static void to_report(twins *t, hd_run **run, hd_random *random)
{
    do {
        if (random && chance(random, 0.1)) take_up(t, chance(random, 0.5));
        step_on(t, *run);
    } while (!hd_run_report_due(*run) && hd_run_stage(*run) != HD_FINISHED);
}

/** A window of covariant vectors begins anew, so that intervals end elsewhere: reports and disks
 * are the same, exponents as accurate as asked. */
static void go_on_with_windows(twins *t, hd_random *random)
{
    const int n = hd_run_vectors(t->alone);
    for (int reports = 0; reports < STEPS && is_under_way(t); reports++) {
        to_report(t, &t->alone, NULL);
        to_report(t, &t->other, random);
        expect_same_step(t);
    }
    if (hd_run_stage(t->alone) != HD_FINISHED) return;
    const hd_spectrum *a = hd_run_spectrum(t->alone), *b = hd_run_spectrum(t->other);
    for (int col = 0; col < n; col++)
        CHECK_CLOSE(hd_spectrum_exponent(a, col), hd_spectrum_exponent(b, col),
                    2.0 * hd_run_scene(t->alone)->accuracy);
}

static void a_resumed_run_is_the_uninterrupted_one(void **state)
{
    hd_random random = hd_random_seeded(*(const uint64_t *)*state, 0);
    const hd_scene_def def = drawn_possible(&random);
    twins t = {.alone = kept_run(def), .other = kept_run(def), .watch_interval = INFINITY};
    if (chance(&random, 0.2)) t.watch_interval = log_uniform(&random, 0.02, 1.0);
    t.watch_first = chance(&random, 0.5) ? hd_run_vectors(t.alone) * 3 / 4 : 4 * def.number;
    tell(&t, t.alone);
    tell(&t, t.other);
    if (hd_run_covariant(t.alone))
        go_on_with_windows(&t, &random);
    else
        go_on(&t, &random);
    hd_run_free(t.alone);
    hd_run_free(t.other);
}

int main(int count, char **argument)
{
    const size_t usual = second_tier() ? RUNS_OF_SECOND_TIER : RUNS;
    const size_t runs = count > 1 ? (size_t)strtoul(argument[1], NULL, 10) : usual;
    const uint64_t first = count > 2 ? strtoull(argument[2], NULL, 10) : 1;
    struct CMUnitTest *tests = calloc(runs, sizeof *tests);
    struct named {
        uint64_t seed;
        char text[32];
    } *names = calloc(runs, sizeof *names);
    for (size_t k = 0; tests && names && k < runs; k++) {
        names[k].seed = first + k;
        snprintf(names[k].text, sizeof names[k].text, "seed %llu", (unsigned long long)(first + k));
        tests[k] = (struct CMUnitTest){.name = names[k].text,
                                       .test_func = a_resumed_run_is_the_uninterrupted_one,
                                       .initial_state = &names[k].seed};
    }
    const int failed = tests && names ? _cmocka_run_group_tests("resume", tests, runs, NULL, NULL)
                                      : 1;
    free(tests);
    free(names);
    return failed;
}
