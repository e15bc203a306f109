/** Quantities by which a run can be ended, one row each: what a scene must have for them, and what
 * a run states of them. The same numbers are published. */
#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "hdlyap/wave.h"
#include "modes/steps.h"
#include "observe/observables.h"
#include "run/run_state.h"
#include "scene/scene.h"

enum { WHY = 160, GOALS_MOST = 16 };

/** One of a target. */
typedef struct aim {
    const struct quantity *quantity;
    int number[HD_DIMENSION_MAX]; /**< nodes of a step, or an index */
    int count;                    /**< of numbers */
    double wanted;                /**< standard error, or if relative its part of the value */
    bool relative;
} aim;

/** All of it; count 0: none. */
typedef struct aims {
    int count;
    aim goal[GOALS_MOST];
} aims;

/** Error negative while not known. */
typedef struct stated {
    double value, error, open;
} stated;

typedef struct quantity {
    const char *name;
    enum { NOTHING, INDEX, NODES } of; /**< whose numbers stand behind the name */
    hd_mode_kind kind;
    unsigned needs;   /**< HD_OBSERVE_*, or 0: exponents alone */
    const char *from; /**< the observable that has it */
    /** False if such a scene never knows it, with the reason; NULL: no more is to be asked. */
    bool (*possible)(const hd_scene_def *def, const aim *goal, char why[WHY]);
    stated (*read)(const hd_run *run, const aim *goal);
} quantity;

static const stated UNKNOWN = {.error = -1.0};

/* ---- what a scene must have ------------------------------------------------------------------ */

static bool smallest_possible(const hd_scene_def *def, const aim *goal, char why[WHY])
{
    const bool any = hd_scene_positive_exponents(def) > 0;
    snprintf(why, WHY, any ? "is an absolute error, as each has its own" : "there are none");
    return any && !goal->relative;
}

static bool index_possible(const hd_scene_def *def, const aim *goal, char why[WHY])
{
    const int index = goal->number[0], vectors = hd_scene_vectors(def);
    const int positive = hd_scene_positive_exponents(def);
    const bool carried = index >= 1 && index <= vectors;
    const bool zero = index > positive && index <= positive + hd_scene_zero_exponents(def);
    if (!carried) snprintf(why, WHY, "indices are from 1 to %d, the exponents computed", vectors);
    if (carried && zero) snprintf(why, WHY, "it is a zero mode");
    return carried && !zero;
}

static const hd_modulations *fields_of(const hd_wave *wave, hd_mode_kind kind)
{
    return kind == HD_MODE_T ? &wave->transverse : &wave->pairs;
}

/** Without memory it cannot be said, and is let pass. */
static bool step_possible(const hd_scene_def *def, const aim *goal, char why[WHY])
{
    const int count = hd_waves(def, NULL, 0);
    hd_wave *wave = hd_memory_alloc((size_t)count + 1, sizeof *wave);
    bool found = !wave;
    if (wave) hd_waves(def, wave, count);
    for (int k = 0; wave && k < count; k++)
        found |= memcmp(wave[k].n, goal->number, sizeof goal->number) == 0 &&
                 fields_of(&wave[k], goal->quantity->kind)->count > 0;
    hd_memory_free(wave);
    snprintf(why, WHY, "it is not among the waves of the scene, which --check lists");
    return found;
}

static bool slope_possible(const hd_scene_def *def, const aim *goal, char why[WHY])
{
    const hd_mode_kind kind = goal->quantity->kind;
    const double open = hd_relation_of(def, kind).box_error;
    if (!(hd_relation_open(def, kind) < INFINITY)) {
        snprintf(why, WHY, "there are no waves of its kind, or they follow no relation");
        return false;
    }
    snprintf(why, WHY, "walls and narrow edges leave %.2g %% open, however long it is averaged",
             100.0 * open);
    return !goal->relative || goal->wanted > open;
}

/* ---- what a run states ----------------------------------------------------------------------- */

static stated read_smallest(const hd_run *run, const aim *goal)
{
    (void)goal;
    const double error = hd_carrier_smallest_error(&run->carrier);
    return (stated){.error = error < INFINITY ? error : -1.0};
}

static stated exponent_at(const hd_run *run, int col)
{
    const hd_spectrum *s = run->carrier.spectrum;
    return (stated){hd_spectrum_exponent(s, col), hd_spectrum_std_error(s, col), 0.0};
}

static stated read_lambda_max(const hd_run *run, const aim *goal)
{
    (void)goal;
    return exponent_at(run, 0);
}

static stated read_index(const hd_run *run, const aim *goal)
{
    return exponent_at(run, goal->number[0] - 1);
}

static stated read_ks_entropy(const hd_run *run, const aim *goal)
{
    (void)goal;
    const hd_spectrum_sums sums = hd_spectrum_sum_up(run->carrier.spectrum);
    return (stated){sums.ks_entropy, sums.ks_entropy_error, 0.0};
}

/** -1: not resolved. */
static int step_of(const hd_run *run, const aim *goal)
{
    const hd_steps *steps = hd_run_parts(run).steps;
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (step->kind == goal->quantity->kind && !step->conjugate && step->resolved &&
            memcmp(step->wave.n, goal->number, sizeof goal->number) == 0)
            return k;
    }
    return -1;
}

static stated read_step(const hd_run *run, const aim *goal)
{
    const int k = step_of(run, goal);
    if (k < 0) return UNKNOWN;
    const hd_step *step = hd_steps_step(hd_run_parts(run).steps, k);
    return (stated){step->exponent, step->std_error, 0.0};
}

static stated read_omega(const hd_run *run, const aim *goal)
{
    stated out = {.open = 0.0};
    const int k = step_of(run, goal);
    const bool known = k >= 0 &&
                       hd_phases_rate(hd_run_parts(run).phases, k, &out.value, &out.error);
    return known ? out : UNKNOWN;
}

/** Of an error of which averaging takes away a part. */
static stated with_sampling(double value, double error, double sampled)
{
    return (stated){value, error, sqrt(fmax(error * error - sampled * sampled, 0.0))};
}

static stated read_slope(const hd_run *run, const aim *goal)
{
    const hd_dispersion d = hd_steps_dispersion(hd_run_parts(run).steps, run->carrier.spectrum,
                                                goal->quantity->kind);
    if (d.points == 0) return UNKNOWN;
    return with_sampling(d.c.value, d.c.error, d.c_sampling_error);
}

static stated read_velocity(const hd_run *run, const aim *goal)
{
    (void)goal;
    const hd_velocity v = hd_phases_velocity(hd_run_parts(run).phases);
    return v.phases > 0 ? with_sampling(v.v, v.v_error, v.v_sampling_error) : UNKNOWN;
}

static stated read_collision_rate(const hd_run *run, const aim *goal)
{
    (void)goal;
    const hd_gas_means means = hd_gas_read(hd_run_parts(run).gas);
    return (stated){means.collision_rate, means.collision_rate_error, 0.0};
}

static stated read_pressure(const hd_run *run, const aim *goal)
{
    (void)goal;
    const hd_gas_means means = hd_gas_read(hd_run_parts(run).gas);
    return (stated){means.pressure, means.pressure_error, 0.0};
}

#define STEPS .needs = HD_OBSERVE_STEPS, .from = "steps"
#define PHASES .needs = HD_OBSERVE_PHASES, .from = "lp_phases"
#define GAS .needs = HD_OBSERVE_GAS, .from = "gas"
static const quantity quantities[] = {
    {.name = "smallest", .possible = smallest_possible, .read = read_smallest},
    {.name = "lambda_max", .read = read_lambda_max},
    {.name = "lambda", .of = INDEX, .possible = index_possible, .read = read_index},
    {.name = "h_KS", .read = read_ks_entropy},
    {.name = "T",
     .of = NODES,
     .kind = HD_MODE_T,
     STEPS,
     .possible = step_possible,
     .read = read_step},
    {.name = "LP",
     .of = NODES,
     .kind = HD_MODE_LP,
     STEPS,
     .possible = step_possible,
     .read = read_step},
    {.name = "c_T", .kind = HD_MODE_T, STEPS, .possible = slope_possible, .read = read_slope},
    {.name = "c_L", .kind = HD_MODE_LP, STEPS, .possible = slope_possible, .read = read_slope},
    {.name = "v", PHASES, .read = read_velocity},
    {.name = "omega",
     .of = NODES,
     .kind = HD_MODE_LP,
     PHASES,
     .possible = step_possible,
     .read = read_omega},
    {.name = "collision_rate", GAS, .read = read_collision_rate},
    {.name = "pressure", GAS, .read = read_pressure}};
#undef STEPS
#undef PHASES
#undef GAS
enum { QUANTITIES = sizeof quantities / sizeof *quantities };

/* ---- text ------------------------------------------------------------------------------------ */

static bool is_name(const char *name, const char *text, size_t length)
{
    if (strlen(name) != length) return false;
    for (size_t k = 0; k < length; k++)
        if (tolower((unsigned char)name[k]) != tolower((unsigned char)text[k])) return false;
    return true;
}

static const quantity *quantity_of(const char *text, size_t length)
{
    for (int k = 0; k < QUANTITIES; k++)
        if (is_name(quantities[k].name, text, length)) return &quantities[k];
    return NULL;
}

static const char *skipped(const char *at, const char *what) { return at + strspn(at, what); }

/** "(1,0)"; NULL if there are not so many. */
static const char *read_numbers(aim *goal, const char *at, int dimension)
{
    const int of[] = {[NOTHING] = 0, [INDEX] = 1, [NODES] = dimension};
    goal->count = of[goal->quantity->of];
    for (int k = 0; k < goal->count; k++) {
        char *end;
        if (*at++ != (k == 0 ? '(' : ',')) return NULL;
        const long number = strtol(at, &end, 10);
        if (end == at || number < 0 || number > 2 * HD_DIMENSION_MAX * 1000000L) return NULL;
        goal->number[k] = (int)number;
        at = skipped(end, " ");
    }
    if (goal->count == 0) return at;
    return *at == ')' ? at + 1 : NULL;
}

/** "c_T 1%"; NULL if it is none. */
static const char *read_goal(aim *goal, const char *at, int dimension)
{
    char *end;
    const size_t length = strcspn(at, " (:0123456789");
    *goal = (aim){.quantity = quantity_of(at, length)};
    if (!goal->quantity || !(at = read_numbers(goal, at + length, dimension))) return NULL;
    at = skipped(at, " :");
    goal->wanted = strtod(at, &end);
    if (end == at || !(goal->wanted > 0.0 && goal->wanted < DBL_MAX)) return NULL;
    at = skipped(end, " ");
    goal->relative = *at == '%';
    if (goal->relative) goal->wanted *= 0.01;
    return skipped(at + goal->relative, " ");
}

/** False if the text is none, in a space of that dimension. */
static bool read_all(aims *out, const hd_text *text, int dimension)
{
    const char *at = skipped(text->line, " ");
    *out = (aims){.count = 0};
    while (at && *at) {
        at = out->count < GOALS_MOST ? read_goal(&out->goal[out->count++], at, dimension) : NULL;
        if (at && *at) at = *at == ',' && at[1] ? skipped(at + 1, " ") : NULL;
    }
    return at;
}

/** Of a text that hd_target_check has passed. */
static aims aims_of(const hd_scene_def *def, const hd_text *text)
{
    aims all;
    HD_ASSERT(read_all(&all, text, hd_scene_dimension(def)));
    return all;
}

static void name_of(char name[HD_QUANTITY_NAME], const aim *goal)
{
    const int room = HD_QUANTITY_NAME, *n = goal->number;
    int length = snprintf(name, (size_t)room, "%s", goal->quantity->name);
    for (int k = 0; k < goal->count && length < room; k++)
        length += snprintf(name + length, (size_t)(room - length), "%c%d", k == 0 ? '(' : ',',
                           n[k]);
    if (goal->count > 0 && length < room) snprintf(name + length, (size_t)(room - length), ")");
}

/* ---- can it be reached? ---------------------------------------------------------------------- */

static hd_status refuse_text(const hd_scene_def *def, char *message, size_t size)
{
    const char *const numbers[] = {[NOTHING] = "",
                                   [INDEX] = "(index)",
                                   [NODES] = hd_scene_dimension(def) == 2 ? "(nx,ny)"
                                                                          : "(nx,ny,nz)"};
    char names[WHY] = "";
    for (int k = 0; k < QUANTITIES; k++) {
        const size_t length = strlen(names);
        snprintf(names + length, sizeof names - length, "%s%s%s", k == 0 ? "" : ", ",
                 quantities[k].name, numbers[quantities[k].of]);
    }
    return hd_refuse(
        message, size,
        "target = %.80s: must be quantities with their errors, as lambda_max 0.01, c_T "
        "1%%, up to %d out of %s",
        def->target.line, GOALS_MOST, names);
}

static bool is_possible(const hd_scene_def *def, const aim *goal, char why[WHY])
{
    const quantity *q = goal->quantity;
    if (q->needs != HD_OBSERVE_GAS && hd_scene_vectors(def) == 0)
        snprintf(why, WHY, "exponents = none");
    else if (q->needs && !(hd_observables_with(def->observe) & q->needs))
        snprintf(why, WHY, "%s is no observable", q->from);
    else
        return !q->possible || q->possible(def, goal, why);
    return false;
}

hd_status hd_target_check(const hd_scene_def *def, char *message, size_t size)
{
    aims target;
    char name[HD_QUANTITY_NAME], why[WHY];
    if (!read_all(&target, &def->target, hd_scene_dimension(def)))
        return refuse_text(def, message, size);
    for (int k = 0; k < target.count; k++) {
        if (is_possible(def, &target.goal[k], why)) continue;
        name_of(name, &target.goal[k]);
        return hd_refuse(message, size, "target = %.100s: must be without %s: %s", def->target.line,
                         name, why);
    }
    return HD_OK;
}

/** Those of a set that this one comes with: itself, if it is one of them. */
static unsigned simplest(unsigned set, unsigned needed)
{
    unsigned all = 0;
    if (set & needed) return needed;
    for (unsigned bit = 1; bit <= set; bit <<= 1)
        if (set & bit && hd_observables_with(bit) & needed) all |= bit;
    return all;
}

unsigned hd_target_stages(const hd_scene_def *def, unsigned stages)
{
    const aims target = aims_of(def, &def->target);
    for (int k = 0; k < target.count; k++) {
        const unsigned needed = target.goal[k].quantity->needs;
        if (!(hd_observables_with(stages & def->observe) & needed))
            stages |= simplest(def->observe, needed);
    }
    return stages;
}

/* ---- how far is it? -------------------------------------------------------------------------- */

/** Time until the part of an error that falls is as small as what is open leaves for it. */
static double left_of(const hd_standing *s, double averaged)
{
    const double falls = s->error * s->error - s->open * s->open;
    const double may = s->wanted * s->wanted - s->open * s->open;
    if (s->reached) return 0.0;
    return s->error >= 0.0 && may > 0.0 ? averaged * (falls / may - 1.0) : INFINITY;
}

static hd_standing standing_of(const hd_run *run, const aim *goal, double averaged)
{
    const stated now = goal->quantity->read(run, goal);
    const double value = fabs(now.value);
    hd_standing s = {
        .value = now.value, .error = now.error, .open = now.open, .wanted = goal->wanted};
    if (!(now.error >= 0.0)) s = (hd_standing){.error = -1.0, .wanted = s.wanted};
    name_of(s.name, goal);
    if (goal->relative) s.wanted = s.error >= 0.0 ? goal->wanted * value : -1.0;
    s.reached = s.error >= 0.0 && s.error <= s.wanted;
    s.left = left_of(&s, averaged);
    return s;
}

/** What is not known is farthest. */
static double distance(const hd_standing *s)
{
    return s->error >= 0.0 ? s->error / s->wanted : INFINITY;
}

hd_standing hd_target_standing(const hd_run *run, const hd_text *target)
{
    const aims asked = aims_of(&run->scene, target);
    const double averaged = hd_run_time(run) - hd_agenda_stage_begin(&run->agenda);
    hd_standing all = {.error = -1.0, .wanted = -1.0, .left = INFINITY};
    for (int k = 0; k < asked.count; k++) {
        const hd_standing one = standing_of(run, &asked.goal[k], averaged);
        const double left = k == 0 ? one.left : fmax(all.left, one.left);
        const bool reached = one.reached && (k == 0 || all.reached);
        if (k == 0 || distance(&one) > distance(&all)) all = one;
        all.left = left;
        all.reached = reached;
    }
    return all;
}

bool hd_target_reached(const hd_run *run)
{
    return hd_target_standing(run, hd_agenda_target(&run->agenda)).reached;
}
