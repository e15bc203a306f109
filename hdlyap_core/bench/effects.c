/** Measures what each effect of a scene costs. Two runs that differ in the effect alone go on by
 * turns, some report intervals each, so that whatever else the machine does slows both; medians are
 * printed. Callgrind counts instructions if valgrind is there (nan if not), in a smaller box, which
 * is as long and narrow, so that steps are found soon. effects_publishing measures what publishing
 * costs.
 * Usage: hdlyap_effects [--disks N] [--aspect A] [--rounds N] [--out FOLDER]
 * With --out it writes FOLDER/effects.csv.
 * Usage: hdlyap_effects --count EFFECT off|on
 * Does one run for callgrind, which counts in count_rounds alone. */
#include <hdlyap/hdlyap.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "gemm.h"
#include "options.h"
#include "sample.h"
#include "table.h"
#include "timing.h"

enum {
    NONE = HD_EXPONENTS_NONE,
    HALF = HD_EXPONENTS_POSITIVE,
    ALL = HD_EXPONENTS_ALL,
    STEPS = HD_OBSERVE_STEPS,
    EVERYTHING = HD_OBSERVE_MODES | HD_OBSERVE_STEPS | HD_OBSERVE_PHASES | HD_OBSERVE_FIELDS |
                 HD_OBSERVE_HYDRO
};
enum { WARM_REPORTS = 10, COUNTED_DISKS = 60, COUNTED_ROUNDS = 2, ROUND_REPORTS = 5 };
static const double COUNTED_ASPECT = 0.12;

/** Which of the effects a run has. */
typedef struct variant {
    int exponents;
    hd_boundary boundary;
    unsigned observe, look; /**< stages that the scene asks for; stages with a subscriber */
} variant;

typedef struct effect {
    const char *name;
    variant off, on;
} effect;

static const effect effects[] = {
    {"walls", {.exponents = NONE}, {.exponents = NONE, .boundary = HD_REFLECTING}},
    {"walls_of_half", {.exponents = HALF}, {.exponents = HALF, .boundary = HD_REFLECTING}},
    {"exponents_1", {.exponents = NONE}, {.exponents = 1}},
    {"exponents_10", {.exponents = NONE}, {.exponents = 10}},
    {"exponents_positive", {.exponents = NONE}, {.exponents = HALF}},
    {"exponents_all", {.exponents = HALF}, {.exponents = ALL}},
    {"nobody_looks", {.exponents = HALF}, {.exponents = HALF, .observe = EVERYTHING}},
    {"modes", {.exponents = HALF}, {HALF, HD_PERIODIC, STEPS, STEPS}},
    {"phases",
     {HALF, HD_PERIODIC, STEPS, STEPS},
     {HALF, HD_PERIODIC, STEPS | HD_OBSERVE_PHASES, STEPS | HD_OBSERVE_PHASES}},
    {"hydro",
     {HALF, HD_PERIODIC, STEPS, STEPS},
     {HALF, HD_PERIODIC, STEPS | HD_OBSERVE_HYDRO, STEPS | HD_OBSERVE_HYDRO}},
    {"fields",
     {HALF, HD_PERIODIC, STEPS, STEPS},
     {HALF, HD_PERIODIC, STEPS | HD_OBSERVE_FIELDS, STEPS | HD_OBSERVE_FIELDS}},
};
enum { EFFECTS = sizeof effects / sizeof *effects };

/* ---- one run ------------------------------------------------------------------------------- */

typedef struct side {
    hd_run *run;
    double *q, *p, *field; /**< [2N] */
    sample seconds;
} side;

static hd_scene_def scene_of(const variant *v, int disks, double aspect)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.number = disks;
    scene.aspect = aspect;
    scene.boundary[0] = scene.boundary[1] = v->boundary;
    scene.exponents = v->exponents;
    scene.observe = v->observe;
    scene.equilibration = 20.0;
    scene.warmup = 10.0;
    scene.duration = 0.0;
    scene.threads = 1;
    return scene;
}

static void report_interval(side *s)
{
    do require(hd_run_advance(s->run), "run");
    while (!hd_run_report_due(s->run));
}

/** Advances the run until intervals have their final length and steps are found. */
static void warm(side *s)
{
    while (hd_run_stage(s->run) < HD_AVERAGING) require(hd_run_advance(s->run), "warm-up");
    for (int k = 0; k < WARM_REPORTS; k++) report_interval(s);
}

static side *side_create(const variant *v, int disks, double aspect)
{
    const hd_scene_def scene = scene_of(v, disks, aspect);
    const size_t size = 2 * (size_t)disks;
    side *s = room(1, sizeof *s);
    double *block = room(3 * size, sizeof *block);
    s->run = created(&scene);
    hd_run_observe(s->run, v->look);
    s->q = block, s->p = block + size, s->field = block + 2 * size;
    warm(s);
    return s;
}

static void side_free(side *s)
{
    hd_run_free(s->run);
    free(s->q);
    free(s);
}

/** Computes what the node publishes as fields: for one vector of each LP step its L and P modes,
 * and the P modes divided by the momenta. */
static void reconstruct(side *s)
{
    const hd_steps *steps = hd_run_parts(s->run).steps;
    hd_pmode *pmode = hd_run_parts(s->run).fields;
    hd_trajectory_state(hd_run_parts(s->run).trajectory, s->q, s->p);
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (step->kind != HD_MODE_LP || !step->resolved) continue;
        if (!hd_pmode_reconstruct(pmode, step, hd_run_parts(s->run).modes,
                                  hd_run_vectors_now(s->run)))
            continue;
        for (int c = hd_pmode_pairs(pmode); c < 2 * hd_pmode_pairs(pmode); c++)
            hd_pmode_divide(pmode, s->field, c, s->p);
    }
}

/** Does one report interval, and computes what the node computes outside of the run. */
static void report(side *s)
{
    report_interval(s);
    if (hd_run_parts(s->run).fields) reconstruct(s);
}

/** Does a round: enough reports for several orthonormalisations. */
static void round_of(side *s)
{
    for (int k = 0; k < ROUND_REPORTS; k++) report(s);
}

static int steps_found(const side *s)
{
    const hd_steps *steps = hd_run_parts(s->run).steps;
    int found = 0;
    for (int k = 0; steps && k < hd_steps_count(steps); k++)
        found += hd_steps_step(steps, k)->resolved;
    return found;
}

/* ---- seconds ------------------------------------------------------------------------------- */

typedef struct cost {
    double off, on; /**< seconds (median), or instructions, per report interval; NAN if unknown */
    double ratio;   /**< off / on; for seconds, the median over rounds */
    int steps;      /**< number of steps found in the run that has the effect */
} cost;

/** The part of the cost that the effect causes in the run that has it [%]. */
static double percent(cost c) { return 100.0 * (1.0 - c.ratio); }

/** Does a round, and returns the seconds of a report interval in it. */
static double round_timed(side *s)
{
    const double start = seconds();
    round_of(s);
    const double taken = (seconds() - start) / ROUND_REPORTS;
    sample_add(&s->seconds, taken);
    return taken;
}

static cost seconds_of(const effect *e, int disks, double aspect, int rounds)
{
    side *off = side_create(&e->off, disks, aspect), *on = side_create(&e->on, disks, aspect);
    sample ratio = {0};
    for (int round = 0; round < rounds; round++) {
        const double first = round_timed(round % 2 ? on : off);
        const double second = round_timed(round % 2 ? off : on);
        sample_add(&ratio, round % 2 ? second / first : first / second);
    }
    const cost c = {sample_median(&off->seconds), sample_median(&on->seconds),
                    sample_median(&ratio), steps_found(on)};
    side_free(off);
    side_free(on);
    return c;
}

/* ---- instructions -------------------------------------------------------------------------- */

/** Callgrind finds this function by its name. */
__attribute__((noinline)) void count_rounds(void *run);
void count_rounds(void *run)
{
    for (int round = 0; round < COUNTED_ROUNDS; round++) round_of(run);
}

/** The mode --count of this program. */
static int count(const char *name, const char *which)
{
    for (int k = 0; k < EFFECTS; k++) {
        if (strcmp(name, effects[k].name) != 0) continue;
        const variant *v = strcmp(which, "on") == 0 ? &effects[k].on : &effects[k].off;
        side *s = side_create(v, COUNTED_DISKS, COUNTED_ASPECT);
        count_rounds(s);
        side_free(s);
        return 0;
    }
    fprintf(stderr, "hdlyap_effects: no effect %s\n", name);
    return 2;
}

/** Instructions per report interval, which a child process counts; NAN without valgrind. */
static double counted(const char *name, const char *which)
{
    char self[1024] = "", command[2048], line[256];
    double instructions = NAN;
    if (readlink("/proc/self/exe", self, sizeof self - 1) < 0) return NAN;
    snprintf(command, sizeof command,
             "OMP_NUM_THREADS=1 HDLYAP_RESTARTED=1 valgrind --tool=callgrind "
             "--callgrind-out-file=/dev/null --toggle-collect=count_rounds '%s' --count %s %s 2>&1",
             self, name, which);
    FILE *out = popen(command, "r");
    while (out && fgets(line, sizeof line, out))
        if (strstr(line, "Collected :")) instructions = atof(strchr(line, ':') + 1);
    if (!out || pclose(out) != 0) return NAN;
    return instructions / (COUNTED_ROUNDS * ROUND_REPORTS);
}

/** Instructions of effect k. known: the costs of the effects before it, many of which have the same
 * run without the effect. */
static cost instructions_of(int k, const cost *known)
{
    cost c = {.off = NAN, .on = NAN};
    for (int j = 0; j < k; j++)
        if (memcmp(&effects[j].off, &effects[k].off, sizeof(variant)) == 0) c.off = known[j].off;
    if (isnan(c.off)) c.off = counted(effects[k].name, "off");
    if (!isnan(c.off)) c.on = counted(effects[k].name, "on");
    c.ratio = c.off / c.on;
    return c;
}

/* ---- what is written ----------------------------------------------------------------------- */

static void tell(table *t, const char *name, cost time, cost work)
{
    printf("%-20s %10.3f %10.3f %8.2f %12.4g %12.4g %8.2f %6d\n", name, 1e3 * time.off,
           1e3 * time.on, percent(time), work.off, work.on, percent(work), time.steps);
    fflush(stdout);
    if (t)
        table_row(t, "%s,%.3f,%.0f,%.6g,%.6g,%.0f,%.0f,%.3f", name, percent(time),
                  work.on - work.off, time.off, time.on, work.off, work.on, percent(work));
}

static void measure_all(table *t, int disks, double aspect, int rounds)
{
    cost work[EFFECTS];
    printf("%d disks, aspect %g, one thread, %s kernels; instructions of %d disks, aspect %g;\n"
           "all per time unit; percent of the run that has the effect\n",
           disks, aspect, hd_blas_query().kernel, COUNTED_DISKS, COUNTED_ASPECT);
    printf("%-20s %10s %10s %8s %12s %12s %8s %6s\n", "effect", "off [ms]", "on [ms]", "%",
           "off [instr]", "on [instr]", "%", "steps");
    for (int k = 0; k < EFFECTS; k++) {
        const cost time = seconds_of(&effects[k], disks, aspect, rounds);
        work[k] = instructions_of(k, work);
        tell(t, effects[k].name, time, work[k]);
    }
}

int main(int argc, char **argv)
{
    int disks = 200, rounds = 15;
    double aspect = 0.05;
    const char *out = NULL;
    const option list[] = {{"--disks", .count = &disks, .least = 10, .most = 5000},
                           {"--aspect", .number = &aspect, .least = 1e-6, .most = 1},
                           {"--rounds", .count = &rounds, .least = 1, .most = SAMPLE_MAX},
                           {"--out", .text = &out},
                           {0}};
    restart_if_slow(argv);
    if (argc == 4 && strcmp(argv[1], "--count") == 0) return count(argv[2], argv[3]);
    options_read(argc, argv, list);
    table *t = out ? table_create(out, "effects",
                                  "effect,percent,instructions,seconds_off,seconds_on,"
                                  "instructions_off,instructions_on,percent_of_instructions")
                   : NULL;
    measure_all(t, disks, aspect, rounds);
    if (t) table_write(t, argv, gemm_once());
    return 0;
}
