/** Scene -> what is known of lambda(k) before its steps are measured [T12].
 *
 * The curvature was measured in long boxes (doc/findings.md) and is a member of hd_fluid. Particles
 * without a fluid are taken to have the curvature of disks or spheres, and to fill a box as these,
 * with errors OTHERS times as large. In a thin gas the scale is the mean free path l, else sigma.
 * The effect of edges was measured for disks and dumbbells in narrow boxes, and for disks in boxes
 * with walls. */
#include "modes/steps.h"

#include <math.h>

#include "dynamics/dynamics.h"
#include "modes/fields.h"
#include "scene/container.h"
#include "scene/ends.h"
#include "scene/fluid.h"
#include "scene/scene.h"

static const double OTHERS = 3.0;
/** Walls change c by about WALL sigma / edge, and each step independently by WALL_OWN of that. */
static const double WALL = 0.25, WALL_OWN = 0.6;
static const hd_relation NONE = {NAN, NAN, NAN, NAN, NAN, NAN};
/** A narrow edge changes c by about NARROW (sigma / edge)^2. Dense disks stand in rows, which fit
 * the edge or do not: this changes c by CROWDED (sigma / edge)^4 at the density DENSE, at most by
 * all of it. */
static const double NARROW = 0.25, CROWDED = 7.0, DENSE = 0.8;
/** A step lies off the relation by MISSING times the square of the part of its multiplicity that
 * was not found, and by ELSEWHERE times the part of its weight in the columns of other steps. */
static const double MISSING = 0.02, ELSEWHERE = 0.006;

/** T steps with exponents below that of an LP step have wave numbers below this many times its own:
 * up to 1.6 was seen, as c_L / c_T is 1.36 at most and LP bends more. */
static const double BELOW_STEP = 1.75;

static double walls_of(const hd_scene_def *def, const double *box)
{
    double square = 0.0;
    for (int d = 0; d < hd_scene_dimension(def); d++)
        if (hd_is_wall(hd_scene_boundary(def, d))) square += WALL * WALL / (box[d] * box[d]);
    return sqrt(square);
}

/** Diameter of the disks, or spheres, that fill as much as the particles; 1 if these have no size.
 */
static double diameter_of(const hd_scene_def *def)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    const double pi = 3.14159265358979323846;
    if (!of->size) return 1.0;
    return of->dimension == 2 ? sqrt(of->size(def) / (pi / 4.0)) : cbrt(of->size(def) / (pi / 6.0));
}

/** Lengths of a mixture are in its own diameters. */
static hd_curvature bend_of(const hd_scene_def *def, bool t)
{
    const hd_fluid *own = hd_dynamics_of(def)->fluid;
    const hd_fluid *like = hd_scene_dimension(def) == 2 ? &hd_fluid_disks : &hd_fluid_spheres;
    hd_curvature bend = t ? (own ? own : like)->t : (own ? own : like)->lp;
    const double s = hd_dynamics_of(def)->kinds ? diameter_of(def) : 1.0;
    bend.c2 *= s, bend.error *= s, bend.c3 *= s * s, bend.c3_error *= s * s;
    if (own) return bend;
    bend.error *= OTHERS, bend.error_l *= OTHERS, bend.c3_error *= OTHERS, bend.off *= OTHERS;
    return bend;
}

hd_relation hd_relation_of(const hd_scene_def *def, hd_mode_kind kind)
{
    const bool t = kind == HD_MODE_T;
    const hd_container_row *container = hd_container_of(def);
    const double strays = t ? container->t_strays : container->lp_strays;
    if (hd_scene_dimension(def) == 0 || isnan(strays)) return NONE;
    const hd_curvature b = bend_of(def, t);
    const double l = hd_scene_mean_free_path(def);
    double box[HD_DIMENSION_MAX], edge = INFINITY;
    hd_scene_box(def, box);
    for (int d = 0; d < hd_scene_dimension(def); d++) edge = fmin(edge, box[d]);
    const double s = diameter_of(def), walls = s * walls_of(def, box);
    const double thin = s * s / (edge * edge),
                 filled = def->density * pow(s, hd_scene_dimension(def));
    const double rows = CROWDED * pow(filled / DENSE, 8.0) * thin * thin;
    const double narrow = hypot(NARROW * thin, rows / (1.0 + rows));
    hd_relation r = {
        .c2 = b.c2 + b.c2_l * l,
        .c2_error = b.error + b.error_l * l,
        .c3 = b.c3 + b.c3_l2 * l * l,
        .box_error = (hd_dynamics_of(def)->fluid ? 1.0 : OTHERS) * hypot(walls, narrow),
        .scatter = hypot(t ? 0.001 : 0.002, WALL_OWN * walls),
    };
    r.c3_error = b.off * r.c3 + b.c3_error;
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
