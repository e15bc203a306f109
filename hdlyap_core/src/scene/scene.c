/** Defaults of a scene, and what is derived from a scene. */
#include "scene/scene.h"

#include <math.h>
#include <string.h>

#include "base/check.h"
#include "scene/ends.h"
#include "scene/fluid.h"
#include "scene/parameters.h"
#include "scene/wave.h"

/** Parameters that only the scene's dynamics has get their defaults. */
static void own_assign(hd_scene_def *def)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    for (int k = 0; k < of->parameters; k++)
        hd_parameter_assign(&of->parameter[k], def, of->parameter[k].default_value);
}

hd_scene_def hd_scene_def_default(void)
{
    hd_scene_def def = {.seed = 0};
    int count;
    const hd_parameter *rows = hd_scene_parameters(&count);
    for (int k = 0; k < count; k++) hd_parameter_assign(&rows[k], &def, rows[k].default_value);
    own_assign(&def);
    return def;
}

hd_scene_def hd_scene_def_of(const hd_dynamics *dynamics)
{
    HD_ASSERT(dynamics);
    hd_scene_def def = hd_scene_def_default();
    def.dynamics = dynamics;
    if (hd_dynamics_check(dynamics, NULL, 0) != HD_OK) return def; /* as hd_scene_check will say */
    for (int k = HD_DISKS; k < HD_PARTICLES_END; k++) {
        const hd_scene_def core = {.particles = (hd_particles)k};
        if (hd_dynamics_of(&core) != dynamics) continue;
        def.particles = (hd_particles)k;
        def.dynamics = NULL;
    }
    own_assign(&def);
    def.exponents = hd_scene_exponents_usual(&def);
    return def;
}

bool hd_scene_symplectic(const hd_scene_def *def)
{
    bool symplectic = hd_dynamics_of(def)->symplectic;
    for (int d = 0; d < hd_scene_dimension(def); d++)
        symplectic &= hd_ends_of(hd_scene_boundary(def, d))->symplectic;
    return symplectic;
}

bool hd_scene_diverges(const hd_scene_def *def)
{
    return hd_dynamics_of(def)->divergence && !hd_scene_symplectic(def);
}

int hd_scene_exponents_usual(const hd_scene_def *def)
{
    return hd_scene_symplectic(def) ? HD_EXPONENTS_POSITIVE : HD_EXPONENTS_ALL;
}

int hd_scene_dimension(const hd_scene_def *def) { return hd_dynamics_of(def)->dimension; }

int hd_scene_coordinates(const hd_scene_def *def) { return hd_dynamics_of(def)->coordinates; }

double hd_scene_inertia(const hd_scene_def *def)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    return of->inertia ? of->inertia(def) : 0.0;
}

int hd_scene_sites(const hd_scene_def *def, double *site)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    site[0] = 0.0;
    return of->sites ? of->sites(def, site) : 1;
}

double hd_scene_packing(const hd_scene_def *def)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    return of->size ? def->density * of->size(def) : NAN;
}

/** Blocks of averages last this many collisions of a particle if nothing better is known. */
static const double BLOCK_COLLISIONS = 8.0;

double hd_scene_collision_time(const hd_scene_def *def)
{
    return 0.5 * def->number / hd_dynamics_of(def)->collision_rate(def);
}

double hd_scene_sound_crossing(const hd_scene_def *def)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    double box[HD_DIMENSION_MAX], longest = 0.0;
    if (of->sound_crossing_time) return of->sound_crossing_time(def);
    if (!of->fluid) return BLOCK_COLLISIONS * hd_scene_collision_time(def);
    hd_scene_box(def, box);
    for (int d = 0; d < of->dimension; d++) longest = fmax(longest, box[d]);
    return longest / of->fluid->sound(def);
}

double hd_scene_mean_free_path(const hd_scene_def *def)
{
    const hd_fluid *fluid = hd_dynamics_of(def)->fluid;
    return fluid ? fluid->free_path(def) : hd_scene_collision_time(def); /* at speed 1 */
}

int hd_scene_zero_exponents(const hd_scene_def *def)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    return of->zero_exponents ? of->zero_exponents(def) : 0;
}

static int all_exponents(const hd_scene_def *def)
{
    return 2 * hd_scene_coordinates(def) * def->number;
}

int hd_scene_vectors(const hd_scene_def *def)
{
    const int all = all_exponents(def);
    if (def->exponents <= HD_EXPONENTS_ALL) return all;
    if (def->exponents == HD_EXPONENTS_POSITIVE) return hd_scene_positive_exponents(def);
    return def->exponents;
}

int hd_scene_positive_exponents(const hd_scene_def *def)
{
    return (all_exponents(def) - hd_scene_zero_exponents(def)) / 2;
}

int hd_scene_carried(const hd_scene_def *def)
{
    const int all = hd_scene_vectors(def);
    const bool half = def->exponents == HD_EXPONENTS_ALL && hd_scene_symplectic(def);
    return half ? all / 2 : all;
}

hd_counts hd_scene_counts(const hd_scene_def *def)
{
    return (hd_counts){.zero = hd_scene_zero_exponents(def),
                       .positive = hd_scene_positive_exponents(def),
                       .vectors = hd_scene_vectors(def),
                       .carried = hd_scene_carried(def)};
}

/** The warm-up separates two steps that differ by GAP times the smallest T step by FOLDS factors of
 * e, so that most of the random start has gone. */
static const double GAP = 0.05, FOLDS = 3.0;
/** Warm-up of a frame that is too small to reach the steps, and the shortest warm-up of all [time
 * units]. */
static const double WARMUP_LEADING = 50.0, WARMUP_MIN = 20.0;
/** Shortest warm-up of particles without a fluid, in collisions of a particle. */
static const double WARMUP_COLLISIONS = 100.0;

/** Particles without a fluid of their own are taken to be as hard ones that are so fast. */
static double warmup_of(const hd_scene_def *def)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    const hd_fluid *like = of->dimension == 2 ? &hd_fluid_disks : &hd_fluid_spheres;
    const double k = hd_wave_limits_of(def).smallest; /* INFINITY: there are no steps to separate */
    const double speed = of->speed ? of->speed(def) : 1.0,
                 least = WARMUP_COLLISIONS * hd_scene_collision_time(def);
    if (hd_scene_vectors(def) < hd_scene_positive_exponents(def))
        return of->fluid ? WARMUP_LEADING : least;
    return fmax(FOLDS / (GAP * speed * (of->fluid ? of->fluid : like)->transverse(def) * k),
                of->fluid ? WARMUP_MIN : least);
}

double hd_scene_parting(const hd_scene_def *def)
{
    if (def->warmup != HD_WARMUP_AUTO) return def->warmup;
    if (def->exponents == HD_EXPONENTS_NONE) return 0.0;
    return warmup_of(def);
}

void hd_scene_settle(hd_scene_def *def)
{
    const hd_scene_def asked = *def;
    const hd_parameter *row;
    for (int k = 0; (row = hd_parameter_of(def, k)); k++)
        if (row->resolve) hd_parameter_assign(row, def, row->resolve(&asked));
}

void hd_scene_keep_chosen(hd_scene_def *asked, const hd_scene_def *kept)
{
    const hd_scene_def was = *asked;
    const hd_parameter *row;
    for (int k = 0; (row = hd_parameter_of(asked, k)); k++)
        if (row->resolve && row->resolve(&was) != hd_parameter_value(row, &was))
            hd_parameter_assign(row, asked, hd_parameter_value(row, kept));
}

/** Reading checks only that types can hold the values; ranges are checked with the whole scene. */
void hd_scene_archive(hd_scene_def *def, hd_archive *archive)
{
    const hd_parameter *r;
    for (int k = 0; (r = hd_parameter_of(def, k)); k++) {
        const char *record = r->record ? r->record : r->name;
        double real = hd_parameter_value(r, def);
        int whole;
        switch (r->kind) {
        case HD_PARAMETER_SEED: hd_archive_bits(archive, record, &def->seed); continue;
        case HD_PARAMETER_TEXT:
            hd_archive_text(archive, record, (char *)def + r->offset, HD_TEXT);
            continue;
        case HD_PARAMETER_REAL:
        case HD_PARAMETER_INTERVAL: hd_archive_double(archive, record, &real); break;
        default:
            whole = (int)real;
            hd_archive_int(archive, record, &whole, (int)r->min, (int)r->max);
            real = whole;
        }
        hd_parameter_assign(r, def, real);
    }
}
