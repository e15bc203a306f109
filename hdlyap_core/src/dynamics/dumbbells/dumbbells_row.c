/** Checks scenes of dumbbells, answers questions about their state and keeps it in a checkpoint;
 * their row. */
#include <float.h>
#include <math.h>
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

/* ---- particles ----------------------------------------------------------------------------- */

static void row_state(const void *state, double *q, double *p)
{
    const hd_molecules *m = state;
    const double t = m->hard.now - m->hard.epoch_start;
    for (int32_t i = 0; i < m->hard.motion.count; i++) {
        hd_disk disk = m->hard.motion.disk[i];
        const double angle = m->spin[i].q + m->spin[i].p * (t - disk.t);
        hd_disk_move_to(&disk, t);
        hd_cells_fold(&m->hard.motion.cells, &disk);
        for (int d = 0; d < 2; d++) {
            if (q) q[3 * i + d] = disk.q[d];
            if (p) p[3 * i + d] = disk.p[d];
        }
        if (q) q[3 * i + 2] = hd_one_turn(m, angle);
        if (p) p[3 * i + 2] = m->spin[i].p;
    }
}

static double row_kinetic_energy(const void *state)
{
    const hd_molecules *m = state;
    double twice = 0.0;
    for (int32_t i = 0; i < m->hard.motion.count; i++) twice += m->spin[i].p * m->spin[i].p;
    return hd_hard_kinetic_energy(state) + 0.5 * twice;
}

static double overlap_max(const hd_molecules *m)
{
    return fmax(HD_OVERLAP_MAX, hd_dumbbells_rounding(m));
}

static void row_examine(const void *state, hd_examined *out)
{
    const hd_molecules *m = state;
    const double kinetic = row_kinetic_energy(m);
    *out = (hd_examined){.kinetic_energy = kinetic,
                         .energy_error = kinetic / m->hard.motion.count - 1.0,
                         .overlap = fmax(0.0, -hd_dumbbells_gap(m)),
                         .overlap_rounding = hd_dumbbells_rounding(m),
                         .overlap_max = overlap_max(m)};
    hd_hard_examine(&m->hard, out);
    for (int32_t i = 0; i < m->hard.motion.count; i++)
        out->angular_momentum += m->spin[i].p * m->shape.root;
}

static uint32_t row_fingerprint(const void *state)
{
    const hd_molecules *m = state;
    return (uint32_t)crc32_z(hd_hard_fingerprint(state), (const Bytef *)m->spin,
                             (size_t)m->hard.motion.count * sizeof *m->spin);
}

static double row_bytes(const hd_scene_def *scene)
{
    const double spin_and_which = 20.0, cells = 15.0; /* more cells than disks have, less dense */
    return hd_hard_bytes(scene) + (spin_and_which + cells) * scene->number;
}

/** Bytes of this many events: in the record, which doubles when it is full, and as tangent maps. */
static double row_record_bytes(double entries) { return 310.0 * entries; }

/* ---- file ---------------------------------------------------------------------------------- */

static void row_archive(void *state, hd_archive *archive)
{
    hd_molecules *m = state;
    const size_t n = (size_t)m->hard.motion.count;
    hd_hard_keep(&m->hard, archive);
    hd_archive_doubles(archive, "trajectory angle spin", &m->spin->q, 2 * n);
    if (!hd_archive_good(archive)) return;
    const char *fault = hd_hard_inconsistency(&m->hard, row_kinetic_energy(m));
    for (size_t i = 0; i < n && !fault; i++)
        if (!(fabs(m->spin[i].q) <= m->shape.turn)) fault = "an angle is more than a turn";
    if (!fault && -hd_dumbbells_gap(m) > overlap_max(m)) fault = "dumbbells overlap";
    if (fault) hd_archive_refuse(archive, "trajectory", fault);
    if (!archive->writing && hd_archive_good(archive)) hd_next_restart(m);
}

/** Returns NULL, or what is wrong with the entries, which are finite numbers. */
static const char *row_fault(const hd_record *record, const hd_scene_def *scene)
{
    for (size_t k = 0; k < hd_record_count(record); k++) {
        const hd_bump *bump = hd_record_entry(record, k);
        const double i = bump->i, j = bump->j,
                     n2 = bump->n[0] * bump->n[0] + bump->n[1] * bump->n[1];
        if (!(i >= 0 && i < scene->number && i == floor(i)))
            return "an entry names a dumbbell that does not exist";
        if (!(j == -1 || (j > i && j < scene->number && j == floor(j))))
            return "an entry names a partner that does not exist";
        if (!(fabs(n2 - 1.0) <= 8.0 * DBL_EPSILON))
            return "a normal vector has a length other than 1";
    }
    return NULL;
}

const hd_dynamics hd_dumbbells_row = {.particles = "dumbbells",
                                      .dimension = 2,
                                      .coordinates = 3,
                                      .entry = sizeof(hd_bump),
                                      .symplectic = true,
                                      .paces = true,
                                      .collides = true,
                                      .parameter = hd_dumbbell_own,
                                      .parameters = HD_DUMBBELL_OWN,
                                      .fluid = &hd_fluid_dumbbells,
                                      .check = row_check,
                                      .zeros = hd_hard_zeros,
                                      .entries = hd_hard_entries,
                                      .rate = hd_hard_rate,
                                      .null = hd_null_space_fill,
                                      .inertia = hd_dumbbell_inertia,
                                      .size = hd_dumbbell_size,
                                      .create = hd_dumbbells_create,
                                      .free = hd_dumbbells_free,
                                      .advance = hd_dumbbells_advance,
                                      .time = hd_hard_time,
                                      .state = row_state,
                                      .totals = hd_hard_totals,
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
