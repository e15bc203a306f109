/** Quantities that a target can name, a row each: what a scene needs for them, and what a run
 * states. The same numbers are published. */
#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/check.h"
#include "observe/observables.h"
#include "run/run_state.h"
#include "scene/scene.h"

enum { GOALS_MOST = 16 };
_Static_assert((int)HD_AVERAGE_NAME <= (int)HD_QUANTITY_NAME, "averages are quantities");

/** All quantities of a target; count 0: none. */
typedef struct aims {
    int count;
    hd_aim goal[GOALS_MOST];
} aims;

/* ---- of the exponents alone ------------------------------------------------------------------ */

static bool smallest_possible(const hd_scene_def *def, const hd_aim *goal, char why[HD_WHY])
{
    const bool any = hd_scene_positive_exponents(def) > 0;
    snprintf(why, HD_WHY,
             any ? "it is several exponents, so its error must be without %%"
                 : "no exponent is positive");
    return any && !goal->relative;
}

static bool index_possible(const hd_scene_def *def, const hd_aim *goal, char why[HD_WHY])
{
    const int index = goal->number[0], vectors = hd_scene_vectors(def);
    const int positive = hd_scene_positive_exponents(def);
    const bool carried = index >= 1 && index <= vectors;
    const bool zero = hd_scene_symplectic(def) && index > positive &&
                      index <= positive + hd_scene_zero_exponents(def);
    if (!carried)
        snprintf(why, HD_WHY, "indices are from 1 to %d, the exponents computed", vectors);
    if (carried && zero) snprintf(why, HD_WHY, "it is the exponent of a zero mode, which is 0");
    return carried && !zero;
}

static hd_stated exponent_at(const hd_spectrum *s, int col)
{
    return (hd_stated){hd_spectrum_exponent(s, col), hd_spectrum_std_error(s, col), 0.0};
}

static hd_stated read_lambda_max(const hd_parts *parts, const hd_aim *goal)
{
    (void)goal;
    return exponent_at(parts->spectrum, 0);
}

static hd_stated read_index(const hd_parts *parts, const hd_aim *goal)
{
    return exponent_at(parts->spectrum, goal->number[0] - 1);
}

static hd_stated read_ks_entropy(const hd_parts *parts, const hd_aim *goal)
{
    (void)goal;
    const hd_spectrum_sums sums = hd_spectrum_sum_up(parts->spectrum);
    return (hd_stated){sums.ks_entropy, sums.ks_entropy_error, 0.0};
}

static bool sum_possible(const hd_scene_def *def, const hd_aim *goal, char why[HD_WHY])
{
    (void)goal;
    const hd_counts counts = hd_scene_counts(def);
    const bool paired = hd_scene_symplectic(def),
               all = counts.vectors == 2 * hd_scene_coordinates(def) * def->number;
    snprintf(why, HD_WHY,
             paired ? "exponents are in pairs of opposite sign" : "not all exponents are computed");
    return !paired && all;
}

static hd_stated read_exponent_sum(const hd_parts *parts, const hd_aim *goal)
{
    (void)goal;
    const hd_spectrum_sums sums = hd_spectrum_sum_up(parts->spectrum);
    return (hd_stated){sums.exponent_sum, sums.exponent_sum_error, 0.0};
}

static hd_stated read_kaplan_yorke(const hd_parts *parts, const hd_aim *goal)
{
    (void)goal;
    const hd_spectrum_sums sums = hd_spectrum_sum_up(parts->spectrum);
    return (hd_stated){sums.kaplan_yorke, sums.kaplan_yorke_error, 0.0};
}

/** Quantities of exponents alone. */
static const hd_quantity of_exponents[] = {
    {.name = "smallest", .possible = smallest_possible},
    {.name = "lambda_max", .read = read_lambda_max},
    {.name = "lambda", .of = HD_OF_INDEX, .possible = index_possible, .read = read_index},
    {.name = "h_KS", .read = read_ks_entropy},
    {.name = "exponent_sum", .possible = sum_possible, .read = read_exponent_sum},
    {.name = "kaplan_yorke", .possible = sum_possible, .read = read_kaplan_yorke},
    {.name = NULL}};

/** The quantities of exponents (k = -1) or of the observable in row k; NULL: none. */
static const hd_quantity *quantities_of(int k)
{
    if (k < 0) return of_exponents;
    return hd_observable_rows[k]->quantities ? hd_observable_rows[k]->quantities->each : NULL;
}

/** The HD_OBSERVE_* that a quantity needs; 0: exponents alone. */
static unsigned needed(const hd_aim *goal)
{
    return goal->row < 0 ? 0 : hd_observable_bits[goal->row];
}

/* ---- text ------------------------------------------------------------------------------------ */

static bool is_name(const char *name, const char *text, size_t length)
{
    if (strlen(name) != length) return false;
    for (size_t k = 0; k < length; k++)
        if (tolower((unsigned char)name[k]) != tolower((unsigned char)text[k])) return false;
    return true;
}

/** The quantity of the core with this name; NULL if there is none. */
static const hd_quantity *quantity_named(int *row, const char *text, size_t length)
{
    for (*row = -1; *row < HD_OBSERVED; ++*row)
        for (const hd_quantity *q = quantities_of(*row); q && q->name; q++)
            if (q->of != HD_OF_AVERAGE && is_name(q->name, text, length)) return q;
    return NULL;
}

/** Finds the average of the particles with this name; false if there is none. */
static bool find_average(hd_aim *goal, const char *text, size_t length, const hd_dynamics *of)
{
    for (int k = 0; k < of->averages; k++) {
        const char *name = of->average[k].name;
        if (strlen(name) != length || strncmp(name, text, length) != 0) continue;
        *goal = (hd_aim){.row = HD_OBSERVED_averages, .name = name, .number = {k}};
        goal->quantity = quantities_of(goal->row);
        return true;
    }
    return false;
}

/** Finds the quantity with whose name the text begins; returns the length of that, or 0. */
static size_t find_quantity(hd_aim *goal, const char *text, const hd_dynamics *of)
{
    const size_t length = strcspn(text, " (:0123456789"), whole = strcspn(text, " (:,");
    *goal = (hd_aim){.count = 0};
    if (find_average(goal, text, whole, of)) return whole;
    goal->quantity = quantity_named(&goal->row, text, length);
    if (!goal->quantity) return 0;
    goal->name = goal->quantity->name;
    return length;
}

static const char *skipped(const char *at, const char *what) { return at + strspn(at, what); }

/** Reads "(1,0)"; NULL if the numbers are not as many as dimensions. */
static const char *read_numbers(hd_aim *goal, const char *at, int dimension)
{
    const int of[] = {
        [HD_OF_NOTHING] = 0, [HD_OF_INDEX] = 1, [HD_OF_NODES] = dimension, [HD_OF_AVERAGE] = 0};
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

/** Reads "c_T 1%"; NULL if it is not like that. */
static const char *read_goal(hd_aim *goal, const char *at, const hd_dynamics *of)
{
    char *end;
    const size_t length = find_quantity(goal, at, of);
    if (length == 0 || !(at = read_numbers(goal, at + length, of->dimension))) return NULL;
    at = skipped(at, " :");
    goal->wanted = strtod(at, &end);
    if (end == at || !(goal->wanted > 0.0 && goal->wanted < DBL_MAX)) return NULL;
    at = skipped(end, " ");
    goal->relative = *at == '%';
    if (goal->relative) goal->wanted *= 0.01;
    return skipped(at + goal->relative, " ");
}

/** Reads a whole target of these particles; false if it is wrong. */
static bool read_all(aims *out, const hd_text *text, const hd_dynamics *of)
{
    const char *at = skipped(text->line, " ");
    *out = (aims){.count = 0};
    while (at && *at) {
        at = out->count < GOALS_MOST ? read_goal(&out->goal[out->count++], at, of) : NULL;
        if (at && *at) at = *at == ',' && at[1] ? skipped(at + 1, " ") : NULL;
    }
    return at;
}

/** The quantities of a text that hd_target_check has passed. */
static aims aims_of(const hd_scene_def *def, const hd_text *text)
{
    aims all;
    HD_ASSERT(read_all(&all, text, hd_dynamics_of(def)));
    return all;
}

static void name_of(char name[HD_QUANTITY_NAME], const hd_aim *goal)
{
    const int room = HD_QUANTITY_NAME, *n = goal->number;
    int length = snprintf(name, (size_t)room, "%s", goal->name);
    for (int k = 0; k < goal->count && length < room; k++)
        length += snprintf(name + length, (size_t)(room - length), "%c%d", k == 0 ? '(' : ',',
                           n[k]);
    if (goal->count > 0 && length < room) snprintf(name + length, (size_t)(room - length), ")");
}

/* ---- can it be reached? ---------------------------------------------------------------------- */

/** Adds a name to the list. */
static void add_name(char *names, size_t size, const char *name, const char *numbers)
{
    const size_t length = strlen(names);
    snprintf(names + length, size - length, "%s%s%s", length ? ", " : "", name, numbers);
}

static hd_status refuse_text(const hd_scene_def *def, char *message, size_t size)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    const char *const numbers[] = {[HD_OF_NOTHING] = "",
                                   [HD_OF_INDEX] = "(index)",
                                   [HD_OF_NODES] = hd_scene_dimension(def) == 2 ? "(nx,ny)"
                                                                                : "(nx,ny,nz)"};
    char names[4 * HD_WHY] = "";
    for (int k = -1; k < HD_OBSERVED; k++)
        for (const hd_quantity *q = quantities_of(k); q && q->name; q++)
            if (q->of != HD_OF_AVERAGE) add_name(names, sizeof names, q->name, numbers[q->of]);
    for (int k = 0; k < of->averages; k++) add_name(names, sizeof names, of->average[k].name, "");
    return hd_refuse(
        message, size,
        "target = %.80s: must be quantities with their errors, as lambda_max 0.01, c_T "
        "1%%, up to %d out of %s",
        def->target.line, GOALS_MOST, names);
}

static bool is_possible(const hd_scene_def *def, const hd_aim *goal, char why[HD_WHY])
{
    const hd_quantity *q = goal->quantity;
    const hd_observable *row = goal->row < 0 ? NULL : hd_observable_rows[goal->row];
    if (hd_scene_vectors(def) == 0 && (!row || row->needs & HD_NEEDS_FRAME))
        snprintf(why, HD_WHY, "exponents = none");
    else if (row && !(hd_observables_with(def->observe) & needed(goal)))
        snprintf(why, HD_WHY, "%s is not among the observables", row->quantities->from);
    else
        return !q->possible || q->possible(def, goal, why);
    return false;
}

/** Refuses a row whose averages cannot be told from other quantities. */
static hd_status check_averages(const hd_dynamics *of, char *message, size_t size)
{
    for (int row, k = 0; k < of->averages; k++)
        if (quantity_named(&row, of->average[k].name, strlen(of->average[k].name)))
            return hd_refuse(message, size,
                             "average[%d].name = %s: must not be that of a quantity of targets", k,
                             of->average[k].name);
    return HD_OK;
}

hd_status hd_target_check(const hd_scene_def *def, char *message, size_t size)
{
    aims target;
    char name[HD_QUANTITY_NAME], why[HD_WHY];
    HD_TRY(check_averages(hd_dynamics_of(def), message, size));
    if (!read_all(&target, &def->target, hd_dynamics_of(def)))
        return refuse_text(def, message, size);
    for (int k = 0; k < target.count; k++) {
        if (is_possible(def, &target.goal[k], why)) continue;
        name_of(name, &target.goal[k]);
        return hd_refuse(message, size, "target = %.100s: must be without %s: %s", def->target.line,
                         name, why);
    }
    return HD_OK;
}

/** The observable `one` if it is in the set, otherwise those of the set that bring it along. */
static unsigned simplest(unsigned set, unsigned one)
{
    unsigned all = 0;
    if (set & one) return one;
    for (unsigned bit = 1; bit <= set; bit <<= 1)
        if (set & bit && hd_observables_with(bit) & one) all |= bit;
    return all;
}

unsigned hd_target_stages(const hd_scene_def *def, unsigned stages)
{
    const aims target = aims_of(def, &def->target);
    for (int k = 0; k < target.count; k++) {
        const unsigned bit = needed(&target.goal[k]);
        if (!(hd_observables_with(stages & def->observe) & bit))
            stages |= simplest(def->observe, bit);
    }
    return stages;
}

/* ---- how far is it? -------------------------------------------------------------------------- */

/** Averaged time that is left until the error is as wanted, if the part of it that averaging
 * reduces falls with the square root of time. */
static double left_of(const hd_target_progress *s, double averaged)
{
    const double falls = s->error * s->error - s->open * s->open;
    const double may = s->wanted * s->wanted - s->open * s->open;
    if (s->reached) return 0.0;
    return s->error >= 0.0 && may > 0.0 ? averaged * (falls / may - 1.0) : INFINITY;
}

static hd_stated smallest_error(const hd_run *run)
{
    const double error = hd_carrier_smallest_error(&run->carrier);
    return (hd_stated){.error = error < INFINITY ? error : -1.0};
}

static hd_target_progress standing_of(const hd_run *run, const hd_aim *goal, double averaged)
{
    const hd_parts parts = hd_run_parts(run);
    const hd_stated now = goal->quantity->read ? goal->quantity->read(&parts, goal)
                                               : smallest_error(run);
    const double value = fabs(now.value);
    hd_target_progress s = {
        .value = now.value, .error = now.error, .open = now.open, .wanted = goal->wanted};
    if (!(now.error >= 0.0)) s = (hd_target_progress){.error = -1.0, .wanted = s.wanted};
    name_of(s.name, goal);
    if (goal->relative) s.wanted = s.error >= 0.0 ? goal->wanted * value : -1.0;
    s.reached = s.error >= 0.0 && s.error <= s.wanted;
    s.left = left_of(&s, averaged);
    return s;
}

/** Present error over wanted error; INFINITY if it is not known. */
static double distance(const hd_target_progress *s)
{
    return s->error >= 0.0 ? s->error / s->wanted : INFINITY;
}

hd_target_progress hd_target_standing(const hd_run *run, const hd_text *target)
{
    const aims asked = aims_of(&run->scene, target);
    const double averaged = hd_trajectory_time(run->advance.trajectory) - run->agenda.start;
    hd_target_progress all = {.error = -1.0, .wanted = -1.0, .left = INFINITY};
    for (int k = 0; k < asked.count; k++) {
        const hd_target_progress one = standing_of(run, &asked.goal[k], averaged);
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
    return hd_target_standing(run, &run->agenda.in_force.target).reached;
}
