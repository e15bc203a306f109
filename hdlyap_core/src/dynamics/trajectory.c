/** Scene -> record: moves the particles of a scene by the row of their dynamics. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <zlib.h>

#include "base/arrays.h"
#include "base/check.h"
#include "base/memory.h"
#include "dynamics/dynamics.h"
#include "dynamics/trajectory.h"
#include "scene/scene.h"

static size_t coordinates(const hd_trajectory *tr)
{
    return (size_t)tr->particles * (size_t)tr->of->coordinates;
}

/** Takes note of q and p, so that reading what follows from them takes no memory. Fails with
 * HD_NOT_FINITE. */
static hd_status note(hd_trajectory *tr)
{
    if (!tr->now) return HD_OK;
    tr->of->state(tr->state, tr->now, tr->now + coordinates(tr));
    return hd_all_finite(tr->now, 2 * coordinates(tr)) ? HD_OK : HD_NOT_FINITE;
}

/** Whether the energy is looked at: what happens in time steps can lose it, and so can what a row
 * asks about; collisions lose no more than rounding. */
static bool is_watched(const hd_dynamics *of)
{
    return of->examine && (of->step || of->energy_asked || !of->collides);
}

/** Looks at what has become of the energy. Fails with HD_ENERGY_LOST, or HD_NOT_FINITE. */
static hd_status look(hd_trajectory *tr)
{
    if (!is_watched(tr->of)) return HD_OK;
    tr->energy.error = hd_trajectory_examined(tr).energy_error;
    const double size = fabs(tr->energy.error);
    /* NaN stays */
    if (!isnan(tr->energy.most) && !(size <= tr->energy.most)) tr->energy.most = size;
    if (isnan(size)) return HD_NOT_FINITE;
    return size <= HD_ENERGY_LOST_FROM ? HD_OK : HD_ENERGY_LOST;
}

double hd_trajectory_noted(const hd_scene_def *def)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    const bool measured = def->observe & HD_OBSERVE_AVERAGES;
    return of->examine && of->fingerprint && !measured ? 0.0 : 2.0 * of->coordinates * def->number;
}

hd_status hd_trajectory_create_with(hd_trajectory **out, const hd_scene_def *def, void *state)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    const size_t noted = (size_t)hd_trajectory_noted(def);
    hd_trajectory *tr = hd_memory_alloc(1, sizeof *tr);
    double *now = noted > 0 ? hd_memory_alloc(noted, sizeof *now) : NULL;
    *out = NULL;
    if (!tr || (noted > 0 && !now)) {
        of->free(state);
        hd_memory_free(now);
        hd_memory_free(tr);
        return HD_NO_MEMORY;
    }
    *tr = (hd_trajectory){.of = of, .state = state, .particles = def->number, .now = now};
    tr->rate = of->collision_rate(def);
    tr->diverges = hd_scene_diverges(def);
    tr->energy.error = tr->energy.most = is_watched(of) ? 0.0 : NAN;
    tr->energy.asked = of->energy_asked ? of->energy_asked(def) : NAN;
    const hd_status status = note(tr);
    if (status == HD_OK)
        *out = tr;
    else
        hd_trajectory_free(tr);
    return status;
}

hd_status hd_trajectory_create(hd_trajectory **out, const hd_scene_def *def)
{
    void *state;
    *out = NULL;
    HD_TRY(hd_dynamics_check(hd_dynamics_of(def), NULL, 0));
    HD_TRY(hd_dynamics_of(def)->create(&state, def));
    return hd_trajectory_create_with(out, def, state);
}

hd_status hd_trajectory_create_empty(hd_trajectory **out, const hd_scene_def *def)
{
    void *state;
    if (!hd_dynamics_of(def)->create_empty) return hd_trajectory_create(out, def);
    *out = NULL;
    HD_TRY(hd_dynamics_of(def)->create_empty(&state, def));
    return hd_trajectory_create_with(out, def, state);
}

hd_status hd_trajectory_check_null(const hd_trajectory *tr, const hd_scene_def *def, char *message,
                                   size_t size)
{
    const size_t half = coordinates(tr), zeros = (size_t)hd_scene_zero_exponents(def);
    if (!def->dynamics || !tr->of->null_vectors || hd_scene_vectors(def) == 0) return HD_OK;
    double *q = hd_memory_alloc(2 * half * (1 + zeros + HD_NULL_SPARE), sizeof *q);
    if (!q) return HD_NO_MEMORY;
    hd_trajectory_state(tr, q, q + half);
    const int known = tr->of->null_vectors(def, q, q + half, q + 2 * half);
    hd_memory_free(q);
    if (known == -1) return HD_NO_MEMORY;
    if (known >= 0 && known <= (int)zeros) return HD_OK;
    return hd_refuse(message, size, "null_vectors = %d: must be from 0 to zero_exponents = %zu",
                     known, zeros);
}

void hd_trajectory_free(hd_trajectory *tr)
{
    if (!tr) return;
    tr->of->free(tr->state);
    hd_memory_free(tr->now);
    hd_memory_free(tr);
}

/** Keeps the line that says what the row did wrong. */
static hd_status fault(hd_trajectory *tr, const char *line, double is, double must_be)
{
    snprintf(tr->fault, sizeof tr->fault, "%s: it is %.12g, and must be %.12g", line, is, must_be);
    return HD_DYNAMICS_FAULT;
}

/** Refuses an advance after which times are not those that it was asked for. Times are sums and
 * differences of the present one, and round as these do. */
static hd_status check_times(hd_trajectory *tr, const hd_record *record, double ends, double t_end)
{
    const double now = tr->of->time(tr->state), close = 16.0 * DBL_EPSILON * fabs(t_end);
    if (record && record->fault) {
        snprintf(tr->fault, sizeof tr->fault, "%s: at %.12g", record->fault, record->at);
        return HD_DYNAMICS_FAULT;
    }
    if (!(fabs(now - t_end) <= close))
        return fault(tr, "time: not what advance was asked for", now, t_end);
    if (record && !(fabs(record->duration - ends) <= close))
        return fault(tr, "hd_record_end: another duration than advance was asked for",
                     record->duration, ends);
    return HD_OK;
}

hd_status hd_trajectory_extend(hd_trajectory *tr, hd_record *record, double t_end)
{
    const double now = hd_trajectory_time(tr),
                 ends = record ? record->duration + (t_end - now) : 0.0;
    const hd_status status = tr->of->advance(tr->state, record, t_end);
    const hd_status finite = note(tr), kept = look(tr);
    HD_TRY(status == HD_DYNAMICS_FAULT ? HD_OK : status);
    HD_TRY(check_times(tr, record, ends, t_end));
    HD_TRY(finite);
    HD_TRY(kept);
    return status;
}

hd_status hd_trajectory_measure(hd_trajectory *tr, double *value, const hd_scene_def *scene)
{
    for (int k = 0; k < tr->of->averages; k++) value[k] = NAN;
    tr->of->measure(scene, tr->now, tr->now + coordinates(tr), value);
    for (int k = 0; k < tr->of->averages; k++) {
        if (fabs(value[k]) <= HD_AVERAGE_MOST) continue;
        snprintf(tr->fault, sizeof tr->fault,
                 "measure: %s is %g at %.12g: must be from -1e100 to 1e100",
                 tr->of->average[k].name, value[k], hd_trajectory_time(tr));
        return HD_DYNAMICS_FAULT;
    }
    return HD_OK;
}

const char *hd_trajectory_fault(const hd_trajectory *tr) { return tr->fault; }

hd_totals hd_trajectory_totals(const hd_trajectory *tr)
{
    hd_totals totals = {.collisions = 0};
    if (tr->of->totals) tr->of->totals(tr->state, &totals);
    totals.expected = tr->rate;
    return totals;
}

double hd_trajectory_divergence(const hd_trajectory *tr)
{
    return tr->diverges ? tr->of->divergence(tr->state) : NAN;
}

double hd_trajectory_time(const hd_trajectory *tr) { return tr->of->time(tr->state); }
int hd_trajectory_particles(const hd_trajectory *tr) { return tr->particles; }

void hd_trajectory_state(const hd_trajectory *tr, double *q, double *p)
{
    tr->of->state(tr->state, q, p);
}

/** Keeps the first `dimension` coordinates of each particle. */
static void keep_places(const hd_trajectory *tr, double *x)
{
    const size_t coordinates = (size_t)tr->of->coordinates, dimension = (size_t)tr->of->dimension;
    for (size_t i = 0; x && i < (size_t)tr->particles; i++)
        memmove(x + dimension * i, x + coordinates * i, dimension * sizeof *x);
}

void hd_trajectory_places(const hd_trajectory *tr, double *q, double *p)
{
    tr->of->state(tr->state, q, p);
    if (tr->of->coordinates == tr->of->dimension) return;
    keep_places(tr, q);
    keep_places(tr, p);
}

hd_invariants hd_trajectory_examined(const hd_trajectory *tr)
{
    hd_invariants examined = {.kinetic_energy = 0.0};
    if (tr->of->examine) {
        tr->of->examine(tr->state, &examined);
        return examined;
    }
    const double *p = tr->now + coordinates(tr);
    for (size_t k = 0; k < coordinates(tr); k++) examined.kinetic_energy += 0.5 * p[k] * p[k];
    return examined;
}

hd_energy hd_trajectory_energy(const hd_trajectory *tr) { return tr->energy; }

void hd_trajectory_archive(hd_trajectory *tr, hd_archive *archive)
{
    tr->of->archive(tr->state, archive);
    if (is_watched(tr->of)) hd_archive_double(archive, "trajectory energy error", &tr->energy.most);
    hd_archive_expect(archive, !(tr->energy.most < 0.0), "trajectory energy error",
                      "it is negative");
    if (archive->writing || !hd_archive_good(archive)) return;
    hd_archive_expect(archive, note(tr) == HD_OK && look(tr) == HD_OK, "trajectory",
                      "its energy, or a number of its state, cannot be right");
}

uint32_t hd_trajectory_fingerprint(const hd_trajectory *tr)
{
    const size_t bytes = 2 * coordinates(tr) * sizeof *tr->now;
    return tr->of->fingerprint ? tr->of->fingerprint(tr->state)
                               : (uint32_t)crc32_z(0, (const Bytef *)tr->now, bytes);
}
