/** Hard disks and spheres of several kinds [T26]: Jenkins and Mancini, J. Appl. Mech. 54, 27
 * (1987), and Mansoori, Carnahan, Starling and Leland, J. Chem. Phys. 54, 1523 (1971). + - * / sqrt
 * only, as the length of an epoch follows. */
#include "scene/mixture.h"

#include <math.h>

#include "scene/scene.h"

#define PI 3.14159265358979323846

/** Numbers of a dimension: size of a particle of diameter 1; factors of y and y^2 in contact
 * values; square of the mean speed over kT / mass; what a particle sweeps over distance^(d - 1). */
typedef struct space_of {
    const hd_fluid *pure;
    int dimension;
    double temperature, size, linear, square, speed, sweep;
} space_of;

static const space_of PLANE = {&hd_fluid_disks, 2, 1.0, PI / 4.0, 9.0 / 8.0, 0.0, 0.5 * PI, 2.0};
static const space_of SPACE = {&hd_fluid_spheres, 3, 2.0 / 3.0, PI / 6.0, 3.0, 2.0, 8.0 / PI, PI};

/** A mixture: the density of each kind, and of all; the part of space that all fill; the same sum
 * with a diameter less in each term. */
typedef struct mixture {
    const space_of *in;
    int kinds;
    hd_kind kind[HD_KINDS_MAX];
    double density[HD_KINDS_MAX], total, filled, surface;
} mixture;

static double power(double x, int n) { return n == 1 ? x : n == 2 ? x * x : x * x * x; }

static mixture mixture_of(const hd_scene_def *def)
{
    mixture m = {.in = hd_scene_dimension(def) == 2 ? &PLANE : &SPACE, .total = def->density};
    m.kinds = hd_scene_kinds(def, m.kind);
    for (int a = 0; a < m.kinds; a++) {
        const double surface = power(m.kind[a].diameter, m.in->dimension - 1);
        m.density[a] = def->density * m.kind[a].number / def->number;
        m.surface += m.in->size * m.density[a] * surface;
        m.filled += m.in->size * m.density[a] * surface * m.kind[a].diameter;
    }
    return m;
}

/** Contact value, and its slope d g / d ln rho, of kinds a and b. */
typedef struct contact {
    double g, slope;
} contact;

/** Packing fractions above 0.9, where the formula diverges, count as 0.9. */
static contact contact_of(const mixture *m, int a, int b)
{
    const double one = m->kind[a].diameter, other = m->kind[b].diameter;
    const double most = fmin(1.0, 0.9 / m->filled), eta = most * m->filled, free = 1.0 - eta;
    const double x = one * other / (one + other) * (most * m->surface), y = x / free;
    const double linear = m->in->linear * y, square = m->in->square * y * y;
    return (contact){(1.0 + linear + square) / free,
                     (eta + linear * (1.0 + eta) + square * (2.0 + eta)) / (free * free)};
}

static double distance(const mixture *m, int a, int b)
{
    return 0.5 * (m->kind[a].diameter + m->kind[b].diameter);
}

static double rate_between(const mixture *m, int a, int b)
{
    const double one = m->kind[a].mass, other = m->kind[b].mass,
                 reduced = one * other / (one + other);
    const double speed = sqrt(m->in->speed * m->in->temperature / reduced);
    return m->density[b] * m->in->sweep * power(distance(m, a, b), m->in->dimension - 1) * speed *
           contact_of(m, a, b).g;
}

/** Z - 1, and its slope d Z / d ln rho. */
static contact excess_of(const mixture *m)
{
    contact sum = {0.0, 0.0};
    for (int a = 0; a < m->kinds; a++)
        for (int b = 0; b < m->kinds; b++) {
            const contact at = contact_of(m, a, b);
            const double half = power(2.0, m->in->dimension - 1) * m->in->size *
                                power(distance(m, a, b),
                                      m->in->dimension); /* of what is excluded */
            const double of_pairs = half * m->density[a] * m->density[b] / m->total;
            sum.g += of_pairs * at.g;
            sum.slope += of_pairs * (at.g + at.slope);
        }
    return sum;
}

static double mean_mass(const mixture *m)
{
    double sum = 0.0;
    for (int a = 0; a < m->kinds; a++) sum += m->density[a] * m->kind[a].mass;
    return sum / m->total;
}

/* ---- what a scene asks --------------------------------------------------------------------- */

double hd_mixture_rate(const hd_scene_def *def, int a, int b)
{
    const mixture m = mixture_of(def);
    return rate_between(&m, a, b);
}

double hd_mixture_compressibility(const hd_scene_def *def)
{
    const mixture m = mixture_of(def);
    return 1.0 + excess_of(&m).g;
}

/** Mean over all particles. */
static double rate_of(const hd_scene_def *def)
{
    const mixture m = mixture_of(def);
    double sum = 0.0;
    for (int a = 0; a < m.kinds; a++)
        for (int b = 0; b < m.kinds; b++) sum += m.density[a] * rate_between(&m, a, b);
    return sum / m.total;
}

/** Mean speed over mean rate. */
static double free_path_of(const hd_scene_def *def)
{
    const mixture m = mixture_of(def);
    double speed = 0.0;
    for (int a = 0; a < m.kinds; a++)
        speed += m.density[a] * sqrt(m.in->speed * m.in->temperature / m.kind[a].mass);
    return speed / m.total / rate_of(def);
}

/** c^2 = kT / mass (d(rho Z)/d rho + 2 Z^2 / d). */
static double sound_of(const hd_scene_def *def)
{
    const mixture m = mixture_of(def);
    const contact excess = excess_of(&m);
    const double z = 1.0 + excess.g;
    const double slope = z + excess.slope + 2.0 / m.in->dimension * z * z;
    return sqrt(m.in->temperature / mean_mass(&m) * slope);
}

/** As one kind of the mean mass that fills as much. */
static double transverse_of(const hd_scene_def *def)
{
    const mixture m = mixture_of(def);
    hd_scene_def alike = *def;
    alike.density = fmin(m.filled / m.in->size, m.in->pure->density_max);
    return m.in->pure->transverse(&alike) / sqrt(mean_mass(&m));
}

const hd_fluid hd_fluid_disk_mixture = {.density_max = 28.867513459481287, /* of diameter 0.2 */
                                        .rate = rate_of,
                                        .free_path = free_path_of,
                                        .sound = sound_of,
                                        .transverse = transverse_of,
                                        .lp = {0.11, 0.16, 0.06, 0.06, 0.55, 2.0, 0.0, 0.3},
                                        .t = {0.02, 0.0, 0.021, 0.0, 0.05, 1.3, 0.03, 0.3}};
const hd_fluid hd_fluid_sphere_mixture = {.density_max = 176.77669529663689,
                                          .rate = rate_of,
                                          .free_path = free_path_of,
                                          .sound = sound_of,
                                          .transverse = transverse_of,
                                          .lp = {0.05, 0.17, 0.09, 0.12, 0.18, 0.8, 0.15, 0.45},
                                          .t = {0.02, 0.0, 0.045, 0.0, 0.01, 0.87, 0.06, 0.45}};
