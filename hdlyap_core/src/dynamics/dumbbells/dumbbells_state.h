/** What the state of dumbbells holds, for the files that make it up: dumbbells.c moves them,
 * dumbbells_row.c tells and keeps. */
#ifndef HD_DUMBBELLS_STATE_H
#define HD_DUMBBELLS_STATE_H

#include <math.h>

#include "dynamics/dumbbells/molecules.h"
#include "dynamics/dynamics.h"

typedef struct dumbbells {
    hd_molecules m;
    double overlap_max;      /**< see hd_examined */
    double epoch_start, now; /**< simulated time; the first is a multiple of the epoch's length */
    uint64_t collisions, wall_events;
    double virial[2];
} dumbbells;

static inline void hd_molecule_move_to(hd_molecules *m, int32_t i, double t)
{
    hd_disk *disk = &m->disk[i];
    for (int d = 0; d < 2; d++) disk->q[d] += disk->p[d] * (t - disk->t);
    m->spin[i].q += m->spin[i].p * (t - disk->t);
    disk->t = t;
}

/** Back into the box, and into one turn; the cell that it is booked in stays. */
static inline void hd_molecule_fold(hd_molecules *m, int32_t i)
{
    hd_disk *disk = &m->disk[i];
    for (int d = 0; d < 2; d++) {
        if (m->cells.boundary[d] != HD_PERIODIC) continue;
        const double turns = floor(disk->q[d] / m->cells.box[d]);
        disk->q[d] -= turns * m->cells.box[d];
        disk->wrap[d] -= (int32_t)turns;
    }
    m->spin[i].q -= floor(m->spin[i].q / m->shape.turn + 0.5) * m->shape.turn;
}

/** Of all gaps and images now, the smallest; at most what cells reach. */
double hd_dumbbells_gap(const dumbbells *all);

HD_MUST_CHECK hd_status hd_dumbbells_create(void **state, const hd_scene_def *def);
HD_MUST_CHECK hd_status hd_dumbbells_create_from(void **state, const hd_scene_def *def,
                                                 const double *q, const double *p);
void hd_dumbbells_free(void *state);
HD_MUST_CHECK hd_status hd_dumbbells_advance(void *state, hd_record *record, double t_end);

#endif
