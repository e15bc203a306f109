/** Scene -> record: moves the particles of a scene by the row of their dynamics. */
#include <math.h>
#include <string.h>
#include <zlib.h>

#include "base/check.h"
#include "base/memory.h"
#include "dynamics/dynamics.h"
#include "dynamics/trajectory.h"

static size_t coordinates(const hd_trajectory *tr)
{
    return (size_t)tr->particles * (size_t)tr->of->coordinates;
}

/** Takes note of q and p, so that reading what follows from them takes no memory. */
static void note(hd_trajectory *tr)
{
    if (tr->now) tr->of->state(tr->state, tr->now, tr->now + coordinates(tr));
}

static bool is_stepped(const hd_dynamics *of) { return of->step && of->examine; }

/** Looks at what time steps have done to the energy. */
static void look(hd_trajectory *tr)
{
    if (!is_stepped(tr->of)) return;
    tr->energy.error = hd_trajectory_examined(tr).energy_error;
    const double size = fabs(tr->energy.error);
    /* NaN stays */
    if (!isnan(tr->energy.most) && !(size <= tr->energy.most)) tr->energy.most = size;
}

double hd_trajectory_noted(const hd_scene_def *def)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    return of->examine && of->fingerprint ? 0.0 : 2.0 * of->coordinates * def->number;
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
    tr->energy.error = tr->energy.most = is_stepped(of) ? 0.0 : NAN;
    tr->energy.asked = of->energy_asked ? of->energy_asked(def) : NAN;
    note(tr);
    *out = tr;
    return HD_OK;
}

hd_status hd_trajectory_create(hd_trajectory **out, const hd_scene_def *def)
{
    void *state;
    *out = NULL;
    HD_TRY(hd_dynamics_of(def)->create(&state, def));
    return hd_trajectory_create_with(out, def, state);
}

void hd_trajectory_free(hd_trajectory *tr)
{
    if (!tr) return;
    tr->of->free(tr->state);
    hd_memory_free(tr->now);
    hd_memory_free(tr);
}

hd_status hd_trajectory_extend(hd_trajectory *tr, hd_record *record, double t_end)
{
    const hd_status status = tr->of->advance(tr->state, record, t_end);
    note(tr);
    look(tr);
    return status;
}

hd_totals hd_trajectory_totals(const hd_trajectory *tr)
{
    hd_totals totals = {.collisions = 0};
    if (tr->of->totals) tr->of->totals(tr->state, &totals);
    totals.expected = tr->rate;
    return totals;
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
    if (is_stepped(tr->of)) hd_archive_double(archive, "trajectory energy error", &tr->energy.most);
    hd_archive_expect(archive, !(tr->energy.most < 0.0), "trajectory energy error",
                      "it is negative");
    if (archive->writing) return;
    note(tr);
    look(tr);
}

uint32_t hd_trajectory_fingerprint(const hd_trajectory *tr)
{
    const size_t bytes = 2 * coordinates(tr) * sizeof *tr->now;
    return tr->of->fingerprint ? tr->of->fingerprint(tr->state)
                               : (uint32_t)crc32_z(0, (const Bytef *)tr->now, bytes);
}
