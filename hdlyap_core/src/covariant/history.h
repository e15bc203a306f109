/** What the forward pass keeps for the way back: the triangle of each interval, and the vectors at
 * chosen times. */
#ifndef HD_HISTORY_H
#define HD_HISTORY_H

#include <stdbool.h>

#include "dynamics/dynamics.h"
#include "tangent/frame.h"

/** How much is kept. */
typedef struct hd_history_def {
    const hd_dynamics *of;
    int particles, vectors, threads;
    bool conjugate; /**< half of the vectors are carried: triangles are R and Y [T18] */
    long intervals; /**< most intervals whose triangles are kept */
    long snapshots; /**< most snapshots */
} hd_history_def;

/** Bytes that it takes at most. */
double hd_history_bytes(const hd_history_def *def);

typedef struct hd_history hd_history;

/** HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_history_create(hd_history **out, const hd_history_def *def,
                                          const hd_scene_def *scene);
void hd_history_free(hd_history *past);

/** Forgets everything and begins at this time. */
void hd_history_begin(hd_history *past, double time);

/** Adds an interval of the record, from t_begin to t_end: its R, and the frame that was replayed
 * through it. There must be room (hd_history_is_full). Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_history_add(hd_history *past, const double *factor,
                                       const hd_frame *frame, const hd_record *record,
                                       double t_begin, double t_end);
bool hd_history_is_full(const hd_history *past);

/** Keeps the frame, positions q and momenta p at the end of the last interval. */
HD_MUST_CHECK hd_status hd_history_snapshot(hd_history *past, hd_columns frame, const double *q,
                                            const double *p);

/** Forgets the intervals that end at or before that time. */
void hd_history_drop(hd_history *past, double time);

/* Intervals are numbered from the beginning; those from hd_history_first to before hd_history_end
 * are there. */

long hd_history_first(const hd_history *past);
long hd_history_end(const hd_history *past);
double hd_history_time(const hd_history *past, long interval); /**< of its end */
double hd_history_length(const hd_history *past, long interval);
bool hd_history_has_snapshot(const hd_history *past, long interval); /**< at its end */

/** Fills in R [n * n] and Y [n * n] (NULL if all vectors are carried) of one interval, row-major
 * from the diagonal on. */
void hd_history_factor(const hd_history *past, double *factor, double *coupling, long interval);
/** Fills in a snapshot: vectors [4N * n], row-major, or all [4N * 2n] if half are carried;
 * positions q and momenta p. */
void hd_history_vectors(const hd_history *past, double *vectors, double *q, double *p,
                        long interval);

#endif
