/** Scene -> record: motion of soft particles, in time steps of drifts and kicks [T24]. Pairs are
 * taken in the order of their numbers, so the bits do not depend on when the list of neighbours was
 * made. One thread computes this, with + - * / sqrt and comparisons only, so that all machines give
 * the same bits. */
#include <math.h>
#include <string.h>
#include <zlib.h>

#include "base/check.h"
#include "base/memory.h"
#include "dynamics/soft/kick.h"
#include "dynamics/soft/kick_maps.h"
#include "dynamics/soft/soft.h"
#include "dynamics/trajectory.h"
#include "scene/container.h"
#include "scene/dynamics.h"
#include "scene/null_space.h"
#include "scene/scene.h"
#include "scene/scene_check.h"

/** The energy is measured after this many time steps. */
enum { LOOK_STEPS = 128 };

#define KERNEL static inline __attribute__((always_inline))

/* ---- pairs --------------------------------------------------------------------------------- */

/** r: the vector from i to the nearest image of j. Returns the square of its length. */
KERNEL double between(double *r, const soft *s, int32_t i, int32_t j, int dimension)
{
    const double *qi = s->q + dimension * i, *qj = s->q + dimension * j;
    double square = 0.0;
    for (int d = 0; d < dimension; d++) {
        r[d] = hd_nearest(qj[d] - qi[d], s->near.box[d]);
        square += r[d] * r[d];
    }
    return square;
}

/** Fills the upper half of b 1 + c r r^T. */
KERNEL void bend_fill(double *bend, const double *r, double b, double c, int dimension)
{
    for (int d = 0; d < dimension; d++)
        for (int e = d; e < dimension; e++) *bend++ = c * r[d] * r[e] + (d == e ? b : 0.0);
}

typedef struct kick {
    double time;     /**< the kick's part of the time step [time units] */
    hd_totals *sums; /**< NULL if sums are not taken */
    hd_record *record;
    hd_kick *entry;
} kick;

KERNEL void sum_pair(hd_totals *sums, const double *r, double energy, double push, int dimension)
{
    sums->potential += energy;
    for (int d = 0; d < dimension; d++) sums->virial[d] -= push * r[d] * r[d];
}

KERNEL hd_status kick_all(soft *s, const kick *k, int dimension)
{
    const hd_potential *potential = s->potential;
    const double cut = potential->cut * potential->cut;
    for (int32_t i = 0; i < s->count; i++)
        for (size_t n = s->near.first[i]; n < s->near.first[i + 1]; n++) {
            const int32_t j = s->near.partner[n];
            double r[HD_DIMENSION_MAX];
            const double square = between(r, s, i, j, dimension);
            if (!(square < cut)) continue;
            const hd_pull pull = potential->at(square);
            const double push = k->time * pull.b;
            for (int d = 0; d < dimension; d++) {
                s->p[dimension * i + d] += push * r[d];
                s->p[dimension * j + d] -= push * r[d];
            }
            if (k->sums) sum_pair(k->sums, r, k->time * pull.v, push, dimension);
            if (!k->record) continue;
            k->entry->i = i;
            k->entry->j = j;
            bend_fill(k->entry->bend, r, push, k->time * pull.c, dimension);
            HD_TRY(hd_record_put(k->record, k->entry));
        }
    return HD_OK;
}

static hd_status potential_energy(double *energy, soft *s)
{
    const double cut = s->potential->cut * s->potential->cut;
    double sum = 0.0, r[HD_DIMENSION_MAX];
    HD_TRY(hd_neighbours_follow(&s->near, s->q));
    for (int32_t i = 0; i < s->count; i++)
        for (size_t n = s->near.first[i]; n < s->near.first[i + 1]; n++) {
            const double square = between(r, s, i, s->near.partner[n], s->dimension);
            if (square < cut) sum += s->potential->at(square).v;
        }
    *energy = sum;
    return HD_OK;
}

static double kinetic_energy(const soft *s)
{
    double twice = 0.0;
    for (int k = 0; k < s->count * s->dimension; k++) twice += s->p[k] * s->p[k];
    return 0.5 * twice;
}

/** Measures s->error: the change of the energy over kinetic + |potential| energy. Fails with
 * HD_ENERGY_LOST if it is more than HD_ENERGY_LOST_FROM. */
static hd_status look(soft *s)
{
    double potential;
    const hd_status status = potential_energy(&potential, s);
    const double kinetic = kinetic_energy(s);
    if (status == HD_NOT_FINITE) return s->error = 1.0, HD_ENERGY_LOST; /* where it tends to */
    HD_TRY(status);
    s->error = (kinetic + potential - s->energy) / (kinetic + fabs(potential));
    return fabs(s->error) <= HD_ENERGY_LOST_FROM ? HD_OK : HD_ENERGY_LOST;
}

/* ---- steps --------------------------------------------------------------------------------- */

static void sum_flight(soft *s, double time)
{
    double square[HD_DIMENSION_MAX] = {0.0};
    const double *p = s->p;
    for (int i = 0; i < s->count; i++)
        for (int d = 0; d < s->dimension; d++, p++) square[d] += *p * *p;
    for (int d = 0; d < s->dimension; d++) s->totals.kinetic[d] += time * square[d];
}

static void drift(soft *s, double time)
{
    if (s->sums) sum_flight(s, time);
    for (int k = 0; k < s->count * s->dimension; k++) {
        const double edge = s->near.box[k % s->dimension];
        double q = s->q[k] + time * s->p[k];
        if (q < 0 || q >= edge) q -= edge * floor(q / edge);
        s->q[k] = q;
    }
}

static hd_status one_kick(soft *s, const kick *k)
{
    HD_TRY(hd_neighbours_follow(&s->near, s->q));
    return s->dimension == 2 ? kick_all(s, k, 2) : kick_all(s, k, 3);
}

/** Does a time step. end: when it ends, since the start of the record. */
static hd_status one_step(soft *s, hd_record *record, double end)
{
    union {
        double room[4 + HD_BENDS_SPACE];
        hd_kick kick;
    } entry = {.room = {end, -1.0, 0.0, s->step}};
    const hd_integrator *by = s->integrator;
    hd_totals *sums = s->sums ? &s->totals : NULL;
    if (record) HD_TRY(hd_record_put(record, &entry.kick));
    for (int k = 0; k < by->kicks; k++) {
        entry.kick.at = by->at[k] * s->step;
        drift(s, by->drift[k] * s->step);
        HD_TRY(one_kick(s, &(kick){by->kick[k] * s->step, sums, record, &entry.kick}));
    }
    drift(s, by->drift[by->kicks] * s->step);
    return HD_OK;
}

/** Time steps end at multiples of their length, whatever t_end is. */
static hd_status step_until(soft *s, hd_record *record, double begin, double t_end)
{
    for (double end; (end = (double)(s->steps + 1) * s->step) <= t_end; s->steps++) {
        HD_TRY(one_step(s, record, end - begin));
        if (s->steps % LOOK_STEPS == 0) HD_TRY(look(s));
    }
    return look(s);
}

/** Fails with HD_ENERGY_LOST, too. */
static hd_status row_advance(void *state, hd_record *record, double t_end)
{
    soft *s = state;
    const double begin = record ? s->now - hd_record_duration(record) : 0.0;
    const hd_status status = step_until(s, record, begin, t_end);
    s->now = t_end;
    if (record) hd_record_end(record, t_end - begin);
    return status == HD_NOT_FINITE ? HD_ENERGY_LOST : status;
}

/* ---- creation ------------------------------------------------------------------------------ */

static void row_free(void *state)
{
    soft *s = state;
    if (!s) return;
    hd_neighbours_clear(&s->near);
    hd_memory_free(s->q);
    hd_memory_free(s->p);
    hd_memory_free(s);
}

static hd_status allocate(soft **out, const hd_scene_def *scene)
{
    soft *s = *out = hd_memory_alloc(1, sizeof *s);
    const size_t all = (size_t)(scene->number * hd_scene_dimension(scene));
    if (!s) return HD_NO_MEMORY;
    *s = (soft){.potential = hd_soft_potential(scene),
                .integrator = hd_soft_integrator(scene),
                .count = scene->number,
                .dimension = hd_scene_dimension(scene),
                .sums = scene->observe & HD_OBSERVE_GAS};
    s->q = hd_memory_alloc(all, sizeof *s->q);
    s->p = hd_memory_alloc(all, sizeof *s->p);
    if (!s->q || !s->p) return HD_NO_MEMORY;
    return hd_neighbours_create(&s->near, scene, s->potential->cut);
}

/** Keeps the energy of the present state, which is conserved from now on. */
static hd_status begin(soft *s, const hd_scene_def *scene)
{
    HD_TRY(potential_energy(&s->energy, s));
    s->energy += kinetic_energy(s);
    s->step = hd_soft_time_step(scene);
    return isfinite(s->energy) ? HD_OK : HD_NOT_FINITE;
}

/** Starts on the lattice. Momenta get the scene's energy less that of the lattice. */
static hd_status start_on_lattice(soft *s, const hd_scene_def *scene)
{
    double potential;
    hd_container_of(scene)->start(scene, s->q);
    HD_TRY(potential_energy(&potential, s));
    hd_null_space_momenta(scene, s->q, s->p);
    const double kinetic = scene->own[HD_SOFT_ENERGY].real * s->count - potential;
    if (!(kinetic > 0)) return HD_REFUSED;
    const double scale = sqrt(kinetic / kinetic_energy(s));
    for (int k = 0; k < s->count * s->dimension; k++) s->p[k] *= scale;
    return begin(s, scene);
}

static hd_status start_from(soft *s, const hd_scene_def *scene, const double *q, const double *p)
{
    const size_t bytes = (size_t)(s->count * s->dimension) * sizeof *q;
    memcpy(s->q, q, bytes);
    memcpy(s->p, p, bytes);
    return begin(s, scene);
}

/** Creates particles at q with momenta p; if q is NULL, on the start lattice. */
static hd_status create(void **state, const hd_scene_def *scene, const double *q, const double *p)
{
    soft *s;
    hd_status status = allocate(&s, scene);
    if (status == HD_OK) status = q ? start_from(s, scene, q, p) : start_on_lattice(s, scene);
    *state = status == HD_OK ? s : NULL;
    if (status != HD_OK) row_free(s);
    return status;
}

static hd_status row_create(void **state, const hd_scene_def *scene)
{
    *state = NULL;
    HD_TRY(hd_scene_check_start(scene, NULL, 0));
    return create(state, scene, NULL, NULL);
}

hd_status hd_soft_create_from(void **state, const hd_scene_def *scene, const double *q,
                              const double *p)
{
    *state = NULL;
    HD_TRY(hd_scene_check_box(scene, NULL, 0));
    return create(state, scene, q, p);
}

/** Finds the potential energy of the start lattice. Fails with HD_NO_MEMORY. */
static hd_status lattice_energy(double *energy, const hd_scene_def *scene)
{
    soft *s;
    hd_status status = allocate(&s, scene);
    if (status == HD_OK) {
        hd_container_of(scene)->start(scene, s->q);
        status = potential_energy(energy, s);
    }
    row_free(s);
    return status;
}

/* ---- scene --------------------------------------------------------------------------------- */

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
    const hd_status found = lattice_energy(&lattice, scene);
    if (found != HD_OK) (void)hd_refuse(message, size, "%s", hd_status_text(found));
    HD_TRY(found);
    if (energy * scene->number > lattice) return HD_OK;
    return hd_refuse(message, size,
                     "energy = %.15g: must be above %.6g, the potential energy per particle of the "
                     "start lattice with potential = %s, density = %.15g, number = %d",
                     energy, lattice / scene->number, potential->name, scene->density,
                     scene->number);
}

static int row_zeros(const hd_scene_def *scene) { return 2 * hd_scene_dimension(scene) + 2; }

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

static void row_examine(const void *state, hd_invariants *out)
{
    const soft *s = state;
    *out = (hd_invariants){.kinetic_energy = kinetic_energy(s),
                           .energy_error = s->error,
                           .energy_rounding = HD_ENERGY_LOST_FROM};
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

static double row_record_bytes_plane(double entries)
{
    return hd_record_bytes_twice(entries, HD_KICK_BYTES(HD_BENDS_PLANE));
}

static double row_record_bytes_space(double entries)
{
    return hd_record_bytes_twice(entries, HD_KICK_BYTES(HD_BENDS_SPACE));
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
    const hd_status seen = fault ? HD_OK : look(s);
    if (seen == HD_NO_MEMORY) hd_archive_fail(archive, seen, "trajectory", NULL);
    if (seen != HD_OK) fault = "the energy is not that of the positions and momenta";
    if (fault) hd_archive_refuse(archive, "trajectory", fault);
}

/** Returns NULL, or what is wrong with the entries, which are finite numbers. */
static const char *row_fault(const hd_record *record, const hd_scene_def *scene)
{
    const double step = hd_soft_time_step(scene);
    for (size_t k = 0; k < hd_record_count(record); k++) {
        const hd_kick *entry = hd_record_entry(record, k);
        const bool begins = entry->i == -1.0;
        if (k == 0 && !begins) return "the first entry begins no time step";
        if (begins && entry->at != step) return "a time step has a wrong length";
        if (!begins && !(entry->i >= 0 && entry->i < scene->number && entry->i == floor(entry->i)))
            return "an entry names a particle that does not exist";
        if (!begins &&
            !(entry->j > entry->i && entry->j < scene->number && entry->j == floor(entry->j)))
            return "an entry names a partner that does not exist";
    }
    return NULL;
}

#define SOFT(name, in, of_one, bends)                                                              \
    {                                                                                              \
        .particles = (name), .dimension = (of_one), .coordinates = (of_one),                       \
        .entry = HD_KICK_BYTES(bends), .symplectic = true, .parameter = hd_soft_own,               \
        .parameters = HD_SOFT_OWN, .check = row_check, .zero_exponents = row_zeros,                \
        .record_rate = hd_soft_entries, .collision_rate = hd_soft_rate, .speed = hd_soft_speed,    \
        .step = hd_soft_time_step, .energy_asked = hd_soft_energy_asked,                           \
        .zero_splitting_order = hd_soft_split, .sound_crossing_time = hd_soft_crossing,            \
        .null_vectors = row_null, .create = row_create, .free = row_free, .advance = row_advance,  \
        .time = row_time, .state = row_state, .totals = row_totals, .examine = row_examine,        \
        .archive = row_archive, .fingerprint = row_fingerprint, .bytes = row_bytes,                \
        .record_bytes = row_record_bytes_##in, .fault = row_fault,                                 \
        .maps_create = hd_kick_maps_create_##in, .maps_free = hd_kick_maps_free,                   \
        .maps_fill = hd_kick_maps_fill, .carry = hd_kick_maps_carry                                \
    }
const hd_dynamics hd_soft_disks_row = SOFT("soft_disks", plane, 2, HD_BENDS_PLANE);
const hd_dynamics hd_soft_spheres_row = SOFT("soft_spheres", space, 3, HD_BENDS_SPACE);
