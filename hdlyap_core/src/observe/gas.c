/** Numbers of collisions, or integrals of energies, of the trajectory -> collision rate, or
 * temperature and potential energy; from the virial the pressure [T19]; and the flow between walls
 * that drag [T27]. Standard errors come from blocks of samples [T8]. */
#include "observe/gas.h"

#include <math.h>
#include <stdio.h>

#include "averages/blocks.h"
#include "base/check.h"
#include "base/memory.h"
#include "observe/observable.h"
#include "scene/container.h"
#include "scene/ends.h"
#include "scene/kinds.h"
#include "scene/mixture.h"
#include "scene/null_space.h"
#include "scene/scene.h"
#include "dynamics/trajectory.h"

/** The series of numbers that are averaged, each per time unit: collisions, or the potential energy
 * of particles that do not collide; then the virial along each direction; then, where it is not
 * known beforehand, twice the kinetic energy along each direction; then the collisions of each pair
 * of kinds, if there are two; then the flow, if walls drag; at last the divergence, if it is told.
 */
enum {
    COLLISIONS,
    POTENTIAL = COLLISIONS, /**< in the same place, for particles that do not collide */
    VIRIAL_X,
    FLOW = 5, /**< its series: the stress, then of both ends the particles near, their momentum */
    SERIES_MAX = VIRIAL_X + 2 * HD_DIMENSION_MAX + HD_KIND_PAIRS + FLOW + 1
};

/** Whether totals are integrals; else they are numbers of collisions, if there are any. */
static bool integrates(const hd_dynamics *of) { return of->totals && !of->collides; }

/** The direction along walls that drag; -1: none do. */
static int dragged(const hd_scene_def *def)
{
    for (int d = 0; d < hd_scene_dimension(def); d++)
        if (hd_ends_drag(def, d)) return d;
    return -1;
}

struct hd_gas {
    int dimension, series;
    bool is_summed, is_mixed, flows, diverges; /**< which series there are */
    int first_pair, first_flow;                /**< series behind those of all particles */
    double along;                              /**< length of the walls that drag [sigma] */
    /** number of particles; area or volume that centres can reach [sigma^d] */
    double particles, area;
    double momenta;                   /**< number of free momenta along all directions */
    double kinetic[HD_DIMENSION_MAX]; /**< twice the mean kinetic energy along each direction, of
                                         particles that collide */
    /** By kinetic theory; NaN where it says nothing. */
    double expected[HD_KIND_PAIRS], compressibility;
    hd_totals last; /**< of when the last sample ended */
    double last_diverged;
    double time, sum[SERIES_MAX]; /**< averaged time, and each series summed over it */
    hd_blocks blocks;
};

/** Number of free momenta along a direction: one of each particle, less the conserved sums. */
static double momenta(const hd_scene_def *def, int d)
{
    return def->number - hd_null_conserved(def, d);
}

double hd_gas_temperature(const hd_scene_def *def)
{
    const int dimension = hd_scene_dimension(def);
    const int others = hd_scene_coordinates(def) - dimension; /* their momenta are not conserved */
    double all = (double)others * def->number;
    for (int d = 0; d < dimension; d++) all += momenta(def, d);
    return 2.0 * def->number / all;
}

double hd_gas_area(const hd_scene_def *def) { return hd_container_of(def)->area(def); }

static bool is_mixed(const hd_scene_def *def)
{
    hd_kind kind[HD_KINDS_MAX];
    return hd_scene_kinds(def, kind) > 1;
}

/** Number of the series that all particles have, and of all. */
static int usual_series(const hd_scene_def *def)
{
    const bool both = integrates(hd_dynamics_of(def)) || dragged(def) >= 0;
    return VIRIAL_X + hd_scene_dimension(def) * (both ? 2 : 1);
}

static int series_of(const hd_scene_def *def)
{
    return usual_series(def) + (is_mixed(def) ? HD_KIND_PAIRS : 0) +
           (dragged(def) >= 0 ? FLOW : 0) + hd_scene_diverges(def);
}

static double edge_along(const hd_scene_def *def)
{
    double box[HD_DIMENSION_MAX];
    hd_scene_box(def, box);
    return box[dragged(def)];
}

/** Writes what kinetic theory says of disks and spheres. */
static void expect(hd_gas *gas, const hd_scene_def *def)
{
    const hd_kinds kinds = hd_kinds_of(def);
    const bool known = hd_dynamics_of(def)->fluid;
    gas->compressibility = known ? hd_mixture_compressibility(def) : NAN;
    for (int pair = 0; pair < HD_KIND_PAIRS; pair++) {
        const int a = pair / 2, b = (pair + 1) / 2; /* 11, 12, 22 */
        const double each = (a == b ? 1.0 : 2.0) * kinds.kind[a].number / def->number;
        gas->expected[pair] = known && gas->is_mixed ? each * hd_mixture_rate(def, a, b) : NAN;
    }
}

hd_status hd_gas_create(hd_gas **out, const hd_scene_def *def, double block)
{
    hd_gas *gas = hd_memory_alloc(1, sizeof *gas);
    *out = NULL;
    if (!gas) return HD_NO_MEMORY;
    gas->dimension = hd_scene_dimension(def);
    gas->is_summed = integrates(hd_dynamics_of(def));
    gas->is_mixed = is_mixed(def);
    expect(gas, def);
    gas->flows = dragged(def) >= 0;
    gas->diverges = hd_scene_diverges(def);
    gas->first_pair = usual_series(def);
    gas->first_flow = gas->first_pair + (gas->is_mixed ? HD_KIND_PAIRS : 0);
    gas->series = series_of(def);
    gas->along = gas->flows ? edge_along(def) : 0.0;
    gas->particles = def->number;
    gas->area = hd_gas_area(def);
    for (int d = 0; d < gas->dimension; d++) gas->momenta += momenta(def, d);
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

/** The series behind the virial. */
static int kinetic_x(const hd_gas *gas) { return VIRIAL_X + gas->dimension; }
static bool has_kinetic(const hd_gas *gas) { return gas->is_summed || gas->flows; }
static int near(const hd_gas *gas, int side) { return gas->first_flow + 1 + 2 * side; }

void hd_gas_begin(hd_gas *gas, const hd_trajectory *trajectory)
{
    gas->last = hd_trajectory_totals(trajectory);
    gas->last_diverged = hd_trajectory_divergence(trajectory);
    gas->time = 0.0;
    for (int s = 0; s < gas->series; s++) gas->sum[s] = 0.0;
    hd_blocks_restart(&gas->blocks);
}

/** Half of what the high wall has given less half of what the low one has: once each, the momentum
 * that flows from one to the other. */
static void sample_flow(double *sample, const hd_totals *a, const hd_totals *b)
{
    double given[2];
    for (int side = 0; side < 2; side++) {
        given[side] = b->walls.impulse[side] - a->walls.impulse[side];
        sample[1 + 2 * side] = b->walls.near[side] - a->walls.near[side];
        sample[2 + 2 * side] = b->walls.momentum[side] - a->walls.momentum[side];
    }
    sample[0] = 0.5 * (given[1] - given[0]);
}

void hd_gas_add(hd_gas *gas, const hd_trajectory *trajectory)
{
    const hd_totals now = hd_trajectory_totals(trajectory), *a = &gas->last, *b = &now;
    const double dt = b->time - a->time;
    double sample[SERIES_MAX] = {[COLLISIONS] = (double)(b->collisions - a->collisions)};
    if (gas->is_summed) sample[POTENTIAL] = b->potential - a->potential;
    for (int d = 0; d < gas->dimension; d++) {
        sample[VIRIAL_X + d] = b->virial[d] - a->virial[d];
        if (has_kinetic(gas)) sample[kinetic_x(gas) + d] = b->kinetic[d] - a->kinetic[d];
    }
    for (int pair = 0; pair < HD_KIND_PAIRS && gas->is_mixed; pair++)
        sample[gas->first_pair + pair] = (double)(b->collisions_of[pair] - a->collisions_of[pair]);
    if (!(dt > 0)) return;
    const double diverged = hd_trajectory_divergence(trajectory);
    if (gas->flows) sample_flow(sample + gas->first_flow, a, b);
    if (gas->diverges) sample[gas->series - 1] = diverged - gas->last_diverged;
    gas->last_diverged = diverged;
    for (int s = 0; s < gas->series; s++) gas->sum[s] += sample[s];
    gas->time += dt;
    gas->last = now;
    hd_blocks_add(&gas->blocks, sample, dt);
}

/** The series first .. last, each times a factor. */
typedef struct span {
    int first, last;
    double factor;
} span;

/** Standard error of the sum of both spans' series, per time. */
static double error_of(const hd_gas *gas, span a, span b)
{
    hd_part parts[SERIES_MAX];
    int count = 0;
    for (int s = a.first; s <= a.last; s++) parts[count++] = (hd_part){s, a.factor};
    for (int s = b.first; s <= b.last; s++) parts[count++] = (hd_part){s, b.factor};
    return hd_blocks_error(&gas->blocks, parts, count);
}

static const span NO_SPAN = {0, -1, 0.0};

static double times(double error, double factor) { return error < 0 ? error : error * factor; }

/** Writes pressures, of all kinds of particles. */
static void read_pressures(hd_gas_means *m, const hd_gas *gas, double t)
{
    const double a = gas->area;
    for (int d = 0; d < gas->dimension; d++) {
        const int virial = VIRIAL_X + d, kinetic = kinetic_x(gas) + d;
        const double of_flight = has_kinetic(gas) ? gas->sum[kinetic] / t : gas->kinetic[d];
        const span flight = has_kinetic(gas) ? (span){kinetic, kinetic, 1.0 / a} : NO_SPAN;
        m->pressure_of[d] = (of_flight + gas->sum[virial] / t) / a;
        m->pressure_of_error[d] = error_of(gas, (span){virial, virial, 1.0 / a}, flight);
        m->pressure += m->pressure_of[d];
    }
    m->pressure /= gas->dimension;
    m->pressure_error = error_of(
        gas, (span){VIRIAL_X, gas->first_pair - 1, 1.0 / gas->dimension / a}, NO_SPAN);
}

/** Writes the parts of the collision rate. */
static void read_pairs(hd_gas_means *m, const hd_gas *gas, double t)
{
    const double each = 2.0 / gas->particles;
    for (int pair = 0; pair < HD_KIND_PAIRS; pair++) {
        const int s = gas->first_pair + pair;
        m->pair_rate[pair] = gas->is_mixed ? each * gas->sum[s] / t : NAN;
        m->pair_rate_error[pair] = gas->is_mixed ? error_of(gas, (span){s, s, each}, NO_SPAN)
                                                 : -1.0;
        m->pair_rate_expected[pair] = gas->expected[pair];
    }
    m->compressibility_expected = gas->compressibility;
}

/** Writes the other means of particles that collide; all their energy is kinetic. Z is that of
 * read_summed, with the exact mean of the kinetic energy of centres. */
static void read_counted(hd_gas_means *m, const hd_gas *gas, double t)
{
    const double each = 2.0 / gas->particles;
    double twice = 0.0;
    for (int d = 0; d < gas->dimension; d++) twice += gas->kinetic[d];
    const double of_pressure = gas->dimension * gas->area / twice;
    m->collision_rate = each * gas->sum[COLLISIONS] / t;
    m->collision_rate_error = error_of(gas, (span){COLLISIONS, COLLISIONS, each}, NO_SPAN);
    m->compressibility = m->pressure * of_pressure;
    m->compressibility_error = times(m->pressure_error, of_pressure);
    m->temperature = m->potential_energy = NAN;
    m->temperature_error = m->potential_energy_error = -1.0;
}

/** Writes the other means of particles with a potential. Z = 1 + W / 2K, with the virial W and the
 * kinetic energy K. */
static void read_summed(hd_gas_means *m, const hd_gas *gas, double t)
{
    const int x = kinetic_x(gas), last = gas->first_pair - 1;
    double twice = 0.0, virial = 0.0; /* 2 K and W, each as a mean over time */
    for (int d = 0; d < gas->dimension; d++) {
        twice += gas->sum[x + d] / t;
        virial += gas->sum[VIRIAL_X + d] / t;
    }
    m->collision_rate = NAN;
    m->collision_rate_error = -1.0;
    m->compressibility = 1.0 + virial / twice;
    m->compressibility_error = error_of(gas, (span){VIRIAL_X, x - 1, 1.0 / twice},
                                        (span){x, last, -virial / (twice * twice)});
    m->temperature = twice / gas->momenta;
    m->temperature_error = error_of(gas, (span){x, last, 1.0 / gas->momenta}, NO_SPAN);
    m->potential_energy = gas->sum[POTENTIAL] / t / gas->particles;
    m->potential_energy_error = error_of(gas, (span){POTENTIAL, POTENTIAL, 1.0 / gas->particles},
                                         NO_SPAN);
}

/** Writes the flow: the stress, and mean velocities, which are ratios u of two sums: their errors
 * are those of (momentum - u particles) / particles. */
static void read_flow(hd_gas_means *m, const hd_gas *gas, double t)
{
    const int stress = gas->first_flow, last = gas->series - 1;
    m->shear_stress = gas->flows ? gas->sum[stress] / t / gas->along : NAN;
    m->shear_stress_error = gas->flows
                                ? error_of(gas, (span){stress, stress, 1.0 / gas->along}, NO_SPAN)
                                : -1.0;
    m->divergence = gas->diverges ? gas->sum[last] / t : NAN;
    m->divergence_error = gas->diverges ? error_of(gas, (span){last, last, 1.0}, NO_SPAN) : -1.0;
    for (int side = 0; side < 2; side++) {
        const int of = near(gas, side);
        const double many = gas->flows ? gas->sum[of] / t : NAN,
                     u = gas->flows ? gas->sum[of + 1] / gas->sum[of] : NAN;
        m->wall_velocity[side] = u;
        m->wall_velocity_error[side] = many > 0 ? error_of(gas, (span){of + 1, of + 1, 1.0 / many},
                                                           (span){of, of, -u / many})
                                                : -1.0;
    }
}

hd_gas_means hd_gas_read(const hd_gas *gas)
{
    const double t = gas->time > 0 ? gas->time : NAN;
    hd_gas_means m = {.time = gas->time};
    read_pressures(&m, gas, t);
    read_pairs(&m, gas, t);
    read_flow(&m, gas, t);
    (gas->is_summed ? read_summed : read_counted)(&m, gas, t);
    return m;
}

/* ---- as an observable ---------------------------------------------------------------------- */

static double gas_bytes(const hd_scene_def *scene, int ranks)
{
    (void)ranks;
    return sizeof(hd_gas) + hd_blocks_bytes(series_of(scene));
}

static void *gas_create(const hd_observing *with, hd_status *status)
{
    hd_gas *made;
    *status = hd_gas_create(&made, with->scene, with->block);
    return made;
}

static void gas_free(void *self) { hd_gas_free(self); }
static void gas_clear(void *self, const hd_moment *now) { hd_gas_begin(self, now->trajectory); }

static void gas_add(void *self, const hd_moment *now) { hd_gas_add(self, now->trajectory); }

static void gas_archive(void *self, const hd_moment *now)
{
    hd_gas *gas = self;
    hd_archive *archive = now->archive;
    hd_totals *last = &gas->last;
    hd_archive_double(archive, "gas last time", &last->time);
    hd_archive_doubles(archive, "gas last virial", last->virial, (size_t)gas->dimension);
    if (has_kinetic(gas))
        hd_archive_doubles(archive, "gas last kinetic", last->kinetic, (size_t)gas->dimension);
    if (gas->is_summed) hd_archive_double(archive, "gas last potential", &last->potential);
    if (gas->flows) {
        hd_archive_doubles(archive, "gas last wall impulse", last->walls.impulse, 2);
        hd_archive_doubles(archive, "gas last near walls", last->walls.near, 2);
        hd_archive_doubles(archive, "gas last momentum near walls", last->walls.momentum, 2);
    }
    if (gas->diverges) hd_archive_double(archive, "gas last diverged", &gas->last_diverged);
    hd_archive_bits(archive, "gas last collisions", &last->collisions);
    for (int pair = 0; pair < HD_KIND_PAIRS && gas->is_mixed; pair++)
        hd_archive_bits(archive, "gas last collisions of kinds", &last->collisions_of[pair]);
    hd_archive_double(archive, "gas time", &gas->time);
    hd_archive_doubles(archive, "gas sum", gas->sum, (size_t)gas->series);
    hd_archive_expect(archive, last->time >= 0 && last->time <= hd_trajectory_time(now->trajectory),
                      "gas last time", "it does not fit the time of the checkpoint");
    hd_archive_expect(archive, last->collisions <= hd_trajectory_totals(now->trajectory).collisions,
                      "gas last collisions", "they are more than the trajectory has had");
    hd_archive_expect(archive, gas->time >= 0, "gas time", "it is negative");
    hd_blocks_archive(&gas->blocks, archive);
}

/** True if the particles have integrals of energies (of_sums), or if they collide (not of_sums);
 * otherwise writes the reason why a target cannot name the quantity. */
static bool is_known(const hd_scene_def *def, bool of_sums, char why[HD_WHY])
{
    const hd_dynamics *of = hd_dynamics_of(def);
    if (integrates(of) != of_sums)
        snprintf(why, HD_WHY,
                 of_sums ? "all energy of %s is kinetic, and fixed" : "%s do not collide",
                 of->particles);
    return integrates(of) == of_sums;
}

static bool rate_possible(const hd_scene_def *def, const hd_aim *goal, char why[HD_WHY])
{
    (void)goal;
    return is_known(def, false, why);
}

static bool energy_possible(const hd_scene_def *def, const hd_aim *goal, char why[HD_WHY])
{
    (void)goal;
    return is_known(def, true, why);
}

/** True if walls drag; otherwise writes why a target cannot name the quantity. */
static bool flow_possible(const hd_scene_def *def, const hd_aim *goal, char why[HD_WHY])
{
    (void)goal;
    snprintf(why, HD_WHY, "no walls shear");
    return dragged(def) >= 0;
}

static bool divergence_possible(const hd_scene_def *def, const hd_aim *goal, char why[HD_WHY])
{
    (void)goal;
    snprintf(why, HD_WHY, "phase space does not contract");
    return hd_scene_diverges(def);
}

/** Reads a mean and its error, which are members of hd_gas_means. */
#define READ(name, mean, std_error)                                                                \
    static hd_stated read_##name(const hd_parts *parts, const hd_aim *goal)                        \
    {                                                                                              \
        (void)goal;                                                                                \
        const hd_gas_means means = hd_gas_read(parts->gas);                                        \
        return (hd_stated){means.mean, means.std_error, 0.0};                                      \
    }
READ(collision_rate, collision_rate, collision_rate_error)
READ(pressure, pressure, pressure_error)
READ(temperature, temperature, temperature_error)
READ(potential_energy, potential_energy, potential_energy_error)
READ(shear_stress, shear_stress, shear_stress_error)
READ(velocity_low, wall_velocity[0], wall_velocity_error[0])
READ(velocity_high, wall_velocity[1], wall_velocity_error[1])
READ(divergence, divergence, divergence_error)
#undef READ

static const hd_quantity each[] = {
    {.name = "collision_rate", .possible = rate_possible, .read = read_collision_rate},
    {.name = "pressure", .read = read_pressure},
    {.name = "temperature", .possible = energy_possible, .read = read_temperature},
    {.name = "potential_energy", .possible = energy_possible, .read = read_potential_energy},
    {.name = "shear_stress", .possible = flow_possible, .read = read_shear_stress},
    {.name = "velocity_low", .possible = flow_possible, .read = read_velocity_low},
    {.name = "velocity_high", .possible = flow_possible, .read = read_velocity_high},
    {.name = "divergence", .possible = divergence_possible, .read = read_divergence},
    {.name = NULL}};
static const hd_quantities quantities = {"gas", each};

const hd_observable hd_gas_row = {.needs = HD_NEEDS_BOX | HD_NEEDS_TOTALS,
                                  .quantities = &quantities,
                                  .bytes = gas_bytes,
                                  .create = gas_create,
                                  .free = gas_free,
                                  .clear = gas_clear,
                                  .add = gas_add,
                                  .archive = gas_archive};
