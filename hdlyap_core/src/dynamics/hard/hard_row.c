/** Answers questions about the state of hard particles; the row of disks and of spheres. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/check.h"
#include "dynamics/hard/event.h"
#include "dynamics/hard/grow.h"
#include "dynamics/hard/hard.h"
#include "dynamics/hard/kinds.h"
#include "dynamics/hard/maps.h"
#include "scene/container.h"
#include "scene/dynamics.h"
#include "scene/ends.h"
#include "scene/mixture.h"
#include "scene/null_space.h"

enum { SAID = 96 }; /* bytes of a container's description */

double hd_hard_time(const void *state)
{
    const hard *tr = state;
    return tr->now;
}

/** Adds the flights since the last events to the sums of the flow. */
static void flow_totals(const hard *tr, hd_totals *totals)
{
    double sum[HD_FLOW_SUMS];
    memcpy(sum, tr->flow.sum, sizeof sum);
    for (int32_t i = 0; i < tr->motion.count; i++)
        hd_flow_fly(&tr->flow, sum, &tr->motion.disk[i], tr->now - tr->epoch_start);
    for (int d = 0; d < HD_DIM; d++) totals->kinetic[d] = sum[HD_FLOW_KINETIC + d];
    for (int side = 0; side < 2; side++) {
        totals->walls.impulse[side] = sum[HD_FLOW_IMPULSE + side];
        totals->walls.near[side] = sum[HD_FLOW_NEAR + side];
        totals->walls.momentum[side] = sum[HD_FLOW_MOMENTUM + side];
    }
}

void hd_hard_totals(const void *state, hd_totals *totals)
{
    const hard *tr = state;
    *totals = (hd_totals){
        .collisions = tr->collisions, .wall_events = tr->wall_events, .time = tr->now};
    totals->collisions_of[0] = tr->collisions;
    if (HD_MIXED) memcpy(totals->collisions_of, tr->collisions_of, sizeof tr->collisions_of);
    for (int d = 0; d < HD_DIM; d++) totals->virial[d] = tr->virial[d];
    if (tr->flow.wall) flow_totals(tr, totals);
}

/** Logarithm of what phase space has become at walls. */
static double hard_divergence(const void *state)
{
    const hard *tr = state;
    return hd_flow_divergence(&tr->flow);
}

/** Disk i moved to the present time and folded into the box. */
static hd_disk disk_now(const hard *tr, int32_t i)
{
    hd_disk disk = tr->motion.disk[i];
    hd_disk_move_to(&disk, tr->now - tr->epoch_start);
    hd_cells_fold(&tr->motion.cells, &disk);
    return disk;
}

void hd_hard_state(const void *state, double *q, double *p)
{
    const hard *tr = state;
    for (int32_t i = 0; i < tr->motion.count; i++) {
        const hd_disk disk = disk_now(tr, i);
        const double root = sqrt(hd_sizes_mass(&tr->motion.sizes, i));
        for (int d = 0; d < HD_DIM; d++) {
            if (q) q[HD_DIM * i + d] = disk.q[d];
            if (p) p[HD_DIM * i + d] = root * disk.p[d];
        }
    }
}

static void momentum(const hard *tr, double *sum)
{
    for (int i = 0; i < tr->motion.count; i++)
        for (int d = 0; d < HD_DIM; d++)
            sum[d] += hd_sizes_mass(&tr->motion.sizes, i) * tr->motion.disk[i].p[d];
}

/** Angular momentum about the middle of the box. It means something only inside a curved wall,
 * where positions need no folding. */
static double angular_momentum(const hard *tr)
{
    double sum = 0.0;
    for (int32_t i = 0; i < tr->motion.count; i++) {
        hd_disk disk = tr->motion.disk[i];
        hd_disk_move_to(&disk, tr->now - tr->epoch_start);
        sum += hd_sizes_mass(&tr->motion.sizes, i) *
               ((disk.q[0] - 0.5 * tr->motion.cells.box[0]) * disk.p[1] -
                (disk.q[1] - 0.5 * tr->motion.cells.box[1]) * disk.p[0]);
    }
    return sum;
}

double hd_hard_kinetic_energy(const void *state)
{
    const hard *tr = state;
    double twice = 0;
    for (int32_t i = 0; i < tr->motion.count; i++)
        twice += hd_sizes_mass(&tr->motion.sizes, i) *
                 hd_contact_dot(tr->motion.disk[i].p, tr->motion.disk[i].p);
    return 0.5 * twice;
}

static double energy_rounding(const hard *tr)
{
    const double events = (double)(tr->collisions + tr->wall_events);
    return DBL_EPSILON * (64.0 + 16.0 * sqrt(events));
}

double hd_hard_overlap_rounding(const hard *tr)
{
    double longest = 0.0;
    for (int d = 0; d < HD_DIM; d++) longest = fmax(longest, tr->motion.cells.box[d]);
    const double fastest = HD_MIXED ? tr->motion.sizes.fastest : 1.0;
    return hd_overlap_rounding(longest, tr->epoch_length * fastest);
}

/** The least value of `of` for disk i with each disk in the n-th of the cells around it. */
static double least_in_cell(const hard *tr, int32_t i, int n,
                            double (*of)(const hard *, int32_t, int32_t, const double[HD_DIM]))
{
    const hd_disk *disk = &tr->motion.disk[i];
    const hd_cell *cell = hd_cells_near(&tr->motion.cells, disk, n);
    double least = INFINITY;
    int32_t j = cell->count > 0 ? cell->disk[0] : -1;
    for (int k = 0; j >= 0;) {
        double shift[HD_DIM];
        for (int d = 0; d < HD_DIM; d++) {
            const int32_t edges =
                tr->motion.cells.line[d][disk->cell[d]].shift[hd_cells_side(n, d)];
            shift[d] = (edges + disk->wrap[d] - tr->motion.disk[j].wrap[d]) *
                       tr->motion.cells.box[d];
        }
        least = fmin(least, of(tr, i, j, shift));
        if (++k < cell->count)
            j = cell->disk[k];
        else
            j = cell->crowded ? hd_cells_next(&tr->motion.cells, j) : -1;
    }
    return least;
}

double hd_hard_least_of(const hard *tr, int32_t i,
                        double (*of)(const hard *, int32_t, int32_t, const double[HD_DIM]))
{
    double least = INFINITY;
    for (int n = 0; n < HD_CELLS_AROUND; n++) least = fmin(least, least_in_cell(tr, i, n, of));
    return least;
}

double hd_hard_least(const hard *tr,
                     double (*of)(const hard *, int32_t, int32_t, const double[HD_DIM]))
{
    double least = INFINITY;
    for (int32_t i = 0; i < tr->motion.count; i++) least = fmin(least, hd_hard_least_of(tr, i, of));
    return least;
}

/** Distance of their rims, infinite if i = j. */
static double gap(const hard *tr, int32_t i, int32_t j, const double shift[HD_DIM])
{
    double r[HD_DIM];
    hd_contact_separation(r, &tr->motion.disk[i], &tr->motion.disk[j], shift,
                          tr->now - tr->epoch_start);
    const double touching = hd_sizes_radius(&tr->motion.sizes, &tr->motion.disk[i]) +
                            hd_sizes_radius(&tr->motion.sizes, &tr->motion.disk[j]);
    return i == j ? INFINITY : sqrt(hd_contact_dot(r, r)) - touching;
}

double hd_hard_overlap(const hard *tr) { return fmax(0.0, -hd_hard_least(tr, gap)); }

void hd_hard_examine(const hard *tr, hd_invariants *examined)
{
    examined->energy_rounding = energy_rounding(tr);
    examined->angular_momentum = angular_momentum(tr);
    momentum(tr, examined->momentum);
}

static void hard_examine(const void *state, hd_invariants *examined)
{
    const hard *tr = state;
    const double kinetic = hd_hard_kinetic_energy(tr);
    *examined = (hd_invariants){.kinetic_energy = kinetic,
                                .energy_error = kinetic / tr->motion.count - 1.0,
                                .overlap = hd_hard_overlap(tr),
                                .overlap_rounding = hd_hard_overlap_rounding(tr),
                                .overlap_max = tr->overlap_max};
    hd_hard_examine(tr, examined);
}

/** Largest part of the densest start at which disks can flow along walls that drag. Above it walls
 * of small b may take away all motion across them (HD_JAMMED), as was seen from 0.98 on. */
static const double FLOWS = 0.95;

/** Refuses a density at which disks would be jammed between walls that drag. */
static hd_status check_flow(const hd_scene_def *scene, char *message, size_t size)
{
    bool drag = false;
    for (int d = 0; d < HD_DIM; d++) drag |= hd_ends_drag(scene, d);
    const double most = drag ? FLOWS * hd_container_of(scene)->density_max(scene) : INFINITY;
    if (scene->density <= most) return HD_OK;
    return hd_refuse(message, size,
                     "density = %.15g: must be at most %.6g with number = %d and walls that shear, "
                     "between which the densest start lattice cannot flow",
                     scene->density, most, scene->number);
}

/** Refuses a fraction that would be that of one kind alone when it is rounded, but does not say so.
 */
static hd_status check_second(const hd_scene_def *scene, char *message, size_t size)
{
    const double fraction = hd_parameter_value(&hd_kinds_own[0], scene);
    const int of_second = hd_kinds_second(scene);
    if (fraction == 0 || fraction == 1 || (of_second > 0 && of_second < scene->number))
        return HD_OK;
    return hd_refuse(message, size,
                     "second_fraction = %.15g: must be 0, 1, or leave at least one particle of "
                     "each kind with number = %d",
                     fraction, scene->number);
}

/** Checks that there are start positions at this density. */
static hd_status hard_check(const hd_scene_def *scene, char *message, size_t size)
{
    const hd_container_row *container = hd_container_of(scene);
    char said[SAID];
    HD_TRY(check_second(scene, message, size));
    if (HD_MIXED) return hd_hard_grow_check(scene, message, size);
    if (container->start_distance(scene) >= HD_START_DISTANCE_MIN)
        return check_flow(scene, message, size);
    container->say(scene, said, sizeof said);
    return hd_refuse(
        message, size,
        "density = %.15g: must be at most %.6g with number = %d, %s (densest start lattice)",
        scene->density, container->density_max(scene), scene->number, said);
}

/** Two exponents vanish by energy and time, and two by each conserved momentum; one by a momentum
 * that walls damp, as the box repeats all the same. */
int hd_hard_zeros(const hd_scene_def *scene) { return hd_null_count(scene); }

#if HD_DIM == 2
extern const hd_dynamics hd_mixed_disks_row;
#define ROWS(kind) hd_##kind##disks_row
#else
extern const hd_dynamics hd_mixed_spheres_row;
#define ROWS(kind) hd_##kind##spheres_row
#endif
#if HD_MIXED
#define ROW ROWS(mixed_)
#else
#define ROW ROWS()
#endif
#if HD_MIXED
#define FLUID (HD_DIM == 2 ? &hd_fluid_disk_mixture : &hd_fluid_sphere_mixture)
#else
#define FLUID (HD_DIM == 2 ? &hd_fluid_disks : &hd_fluid_spheres)
#endif
const hd_dynamics ROW = {.particles = HD_DIM == 2 ? "disks" : "spheres",
                         .dimension = HD_DIM,
                         .coordinates = HD_DIM,
                         .entry = sizeof(hd_event),
                         .symplectic = true,
                         .dispersing = true,
                         .scale_invariant = true,
                         .collides = true,
                         .ends = HD_DIM == 2 && !HD_MIXED ? 1u << HD_SHEARING : 0u,
                         .parameter = hd_kinds_own,
                         .parameters = HD_KINDS_OWN,
                         .fluid = FLUID,
                         .check = hard_check,
                         .zero_exponents = hd_hard_zeros,
                         .record_rate = hd_hard_entries,
                         .collision_rate = hd_hard_rate,
                         .null_vectors = hd_null_space_fill,
                         .size = hd_hard_size,
                         .kinds = hd_hard_kinds,
                         .mixture = &ROWS(mixed_),
                         .create = hd_hard_create,
                         .create_empty = hd_hard_create_empty,
                         .free = hd_hard_free,
                         .advance = hd_hard_advance,
                         .time = hd_hard_time,
                         .state = hd_hard_state,
                         .totals = hd_hard_totals,
                         .divergence = hard_divergence,
                         .examine = hard_examine,
                         .archive = hd_hard_archive,
                         .fingerprint = hd_hard_fingerprint,
                         .bytes = hd_hard_bytes,
                         .fault = hd_events_fault,
                         .record_bytes = hd_events_bytes,
                         .maps_create = hd_maps_create,
                         .maps_free = hd_maps_free,
                         .maps_fill = hd_maps_fill,
                         .carry = hd_maps_carry};
