/** Counts of the trajectory -> collision rate and pressure [T19], in samples and blocks [T8]. */
#include "observe/gas.h"

#include <math.h>

#include "averages/blocks.h"
#include "base/check.h"
#include "base/memory.h"
#include "observe/observable.h"
#include "scene/container.h"
#include "scene/null_space.h"
#include "scene/scene.h"
#include "dynamics/trajectory.h"

/** Series that are averaged: per time unit; of the virial one for each direction. */
enum { COLLISIONS, VIRIAL_X, SERIES_MAX = VIRIAL_X + HD_DIMENSION_MAX };

/** What a trajectory has counted. */
typedef struct counts {
    double time, virial[HD_DIMENSION_MAX];
    uint64_t collisions;
} counts;

struct hd_gas {
    int dimension, coordinates, series;
    double disks, area;
    double kinetic[HD_DIMENSION_MAX]; /**< twice the mean kinetic energy along each direction */
    counts last;                      /**< where the last sample ended */
    double time, sum[SERIES_MAX];     /**< since the beginning */
    hd_blocks blocks;
};

static counts counts_of(const hd_trajectory *trajectory)
{
    counts now = {.time = hd_trajectory_time(trajectory),
                  .collisions = hd_trajectory_collisions(trajectory)};
    hd_trajectory_virial(trajectory, now.virial);
    return now;
}

/** Momenta along a direction, but for what is conserved. */
static double momenta(const hd_scene_def *def, int d)
{
    return def->number - hd_null_conserved(def, d);
}

double hd_gas_temperature(const hd_scene_def *def)
{
    const int dimension = hd_scene_dimension(def);
    const int others = hd_scene_coordinates(def) - dimension; /* of which nothing is conserved */
    double all = (double)others * def->number;
    for (int d = 0; d < dimension; d++) all += momenta(def, d);
    return 2.0 * def->number / all;
}

double hd_gas_area(const hd_scene_def *def) { return hd_container_of(def)->area(def); }

hd_status hd_gas_create(hd_gas **out, const hd_scene_def *def, double block)
{
    hd_gas *gas = hd_memory_alloc(1, sizeof *gas);
    *out = NULL;
    if (!gas) return HD_NO_MEMORY;
    gas->dimension = hd_scene_dimension(def);
    gas->coordinates = hd_scene_coordinates(def);
    gas->series = VIRIAL_X + gas->dimension;
    gas->disks = def->number;
    gas->area = hd_gas_area(def);
    for (int d = 0; d < gas->dimension; d++)
        gas->kinetic[d] = momenta(def, d) * hd_gas_temperature(def);
    const hd_status status = hd_blocks_create(&gas->blocks, gas->series, block);
    if (status == HD_OK)
        *out = gas;
    else
        hd_memory_free(gas);
    return status;
}

void hd_gas_free(hd_gas *gas)
{
    if (!gas) return;
    hd_blocks_clear(&gas->blocks);
    hd_memory_free(gas);
}

void hd_gas_begin(hd_gas *gas, const hd_trajectory *trajectory)
{
    gas->last = counts_of(trajectory);
    gas->time = 0.0;
    for (int s = 0; s < gas->series; s++) gas->sum[s] = 0.0;
    hd_blocks_restart(&gas->blocks);
}

void hd_gas_add(hd_gas *gas, const hd_trajectory *trajectory)
{
    const counts now = counts_of(trajectory), last = gas->last;
    const double dt = now.time - last.time;
    double sample[SERIES_MAX] = {[COLLISIONS] = (double)(now.collisions - last.collisions)};
    for (int d = 0; d < gas->dimension; d++) sample[VIRIAL_X + d] = now.virial[d] - last.virial[d];
    if (!(dt > 0)) return;
    for (int s = 0; s < gas->series; s++) gas->sum[s] += sample[s];
    gas->time += dt;
    gas->last = now;
    hd_blocks_add(&gas->blocks, sample, dt);
}

/** Standard error of factor times the sum of series first .. last, per time. */
static double error_of(const hd_gas *gas, int first, int last, double factor)
{
    hd_part parts[SERIES_MAX];
    for (int s = first; s <= last; s++) parts[s - first] = (hd_part){s, factor};
    return hd_blocks_error(&gas->blocks, parts, last - first + 1);
}

hd_gas_means hd_gas_read(const hd_gas *gas)
{
    const double t = gas->time > 0 ? gas->time : NAN, each = 2.0 / gas->disks, a = gas->area;
    hd_gas_means m = {
        .time = gas->time,
        .collision_rate = each * gas->sum[COLLISIONS] / t,
        .collision_rate_error = error_of(gas, COLLISIONS, COLLISIONS, each),
        .pressure_error = error_of(gas, VIRIAL_X, gas->series - 1, 1.0 / gas->dimension / a)};
    for (int d = 0; d < gas->dimension; d++) {
        m.pressure_of[d] = (gas->kinetic[d] + gas->sum[VIRIAL_X + d] / t) / a;
        m.pressure_of_error[d] = error_of(gas, VIRIAL_X + d, VIRIAL_X + d, 1.0 / a);
    }
    for (int d = 0; d < gas->dimension; d++) m.pressure += m.pressure_of[d];
    m.pressure /= gas->dimension;
    m.compressibility = m.pressure * a / gas->disks * (gas->coordinates / 2.0);
    return m;
}

/* ---- as an observable ---------------------------------------------------------------------- */

static double gas_bytes(const hd_scene_def *scene, int ranks)
{
    (void)ranks;
    return sizeof(hd_gas) + hd_blocks_bytes(VIRIAL_X + hd_scene_dimension(scene));
}

static void *gas_create(const hd_observing *with, hd_status *status)
{
    hd_gas *made;
    *status = hd_gas_create(&made, with->scene, with->block);
    return made;
}

static void gas_free(void *self) { hd_gas_free(self); }
static void gas_clear(void *self, const hd_view *here) { hd_gas_begin(self, here->trajectory); }

static void gas_add(void *self, const hd_observing *with, const hd_view *state)
{
    (void)with;
    hd_gas_add(self, state->trajectory);
}

static void gas_archive(void *self, hd_archive *archive, const hd_trajectory *now)
{
    hd_gas *gas = self;
    hd_archive_double(archive, "gas last time", &gas->last.time);
    hd_archive_doubles(archive, "gas last virial", gas->last.virial, (size_t)gas->dimension);
    hd_archive_bits(archive, "gas last collisions", &gas->last.collisions);
    hd_archive_double(archive, "gas time", &gas->time);
    hd_archive_doubles(archive, "gas sum", gas->sum, (size_t)gas->series);
    hd_archive_expect(archive, gas->last.time >= 0 && gas->last.time <= hd_trajectory_time(now),
                      "gas last time", "it does not fit the time");
    hd_archive_expect(archive, gas->last.collisions <= hd_trajectory_collisions(now),
                      "gas last collisions", "there were not so many");
    hd_archive_expect(archive, gas->time >= 0, "gas time", "it is negative");
    hd_blocks_archive(&gas->blocks, archive);
}

static hd_stated read_collision_rate(const hd_parts *parts, const hd_aim *goal)
{
    (void)goal;
    const hd_gas_means means = hd_gas_read(parts->gas);
    return (hd_stated){means.collision_rate, means.collision_rate_error, 0.0};
}

static hd_stated read_pressure(const hd_parts *parts, const hd_aim *goal)
{
    (void)goal;
    const hd_gas_means means = hd_gas_read(parts->gas);
    return (hd_stated){means.pressure, means.pressure_error, 0.0};
}

static const hd_quantity each[] = {{.name = "collision_rate", .read = read_collision_rate},
                                   {.name = "pressure", .read = read_pressure},
                                   {.name = NULL}};
static const hd_quantities quantities = {"gas", each};

static hd_status gas_check(const hd_scene_def *scene, char *message, size_t size)
{
    const hd_dynamics *of = hd_dynamics_of(scene);
    if (of->tell) return HD_OK;
    return hd_refuse(message, size,
                     "observables = gas: must not be given with particles = %s, which tell of no "
                     "collisions",
                     of->particles);
}

const hd_observable hd_gas_row = {.needs = HD_NEEDS_BOX,
                                  .check = gas_check,
                                  .quantities = &quantities,
                                  .bytes = gas_bytes,
                                  .create = gas_create,
                                  .free = gas_free,
                                  .clear = gas_clear,
                                  .add = gas_add,
                                  .archive = gas_archive};
