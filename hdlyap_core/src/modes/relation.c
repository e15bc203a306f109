/** Scene -> what is known of lambda(k) before its steps are measured [T12].
 *
 * How it bends was measured in long boxes: of disks, wide ones too, at densities from 0.2 to 0.8;
 * of spheres, 8 : 1 : 1, from 0.3 to 0.9 (doc/findings.md). Of dumbbells in five boxes of 160,
 * densities 0.3 and 0.6, bonds 0.25 and 0.5. What else moves is taken to bend as disks and spheres
 * do, but for OTHERS times their errors. In a thin gas k
 * l decides, l the mean free path, else k sigma. What edges do, of disks in boxes with walls and in
 * narrow ones. */
#include "modes/steps.h"

#include <math.h>

#include "modes/archived.h"
#include "scene/container.h"
#include "scene/scene.h"

/** c2 / c = c2 + c2_l l, its error alike; c3 / c = c3 + c3_l2 l^2, its error besides OFF times c3.
 */
typedef struct bend {
    double c2, c2_l, error, error_l, c3, c3_l2, c3_error;
} bend;
/** Of LP and of T. */
static const bend BENDS[][2] = {[HD_DISKS] = {{0.11, 0.16, 0.02, 0.02, 0.55, 2.0, 0.0},
                                              {0.02, 0.0, 0.007, 0.0, 0.05, 1.3, 0.01}},
                                [HD_SPHERES] = {{0.05, 0.17, 0.03, 0.04, 0.18, 0.8, 0.05},
                                                {0.02, 0.0, 0.015, 0.0, 0.01, 0.87, 0.02}},
                                [HD_DUMBBELLS] = {{0.11, 0.16, 0.02, 0.02, 0.28, 2.0, 0.1},
                                                  {0.02, 0.0, 0.007, 0.0, 0.06, 1.3, 0.03}}};
/** Of c3 / c: how far densities lie off the formulae. */
static const double OFF[] = {[HD_DISKS] = 0.1, [HD_SPHERES] = 0.15, [HD_DUMBBELLS] = 0.1};
static const double OTHERS = 3.0;
/** Walls move c by about WALL sigma / edge, and each step by WALL_OWN of that for itself. */
static const double WALL = 0.25, WALL_OWN = 0.6;
static const hd_relation NONE = {NAN, NAN, NAN, NAN, NAN, NAN};
/** Dense disks in a narrow box stand in rows, which fit its edge or do not: CROWDED (sigma /
 * edge)^4 at the density DENSE. */
static const double CROWDED = 7.0, DENSE = 0.8;
/** A step strays by MISSING times the square of the part of its multiplicity that is missing, and
 * by ELSEWHERE times the part of its weight that lies in the columns of other steps. */
static const double MISSING = 0.02, ELSEWHERE = 0.006;

/** T exponents that lie below an LP step are of wave numbers up to 1.6 times its own, where it is
 * highest: c_L / c_T is 1.36 at most, and LP bends more. */
static const double BELOW_STEP = 1.75;

static double walls_of(const hd_scene_def *def, const double *box)
{
    double square = 0.0;
    for (int d = 0; d < hd_scene_dimension(def); d++)
        if (hd_scene_boundary(def, d) == HD_REFLECTING) square += WALL * WALL / (box[d] * box[d]);
    return sqrt(square);
}

/** Those whose branches are known, and near those of what moves. */
static hd_particles bends_as(const hd_scene_def *def)
{
    if (!def->dynamics && def->particles <= HD_DUMBBELLS) return def->particles;
    return hd_scene_dimension(def) == 2 ? HD_DISKS : HD_SPHERES;
}

hd_relation hd_relation_of(const hd_scene_def *def, hd_mode_kind kind)
{
    const bool t = kind == HD_MODE_T;
    const hd_container_row *container = hd_container_of(def);
    const double strays = t ? container->t_strays : container->lp_strays;
    if (hd_scene_dimension(def) == 0 || isnan(strays)) return NONE;
    const hd_particles as = bends_as(def);
    const bend *b = &BENDS[as][t];
    const double l = hd_scene_mean_free_path(def);
    double box[HD_DIMENSION_MAX], edge = INFINITY;
    hd_scene_box(def, box);
    for (int d = 0; d < hd_scene_dimension(def); d++) edge = fmin(edge, box[d]);
    const double walls = walls_of(def, box), square = edge * edge;
    const double rows = CROWDED * pow(def->density / DENSE, 8.0) / (square * square);
    const double narrow = hypot((t ? 0.1 : 0.25) / square, rows);
    hd_relation r = {
        .c2 = b->c2 + b->c2_l * l,
        .c2_error = b->error + b->error_l * l,
        .c3 = b->c3 + b->c3_l2 * l * l,
        .box_error = hypot(walls, narrow),
        .scatter = hypot(t ? 0.001 : 0.002, WALL_OWN * walls),
    };
    r.c3_error = OFF[as] * r.c3 + b->c3_error;
    if (def->dynamics || as != def->particles) r.c2_error *= OTHERS, r.c3_error *= OTHERS;
    if (strays > 0) r.scatter = r.box_error = strays;
    return r;
}

/** Wave number of the longest wave with fields of a kind; INFINITY if the scene asks for none. */
static double longest_of(const hd_scene_def *def, hd_mode_kind kind)
{
    enum { LONG = 8 };
    hd_wave wave[LONG];
    hd_scene_def first = *def;
    first.max_mode_number = 1;
    first.max_wave_number = 0.0;
    const int count = hd_waves(&first, wave, LONG);
    const double limit = hd_wave_limit(def);
    for (int k = 0; k < count && wave[k].number <= limit; k++)
        if ((kind == HD_MODE_T ? wave[k].transverse : wave[k].pairs).count > 0)
            return wave[k].number;
    return INFINITY;
}

double hd_relation_open(const hd_scene_def *def, hd_mode_kind kind)
{
    const hd_relation r = hd_relation_of(def, kind);
    const double k = longest_of(def, kind);
    if (isnan(r.c2)) return INFINITY;
    const double curved = hypot(r.c2_error * k, r.c3_error * k * k);
    return hypot(r.box_error, hypot(r.scatter, curved));
}

static void raise_to(void *shortest, const hd_wave *wave)
{
    double *number = shortest;
    *number = fmax(*number, wave->number);
}

int hd_steps_exponents_least(const hd_scene_def *def)
{
    hd_scene_def all = *def;
    double shortest = 0.0;
    hd_container_of(def)->waves(def, raise_to, &shortest);
    if (shortest == 0.0) return 0;
    all.max_mode_number = 0;
    all.max_wave_number = BELOW_STEP * shortest;
    const double fields = hd_fields_count_of(&all).columns;
    return (int)fmax(hd_scene_positive_exponents(def) - fields + 1.0, 1.0);
}

double hd_steps_scatter(const hd_steps *steps, const hd_step *step)
{
    const double missing = 1.0 - step->multiplicity / step->expected;
    const double own = hypot(MISSING * missing * missing, ELSEWHERE * (1.0 - step->own_part));
    return hypot(hd_steps_relation(steps, step->kind)->scatter, own);
}
