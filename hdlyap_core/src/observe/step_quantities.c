/** Steps and their phases -> quantities that a target can name. */
#include "observe/step_quantities.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hdlyap/phases.h"
#include "hdlyap/wave.h"
#include "modes/steps.h"
#include "observe/observable.h"
#include "scene/container.h"

static const hd_stated UNKNOWN = {.error = -1.0};

/* ---- what a scene must have ------------------------------------------------------------------ */

static const hd_modulations *fields_of(const hd_wave *wave, hd_mode_kind kind)
{
    return kind == HD_MODE_T ? &wave->transverse : &wave->pairs;
}

/** The search for a target's step among the waves. */
typedef struct search {
    const hd_aim *goal;
    bool found;
} search;

static void look_at(void *to, const hd_wave *wave)
{
    search *s = to;
    s->found |= memcmp(wave->n, s->goal->number, sizeof s->goal->number) == 0 &&
                fields_of(wave, s->goal->quantity->kind)->count > 0;
}

static bool step_possible(const hd_scene_def *def, const hd_aim *goal, char why[HD_WHY])
{
    search s = {goal, false};
    hd_container_of(def)->waves(def, look_at, &s);
    snprintf(why, HD_WHY, "it is not among the waves of the scene, which --check lists");
    return s.found;
}

static bool edges_do(const hd_scene_def *def, hd_mode_kind kind, double wanted)
{
    return hd_relation_of(def, kind).box_error < wanted;
}

/** Finds a box whose edges leave an error below `wanted`, as it will be written: another shape of
 * it, up to aspect 1, or else more particles in that shape, up to TENFOLD as many. Writes nothing
 * if there is none. */
static void advise(const hd_scene_def *def, hd_mode_kind kind, double wanted, char *text,
                   size_t size)
{
    enum { TRIED = 100, TENFOLD = 10 };
    hd_scene_def other = *def;
    char rounded[16];
    for (int k = 1; k <= TRIED; k++) {
        snprintf(rounded, sizeof rounded, "%.3g", pow(def->aspect, 1.0 - (double)k / TRIED));
        other.aspect = strtod(rounded, NULL);
        if (!edges_do(&other, kind, wanted)) continue;
        snprintf(text, size, "; less with aspect = %s", rounded);
        return;
    }
    other.aspect = def->aspect;
    for (int k = 1; k <= TRIED; k++) {
        const double number = def->number * pow(TENFOLD, (double)k / TRIED);
        const double step = pow(10.0, fmax(floor(log10(number)) - 1.0, 0.0)); /* of two digits */
        other.number = (int)(step * ceil(number / step));
        if (!edges_do(&other, kind, wanted)) continue;
        snprintf(text, size, "; less with number = %d", other.number);
        return;
    }
}

/** Of c_T, c_L and v. */
static bool edges_allow(const hd_scene_def *def, hd_mode_kind kind, const hd_aim *goal,
                        char why[HD_WHY])
{
    const double open = hd_relation_of(def, kind).box_error; /* NaN of LP in a circle */
    if (!(goal->relative && goal->wanted <= open)) return true;
    const int length = snprintf(
        why, HD_WHY, "walls and short edges leave an error of %.3g %%, however long it is averaged",
        100.0 * open);
    advise(def, kind, goal->wanted, why + length, HD_WHY - (size_t)length);
    return false;
}

static bool slope_possible(const hd_scene_def *def, const hd_aim *goal, char why[HD_WHY])
{
    const hd_mode_kind kind = goal->quantity->kind;
    if (hd_relation_open(def, kind) < INFINITY) return edges_allow(def, kind, goal, why);
    snprintf(why, HD_WHY, "no steps of this scene follow the relation whose slope it is");
    return false;
}

static bool velocity_possible(const hd_scene_def *def, const hd_aim *goal, char why[HD_WHY])
{
    return edges_allow(def, HD_MODE_LP, goal, why);
}

/* ---- what a run states ----------------------------------------------------------------------- */

/** The number of the step; -1: it is not resolved. */
static int step_of(const hd_steps *steps, const hd_aim *goal)
{
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (step->kind == goal->quantity->kind && !step->conjugate && step->resolved &&
            memcmp(step->wave.n, goal->number, sizeof goal->number) == 0)
            return k;
    }
    return -1;
}

static hd_stated read_step(const hd_parts *parts, const hd_aim *goal)
{
    const int k = step_of(parts->steps, goal);
    if (k < 0) return UNKNOWN;
    const hd_step *step = hd_steps_step(parts->steps, k);
    return (hd_stated){step->exponent, step->std_error, step->mixing};
}

static hd_stated read_omega(const hd_parts *parts, const hd_aim *goal)
{
    hd_stated out = {.open = 0.0};
    const int k = step_of(parts->steps, goal);
    const bool known = k >= 0 && hd_phases_rate(parts->phases, k, &out.value, &out.error);
    return known ? out : UNKNOWN;
}

/** A stated value whose error averaging reduces only in part. */
static hd_stated with_sampling(double value, double error, double sampled)
{
    return (hd_stated){value, error, sqrt(fmax(error * error - sampled * sampled, 0.0))};
}

static hd_stated read_slope(const hd_parts *parts, const hd_aim *goal)
{
    const hd_dispersion d = hd_steps_dispersion(parts->steps, parts->spectrum,
                                                goal->quantity->kind);
    if (d.points == 0) return UNKNOWN;
    hd_stated out = with_sampling(d.c.value, d.c.error, d.c_sampling_error);
    out.open = hypot(out.open, d.c_mixing);
    return out;
}

static hd_stated read_velocity(const hd_parts *parts, const hd_aim *goal)
{
    (void)goal;
    const hd_velocity v = hd_phases_velocity(parts->phases);
    return v.phases > 0 ? with_sampling(v.v, v.v_error, v.v_sampling_error) : UNKNOWN;
}

static const hd_quantity of_steps[] = {
    {"T", HD_OF_NODES, HD_MODE_T, step_possible, read_step},
    {"LP", HD_OF_NODES, HD_MODE_LP, step_possible, read_step},
    {"c_T", HD_OF_NOTHING, HD_MODE_T, slope_possible, read_slope},
    {"c_L", HD_OF_NOTHING, HD_MODE_LP, slope_possible, read_slope},
    {.name = NULL}};
static const hd_quantity of_phases[] = {
    {.name = "v", .possible = velocity_possible, .read = read_velocity},
    {"omega", HD_OF_NODES, HD_MODE_LP, step_possible, read_omega},
    {.name = NULL}};

const hd_quantities hd_step_quantities = {"steps", of_steps};
const hd_quantities hd_phase_quantities = {"lp_phases", of_phases};
