/** What the state of dumbbells holds, for the files that make it up: dumbbells.c moves them,
 * dumbbells_row.c tells and keeps. */
#ifndef HD_DUMBBELLS_STATE_H
#define HD_DUMBBELLS_STATE_H

#include <math.h>

#include "dynamics/dumbbells/molecules.h"
#include "dynamics/dynamics.h"

typedef struct dumbbells {
    hd_molecules m;
    double epoch_start, now; /**< simulated time; the first is a multiple of the epoch's length */
    uint64_t collisions, wall_events;
    double virial[2];
} dumbbells;

static inline void hd_molecule_move_to(hd_disk *disk, hd_spin *spin, double t)
{
    spin->q += spin->p * (t - disk->t);
    hd_disk_move_to(disk, t);
}

/** Back into the box, and into one turn; the cell that it is booked in stays. */
static inline void hd_molecule_fold(const hd_molecules *m, hd_disk *disk, hd_spin *spin)
{
    hd_cells_fold(&m->cells, disk);
    spin->q -= floor(spin->q / m->shape.turn + 0.5) * m->shape.turn;
}

/** More than rounding makes of an overlap, see hd_examined: the faster they turn, the more. */
double hd_dumbbells_rounding(const dumbbells *all);
/** Deeper than this is a fault: HD_OVERLAP_MAX, or what rounding makes where that is more. */
static inline double hd_dumbbells_overlap_max(const dumbbells *all)
{
    return fmax(HD_OVERLAP_MAX, hd_dumbbells_rounding(all));
}

/** A rectangle, and a molecule that could meet its own image is no pair. */
HD_MUST_CHECK hd_status hd_dumbbells_check_box(const hd_scene_def *scene, char *message,
                                               size_t size);
/** Of all gaps and images now, the smallest; at most what cells reach. */
double hd_dumbbells_gap(const dumbbells *all);

HD_MUST_CHECK hd_status hd_dumbbells_create(void **state, const hd_scene_def *def);
HD_MUST_CHECK hd_status hd_dumbbells_create_from(void **state, const hd_scene_def *def,
                                                 const double *q, const double *p);
void hd_dumbbells_free(void *state);
HD_MUST_CHECK hd_status hd_dumbbells_advance(void *state, hd_record *record, double t_end);

#endif
