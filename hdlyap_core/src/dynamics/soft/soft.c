/** Scene -> record: motion of soft particles, in time steps of drifts and kicks [T24]. Pairs are
 * taken in the order of their numbers, so the bits do not depend on when the list of neighbours was
 * made. One thread computes this, with + - * / sqrt and comparisons only, so that all machines give
 * the same bits. */
#include <math.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"
#include "dynamics/soft/kick.h"
#include "dynamics/soft/soft_state.h"
#include "scene/container.h"
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

double hd_soft_kinetic_energy(const void *state)
{
    const soft *s = state;
    double twice = 0.0;
    for (int k = 0; k < s->count * s->dimension; k++) twice += s->p[k] * s->p[k];
    return 0.5 * twice;
}

hd_status hd_soft_look(soft *s)
{
    double potential;
    const hd_status status = potential_energy(&potential, s);
    const double kinetic = hd_soft_kinetic_energy(s);
    if (status == HD_NOT_FINITE) return s->error = 1.0, HD_ENERGY_LOST; /* where it tends to */
    s->error = (kinetic + potential - s->energy) / (kinetic + fabs(potential));
    return status == HD_OK && !(fabs(s->error) <= HD_SOFT_LOST) ? HD_ENERGY_LOST : status;
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
        if (s->steps % LOOK_STEPS == 0) HD_TRY(hd_soft_look(s));
    }
    return hd_soft_look(s);
}

hd_status hd_soft_advance(void *state, hd_record *record, double t_end)
{
    soft *s = state;
    const double begin = record ? s->now - hd_record_duration(record) : 0.0;
    const hd_status status = step_until(s, record, begin, t_end);
    s->now = t_end;
    if (record) hd_record_end(record, t_end - begin);
    return status == HD_NOT_FINITE ? HD_ENERGY_LOST : status;
}

/* ---- creation ------------------------------------------------------------------------------ */

void hd_soft_free(void *state)
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
    s->energy += hd_soft_kinetic_energy(s);
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
    const double scale = sqrt(kinetic / hd_soft_kinetic_energy(s));
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
    if (status != HD_OK) hd_soft_free(s);
    return status;
}

hd_status hd_soft_create(void **state, const hd_scene_def *scene)
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

hd_status hd_soft_lattice_energy(double *energy, const hd_scene_def *scene)
{
    soft *s;
    hd_status status = allocate(&s, scene);
    if (status == HD_OK) {
        hd_container_of(scene)->start(scene, s->q);
        status = potential_energy(energy, s);
    }
    hd_soft_free(s);
    return status;
}
