/** What dumbbells.c, which moves them, has for dumbbells_row.c, which tells and keeps. */
#ifndef HD_DUMBBELLS_STATE_H
#define HD_DUMBBELLS_STATE_H

#include "dynamics/dumbbells/molecules.h"
#include "dynamics/dynamics.h"

/** Of all gaps and images now, the smallest; at most what cells reach. */
double hd_dumbbells_gap(const hd_molecules *m);
/** More than rounding makes of an overlap, see hd_examined: the faster they turn, the more. */
double hd_dumbbells_rounding(const hd_molecules *m);

/** A rectangle, and a molecule that could meet its own image is no pair. */
HD_MUST_CHECK hd_status hd_dumbbells_check_box(const hd_scene_def *scene, char *message,
                                               size_t size);
HD_MUST_CHECK hd_status hd_dumbbells_create(void **state, const hd_scene_def *def);
HD_MUST_CHECK hd_status hd_dumbbells_create_from(void **state, const hd_scene_def *def,
                                                 const double *q, const double *p);
void hd_dumbbells_free(void *state);
HD_MUST_CHECK hd_status hd_dumbbells_advance(void *state, hd_record *record, double t_end);

#endif
