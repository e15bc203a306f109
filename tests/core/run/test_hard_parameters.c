/** Thousands of random scenes, possible and impossible: each runs, or is refused by the name of a
 * parameter. */
#include <limits.h>
#include "draw.h"
#include "runs.h"

enum { LINE = 256 };

/** A run is followed for so long: the first steps are short, each at most four times the one
 * before. */
enum { STEPS_MAX = 60, EVENTS_ENOUGH = 3000 };
/** Of one step: run.c aims at 2e5, from what the step before it met. */
static const double EVENTS_OF_A_STEP_MAX = 1e6;
/** Of more disks it is only asked whether they are refused: a frame would take gigabytes. */
enum { DISKS_RUN = 200 };

/** Relative error of N additions of products and of so many collisions, which conserve it to
 * rounding each. */
static const double ENERGY_ERROR = 1e4 * DBL_EPSILON;
/** As stated by hd_trajectory_advance. */
static const double OVERLAP_MAX = 1e-9;

/* ---- random scenes ------------------------------------------------------------------------- */

static uint64_t bits(hd_random *random)
{
    const double two_32 = 4294967296.0;
    const uint64_t high = (uint64_t)(uniform(random) * two_32);
    return high << 32 | (uint64_t)(uniform(random) * two_32);
}

/** Values that scenes usually have here: small ones, which run fast. Of the others all that is
 * allowed is usual. */
static const struct {
    const char *name;
    double low, high;
} USUAL[] = {
    {"disks", 2, 30},
    {"density", 0.01, 0.8},
    {"aspect", 0.1, 10},
    {"exponents", -2, 8},
    {"equilibration", 1e-3, 1},
    {"warmup", 1e-3, 1},
    {"duration", 0.1, 100},
    {"interval", 0.01, 10},
    {"report_interval", 0.1, 10},
    {"phase_interval", 0.05, 10},
    {"max_wave_number", 0.3, 3},
    {"max_mode_number", 0, 3},
    {"observe", 0, HD_OBSERVE_ALL ^ HD_OBSERVE_COVARIANT},
    {"threads", 0, 2},
};

static bool is_whole(const hd_parameter *p)
{
    return p->kind != HD_PARAMETER_REAL && p->kind != HD_PARAMETER_INTERVAL;
}

static void put(hd_scene_def *def, const hd_parameter *p, double real, int whole)
{
    hd_parameter_assign(p, def, is_whole(p) ? whole : real);
}

/** Within a range, its ends included; down to denormals where the range begins at 0. */
static void put_within(hd_random *random, hd_scene_def *def, const hd_parameter *p, double least,
                       double most)
{
    const double floor_of = is_whole(p) ? 1.0 : DBL_TRUE_MIN;
    double x = log_uniform(random, fmax(least, floor_of), fmax(most, floor_of));
    if (chance(random, 0.1)) x = least;
    if (chance(random, 0.1)) x = most;
    if (is_whole(p) && least < 1 && chance(random, 0.5)) x = least + one_of(random, 1 - (int)least);
    put(def, p, x, (int)x);
}

/** What no user means: not numbers, the ends of the types, just outside the range, any bits. */
static void put_wild(hd_random *random, hd_scene_def *def, const hd_parameter *p)
{
    const double reals[] = {NAN,
                            INFINITY,
                            -INFINITY,
                            -1.0,
                            -0.0,
                            DBL_TRUE_MIN,
                            DBL_MAX,
                            -DBL_TRUE_MIN,
                            DBL_MIN,
                            p->least * (1.0 - 1e-9),
                            p->most * (1.0 + 1e-9),
                            -DBL_MAX,
                            0.0};
    const int wholes[] = {INT_MIN, INT_MAX, -1, -3, 0, 1, (int)p->most + 1, (int)p->least - 1};
    const uint64_t any = bits(random);
    double real;
    memcpy(&real, &any, sizeof real);
    if (chance(random, 0.7)) real = reals[one_of(random, sizeof reals / sizeof *reals)];
    int whole = (int)(any & INT_MAX);
    if (chance(random, 0.7)) whole = wholes[one_of(random, sizeof wholes / sizeof *wholes)];
    put(def, p, real, whole);
}

static bool is_named(const hd_parameter *p, const char *name) { return strcmp(p->name, name) == 0; }

/** Threads are a machine's, and large boxes take long: seldom. */
static bool is_costly(const hd_parameter *p)
{
    return is_named(p, "disks") || is_named(p, "threads");
}

static void put_usual(hd_random *random, hd_scene_def *def, const hd_parameter *p)
{
    double low = p->least, high = p->most;
    for (size_t k = 0; k < sizeof USUAL / sizeof *USUAL; k++)
        if (is_named(p, USUAL[k].name)) low = USUAL[k].low, high = USUAL[k].high;
    put_within(random, def, p, low, high);
}

/** A channel hardly wider than a disk, down to the last bit. */
static void make_narrow(hd_random *random, hd_scene_def *def)
{
    const double width = 1.0 + log_uniform(random, DBL_EPSILON, 1.0);
    def->aspect = width * width * def->density / def->disks;
    if (chance(random, 0.5)) def->aspect = 1.0 / def->aspect;
}

/** Covariant vectors are left out: on their way back steps take no simulated time. Half of the
 * scenes have wild values; the others are possible one by one, if not together. */
static hd_scene_def drawn(hd_random *random)
{
    hd_scene_def def = hd_scene_def_default();
    const bool wild = chance(random, 0.5);
    int count;
    const hd_parameter *rows = hd_scene_parameters(&count);
    for (int k = 0; k < count; k++) {
        const hd_parameter *p = &rows[k];
        if (p->kind == HD_PARAMETER_SEED || p->needs == HD_OBSERVE_COVARIANT) continue;
        if (is_of_spheres(p) && chance(random, 0.98)) continue;
        if (is_named(p, "max_mode_number") && chance(random, 0.5)) continue;
        if (is_named(p, "max_wave_number") && chance(random, 0.8)) continue;
        put_usual(random, &def, p);
        if (p->kind != HD_PARAMETER_SET && chance(random, is_costly(p) ? 0.005 : 0.1))
            put_within(random, &def, p, p->least, p->most);
        if (wild && chance(random, 0.1)) put_wild(random, &def, p);
    }
    if (chance(random, 0.05)) make_narrow(random, &def);
    def.seed = bits(random);
    return def;
}

static void print_scene(int number, const hd_scene_def *def)
{
    print_error("set %d: disks %d density %a aspect %a boundaries %d %d seed %llu exponents %d\n"
                "  equilibration %a warmup %a duration %a target %s interval %a accuracy %a\n"
                "  report_interval %a phase_interval %a observe %x max_wave_number %a "
                "max_mode_number %d threads %d\n",
                number, def->disks, def->density, def->aspect, (int)def->boundary[0],
                (int)def->boundary[1], (unsigned long long)def->seed, def->exponents,
                def->equilibration, def->warmup, def->duration, def->target.line, def->interval,
                def->accuracy, def->report_interval, def->phase_interval, def->observe,
                def->max_wave_number, def->max_mode_number, def->threads);
}

/* ---- what becomes of them ------------------------------------------------------------------ */

/** One line, which begins with the name of a parameter, and its value. */
static bool is_named_line(const char *line)
{
    int count;
    const hd_parameter *rows = hd_scene_parameters(&count);
    if (strchr(line, '\n') || !strstr(line, ": ")) return false;
    for (int k = 0; k < count; k++) {
        const size_t length = strlen(rows[k].name);
        if (strncmp(line, rows[k].name, length) == 0 && strncmp(line + length, " = ", 3) == 0)
            return true;
    }
    return false;
}

/** A shorter room holds the beginning of the same line, and nothing is written behind it. */
static bool same_in_short_room(const hd_scene_def *def, const char *line, size_t size)
{
    char room[LINE];
    memset(room, '#', sizeof room);
    if (hd_scene_check(def, room, size) != HD_REFUSED) return false;
    for (size_t k = size; k < sizeof room; k++)
        if (room[k] != '#') return false;
    if (size == 0) return true;
    const size_t shown = strlen(line) < size ? strlen(line) : size - 1;
    return memcmp(room, line, shown) == 0 && room[shown] == '\0';
}

static double events_of(const hd_run *run)
{
    const hd_trajectory *trajectory = hd_run_trajectory(run);
    return (double)(hd_trajectory_collisions(trajectory) + hd_trajectory_wall_events(trajectory));
}

/** NULL if all went well, otherwise what did not. */
static const char *step_once(hd_run *run)
{
    const double before = hd_run_time(run), events = events_of(run);
    const hd_stage phase = hd_run_stage(run);
    const hd_status status = hd_run_advance(run);
    if (status != HD_OK) return hd_status_text(status);
    if (!(hd_run_time(run) > before) && hd_run_stage(run) == phase) return "a step goes nowhere";
    if (!(events_of(run) - events <= EVENTS_OF_A_STEP_MAX)) return "a step without end";
    return NULL;
}

static const char *state_fault(const hd_run *run)
{
    const hd_trajectory *trajectory = hd_run_trajectory(run);
    const double disks = hd_run_scene(run)->disks;
    if (!(fabs(hd_trajectory_kinetic_energy(trajectory) - disks) <= ENERGY_ERROR * disks))
        return "the energy is not conserved";
    if (!(hd_trajectory_overlap(trajectory) <= OVERLAP_MAX)) return "disks overlap";
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    for (int col = 0; spectrum && col < hd_run_vectors(run); col++)
        if (hd_spectrum_time(spectrum) > 0 && !isfinite(hd_spectrum_exponent(spectrum, col)))
            return "an exponent is not finite";
    return NULL;
}

static const char *run_fault(hd_run *run)
{
    const char *fault = NULL;
    for (int step = 0; !fault && step < STEPS_MAX && events_of(run) < EVENTS_ENOUGH &&
                       hd_run_stage(run) != HD_FINISHED;
         step++)
        fault = step_once(run);
    return fault ? fault : state_fault(run);
}

/** How often a scene was what. */
typedef struct tally {
    int run, refused, averaged;
} tally;

static const char *refusal_fault(hd_random *random, const hd_scene_def *def, const char *line,
                                 tally *seen)
{
    if (!is_named_line(line)) return "the line names no parameter";
    seen->refused++;
    return same_in_short_room(def, line, (size_t)one_of(random, LINE)) ? NULL
                                                                       : "a short room overflows";
}

static const char *scene_fault(hd_random *random, const hd_scene_def *def, tally *seen)
{
    char line[LINE] = "";
    OWNED(hd_run) *run = NULL;
    hd_status status = hd_scene_check(def, line, sizeof line);
    if (status == HD_OK && def->disks > DISKS_RUN) return NULL;
    if (status == HD_OK) status = hd_run_create(&run, def, line, sizeof line);
    if (status == HD_REFUSED) return refusal_fault(random, def, line, seen);
    if (status != HD_OK) return hd_status_text(status);
    const char *fault = *line ? line : run_fault(run);
    seen->run++;
    seen->averaged += hd_run_stage(run) >= HD_AVERAGING;
    return fault;
}

TEST(each_runs_or_is_refused_by_name)
{
    hd_random random = hd_random_seeded(20260801, 0);
    const int sets = HD_SANITIZED ? 2000 : second_tier() ? 10000 : 4000;
    tally seen = {0};
    int faults = 0;
    for (int number = 0; number < sets; number++) {
        const hd_scene_def def = drawn(&random);
        const char *fault = scene_fault(&random, &def, &seen);
        if (!fault) continue;
        print_scene(number, &def);
        print_error("  %s\n", fault);
        faults++;
    }
    assert_int_equal(faults, 0);
    assert_true(seen.run >= sets / 10 && seen.refused >= sets / 10);
    assert_true(seen.averaged >= sets / 20);
}

/** Steps until the run ends; fails if one goes nowhere, or takes more events than it should. */
static int steps_to_the_end(const hd_scene_def *def)
{
    OWNED(hd_run) *run = NULL;
    int steps = 0;
    run = created(*def);
    for (; hd_run_stage(run) != HD_FINISHED; steps++) {
        const char *fault = step_once(run);
        if (!fault) continue;
        print_scene(steps, def);
        fail_msg("%s", fault);
    }
    assert_null(state_fault(run));
    return steps;
}

/** Phases so short that the time does not move in them: what comes after is not held up. From 1e-12
 * steps grow by 4 each, which is 25 of them to 1e3; a sample here and there ends one early. */
TEST(phases_without_length_pass)
{
    const double lengths[] = {DBL_TRUE_MIN, DBL_MIN, 1e-300, 1e-30, 1e-17, 1e-15, 1e-12};
    for (size_t k = 0; k < 3 * 7; k++) {
        hd_scene_def def = scene(.disks = 5, .density = 0.5, .aspect = 1.0,
                                 .boundary[0] = (hd_boundary)(k % 2), .seed = k,
                                 .equilibration = k / 7 == 0 ? lengths[k % 7] : 1.0,
                                 .warmup = k / 7 == 1 ? lengths[k % 7] : 1.0,
                                 .duration = k / 7 == 2 ? lengths[k % 7] : 1.0,
                                 .observe = HD_OBSERVE_STEPS);
        assert_true(steps_to_the_end(&def) < 200);
    }
}

/** Between walls 1e-9 further apart than a disk there are 1e9 events of each disk in a time unit:
 * the first step must not be one of a thousandth of a collision, and those after it not too long.
 */
TEST(narrow_channels_keep_steps_short)
{
    enum {
        STEPS = 18
    }; /* 1e-12 time units at first, each four times the one before, up to 2e5 events */
    hd_scene_def def = scene_in_box(4, 40.0, 1.0 + 1e-9, P, R, 1);
    OWNED(hd_run) *run = NULL;
    def.equilibration = 1.0;
    run = created(def);
    for (int step = 0; step < STEPS; step++) assert_null(step_once(run));
    assert_true(events_of(run) > 2e5);
    assert_null(state_fault(run));
}
