/** What the state of hard bodies holds, for the files that make it up: hard.c moves them,
 * hard_row.c tells, hard_archive.c keeps. */
#ifndef HD_HARD_STATE_H
#define HD_HARD_STATE_H

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

/* Entries of the row: see hd_dynamics. */

HD_MUST_CHECK hd_status hd_hard_create(void **state, const hd_scene_def *def);
HD_MUST_CHECK hd_status hd_hard_create_from(void **state, const hd_scene_def *def, const double *q,
                                            const double *p);
void hd_hard_free(void *state);
HD_MUST_CHECK hd_status hd_hard_advance(void *state, hd_record *record, double t_end);
double hd_hard_bytes(double disks);
double hd_hard_rate(const hd_scene_def *def);
double hd_hard_entries(const hd_scene_def *def);
void hd_hard_archive(void *state, hd_archive *archive);
uint32_t hd_hard_fingerprint(const void *state);

/** See hd_trajectory_overlap and hd_trajectory_overlap_rounding. */
double hd_hard_overlap(const hard *tr);
double hd_hard_overlap_rounding(const hard *tr);

/** Sum p^2 / 2 of all. */
double hd_hard_kinetic_energy(const void *state);

#endif
