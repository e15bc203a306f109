/** Scene -> record: moves the particles of a scene by the row of their dynamics. */
#include <math.h>
#include <string.h>
#include <zlib.h>

#include "base/check.h"
#include "base/memory.h"
#include "dynamics/archived.h"
#include "dynamics/trajectory_state.h"

static size_t coordinates(const hd_trajectory *tr)
{
    return (size_t)tr->particles * (size_t)tr->of->coordinates;
}

/** Takes note of q and p, so that reading what follows from them takes no memory. */
static void note(hd_trajectory *tr)
{
    if (tr->now) tr->of->state(tr->state, tr->now, tr->now + coordinates(tr));
}

static bool is_stepped(const hd_dynamics *of) { return of->step && of->energy_error; }

/** Looks at what time steps have done to the energy. */
static void look(hd_trajectory *tr)
{
    if (!is_stepped(tr->of)) return;
    tr->energy.error = tr->of->energy_error(tr->state);
    tr->energy.most = fmax(tr->energy.most, fabs(tr->energy.error));
}

double hd_trajectory_noted(const hd_scene_def *def)
{
    const hd_dynamics *of = hd_dynamics_of(def);
    return of->kinetic_energy && of->fingerprint ? 0.0 : 2.0 * of->coordinates * def->number;
}

static hd_status create(hd_trajectory *tr, const hd_scene_def *def, const double *q,
                        const double *p)
{
    const size_t noted = (size_t)hd_trajectory_noted(def);
    if (noted > 0 && !(tr->now = hd_memory_alloc(noted, sizeof *tr->now))) return HD_NO_MEMORY;
    HD_TRY(q ? tr->of->create_from(&tr->state, def, q, p) : tr->of->create(&tr->state, def));
    note(tr);
    return HD_OK;
}

hd_status hd_trajectory_create_from(hd_trajectory **out, const hd_scene_def *def, const double *q,
                                    const double *p)
{
    hd_trajectory *tr = hd_memory_alloc(1, sizeof *tr);
    *out = NULL;
    if (!tr) return HD_NO_MEMORY;
    *tr = (hd_trajectory){.of = hd_dynamics_of(def), .particles = def->number};
    tr->rate = tr->of->rate(def);
    tr->energy.error = tr->energy.most = is_stepped(tr->of) ? 0.0 : NAN;
    tr->energy.asked = tr->of->energy_asked ? tr->of->energy_asked(def) : NAN;
    const hd_status status = create(tr, def, q, p);
    if (status == HD_OK) {
        *out = tr;
        return HD_OK;
    }
    hd_memory_free(tr->now);
    hd_memory_free(tr);
    return status;
}

hd_status hd_trajectory_create(hd_trajectory **out, const hd_scene_def *def)
{
    return hd_trajectory_create_from(out, def, NULL, NULL);
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

hd_told hd_trajectory_told(const hd_trajectory *tr)
{
    hd_told told = {.collisions = 0};
    if (tr->of->tell) tr->of->tell(tr->state, &told);
    told.expected = tr->rate;
    return told;
}

hd_summed hd_trajectory_summed(const hd_trajectory *tr)
{
    hd_summed summed = {.time = 0.0};
    if (tr->of->sum) tr->of->sum(tr->state, &summed);
    return summed;
}

double hd_trajectory_time(const hd_trajectory *tr) { return tr->of->time(tr->state); }
int hd_trajectory_particles(const hd_trajectory *tr) { return tr->particles; }
uint64_t hd_trajectory_collisions(const hd_trajectory *tr)
{
    return hd_trajectory_told(tr).collisions;
}
uint64_t hd_trajectory_wall_events(const hd_trajectory *tr)
{
    return hd_trajectory_told(tr).wall_events;
}
double hd_trajectory_collision_rate(const hd_trajectory *tr) { return tr->rate; }

void hd_trajectory_virial(const hd_trajectory *tr, double *virial)
{
    const hd_told all = hd_trajectory_told(tr);
    for (int d = 0; d < tr->of->dimension; d++) virial[d] = all.virial[d];
}

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

double hd_trajectory_kinetic_energy(const hd_trajectory *tr)
{
    if (tr->of->kinetic_energy) return tr->of->kinetic_energy(tr->state);
    const double *p = tr->now + coordinates(tr);
    double sum = 0.0;
    for (size_t k = 0; k < coordinates(tr); k++) sum += 0.5 * p[k] * p[k];
    return sum;
}

hd_examined hd_trajectory_examined(const hd_trajectory *tr)
{
    hd_examined examined = {.overlap = 0.0};
    if (!tr->of->examine) return examined;
    tr->of->examine(tr->state, &examined);
    examined.energy_error = tr->of->energy_error
                                ? tr->of->energy_error(tr->state)
                                : hd_trajectory_kinetic_energy(tr) / tr->particles - 1.0;
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
