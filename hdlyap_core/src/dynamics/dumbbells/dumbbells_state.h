/** Functions of dumbbells.c, which moves dumbbells, that dumbbells_row.c uses. */
#ifndef HD_DUMBBELLS_STATE_H
#define HD_DUMBBELLS_STATE_H

#include "dynamics/create_from.h"
#include "dynamics/dumbbells/molecules.h"
#include "dynamics/dynamics.h"

/** The smallest gap now, between two dumbbells (images, too) or at a wall. Gaps beyond the
 * neighbouring cells are not seen. */
double hd_dumbbells_gap(const hd_molecules *m);
/** See hd_examined.overlap_rounding. It grows with the fastest rotation. */
double hd_dumbbells_rounding(const hd_molecules *m);

/** Checks that the container is a rectangle, so long that no dumbbell can meet its own image. */
HD_MUST_CHECK hd_status hd_dumbbells_check_box(const hd_scene_def *scene, char *message,
                                               size_t size);
HD_MUST_CHECK hd_status hd_dumbbells_create(void **state, const hd_scene_def *def);
void hd_dumbbells_free(void *state);
HD_MUST_CHECK hd_status hd_dumbbells_advance(void *state, hd_record *record, double t_end);

#endif
