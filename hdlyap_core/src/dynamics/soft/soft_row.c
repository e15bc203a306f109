/** Parameters of soft particles, what is expected of them, and questions about their state; their
 * rows in the plane and in space. */
#include <math.h>
#include <string.h>
#include <zlib.h>

#include "base/check.h"
#include "dynamics/soft/kick.h"
#include "dynamics/soft/kick_maps.h"
#include "dynamics/soft/soft_state.h"
#include "scene/container.h"
#include "scene/dynamics.h"
#include "scene/scene.h"

/* ---- parameters ---------------------------------------------------------------------------- */

static const hd_parameter_word potential_words[] = {
    {"power", HD_POWER}, {"wca", HD_WCA}, {"lennard_jones", HD_LENNARD_JONES}, {NULL, 0}};
static const hd_parameter_word integrator_words[] = {
    {"auto", HD_INTEGRATOR_AUTO}, {"verlet", HD_VERLET}, {"pefrl", HD_PEFRL}, {NULL, 0}};

static const hd_parameter own[HD_SOFT_OWN] = {
    {.name = "potential",
     .kind = HD_PARAMETER_WORD,
     .words = potential_words,
     .offset = HD_OWN(HD_SOFT_POTENTIAL),
     .usual = HD_WCA,
     .most = HD_POTENTIALS - 1,
     .allowed = "power, wca or lennard_jones",
     .unit = "",
     .text = "Energy of a pair at distance r. power: 100 (1 - r^2)^4. wca: 4 (r^-12 - r^-6) + 1 "
             "up to r = 2^(1/6). lennard_jones: 4 (r^-12 - r^-6), cut off smoothly from r = 2 to "
             "2.5."},
    {.name = "energy",
     .kind = HD_PARAMETER_REAL,
     .offset = HD_OWN(HD_SOFT_ENERGY),
     .usual = 1.0,
     .least = -10.0,
     .most = 1e6,
     .allowed = "from -10 to 1e6",
     .unit = "epsilon",
     .text = "Kinetic and potential energy per particle. It must be above the energy of the start "
             "lattice."},
    {.name = "time_step",
     .kind = HD_PARAMETER_REAL,
     .offset = HD_OWN(HD_SOFT_TIME_STEP),
     .most = 10.0,
     .chosen = hd_soft_time_step,
     .allowed = "from 0 to 10",
     .unit = "time units",
     .text =
         "Time step of the integrator. 0: chosen so that the relative error of the energy stays "
         "below ten times the accuracy, which counts as at least 1e-6, for wca 5e-5, and at most "
         "1e-3, to the end of the duration (0: over 1e4 time units); when resumed, as before."},
    {.name = "integrator",
     .kind = HD_PARAMETER_WORD,
     .words = integrator_words,
     .offset = HD_OWN(HD_SOFT_INTEGRATOR),
     .usual = HD_INTEGRATOR_AUTO,
     .most = HD_INTEGRATOR_AUTO,
     .chosen = hd_soft_integrator_chosen,
     .allowed = "auto, verlet or pefrl",
     .unit = "",
     .text = "Method by which particles move. verlet has order 2 and computes forces once a step; "
             "pefrl has order 4 and computes them four times. auto: verlet for wca, which is not "
             "smooth enough for order 4, and pefrl for the others; when resumed, as before."}};

/** The power of the time step by which zero exponents split: from the jump at the cut [T24], or the
 * order of the integrator if that is less. */
static double row_split(const hd_scene_def *scene)
{
    return fmin(2.0 / 3.0 * hd_soft_potential(scene)->smooth, hd_soft_integrator(scene)->order);
}

static hd_status row_check(const hd_scene_def *scene, char *message, size_t size)
{
    const char *particles = hd_dynamics_of(scene)->particles;
    const hd_potential *potential = hd_soft_potential(scene);
    const double energy = scene->own[HD_SOFT_ENERGY].real;
    double box[HD_DIMENSION_MAX], lattice;
    if (hd_container_of(scene)->wall)
        return hd_refuse(message, size, "container = %s: must be rectangle with particles = %s",
                         hd_container_name(scene), particles);
    hd_scene_box(scene, box);
    for (int d = 0; d < hd_scene_dimension(scene); d++) {
        const char axis = "xyz"[d];
        if (scene->boundary[d] != HD_PERIODIC)
            return hd_refuse(message, size,
                             "boundary_%c = %s: must be periodic with particles = %s", axis,
                             hd_scene_boundary_word(scene, d), particles);
        if (!(box[d] > 2.0 * potential->cut))
            return hd_refuse(message, size,
                             "density = %.15g with number = %d: the box edge L%c = %.15g must be "
                             "above %.6g, twice the range of potential = %s",
                             scene->density, scene->number, axis, box[d], 2.0 * potential->cut,
                             potential->name);
    }
    const hd_status found = hd_soft_lattice_energy(&lattice, scene);
    if (found != HD_OK) (void)hd_refuse(message, size, "%s", hd_status_text(found));
    HD_TRY(found);
    if (energy * scene->number > lattice) return HD_OK;
    return hd_refuse(message, size,
                     "energy = %.15g: must be above %.6g, the potential energy per particle of the "
                     "start lattice with potential = %s, density = %.15g, number = %d",
                     energy, lattice / scene->number, potential->name, scene->density,
                     scene->number);
}

/* ---- what is expected ---------------------------------------------------------------------- */

static int row_zeros(const hd_scene_def *scene) { return 2 * hd_scene_dimension(scene) + 2; }

static double row_entries(const hd_scene_def *scene)
{
    const double kicks = hd_soft_integrator(scene)->kicks,
                 pairs = scene->number *
                         hd_neighbours_expected(scene, hd_soft_potential(scene)->cut);
    return (1.0 + 1.2 * kicks * pairs) / hd_soft_time_step(scene);
}

/** Time that sound takes through the box; its velocity is some times the usual speed. */
static double row_crossing(const hd_scene_def *scene)
{
    double box[HD_DIMENSION_MAX], longest = 0.0;
    hd_scene_box(scene, box);
    for (int d = 0; d < hd_scene_dimension(scene); d++) longest = fmax(longest, box[d]);
    return longest / (hd_soft_speed(scene) * (1.5 + 8.0 * scene->density));
}

/** The force on particle i from all others. */
static void force_on(double *force, const hd_scene_def *scene, const double *q, int i)
{
    const int dimension = hd_scene_dimension(scene);
    const hd_potential *potential = hd_soft_potential(scene);
    double box[HD_DIMENSION_MAX];
    hd_scene_box(scene, box);
    for (int d = 0; d < dimension; d++) force[d] = 0.0;
    for (int j = 0; j < scene->number; j++) {
        double r[HD_DIMENSION_MAX], square = 0.0;
        for (int d = 0; d < dimension; d++) {
            r[d] = hd_nearest(q[dimension * j + d] - q[dimension * i + d], box[d]);
            square += r[d] * r[d];
        }
        if (i == j || !(square < potential->cut * potential->cut)) continue;
        const double b = potential->at(square).b;
        for (int d = 0; d < dimension; d++) force[d] += b * r[d];
    }
}

/** Fills the null vectors: translations, their momenta, and the flow (p, F). The vector that
 * belongs to the energy is not known. */
static int row_null(const hd_scene_def *scene, const double *q, const double *p, double *column)
{
    const int dimension = hd_scene_dimension(scene), count = 2 * dimension + 1;
    const size_t of_one = 2 * (size_t)dimension, rows = of_one * (size_t)scene->number;
    memset(column, 0, (size_t)count * rows * sizeof *column);
    for (int i = 0; i < scene->number; i++) {
        double *one = column + of_one * (size_t)i, *flow = one + 2 * (size_t)dimension * rows;
        for (int k = 0; k < 2 * dimension; k++) one[(size_t)k * rows + (size_t)k] = 1.0;
        memcpy(flow, p + dimension * i, (size_t)dimension * sizeof *p);
        force_on(flow + dimension, scene, q, i);
    }
    return count;
}

/* ---- state --------------------------------------------------------------------------------- */

static double row_time(const void *state) { return ((const soft *)state)->now; }

static void row_state(const void *state, double *q, double *p)
{
    const soft *s = state;
    const size_t bytes = (size_t)(s->count * s->dimension) * sizeof *q;
    if (q) memcpy(q, s->q, bytes);
    if (p) memcpy(p, s->p, bytes);
}

static void row_examine(const void *state, hd_examined *out)
{
    const soft *s = state;
    *out = (hd_examined){.kinetic_energy = hd_soft_kinetic_energy(s),
                         .energy_error = s->error,
                         .energy_rounding = HD_SOFT_LOST};
    for (int k = 0; k < s->count * s->dimension; k++) out->momentum[k % s->dimension] += s->p[k];
}

static void row_totals(const void *state, hd_totals *out)
{
    const soft *s = state;
    *out = s->totals;
    out->time = s->sums ? (double)s->steps * s->step : 0.0;
}

static uint32_t row_fingerprint(const void *state)
{
    const soft *s = state;
    const size_t bytes = (size_t)(s->count * s->dimension) * sizeof *s->q;
    return (uint32_t)crc32_z(crc32_z(0, (const Bytef *)s->q, bytes), (const Bytef *)s->p, bytes);
}

static double row_bytes(const hd_scene_def *scene)
{
    const double of_one = 2.0 * sizeof(double) * hd_scene_dimension(scene);
    return of_one * scene->number + hd_neighbours_bytes(scene, hd_soft_potential(scene)->cut);
}

/** Bytes of this many entries: in the record, which doubles when it is full, and as maps, which
 * take as much. */
static double record_bytes(double entries, double entry)
{
    double room = 4096.0;
    while (room < 1.1 * entries) room *= 2.0;
    return 2.0 * room * entry;
}

static double row_record_bytes_plane(double entries)
{
    return record_bytes(entries, HD_KICK_BYTES(HD_BENDS_PLANE));
}

static double row_record_bytes_space(double entries)
{
    return record_bytes(entries, HD_KICK_BYTES(HD_BENDS_SPACE));
}

static const char *inconsistency(const soft *s)
{
    for (int k = 0; k < s->count * s->dimension; k++)
        if (!(s->q[k] >= 0 && s->q[k] <= s->near.box[k % s->dimension]))
            return "a particle is outside the box";
    return NULL;
}

static void row_archive(void *state, hd_archive *archive)
{
    soft *s = state;
    const size_t all = (size_t)(s->count * s->dimension);
    hd_archive_double(archive, "trajectory time", &s->now);
    hd_archive_bits(archive, "trajectory steps", &s->steps);
    hd_archive_double(archive, "trajectory energy", &s->energy);
    hd_archive_doubles(archive, "trajectory q", s->q, all);
    hd_archive_doubles(archive, "trajectory p", s->p, all);
    if (s->sums) {
        hd_archive_doubles(archive, "trajectory kinetic", s->totals.kinetic, (size_t)s->dimension);
        hd_archive_doubles(archive, "trajectory virial", s->totals.virial, (size_t)s->dimension);
        hd_archive_double(archive, "trajectory potential", &s->totals.potential);
    }
    if (!hd_archive_good(archive)) return;
    const double since = s->now - (double)s->steps * s->step;
    const char *fault = since >= 0 && since < 2.0 * s->step
                            ? inconsistency(s)
                            : "the time does not fit the number of time steps";
    hd_neighbours_forget(&s->near);
    const hd_status look = fault ? HD_OK : hd_soft_look(s);
    if (look == HD_NO_MEMORY) hd_archive_fail(archive, look, "trajectory", NULL);
    if (look != HD_OK) fault = "the energy is not that of the positions and momenta";
    if (fault) hd_archive_refuse(archive, "trajectory", fault);
}

/** Returns NULL, or what is wrong with the entries, which are finite numbers. */
static const char *row_fault(const hd_record *record, const hd_scene_def *scene)
{
    const double step = hd_soft_time_step(scene);
    for (size_t k = 0; k < hd_record_count(record); k++) {
        const hd_kick *kick = hd_record_entry(record, k);
        const bool begins = kick->i == -1.0;
        if (k == 0 && !begins) return "the first entry begins no time step";
        if (begins && kick->at != step) return "a time step has a wrong length";
        if (!begins && !(kick->i >= 0 && kick->i < scene->number && kick->i == floor(kick->i)))
            return "an entry names a particle that does not exist";
        if (!begins && !(kick->j > kick->i && kick->j < scene->number && kick->j == floor(kick->j)))
            return "an entry names a partner that does not exist";
    }
    return NULL;
}

#define SOFT(name, in, of_one, bends)                                                              \
    {                                                                                              \
        .particles = (name), .dimension = (of_one), .coordinates = (of_one),                       \
        .entry = HD_KICK_BYTES(bends), .symplectic = true, .parameter = own,                       \
        .parameters = HD_SOFT_OWN, .check = row_check, .zeros = row_zeros, .entries = row_entries, \
        .rate = hd_soft_rate, .speed = hd_soft_speed, .step = hd_soft_time_step,                   \
        .energy_asked = hd_soft_energy_asked, .split = row_split, .crossing = row_crossing,        \
        .null = row_null, .create = hd_soft_create, .free = hd_soft_free,                          \
        .advance = hd_soft_advance, .time = row_time, .state = row_state, .totals = row_totals,    \
        .examine = row_examine, .archive = row_archive, .fingerprint = row_fingerprint,            \
        .bytes = row_bytes, .record_bytes = row_record_bytes_##in, .fault = row_fault,             \
        .maps_create = hd_kick_maps_create_##in, .maps_free = hd_kick_maps_free,                   \
        .maps_fill = hd_kick_maps_fill, .carry = hd_kick_maps_carry                                \
    }
const hd_dynamics hd_soft_disks = SOFT("soft_disks", plane, 2, HD_BENDS_PLANE);
const hd_dynamics hd_soft_spheres = SOFT("soft_spheres", space, 3, HD_BENDS_SPACE);
