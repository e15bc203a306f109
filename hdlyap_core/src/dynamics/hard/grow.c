/** Scene of two kinds -> start positions, after Lubachevsky and Stillinger (J. Stat. Phys. 60, 561
 * (1990)): disks begin small, on the sites of the lattice on which disks of one kind start, move,
 * and grow. Here each grows by itself when the motion stops for it, as far as those around leave
 * room, up to its own size; so the energy stays, and the last ones grow as soon as there is room.
 * Which sites the second kind has is drawn by the seed. + - * / sqrt only, so that all machines
 * give the same bits. */
#include "dynamics/hard/grow.h"

#include <math.h>

#include "base/check.h"
#include "base/memory.h"
#include "base/random.h"
#include "dynamics/hard/hard.h"
#include "dynamics/hard/kinds.h"
#include "scene/container.h"
#include "scene/fluid.h"
#include "scene/kinds.h"
#include "scene/null_space.h"
#include "scene/scene.h"

/** Stops after which no start is found (dense fluids take 20 to 200), and how many particles of the
 * largest volume over that of the first kind are few enough to try that beforehand. */
enum { STOPS = 2000, FEW = 2000 };
/** Most collisions of a particle between two stops; they have jammed if the time for these becomes
 * such a part of what the fluid's theory expects. */
static const double BETWEEN = 2.0, JAMMED = 1e-6;
/** They stop at once where they collide so many times more often: where they touch all around, gaps
 * shrink by many tens between two stops. */
static const double FAR_BEYOND = 100.0;
/** Most times that a particle meets walls between two stops, at which hardly more than its own
 * diameter may fit between them. */
static const double WALLS_BETWEEN = 100.0;
/** Part of the room by which a disk grows that does not reach its own size: so that collisions do
 * not become more than ten times as frequent at once. */
static const double GROWTH = 0.9;
/** Rims stay apart by more than rounding. */
static const double APART = 1.0 - 1e-12;
enum { STREAM = 2, SAID = 96 }; /* of random numbers; bytes of a container's description */

/** Gives sites to the second kind at random. Within a kind the order of sites is kept, so that
 * disks that are near each other are so in memory, too. */
static void draw(double *q, const double *site, const hd_scene_def *def)
{
    const hd_kinds kinds = hd_kinds_of(def);
    hd_random random = hd_random_seeded(def->seed, STREAM);
    int next[2] = {0, kinds.kind[0].number};
    for (int k = 0; k < def->number; k++) {
        const double drawn = 0.5 + 0.5 * hd_random_symmetric(&random);
        const int of_second = drawn * (def->number - k) < def->number - next[1];
        for (int d = 0; d < HD_DIM; d++) q[HD_DIM * next[of_second] + d] = site[HD_DIM * k + d];
        next[of_second]++;
    }
}

/** The largest radius that disk j leaves to disk i. */
static double left_by(const hard *tr, int32_t i, int32_t j, const double shift[HD_DIM])
{
    double r[HD_DIM];
    if (i == j) return INFINITY; /* boxes are longer than the largest diameter */
    hd_contact_separation(r, &tr->motion.disk[i], &tr->motion.disk[j], shift,
                          tr->now - tr->epoch_start);
    return sqrt(hd_contact_dot(r, r)) - tr->motion.sizes.radius[j];
}

/** The largest radius that the walls leave to disk i. */
static double left_by_walls(const hard *tr, int32_t i)
{
    const hd_motion *m = &tr->motion;
    const double *q = m->disk[i].q;
    const hd_wall *wall = &m->sizes.wall[i];
    double least = INFINITY;
    if (wall->excess) return m->sizes.radius[i] - wall->excess(wall, q);
    for (int d = 0; d < HD_DIM; d++)
        if (m->cells.boundary[d] == HD_REFLECTING)
            least = fmin(least, fmin(q[d], m->cells.box[d] - q[d]));
    return least;
}

static void set_radius(hard *tr, const hd_scene_def *def, int32_t i, double radius)
{
    tr->motion.sizes.radius[i] = radius;
    tr->motion.sizes.wall[i] = hd_wall_of(def, radius);
}

/** Moves all disks to the present: when they were last met they may have been closer than they can
 * be now. */
static void settle(hard *tr)
{
    for (int32_t i = 0; i < tr->motion.count; i++) {
        hd_disk_move_to(&tr->motion.disk[i], tr->now - tr->epoch_start);
        tr->motion.disk[i].collisions++;
    }
}

/** Lets each disk grow as far as it can, and returns how many have not their own size yet. */
static int swell(hard *tr, const hd_scene_def *def)
{
    const hd_kinds kinds = hd_kinds_of(def);
    int small = 0;
    for (int32_t i = 0; i < tr->motion.count; i++) {
        const double own = 0.5 * kinds.kind[i >= kinds.kind[0].number].diameter,
                     radius = tr->motion.sizes.radius[i];
        if (radius == own) continue;
        const double room = APART * fmin(hd_hard_least_of(tr, i, left_by), left_by_walls(tr, i));
        if (room > radius)
            set_radius(tr, def, i, room < own ? radius + GROWTH * (room - radius) : own);
        small += room < own;
    }
    return small;
}

/** Fills a state that has no disks yet with small ones. */
static void begin(hard *tr, const hd_scene_def *def, const double *q, const double *p)
{
    const double distance = hd_container_of(def)->start_distance(def);
    const double smallest = 0.1;          /* the least radius of a particle */
    tr->motion.sizes.first = def->number; /* masses are equal */
    for (int32_t i = 0; i < def->number; i++) {
        hd_disk *disk = &tr->motion.disk[i];
        disk->size = (uint32_t)i;
        set_radius(tr, def, i, fmin(smallest, 0.5 * APART * distance));
        for (int d = 0; d < HD_DIM; d++) {
            disk->q[d] = q[HD_DIM * i + d];
            disk->p[d] = p[HD_DIM * i + d];
        }
        hd_cells_add(&tr->motion.cells, tr->motion.disk, i);
    }
}

/** Collisions of a particle since there were `before` of all. */
static double met_since(const hard *tr, uint64_t before)
{
    return 2.0 * (double)(tr->collisions - before) / tr->motion.count;
}

/** Moves the disks for this time, or until they have collided far too often. What happens does not
 * depend on the parts in which it does. */
static hd_status move_on(hard *tr, double time)
{
    const uint64_t before = tr->collisions;
    const double end = tr->now + time;
    double part = 0x1p-20 * time;
    for (; tr->now < end && !(met_since(tr, before) > FAR_BEYOND * BETWEEN); part *= 2.0)
        HD_TRY(hd_hard_advance(tr, NULL, fmin(tr->now + part, end)));
    return HD_OK;
}

static hd_status grow(hard *tr, const hd_scene_def *def)
{
    const double longest = fmin(1.0 / hd_dynamics_of(def)->fluid->rate(def),
                                WALLS_BETWEEN / hd_hard_with_walls(def, 0.0));
    double time = longest;
    for (int k = 0; swell(tr, def) > 0; k++) {
        const uint64_t before = tr->collisions;
        const double since = tr->now;
        if (k == STOPS || time < JAMMED * longest) return HD_REFUSED;
        hd_hard_predict(tr);
        HD_TRY(move_on(tr, time));
        const double met = met_since(tr, before);
        if (met > FAR_BEYOND * BETWEEN)
            time = (tr->now - since) * BETWEEN / met;
        else if (met > BETWEEN)
            time *= 0.5;
        if (met < 0.25 * BETWEEN && time < longest) time *= 2.0;
        settle(tr);
    }
    return HD_OK;
}

/** Writes positions; those at a wall are off by rounding, which is undone. */
static void positions(const hard *tr, double *q)
{
    hd_hard_state(tr, q, NULL);
    for (int k = 0; k < HD_DIM * tr->motion.count; k++) {
        const double radius = tr->motion.sizes.radius[k / HD_DIM];
        const hd_cells *cells = &tr->motion.cells;
        if (cells->boundary[k % HD_DIM] != HD_REFLECTING) continue;
        q[k] = fmin(fmax(q[k], radius), cells->box[k % HD_DIM] - radius);
    }
}

hd_status hd_hard_grow(const hd_scene_def *def, double *q)
{
    hard tr = {.now = 0.0};
    double *p = hd_memory_alloc(HD_DIM * (size_t)def->number, sizeof *p);
    hd_status status = p ? hd_sizes_create(&tr.motion.sizes, def, def->number) : HD_NO_MEMORY;
    if (status == HD_OK) status = hd_hard_prepare(&tr, def, hd_kinds_largest(def));
    if (status == HD_OK) {
        hd_container_of(def)->start(def, p); /* sites, for now */
        draw(q, p, def);
        hd_null_space_momenta(def, q, p);
        begin(&tr, def, q, p);
        status = grow(&tr, def);
        positions(&tr, q);
    }
    hd_memory_free(p);
    hd_hard_clear(&tr);
    return status;
}

/** Whether one is found for so many particles as can be tried at once; true for more. */
static hd_status try_few(bool *found, const hd_scene_def *def)
{
    const double largest = hd_kinds_largest(def), square = largest * largest;
    *found = true;
    if (def->number * square * (HD_DIM == 2 ? 1.0 : largest) > FEW) return HD_OK;
    double *q = hd_memory_alloc(HD_DIM * (size_t)def->number, sizeof *q);
    const hd_status status = q ? hd_hard_grow(def, q) : HD_NO_MEMORY;
    hd_memory_free(q);
    *found = status == HD_OK;
    return status == HD_REFUSED ? HD_OK : status;
}

hd_status hd_hard_grow_check(const hd_scene_def *def, char *message, size_t size)
{
    const double packing = hd_scene_packing(def), most = def->density * HD_GROW_PACKING / packing;
    const hd_container_row *container = hd_container_of(def);
    const bool fits = container->start_distance(def) >=
                      HD_START_DISTANCE_MIN * hd_kinds_largest(def);
    bool found;
    if (!fits && packing > HD_GROW_PACKING * (1.0 + 1e-9))
        return hd_refuse(message, size,
                         "density = %.15g: must be at most %.6g, packing fraction %g, with "
                         "second_fraction = %.15g, second_diameter = %.15g",
                         def->density, most, HD_GROW_PACKING,
                         hd_parameter_value(&hd_kinds_own[0], def),
                         hd_parameter_value(&hd_kinds_own[1], def));
    HD_TRY(try_few(&found, def));
    if (found) return HD_OK;
    char said[SAID];
    container->say(def, said, sizeof said);
    return hd_refuse(
        message, size,
        "density = %.15g: must be lower with number = %d, second_diameter = %.15g, %s: "
        "no start is found",
        def->density, def->number, hd_parameter_value(&hd_kinds_own[1], def), said);
}
