/** Scene -> record: event-driven motion of hard dumbbells between periodic or reflecting edges, by
 * the scheme of dynamics/hard/hard.c: every dumbbell keeps the state of its last event, and
 * predictions depend on these states alone. A contact is a reflection in the space of all
 * coordinates [T23]. One thread computes this, with + - * / sqrt and comparisons only, so that all
 * machines give the same bits. */
#include "dynamics/dumbbells/dumbbells.h"

#include <float.h>
#include <math.h>
#include <zlib.h>

#include "base/check.h"
#include "base/memory.h"
#include "scene/container.h"
#include "scene/dynamics.h"
#include "scene/null_space.h"
#include "scene/scene.h"

/** Largest momentum and angular velocity. A faster dumbbell would move so far in one epoch that its
 * position or angle would lose digits. */
static const double FASTEST = 1e6;

enum { SAID = 96 };

/* ---- gaps ---------------------------------------------------------------------------------- */

/** r: at time t, the vector from one disk of dumbbell pair[0] to one of pair[1] shifted by `shift`.
 * arms: the vectors from the centres to these disks. */
static void between(double r[2], const hd_molecules *m, const int32_t pair[2],
                    const double shift[2], double t, const double arms[2][2])
{
    hd_contact_separation(r, &m->hard.motion.disk[pair[0]], &m->hard.motion.disk[pair[1]], shift,
                          t);
    for (int d = 0; d < 2; d++) r[d] += arms[1][d] - arms[0][d];
}

static double least_between(const hard *centres, int32_t i, int32_t j, const double shift[2])
{
    const hd_molecules *m = (const hd_molecules *)centres;
    const double t = centres->now - centres->epoch_start;
    const int32_t pair[2] = {i, j};
    double least = INFINITY;
    if (j <= i) return least;
    for (int which = 0; which < HD_MEETS; which++) {
        double arms[2][2], r[2];
        for (int k = 0; k < 2; k++) hd_arm_at(arms[k], m, pair[k], which >> k & 1, t);
        between(r, m, pair, shift, t, (const double(*)[2])arms);
        least = fmin(least, sqrt(hd_contact_dot(r, r)) - 1.0);
    }
    return least;
}

static double least_at_walls(const hd_molecules *m, int32_t i, double t)
{
    double arm[2], least = INFINITY;
    hd_arm_at(arm, m, i, 0, t);
    for (int d = 0; d < 2; d++) {
        const double at = m->hard.motion.disk[i].q[d] +
                          m->hard.motion.disk[i].p[d] * (t - m->hard.motion.disk[i].t),
                     reach = 0.5 + fabs(arm[d]);
        if (m->hard.motion.cells.boundary[d] != HD_REFLECTING) continue;
        least = fmin(least, fmin(at - reach, m->hard.motion.cells.box[d] - reach - at));
    }
    return least;
}

/** The smallest gap now, between two dumbbells (images, too) or at a wall. Gaps beyond the
 * neighbouring cells are not seen. */
static double gap_of(const hd_molecules *m)
{
    double least = hd_hard_least(&m->hard, least_between);
    for (int32_t i = 0; i < m->hard.motion.count; i++)
        least = fmin(least, least_at_walls(m, i, m->hard.now - m->hard.epoch_start));
    return least;
}

/** See hd_invariants.overlap_rounding. It grows with the fastest rotation. */
static double rounding_of(const hd_molecules *m)
{
    double fastest = 0.0;
    for (int32_t i = 0; i < m->hard.motion.count; i++) fastest = fmax(fastest, fabs(m->spin[i].p));
    return hd_meeting_depth(m, 2.0 * fastest / m->shape.root);
}

/* ---- bodies -------------------------------------------------------------------------------- */

typedef hd_bump hd_entry;
typedef hd_molecules hd_bodies;
enum { HD_HALF = 3 };

static hd_status prepare(hd_molecules *m, const hd_scene_def *def)
{
    double longest = 0.0;
    m->shape.arm = 0.5 * hd_dumbbell_bond(def);
    m->shape.root = sqrt(hd_dumbbell_inertia(def));
    m->shape.turn = 6.28318530717958647693 * m->shape.root;
    m->spin = hd_memory_alloc((size_t)def->number, sizeof *m->spin);
    m->which = hd_memory_alloc((size_t)def->number, sizeof *m->which);
    HD_TRY(hd_hard_prepare(&m->hard, def, 1.0 + 2.0 * m->shape.arm));
    for (int d = 0; d < 2; d++) longest = fmax(longest, m->hard.motion.cells.box[d]);
    m->rounding = fmax(1e-13, hd_overlap_rounding(longest, m->hard.epoch_length));
    return m->spin && m->which ? HD_OK : HD_NO_MEMORY;
}

static double momenta_of(const hd_molecules *m, int32_t i)
{
    return fabs(m->hard.motion.disk[i].p[0]) + fabs(m->hard.motion.disk[i].p[1]) +
           fabs(m->spin[i].p);
}

static hd_status start(hd_molecules *m, const double *q, const double *p)
{
    hd_motion *centres = &m->hard.motion;
    for (int32_t i = 0; i < centres->count; i++, q += 3, p += 3) {
        for (int d = 0; d < 2; d++) {
            centres->disk[i].q[d] = q[d];
            centres->disk[i].p[d] = p[d];
            if (!(q[d] >= 0 && q[d] <= centres->cells.box[d])) return HD_REFUSED;
        }
        m->spin[i] = (hd_spin){hd_one_turn(m, q[2]), p[2]};
        if (!(momenta_of(m, i) <= FASTEST * fmax(1.0, m->shape.root)) || !isfinite(q[2]))
            return HD_REFUSED;
        if (!(fabs(p[2]) <= FASTEST * m->shape.root)) return HD_REFUSED;
        hd_cells_add(&centres->cells, centres->disk, i);
    }
    if (-gap_of(m) > fmax(HD_OVERLAP_MAX, rounding_of(m))) return HD_OVERLAP;
    hd_next_restart(m);
    return HD_OK;
}

static void release(hd_molecules *m)
{
    hd_hard_clear(&m->hard);
    hd_memory_free(m->spin);
    hd_memory_free(m->which);
    hd_memory_free(m);
}

static hd_status lattice(const hd_scene_def *def, double *q)
{
    hd_dumbbell_start(def, q);
    return HD_OK;
}

static bool finish(hd_molecules *m, int32_t i, double t)
{
    const hd_disk *disk = &m->hard.motion.disk[i];
    hd_molecule_move_to(m, i, t);
    hd_molecule_fold(m, i);
    return isfinite(disk->q[0] + disk->q[1] + m->spin[i].q + momenta_of(m, i));
}

static bool rests(const hd_molecules *m, int32_t i) { return momenta_of(m, i) == 0; }
static void renew(hd_molecules *m, int32_t i) { hd_next_renew(m, i); }

static void extend(hd_molecules *m, int32_t i, int d, int side) { hd_next_extend(m, i, d, side); }

#include "dynamics/hard/scheme.h"

/* ---- contacts ------------------------------------------------------------------------------ */

/** Fills the members of an event that belong to dumbbell i, at index k; arm: that of its disk. */
static void turn_fill(hd_bump *bump, const hd_molecules *m, int k, int32_t i, const double arm[2])
{
    bump->per_root = 1.0 / m->shape.root;
    bump->spin[k] = m->spin[i].p;
    bump->across[k] = (bump->n[1] * arm[0] - bump->n[0] * arm[1]) / m->shape.root;
    bump->along[k] = (bump->n[0] * arm[0] + bump->n[1] * arm[1]) / m->shape.root;
}

/** The factor of the gradient in the exchanged momentum, for a gap that changes at `rate`; square:
 * that of the gradient. If the gap closes so slowly that the momenta round by more, *meets is
 * false and there is no event, but the dumbbells are pushed apart by more than rounding: otherwise
 * they might meet again at once, forever. */
static double exchanged(bool *meets, double rate, double square, double momenta)
{
    const double lost = 8.0 * DBL_EPSILON * momenta;
    *meets = rate < -lost;
    return *meets ? -2.0 * rate / square : rate < 0 ? (lost - rate) / square : 0.0;
}

static void push(hd_molecules *m, int32_t i, double by, const double n[2], double across)
{
    for (int d = 0; d < 2; d++) m->hard.motion.disk[i].p[d] += by * n[d];
    m->spin[i].p += by * across;
    m->hard.motion.disk[i].collisions++;
    hd_molecule_fold(m, i);
}

/** Moves two dumbbells to their contact, where they exchange momentum. */
static hd_status collide(hd_molecules *m, hd_record *record, hd_bump *bump, int32_t finder,
                         double t)
{
    const prediction *how = &m->hard.motion.predicted[finder];
    const int32_t which = m->which[finder];
    const int32_t pair[2] = {(int32_t)bump->i, (int32_t)bump->j};
    const double sign = finder == pair[0] ? 1.0 : -1.0; /* the image is relative to the finder */
    double arms[2][2], shift[2], r[2], turning = 0.0;
    for (int d = 0; d < 2; d++) shift[d] = sign * how->image[d] * m->hard.motion.cells.box[d];
    for (int k = 0; k < 2; k++) {
        hd_molecule_move_to(m, pair[k], t);
        hd_arm_at(arms[k], m, pair[k], which >> k & 1, t);
        turning += fabs(m->spin[pair[k]].p / m->shape.root);
    }
    between(r, m, pair, shift, t, (const double(*)[2])arms);
    const double distance = sqrt(hd_contact_dot(r, r));
    for (int d = 0; d < 2; d++) {
        bump->n[d] = r[d] / distance;
        bump->p[d] = m->hard.motion.disk[pair[1]].p[d] - m->hard.motion.disk[pair[0]].p[d];
    }
    for (int k = 0; k < 2; k++) turn_fill(bump, m, k, pair[k], arms[k]);
    if (distance - 1.0 < -m->hard.overlap_max - hd_meeting_depth(m, turning)) return HD_OVERLAP;
    const double rate = hd_contact_dot(bump->n, bump->p) + bump->across[1] * bump->spin[1] -
                        bump->across[0] * bump->spin[0];
    const double square = 2.0 * hd_contact_dot(bump->n, bump->n) +
                          bump->across[0] * bump->across[0] + bump->across[1] * bump->across[1];
    bool meets;
    const double by = exchanged(&meets, rate, square,
                                momenta_of(m, pair[0]) + momenta_of(m, pair[1]));
    for (int k = 0; k < 2; k++) push(m, pair[k], (2 * k - 1) * by, bump->n, bump->across[k]);
    m->hard.collisions += meets;
    for (int d = 0; d < 2 && meets; d++)
        m->hard.virial[d] += by * bump->n[d] * (r[d] - arms[1][d] + arms[0][d]);
    hd_next_renew(m, finder);
    hd_next_renew(m, pair[0] + pair[1] - finder);
    return meets ? put(record, bump) : HD_OK;
}

/** Reflects a dumbbell, one of whose disks meets a wall. */
static hd_status reflect(hd_molecules *m, hd_record *record, hd_bump *bump, int32_t i, double t)
{
    const int d = -1 - m->hard.motion.predicted[i].partner, which = m->which[i];
    double arm[2];
    hd_molecule_move_to(m, i, t);
    hd_arm_at(arm, m, i, which & 1, t);
    bump->j = -1.0;
    bump->n[d] = which >> 1 ? -1.0 : 1.0;
    for (int e = 0; e < 2; e++) bump->p[e] = m->hard.motion.disk[i].p[e];
    turn_fill(bump, m, 0, i, arm);
    const double rate = hd_contact_dot(bump->n, bump->p) + bump->across[0] * bump->spin[0];
    bool meets;
    const double by = exchanged(&meets, rate, 1.0 + bump->across[0] * bump->across[0],
                                momenta_of(m, i));
    push(m, i, by, bump->n, bump->across[0]);
    m->hard.wall_events += meets;
    if (meets) m->hard.virial[d] -= by * bump->n[d] * arm[d];
    hd_next_renew(m, i);
    return meets ? put(record, bump) : HD_OK;
}

static hd_status row_advance(void *state, hd_record *record, double t_end)
{
    return advance(state, record, t_end);
}

/* ---- scene --------------------------------------------------------------------------------- */

/** Checks that the container is a rectangle, so long that no dumbbell can meet its own image. */
static hd_status check_box(const hd_scene_def *scene, char *message, size_t size)
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
    HD_TRY(check_box(scene, message, size));
    if (hd_dumbbell_start_gap(scene) >= HD_START_DISTANCE_MIN - 1.0) return HD_OK;
    hd_container_of(scene)->say(scene, said, sizeof said);
    return hd_refuse(message, size,
                     "density = %.15g (packing fraction %.4g): must be at most %.6g with number = "
                     "%d, bond = %.15g, %s (densest start lattice)",
                     scene->density, hd_scene_packing(scene), hd_dumbbell_density_max(scene),
                     scene->number, hd_dumbbell_bond(scene), said);
}

/* ---- creation ------------------------------------------------------------------------------ */

static void row_free(void *state)
{
    if (state) release(state);
}

hd_status hd_dumbbells_create_from(void **state, const hd_scene_def *def, const double *q,
                                   const double *p)
{
    *state = NULL;
    HD_TRY(hd_scene_check_box(def, NULL, 0));
    HD_TRY(check_box(def, NULL, 0));
    return create_at(state, def, q, p);
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

static double overlap_max(const hd_molecules *m) { return fmax(HD_OVERLAP_MAX, rounding_of(m)); }

static void row_examine(const void *state, hd_invariants *out)
{
    const hd_molecules *m = state;
    const double kinetic = row_kinetic_energy(m);
    *out = (hd_invariants){.kinetic_energy = kinetic,
                           .energy_error = kinetic / m->hard.motion.count - 1.0,
                           .overlap = fmax(0.0, -gap_of(m)),
                           .overlap_rounding = rounding_of(m),
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
    if (!fault && -gap_of(m) > overlap_max(m)) fault = "dumbbells overlap";
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
                                      .scale_invariant = true,
                                      .collides = true,
                                      .parameter = hd_dumbbell_own,
                                      .parameters = HD_DUMBBELL_OWN,
                                      .fluid = &hd_fluid_dumbbells,
                                      .check = row_check,
                                      .zero_exponents = hd_hard_zeros,
                                      .record_rate = hd_hard_entries,
                                      .collision_rate = hd_hard_rate,
                                      .null_vectors = hd_null_space_fill,
                                      .inertia = hd_dumbbell_inertia,
                                      .sites = hd_dumbbell_sites,
                                      .size = hd_dumbbell_size,
                                      .create = create_on_lattice,
                                      .free = row_free,
                                      .advance = row_advance,
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
