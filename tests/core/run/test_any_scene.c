/** Random scenes, possible and impossible, of disks and of spheres: each is refused by the name of
 * a parameter, or its events are those of its slow twin, the same at any time, and its run
 * publishes numbers. A case that fails is said; HDLYAP_CASE=number tries it alone. */
#include <limits.h>
#include "bodies.h"
#include "draw.h"
#include "prepared.h"
#include "published.h"
#include "runs.h"
#include "scene/container.h"
#include "twin.h"

enum { LINE = 256 };

/** A run is followed for so long: the first steps are short, each at most four times the one
 * before. */
enum { STEPS_MAX = 60, EVENTS_ENOUGH = 3000 };
/** Of one step: run.c aims at 2e5, from what the step before it met. */
static const double EVENTS_OF_A_STEP_MAX = 1e6;
/** Of more disks it is only asked whether they are refused: a frame would take gigabytes. */
enum { DISKS_RUN = 200 };
/** Beside the twin, which tries every image of every pair. */
enum { DISKS_TWIN = 20, EVENTS_TWIN = 60, PIECES_TWIN = 42 };
static const double IMAGES_TWIN = 1e4;

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
    {"number", 2, 9},
    {"density", 0.01, 0.8},
    {"aspect", 0.1, 10},
    {"aspect_z", 0.1, 10},
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
    {"second_fraction", 0.25, 1}, /* one of two at least */
    {"boundary_x", HD_PERIODIC, DIM == 2 ? HD_SHEARING : HD_REFLECTING},
    {"boundary_y", HD_PERIODIC, DIM == 2 ? HD_SHEARING : HD_REFLECTING},
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
                            p->min * (1.0 - 1e-9),
                            p->max * (1.0 + 1e-9),
                            -DBL_MAX,
                            0.0};
    const int wholes[] = {INT_MIN, INT_MAX, -1, -3, 0, 1, (int)p->max + 1, (int)p->min - 1};
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
    return is_named(p, "number") || is_named(p, "threads");
}

static void put_usual(hd_random *random, hd_scene_def *def, const hd_parameter *p)
{
    double low = p->min, high = p->max;
    for (size_t k = 0; k < sizeof USUAL / sizeof *USUAL; k++)
        if (is_named(p, USUAL[k].name)) low = USUAL[k].low, high = USUAL[k].high;
    put_within(random, def, p, low, high);
}

/** A channel hardly wider than a disk, down to the last bit. */
static void make_narrow(hd_random *random, hd_scene_def *def)
{
    const double width = 1.0 + log_uniform(random, DBL_EPSILON, 1.0), area = width * width;
    def->aspect = area * (DIM == 2 ? 1.0 : width) * def->density / def->number;
    if (chance(random, 0.5)) def->aspect = 1.0 / def->aspect;
}

/** Up to the last lattice that holds them. */
static void make_dense(hd_random *random, hd_scene_def *def)
{
    const double most = hd_container_of(def)->density_max(def);
    if (most > 0.0) def->density = most * (1.0 - log_uniform(random, 1e-9, 0.5));
}

static bool is_left_out(hd_random *random, const hd_parameter *p)
{
    /* covariant vectors: on their way back steps take no simulated time */
    if (p->kind == HD_PARAMETER_SEED || p->needs == HD_OBSERVE_COVARIANT) return true;
    if (is_named(p, "particles")) return true;
    if (DIM == 2 && is_of_spheres(p)) return chance(random, 0.98);
    if (is_named(p, "max_mode_number") || is_named(p, "container")) return chance(random, 0.5);
    return is_named(p, "max_wave_number") && chance(random, 0.8);
}

/** Disks or spheres of two kinds. */
static void make_mixed(hd_random *random, hd_scene_def *def, bool wild)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    for (int k = 0; k < of->parameters; k++) {
        put_usual(random, def, &of->parameter[k]);
        if (wild && chance(random, 0.1)) put_wild(random, def, &of->parameter[k]);
    }
}

/** A third of the scenes have wild values; the others are possible one by one, if not together. */
static hd_scene_def drawn(hd_random *random)
{
    hd_scene_def def = usual_scene();
    const bool wild = chance(random, 0.3);
    int count;
    const hd_parameter *rows = hd_scene_parameters(&count);
    for (int k = 0; k < count; k++) {
        const hd_parameter *p = &rows[k];
        if (is_left_out(random, p)) continue;
        put_usual(random, &def, p);
        if (p->kind != HD_PARAMETER_SET && chance(random, is_costly(p) ? 0.005 : 0.1))
            put_within(random, &def, p, p->min, p->max);
        if (wild && chance(random, 0.1)) put_wild(random, &def, p);
    }
    if (chance(random, 0.05)) def.number = 1; /* in a circle */
    if (chance(random, 0.05)) make_narrow(random, &def);
    if (hd_scene_check(&def, NULL, 0) == HD_OK && chance(random, 0.2)) make_dense(random, &def);
    def.seed = bits(random);
    if (chance(random, 0.25)) make_mixed(random, &def, wild);
    return def;
}

static void print_scene(int number, const hd_scene_def *def)
{
    const hd_parameter *p;
    print_error("HDLYAP_CASE=%d tries it alone: seed %llu", number, (unsigned long long)def->seed);
    for (int k = 0; (p = hd_parameter_of(def, k)); k++)
        print_error(" %s %a", p->name, hd_parameter_value(p, def));
    print_error("\n");
}

/* ---- what becomes of them ------------------------------------------------------------------ */

/** One line, which begins with the name of a parameter, and its value. */
static bool is_named_line(const hd_scene_def *def, const char *line)
{
    const hd_parameter *p;
    if (strchr(line, '\n') || !strstr(line, ": ")) return false;
    for (int k = 0; (p = hd_parameter_of(def, k)); k++) {
        const size_t length = strlen(p->name);
        if (strncmp(line, p->name, length) == 0 && strncmp(line + length, " = ", 3) == 0)
            return true;
    }
    return false;
}

/** A shorter room holds the beginning of the same line, and nothing is written behind it. */
static bool same_in_short_room(const hd_scene_def *def, const char *line, size_t size)
{
    char room[LINE];
    OWNED(hd_run) *run = NULL;
    memset(room, '#', sizeof room);
    if (hd_run_create(&run, def, room, size) != HD_REFUSED) return false;
    for (size_t k = size; k < sizeof room; k++)
        if (room[k] != '#') return false;
    if (size == 0) return true;
    const size_t shown = strlen(line) < size ? strlen(line) : size - 1;
    return memcmp(room, line, shown) == 0 && room[shown] == '\0';
}

static double events_of(const hd_run *run)
{
    const hd_trajectory *trajectory = hd_run_trajectory(run);
    return (double)(hd_trajectory_totals(trajectory).collisions +
                    hd_trajectory_totals(trajectory).wall_events);
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

/** Volume is kept, but for what walls do: if all are carried they add up to that, each known to the
 * stated bound, and the logarithms of the stretches to rounding. */
static const char *spectrum_fault(const hd_run *run)
{
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    const double time = spectrum ? hd_spectrum_time(spectrum) : 0.0;
    const int n = hd_run_vectors(run);
    double sum = 0.0;
    for (int col = 0; time > 0 && col < n; col++) sum += time * hd_spectrum_exponent(spectrum, col);
    if (!isfinite(sum)) return "an exponent is not finite";
    const double known = hd_run_cost(run).error_bound * time + 1e-12;
    if (hd_scene_diverges(hd_run_scene(run))) sum -= time * hd_run_divergence(run);
    if (hd_run_scene(run)->exponents == HD_EXPONENTS_ALL_INDEPENDENT && fabs(sum) > n * known)
        return "the volume is not kept";
    return NULL;
}

static const char *state_fault(const hd_run *run)
{
    const hd_trajectory *trajectory = hd_run_trajectory(run);
    const double disks = hd_run_scene(run)->number;
    if (!(fabs(hd_trajectory_examined(trajectory).kinetic_energy - disks) <= ENERGY_ERROR * disks))
        return "the energy is not conserved";
    if (!(hd_trajectory_examined(trajectory).overlap <= OVERLAP_MAX)) return "disks overlap";
    return spectrum_fault(run);
}

/** What is seen of a run; a stage may be asked for whose length is no normal number. */
static void look_at(const hd_run *run)
{
    if (hd_run_time(run) > 1e-280) check_published(run);
}

/** Looked at now and then, and at the end. */
static const char *run_fault(hd_run *run)
{
    const char *fault = NULL;
    for (int step = 0; !fault && step < STEPS_MAX && events_of(run) < EVENTS_ENOUGH &&
                       hd_run_stage(run) != HD_FINISHED;
         step++) {
        fault = step_once(run);
        if (!fault && step % 8 == 0) look_at(run);
    }
    if (!fault) look_at(run);
    return fault ? fault : state_fault(run);
}

/** How often a scene was what. */
typedef struct tally {
    int run, refused, averaged;
    size_t events; /**< beside the twin */
} tally;

/** Images of a pair in an epoch, at a speed of 4. */
static double images_of(const hd_scene_def *def, const hd_trajectory *tr)
{
    double box[3] = {INFINITY, INFINITY, INFINITY};
    hd_scene_box(def, box);
    return 8.0 * hard_in(tr)->epoch_length / fmin(box[0], fmin(box[1], box[2]));
}

/** What no lattice starts with: some at rest, some that hardly move or fast ones, some along an
 * axis. */
static hd_trajectory *with_odd_momenta(hd_random *random, const hd_scene_def *def)
{
    const double scale[] = {0.0, -0.0, 1e-300, 1e-155, 1e-3, 30.0};
    double q[DIM * DISKS_TWIN], p[DIM * DISKS_TWIN];
    OWNED(hd_trajectory) *tr = trajectory_of(*def);
    hd_trajectory_state(tr, q, p);
    for (int k = 0; k < DIM * def->number; k++)
        if (chance(random, 0.3)) p[k] *= scale[one_of(random, sizeof scale / sizeof *scale)];
    return started(def, q, p);
}

/** The clock alone is set: the same events from t = 0 and from t = 2^20, bit for bit. Pieces are
 * parts of an epoch: their sums are exact. */
static const char *late_fault(const hd_scene_def *def)
{
    OWNED(hd_trajectory) *early = trajectory_of(*def), *late = trajectory_of(*def);
    OWNED(hd_record) *log = new_log(), *other = new_log();
    const double begin = ldexp(1.0, 20);
    hard_in(late)->epoch_start = hard_in(late)->now = begin;
    size_t events = 0;
    for (int k = 20; k >= 0 && events < EVENTS_TWIN; k--) {
        const double end = ldexp(hard_in(early)->epoch_length, 1 - k);
        CHECK_OK(trajectory_to(early, log, end));
        CHECK_OK(trajectory_to(late, other, begin + end));
        events += log->count;
        if (log->count != other->count) return "it has other events at another time";
        if (log->count > 0 &&
            memcmp(events_in(log), events_in(other), log->count * sizeof(hd_event)) != 0)
            return "it goes on otherwise at another time";
    }
    return NULL;
}

/** Of a box; what holds in a circle is seen in test_round_wall.c. */
static const char *events_fault(hd_random *random, const hd_scene_def *def, tally *seen)
{
    if (def->container == HD_CIRCLE || def->number > DISKS_TWIN) return NULL;
    OWNED(hd_trajectory) *fast = chance(random, 0.3) ? with_odd_momenta(random, def)
                                                     : trajectory_of(*def);
    if (images_of(def, fast) > IMAGES_TWIN) return NULL;
    const double energy = hd_trajectory_examined(fast).kinetic_energy;
    seen->events += twin_follow(fast, def, EVENTS_TWIN, PIECES_TWIN);
    if (!(fabs(hd_trajectory_examined(fast).kinetic_energy - energy) <= ENERGY_ERROR * energy))
        return "the energy is not conserved";
    return late_fault(def);
}

static const char *refusal_fault(hd_random *random, const hd_scene_def *def, const char *line,
                                 tally *seen)
{
    if (!is_named_line(def, line)) return "the line names no parameter";
    seen->refused++;
    return same_in_short_room(def, line, (size_t)one_of(random, LINE)) ? NULL
                                                                       : "a short room overflows";
}

static const char *scene_fault(hd_random *random, const hd_scene_def *def, tally *seen)
{
    char line[LINE] = "";
    OWNED(hd_run) *run = NULL;
    hd_status status = hd_scene_check(def, line, sizeof line);
    if (status == HD_OK && def->number > DISKS_RUN) return NULL;
    if (status == HD_OK) status = hd_run_create(&run, def, line, sizeof line);
    if (status == HD_REFUSED) return refusal_fault(random, def, line, seen);
    if (status != HD_OK) return hd_status_text(status);
    const char *fault = *line ? line : events_fault(random, def, seen);
    if (!fault) fault = run_fault(run);
    seen->run++;
    seen->averaged += hd_run_stage(run) >= HD_AVERAGING;
    return fault;
}

/** The case and its scene, for main to say if its test fails. */
static int number;
static hd_scene_def tried;

static void try_case(int case_number, tally *seen)
{
    hd_random random = hd_random_seeded(20260801, (uint64_t)case_number);
    number = case_number;
    tried = drawn(&random);
    const char *fault = scene_fault(&random, &tried, seen);
    if (fault) fail_msg("%s", fault);
}

TEST(each_is_refused_by_name_or_runs_as_its_twin)
{
    const int cases = HD_SANITIZED ? 2000 : second_tier() ? 20000 : 4000;
    const char *alone = getenv("HDLYAP_CASE");
    tally seen = {0};
    if (alone) {
        try_case(atoi(alone), &seen);
        return;
    }
    for (int k = 0; k < cases; k++) try_case(k, &seen);
    assert_true(seen.run >= cases / 8 && seen.refused >= cases / 10);
    assert_true(seen.averaged >= cases / 20 && seen.events >= 10 * (size_t)cases);
    print_message("%d run, %d refused, %zu events beside the twin\n", seen.run, seen.refused,
                  seen.events);
}

/** Steps until the run ends; fails if one goes nowhere, or takes more events than it should. */
static int steps_to_the_end(const hd_scene_def *def)
{
    OWNED(hd_run) *run = NULL;
    int steps = 0;
    run = created(*def);
    for (; hd_run_stage(run) != HD_FINISHED; steps++) {
        const char *fault = step_once(run);
        if (fault) fail_msg("step %d: %s", steps, fault);
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
        hd_scene_def def = scene_from(
            box_of(5, 0.5, 1.0, 1.0, k % 2, k), .equilibration = k / 7 == 0 ? lengths[k % 7] : 1.0,
            .warmup = k / 7 == 1 ? lengths[k % 7] : 1.0,
            .duration = k / 7 == 2 ? lengths[k % 7] : 1.0, .observe = HD_OBSERVE_STEPS);
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
    OWNED(hd_run) *run = created(
        scene_from(box_with(4, 40.0, 1.0 + 1e-9, 1.5, 6, 1), .equilibration = 1.0));
    for (int step = 0; step < STEPS; step++) assert_null(step_once(run));
    assert_true(events_of(run) > 2e5);
    assert_null(state_fault(run));
}

int main(int argc, char **argv)
{
    const int failures = tests_run(argc > 1 ? argv[1] : NULL);
    if (failures) print_scene(number, &tried);
    return failures;
}
