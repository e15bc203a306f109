/** What each effect of a scene costs: two runs that differ in it alone, side by side, some report
 * intervals of the one after those of the other, so that whatever else the machine does falls on
 * both; medians. Instructions are counted by callgrind, if valgrind is there (nan if not), in a
 * smaller box of the same kind: a long one, in which steps are found soon. What publishing costs:
 * effects_publishing. Usage: hdlyap_effects [--disks N] [--aspect A] [--rounds N] [--out FOLDER];
 * with --out it writes FOLDER/effects.csv. hdlyap_effects --count EFFECT off|on: one run for
 * callgrind, which collects in count_rounds */
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

/** What a run has of all the effects. */
typedef struct variant {
    int exponents;
    hd_boundary boundary;
    unsigned observe, look; /**< asked for, and looked at */
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

/** Until the intervals have found their length, and the steps are found. */
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

/** One vector of each LP step: its L and P modes, and these over the momenta, as the node publishes
 * them. */
static void reconstruct(side *s)
{
    const hd_steps *steps = hd_run_parts(s->run).steps;
    hd_pmode *pmode = hd_run_parts(s->run).fields;
    hd_trajectory_state(hd_run_parts(s->run).trajectory, s->q, s->p);
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (step->kind != HD_MODE_LP || !step->resolved) continue;
        if (!hd_pmode_reconstruct(pmode, step, hd_run_parts(s->run).modes,
                                  hd_run_frame_columns(s->run)))
            continue;
        for (int c = hd_pmode_pairs(pmode); c < 2 * hd_pmode_pairs(pmode); c++)
            hd_pmode_divide(pmode, s->field, c, s->p);
    }
}

/** A report interval, and what is made of a report outside of the run. */
static void report(side *s)
{
    report_interval(s);
    if (hd_run_parts(s->run).fields) reconstruct(s);
}

/** So many that each round has several orthonormalisations. */
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
    double ratio;   /**< off / on; of seconds the median of the rounds' own */
    int steps;      /**< found in the run that has the effect */
} cost;

/** Of the run that has the effect, what it would do without. */
static double percent(cost c) { return 100.0 * (1.0 - c.ratio); }

/** Seconds of a report interval in this round. */
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

/** Has a name for callgrind. */
__attribute__((noinline)) void count_rounds(void *run);
void count_rounds(void *run)
{
    for (int round = 0; round < COUNTED_ROUNDS; round++) round_of(run);
}

/** This program's other mode. */
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

/** NAN without valgrind. */
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

/** Of effect k; `known` are those before it: many are measured against the same run. */
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
    hd_blas_restart_if_slow(argv);
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
