/** Defaults of what is asked for, and what follows from it. */
#include "hdlyap/scene.h"

#include <math.h>

#include "hdlyap/parameters.h"
#include "hdlyap/wave.h"
#include "scene/archived.h"
#include "scene/container.h"

hd_scene_def hd_scene_def_default(void)
{
    hd_scene_def def = {.seed = 0};
    int count;
    const hd_parameter *rows = hd_scene_parameters(&count);
    for (int k = 0; k < count; k++) hd_parameter_assign(&rows[k], &def, rows[k].usual);
    return def;
}

void hd_scene_box(const hd_scene_def *def, double box[HD_DIM])
{
    hd_container_of(def)->box(def, box);
}

const hd_container_row *hd_container_of(const hd_scene_def *def)
{
    return def->container == HD_CIRCLE ? &hd_circle_row : &hd_rectangle_row;
}

hd_boundary hd_scene_boundary(const hd_scene_def *def, int d)
{
    return def->container == HD_CIRCLE ? HD_CURVED : def->boundary[d];
}

/** p = rho Z: c^2 = d(rho Z)/d rho + Z^2, as a disk has two degrees of freedom and kT = 1. */
double hd_scene_sound_crossing(const hd_scene_def *def)
{
    const double eta = 0.25 * 3.14159265358979323846 * def->density, free = 1.0 - eta;
    const double z = (1.0 + eta * eta / 8.0) / (free * free);
    const double slope = (0.25 * eta + 2.0 * z * free) / (free * free); /* dZ / d eta */
    double box[HD_DIM];
    hd_scene_box(def, box);
    return fmax(box[0], box[1]) / sqrt(z + eta * slope + z * z);
}

double hd_scene_mean_free_path(const hd_scene_def *def)
{
    const double eta = 0.25 * 3.14159265358979323846 * def->density, free = 1.0 - eta;
    const double g = (1.0 - 7.0 / 16.0 * eta) / (free * free);
    return 1.0 / (2.0 * sqrt(2.0) * def->density * g);
}

int hd_scene_zero_exponents(const hd_scene_def *def)
{
    return 2 * hd_container_of(def)->symmetries(def);
}

int hd_scene_vectors(const hd_scene_def *def)
{
    const int all = HD_ROWS * def->disks;
    if (def->exponents <= HD_EXPONENTS_ALL) return all;
    if (def->exponents == HD_EXPONENTS_POSITIVE) return hd_scene_positive_exponents(def);
    return def->exponents;
}

int hd_scene_positive_exponents(const hd_scene_def *def)
{
    return (HD_ROWS * def->disks - hd_scene_zero_exponents(def)) / 2;
}

int hd_scene_carried(const hd_scene_def *def)
{
    const int all = hd_scene_vectors(def);
    return def->exponents == HD_EXPONENTS_ALL ? all / 2 : all;
}

/** Steps that differ by this part of the smallest of all are to part by so many factors of e: most
 * of a random start has gone. */
static const double GAP = 0.05, FOLDS = 3.0;
/** A frame that does not reach the steps has less to forget; none is forgotten sooner. */
static const double WARMUP_LEADING = 50.0, WARMUP_MIN = 20.0;

/** Of the transverse branch, the smallest: Eckmann et al. (2005), to 3 % for densities up to 0.8.
 */
static double slope(double density)
{
    const double square = density * density;
    return 0.902 + 1.050 * density - 0.053 * square + 3.85 * square * square;
}

double hd_scene_warmup(const hd_scene_def *def)
{
    if (def->warmup != HD_WARMUP_AUTO) return def->warmup;
    if (def->exponents == HD_EXPONENTS_NONE) return 0.0;
    const bool leading = hd_scene_vectors(def) < hd_scene_positive_exponents(def);
    const double k = hd_wave_limits_of(def).smallest; /* INFINITY: no step, nothing parts */
    const double parting = FOLDS / (GAP * slope(def->density) * k);
    const double time = leading ? WARMUP_LEADING : fmax(parting, WARMUP_MIN);
    return def->observe & HD_OBSERVE_COVARIANT ? fmax(time, def->covariant_transient) : time;
}

/** Ranges beyond what the types hold are checked with the whole of it. */
void hd_scene_archive(hd_scene_def *def, hd_archive *archive)
{
    int count;
    const hd_parameter *rows = hd_scene_parameters(&count);
    for (int k = 0; k < count; k++) {
        const hd_parameter *r = &rows[k];
        double real = hd_parameter_value(r, def);
        int whole;
        switch (r->kind) {
        case HD_PARAMETER_SEED: hd_archive_bits(archive, r->record, &def->seed); continue;
        case HD_PARAMETER_REAL:
        case HD_PARAMETER_INTERVAL: hd_archive_double(archive, r->record, &real); break;
        default:
            whole = (int)real;
            hd_archive_int(archive, r->record, &whole, (int)r->least, (int)r->most);
            real = whole;
        }
        hd_parameter_assign(r, def, real);
    }
}
