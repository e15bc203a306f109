/** What is asked of dumbbells, and their row. */
#include <float.h>
#include <zlib.h>

#include "base/check.h"
#include "dynamics/dumbbells/bump.h"
#include "dynamics/dumbbells/bump_maps.h"
#include "dynamics/dumbbells/dumbbells_state.h"
#include "dynamics/dumbbells/next.h"
#include "dynamics/dumbbells/shape.h"
#include "dynamics/dumbbells/start.h"
#include "scene/container.h"
#include "scene/dynamics.h"
#include "scene/null_space.h"
#include "scene/scene.h"

enum { SAID = 96 };

/* ---- scene --------------------------------------------------------------------------------- */

hd_status hd_dumbbells_check_box(const hd_scene_def *scene, char *message, size_t size)
{
    double box[HD_DIMENSION_MAX];
    const double bond = hd_dumbbell_bond(scene);
    if (hd_container_of(scene)->wall)
        return hd_refuse(message, size, "container = %s: must be rectangle with particles = %s",
                         hd_container_name(scene), hd_dumbbells_row.particles);
    hd_scene_box(scene, box);
    for (int d = 0; d < 2; d++)
        if (scene->boundary[d] == HD_PERIODIC && !(box[d] > 1.0 + bond))
            return hd_refuse(message, size,
                             "density = %.15g with number = %d, aspect = %.15g: the box edge L%c = "
                             "%.15g must be above the length of a dumbbell, 1 + bond = %.15g",
                             scene->density, scene->number, scene->aspect, "xy"[d], box[d],
                             1.0 + bond);
    return HD_OK;
}

static hd_status row_check(const hd_scene_def *scene, char *message, size_t size)
{
    char said[SAID];
    HD_TRY(hd_dumbbells_check_box(scene, message, size));
    if (hd_dumbbell_start_gap(scene) >= HD_START_DISTANCE_MIN - 1.0) return HD_OK;
    hd_container_of(scene)->say(scene, said, sizeof said);
    return hd_refuse(message, size,
                     "density = %.15g (packing fraction %.4g): must be at most %.6g with number = "
                     "%d, bond = %.15g, %s (densest start lattice)",
                     scene->density, hd_scene_packing(scene), hd_dumbbell_density_max(scene),
                     scene->number, hd_dumbbell_bond(scene), said);
}

static double row_rate(const hd_scene_def *scene)
{
    return 0.5 * scene->number * hd_fluid_dumbbells.rate(scene);
}

static double row_entries(const hd_scene_def *scene)
{
    double box[HD_DIMENSION_MAX], walls = 0.0;
    hd_scene_box(scene, box);
    for (int d = 0; d < 2; d++)
        if (scene->boundary[d] != HD_PERIODIC) walls += 1.0 / (box[d] - 1.0);
    return row_rate(scene) + scene->number * walls;
}

static int row_zeros(const hd_scene_def *scene)
{
    int axis[HD_DIMENSION_MAX + 1];
    return 2 * hd_null_axes(scene, axis);
}

/* ---- particles ----------------------------------------------------------------------------- */

static double row_time(const void *state) { return ((const dumbbells *)state)->now; }

static void row_state(const void *state, double *q, double *p)
{
    const dumbbells *all = state;
    for (int32_t i = 0; i < all->m.count; i++) {
        hd_disk disk = all->m.disk[i];
        hd_spin spin = all->m.spin[i];
        hd_molecule_move_to(&disk, &spin, all->now - all->epoch_start);
        hd_molecule_fold(&all->m, &disk, &spin);
        for (int d = 0; d < 2; d++) {
            if (q) q[3 * i + d] = disk.q[d];
            if (p) p[3 * i + d] = disk.p[d];
        }
        if (q) q[3 * i + 2] = spin.q;
        if (p) p[3 * i + 2] = spin.p;
    }
}

static double row_kinetic_energy(const void *state)
{
    const hd_molecules *m = &((const dumbbells *)state)->m;
    double twice = 0.0;
    for (int32_t i = 0; i < m->count; i++)
        twice += m->disk[i].p[0] * m->disk[i].p[0] + m->disk[i].p[1] * m->disk[i].p[1] +
                 m->spin[i].p * m->spin[i].p;
    return 0.5 * twice;
}

static void row_tell(const void *state, hd_told *told)
{
    const dumbbells *all = state;
    *told = (hd_told){.collisions = all->collisions,
                      .wall_events = all->wall_events,
                      .virial = {all->virial[0], all->virial[1]}};
}

static void row_examine(const void *state, hd_examined *out)
{
    const dumbbells *all = state;
    const hd_molecules *m = &all->m;
    const double events = (double)(all->collisions + all->wall_events),
                 t = all->now - all->epoch_start;
    *out = (hd_examined){.energy_rounding = DBL_EPSILON * (64.0 + 16.0 * sqrt(events)),
                         .overlap = fmax(0.0, -hd_dumbbells_gap(all)),
                         .overlap_rounding = hd_dumbbells_rounding(all),
                         .overlap_max = hd_dumbbells_overlap_max(all)};
    for (int32_t i = 0; i < m->count; i++) {
        const hd_disk *disk = &m->disk[i];
        double r[2];
        for (int d = 0; d < 2; d++) {
            out->momentum[d] += disk->p[d];
            r[d] = disk->q[d] + disk->p[d] * (t - disk->t) - 0.5 * m->cells.box[d];
        }
        out->angular_momentum += r[0] * disk->p[1] - r[1] * disk->p[0] +
                                 m->spin[i].p * m->shape.root;
    }
}

static uint32_t row_fingerprint(const void *state)
{
    const hd_molecules *m = &((const dumbbells *)state)->m;
    uLong crc = 0;
    for (int32_t i = 0; i < m->count; i++) {
        crc = crc32_z(crc, (const Bytef *)m->disk[i].q, sizeof m->disk[i].q);
        crc = crc32_z(crc, (const Bytef *)m->disk[i].p, sizeof m->disk[i].p);
        crc = crc32_z(crc, (const Bytef *)&m->spin[i], sizeof m->spin[i]);
    }
    return (uint32_t)crc;
}

/** Cells, queue, the next event. */
static double row_bytes(double molecules) { return 290.0 * molecules; }

/** In the record, which doubles when it is full, and as maps. */
static double row_record_bytes(double entries) { return 310.0 * entries; }

/* ---- file ---------------------------------------------------------------------------------- */

/** Turns around the box within one epoch; rounding of a position, and of the energy, which walks by
 * 1e-16 of itself in a collision. */
enum { WRAP_MAX = 1 << 24 };
static const double PLACE_CLOSE = 1e-6, ENERGY_CLOSE = 1e-6;

static void molecules_archive(hd_molecules *m, hd_archive *archive)
{
    const size_t n = (size_t)m->count;
    hd_archive_of_doubles(archive, "trajectory q p t", 7 * n);
    for (size_t i = 0; i < n; i++) {
        hd_archive_next_doubles(archive, m->disk[i].q, 2);
        hd_archive_next_doubles(archive, m->disk[i].p, 2);
        hd_archive_next_doubles(archive, &m->spin[i].q, 1);
        hd_archive_next_doubles(archive, &m->spin[i].p, 1);
        hd_archive_next_doubles(archive, &m->disk[i].t, 1);
    }
    hd_archive_of_ints(archive, "trajectory wrap cell", 4 * n);
    for (size_t i = 0; i < n; i++)
        for (int d = 0; d < 2; d++) {
            hd_archive_next_int(archive, &m->disk[i].wrap[d], -WRAP_MAX, WRAP_MAX);
            hd_archive_next_int(archive, &m->disk[i].cell[d], 0, m->cells.size[d] - 1);
        }
}

static bool in_its_cell(const hd_molecules *m, const hd_disk *disk, double t, double close)
{
    for (int d = 0; d < 2; d++) {
        const double *bound = m->cells.line[d][disk->cell[d]].bound;
        const double place = disk->q[d] + disk->p[d] * (t - disk->t) -
                             disk->wrap[d] * m->cells.box[d];
        if (!(place >= bound[0] - close && place <= bound[1] + close)) return false;
    }
    return true;
}

/** What the numbers are not, or NULL. Of a scene: its energy is N. */
static const char *inconsistency(const dumbbells *all)
{
    const hd_molecules *m = &all->m;
    const double since = all->now - all->epoch_start;
    if (!(all->epoch_start >= 0 && since >= 0 && since <= m->epoch_length))
        return "the time is outside its epoch";
    for (int32_t i = 0; i < m->count; i++) {
        const hd_disk *disk = &m->disk[i];
        if (!(disk->t >= 0 && disk->t <= since)) return "a dumbbell is ahead of its time";
        if (!in_its_cell(m, disk, since, fmax(PLACE_CLOSE, m->rounding)))
            return "a dumbbell is not in its cell";
        if (!(fabs(m->spin[i].q) <= m->shape.turn)) return "an angle is more than a turn";
    }
    const double excess = row_kinetic_energy(all) - m->count;
    if (!(fabs(excess) <= ENERGY_CLOSE * m->count)) return "the energy is wrong";
    return hd_dumbbells_gap(all) < -hd_dumbbells_overlap_max(all) ? "dumbbells overlap" : NULL;
}

static void row_archive(void *state, hd_archive *archive)
{
    dumbbells *all = state;
    hd_molecules *m = &all->m;
    hd_archive_double(archive, "trajectory epoch start", &all->epoch_start);
    hd_archive_double(archive, "trajectory time", &all->now);
    hd_archive_bits(archive, "trajectory collisions", &all->collisions);
    hd_archive_bits(archive, "trajectory wall events", &all->wall_events);
    hd_archive_doubles(archive, "trajectory virial", all->virial, 2);
    molecules_archive(m, archive);
    if (!hd_archive_good(archive)) return;
    if (!archive->writing) hd_cells_empty(&m->cells);
    for (int32_t i = 0; i < m->count && !archive->writing; i++)
        hd_cells_book(&m->cells, m->disk, i);
    const char *fault = inconsistency(all);
    if (fault) hd_archive_refuse(archive, "trajectory", fault);
    if (!archive->writing && hd_archive_good(archive)) hd_next_restart(m);
}

/** What is wrong with entries beyond their being numbers. */
static const char *row_fault(const hd_record *record, const hd_scene_def *scene)
{
    for (size_t k = 0; k < hd_record_count(record); k++) {
        const hd_bump *bump = hd_record_entry(record, k);
        const double i = bump->i, j = bump->j,
                     n2 = bump->n[0] * bump->n[0] + bump->n[1] * bump->n[1];
        if (!(i >= 0 && i < scene->number && i == floor(i))) return "there is no such dumbbell";
        if (!(j == -1 || (j > i && j < scene->number && j == floor(j))))
            return "there is no such partner";
        if (!(fabs(n2 - 1.0) <= 8.0 * DBL_EPSILON)) return "a normal has not the length 1";
    }
    return NULL;
}

const hd_dynamics hd_dumbbells_row = {.particles = "dumbbells",
                                      .dimension = 2,
                                      .coordinates = 3,
                                      .entry = sizeof(hd_bump),
                                      .symplectic = true,
                                      .parameter = hd_dumbbell_own,
                                      .parameters = HD_DUMBBELL_OWN,
                                      .fluid = &hd_fluid_dumbbells,
                                      .check = row_check,
                                      .zeros = row_zeros,
                                      .entries = row_entries,
                                      .rate = row_rate,
                                      .null = hd_null_space_fill,
                                      .inertia = hd_dumbbell_inertia,
                                      .size = hd_dumbbell_size,
                                      .create = hd_dumbbells_create,
                                      .create_from = hd_dumbbells_create_from,
                                      .free = hd_dumbbells_free,
                                      .advance = hd_dumbbells_advance,
                                      .time = row_time,
                                      .state = row_state,
                                      .kinetic_energy = row_kinetic_energy,
                                      .tell = row_tell,
                                      .examine = row_examine,
                                      .archive = row_archive,
                                      .fingerprint = row_fingerprint,
                                      .bytes = row_bytes,
                                      .fault = row_fault,
                                      .record_bytes = row_record_bytes,
                                      .maps_create = hd_bump_maps_create,
                                      .maps_free = hd_bump_maps_free,
                                      .maps_fill = hd_bump_maps_fill,
                                      .carry = hd_bump_maps_carry};
