/** What the state of hard bodies holds: hard.c moves them, hard_row.c tells, hard_archive.c keeps.
 * Of other bodies than disks and spheres this is what their centres do, and stands first in their
 * state. */
#ifndef HD_HARD_H
#define HD_HARD_H

#include <math.h>

#include "dynamics/dynamics.h"
#include "dynamics/hard/disk.h"
#include "dynamics/hard/prediction.h"

typedef struct hard {
    hd_motion motion;
    double epoch_length;
    double overlap_max; /**< see hd_trajectory_overlap_max */
    double epoch_start; /**< simulated time, a multiple of epoch_length */
    double now;         /**< simulated time */
    uint64_t collisions, wall_events;
    double virial[HD_DIM]; /**< of the collisions */
} hard;

/* ---- of any bodies ------------------------------------------------------------------------- */

/** Room, and cells for centres that meet within `reach`. */
HD_MUST_CHECK hd_status hd_hard_prepare(hard *tr, const hd_scene_def *def, double reach);
/** All but itself. */
void hd_hard_clear(hard *tr);
/** Of all pairs and images the least `of`, of j seen `shift` away from where it is; asked twice for
 * each pair. */
double hd_hard_least(const hard *tr, double (*of)(const hard *tr, int32_t i, int32_t j,
                                                  const double shift[HD_DIM]));
/** Fills energy_rounding, momentum, angular_momentum. */
void hd_hard_examine(const hard *tr, hd_examined *examined);
/** Fills what is kept of centres; cells follow. */
void hd_hard_keep(hard *tr, hd_archive *archive);
/** What the numbers are not, or NULL. Of a scene: the energy is N. */
const char *hd_hard_inconsistency(const hard *tr, double energy);

/* Entries of the row: see hd_dynamics. */

double hd_hard_time(const void *state);
void hd_hard_tell(const void *state, hd_told *told);
int hd_hard_zeros(const hd_scene_def *def);
double hd_hard_rate(const hd_scene_def *def);
double hd_hard_entries(const hd_scene_def *def);
double hd_hard_bytes(const hd_scene_def *scene);
uint32_t hd_hard_fingerprint(const void *state);

/* ---- of disks and spheres ------------------------------------------------------------------ */

HD_MUST_CHECK hd_status hd_hard_create(void **state, const hd_scene_def *def);
HD_MUST_CHECK hd_status hd_hard_create_from(void **state, const hd_scene_def *def, const double *q,
                                            const double *p);
void hd_hard_free(void *state);
HD_MUST_CHECK hd_status hd_hard_advance(void *state, hd_record *record, double t_end);
void hd_hard_archive(void *state, hd_archive *archive);

/** See hd_trajectory_overlap and hd_trajectory_overlap_rounding. */
double hd_hard_overlap(const hard *tr);
double hd_hard_overlap_rounding(const hard *tr);

/** Sum p^2 / 2 of all. */
double hd_hard_kinetic_energy(const void *state);

#endif
