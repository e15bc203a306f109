/** The state of hard particles <-> checkpoint. Only the disks are kept: cells, queue and
 * predictions follow from them (see hard.c). */
#include <math.h>
#include <stdbool.h>
#include <zlib.h>

#include "dynamics/hard/hard.h"

/** A checkpoint whose disk has gone around the box more often than this in one epoch is refused; no
 * speed allows it. */
enum { WRAP_MAX = 1 << 24 };
/** How far a disk may be outside its cell (in a long box, whose coordinates round by more, it may
 * be overlap_max), and how far the energy per particle may be off 1: each collision changes the
 * energy by 1e-16 of it, at random. */
static const double PLACE_CLOSE = 1e-6, ENERGY_CLOSE = 1e-6;

static void disks_archive(hard *tr, hd_archive *archive)
{
    const size_t n = (size_t)tr->motion.count;
    hd_archive_of_doubles(archive, "trajectory q p t", (2 * HD_DIM + 1) * n);
    for (size_t i = 0; i < n; i++) {
        hd_archive_next_doubles(archive, tr->motion.disk[i].q, HD_DIM);
        hd_archive_next_doubles(archive, tr->motion.disk[i].p, HD_DIM);
        hd_archive_next_doubles(archive, &tr->motion.disk[i].t, 1);
    }
    hd_archive_of_ints(archive, "trajectory wrap cell", 2 * HD_DIM * n);
    for (size_t i = 0; i < n; i++)
        for (int d = 0; d < HD_DIM; d++) {
            hd_archive_next_int(archive, &tr->motion.disk[i].wrap[d], -WRAP_MAX, WRAP_MAX);
            hd_archive_next_int(archive, &tr->motion.disk[i].cell[d], 0,
                                tr->motion.cells.size[d] - 1);
        }
}

static bool in_its_cell(const hard *tr, const hd_disk *disk)
{
    const double close = fmax(PLACE_CLOSE, tr->overlap_max);
    double at[HD_DIM];
    for (int d = 0; d < HD_DIM; d++) {
        const hd_cell_line *line = &tr->motion.cells.line[d][disk->cell[d]];
        const double radius = hd_sizes_radius(&tr->motion.sizes, disk);
        const double flight = disk->p[d] * (tr->now - tr->epoch_start - disk->t);
        const double place = disk->q[d] + flight - disk->wrap[d] * tr->motion.cells.box[d];
        at[d] = place;
        if (!(place >= hd_cell_line_end(line, 0, radius) - close)) return false;
        if (!(place <= hd_cell_line_end(line, 1, radius) + close)) return false;
    }
    const hd_wall *wall = hd_motion_wall(&tr->motion, disk);
    return !wall->excess || wall->excess(wall, at) <= close;
}

const char *hd_hard_inconsistency(const hard *tr, double energy)
{
    const double since = tr->now - tr->epoch_start;
    if (!(tr->epoch_start >= 0 && since >= 0 && since <= tr->epoch_length))
        return "the time is outside the epoch from which event times count";
    for (int32_t i = 0; i < tr->motion.count; i++) {
        const hd_disk *disk = &tr->motion.disk[i];
        if (!(disk->t >= 0 && disk->t <= since))
            return "a particle has a later time than the trajectory";
        if (!in_its_cell(tr, disk)) return "a particle is not in its cell";
    }
    const double excess = energy - tr->motion.count;
    return fabs(excess) <= ENERGY_CLOSE * tr->motion.count
               ? NULL
               : "the kinetic energy is not 1 per particle";
}

static void book(hard *tr)
{
    hd_cells_empty(&tr->motion.cells);
    for (int32_t i = 0; i < tr->motion.count; i++)
        hd_cells_book(&tr->motion.cells, tr->motion.disk, i);
}

void hd_hard_predict(hard *tr)
{
    hd_queue_restart(&tr->motion.queue);
    for (int32_t i = 0; i < tr->motion.count; i++) hd_prediction_renew(&tr->motion, i);
}

static void flow_archive(hd_flow *flow, hd_archive *archive)
{
    hd_archive_doubles(archive, "trajectory flow", flow->sum, HD_FLOW_SUMS);
    const double *near = flow->sum + HD_FLOW_NEAR;
    hd_archive_expect(archive, near[0] >= 0 && near[1] >= 0 && flow->sum[HD_FLOW_VOLUME] > 0,
                      "trajectory flow", "a time, or a volume, is negative");
}

void hd_hard_keep(hard *tr, hd_archive *archive)
{
    hd_archive_double(archive, "trajectory epoch start", &tr->epoch_start);
    hd_archive_double(archive, "trajectory time", &tr->now);
    hd_archive_bits(archive, "trajectory collisions", &tr->collisions);
    hd_archive_bits(archive, "trajectory wall events", &tr->wall_events);
    static const char *const of[] = {"trajectory collisions 11", "trajectory collisions 12",
                                     "trajectory collisions 22"};
    for (int k = 0; HD_MIXED && k < 3; k++) hd_archive_bits(archive, of[k], &tr->collisions_of[k]);
    hd_archive_doubles(archive, "trajectory virial", tr->virial, HD_DIM);
    if (tr->flow.wall) flow_archive(&tr->flow, archive);
    disks_archive(tr, archive);
    if (!archive->writing && hd_archive_good(archive)) book(tr);
}

void hd_hard_archive(void *state, hd_archive *archive)
{
    hard *tr = state;
    hd_hard_keep(tr, archive);
    if (!hd_archive_good(archive)) return;
    const char *fault = hd_hard_inconsistency(tr, hd_hard_kinetic_energy(tr));
    if (!fault && hd_hard_overlap(tr) > tr->overlap_max) fault = "disks overlap";
    if (fault) hd_archive_refuse(archive, "trajectory", fault);
    if (!archive->writing && hd_archive_good(archive)) hd_hard_predict(tr);
}

uint32_t hd_hard_fingerprint(const void *state)
{
    const hard *tr = state;
    uLong crc = 0;
    for (int i = 0; i < tr->motion.count; i++) {
        const hd_disk *disk = &tr->motion.disk[i];
        crc = crc32_z(crc, (const Bytef *)disk->q, sizeof disk->q);
        crc = crc32_z(crc, (const Bytef *)disk->p, sizeof disk->p);
    }
    return (uint32_t)crc;
}
