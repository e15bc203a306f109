/** The state of hard particles. hard.c moves disks and spheres, hard_row.c answers questions about
 * the state, hard_archive.c keeps it in a checkpoint. Dumbbells have this struct as the first
 * member of their state, for their centres. */
#ifndef HD_HARD_H
#define HD_HARD_H

#include <math.h>

#include "dynamics/create_from.h"
#include "dynamics/dynamics.h"
#include "dynamics/hard/disk.h"
#include "dynamics/hard/flow.h"
#include "dynamics/hard/prediction.h"

typedef struct hard {
    hd_motion motion;
    double epoch_length;
    double overlap_max; /**< see hd_invariants */
    double epoch_start; /**< simulated time, a multiple of epoch_length */
    double now;         /**< simulated time */
    uint64_t collisions, wall_events;
    uint64_t collisions_of[3]; /**< see hd_totals; of disks of two kinds */
    double virial[HD_DIM];     /**< sum over collisions; see hd_totals */
    hd_flow flow;              /**< of disks of one kind alone */
} hard;

/* ---- for all hard particles ---------------------------------------------------------------- */

/** Allocates disks, predictions, queue and cells; centres meet within a distance `reach`. Fails
 * with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_hard_prepare(hard *tr, const hd_scene_def *def, double reach);
/** Frees all that hd_hard_prepare has allocated, but not tr itself. */
void hd_hard_clear(hard *tr);
/** The least value of `of` over all pairs in neighbouring cells, with j moved by `shift` to the
 * image that i sees. Each pair is computed twice, once from either side, and i = j is one, too. */
double hd_hard_least(const hard *tr, double (*of)(const hard *tr, int32_t i, int32_t j,
                                                  const double shift[HD_DIM]));
/** The same over pairs with disk i. */
double hd_hard_least_of(const hard *tr, int32_t i,
                        double (*of)(const hard *tr, int32_t i, int32_t j,
                                     const double shift[HD_DIM]));
/** Fills energy_rounding, momentum and angular_momentum. */
void hd_hard_examine(const hard *tr, hd_invariants *examined);
/** Writes or reads time, counters and the states of disks; reading fills the cells, too. */
void hd_hard_keep(hard *tr, hd_archive *archive);
/** Returns what is wrong with the state, or NULL. A scene's energy has to be its number of
 * particles. */
const char *hd_hard_inconsistency(const hard *tr, double energy);

/* Entries of the row: see hd_dynamics. */

double hd_hard_time(const void *state);
void hd_hard_totals(const void *state, hd_totals *totals);
int hd_hard_zeros(const hd_scene_def *def);
double hd_hard_rate(const hd_scene_def *def);
double hd_hard_entries(const hd_scene_def *def);

/** A rate, and how often in a time unit one of the largest particles meets flat walls. */
double hd_hard_with_walls(const hd_scene_def *def, double rate);
double hd_hard_bytes(const hd_scene_def *scene);
uint32_t hd_hard_fingerprint(const void *state);

/* ---- for disks and spheres ----------------------------------------------------------------- */

HD_MUST_CHECK hd_status hd_hard_create(void **state, const hd_scene_def *def);
HD_MUST_CHECK hd_status hd_hard_create_empty(void **state, const hd_scene_def *def);
void hd_hard_free(void *state);
HD_MUST_CHECK hd_status hd_hard_advance(void *state, hd_record *record, double t_end);
void hd_hard_archive(void *state, hd_archive *archive);
void hd_hard_state(const void *state, double *q, double *p);
/** Predicts all events anew. */
void hd_hard_predict(hard *tr);

/** See hd_invariants.overlap and hd_invariants.overlap_rounding. */
double hd_hard_overlap(const hard *tr);
double hd_hard_overlap_rounding(const hard *tr);

/** Sum of p^2 / 2 over all disks. */
double hd_hard_kinetic_energy(const void *state);

#endif
