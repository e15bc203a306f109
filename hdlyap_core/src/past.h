/** What the forward pass leaves for the way back: the triangle of each interval, and the vectors of
 * chosen times. */
#ifndef HD_PAST_H
#define HD_PAST_H

#include <stdbool.h>

#include "hdlyap/frame.h"

/** Where triangles are kept. */
typedef struct hd_past_def {
    int disks, vectors, threads;
    long intervals;     /**< of which triangles are kept, at most */
    long snapshots;     /**< at most */
    bool recompute;     /**< triangles are computed again instead of being kept */
    const char *folder; /**< of a file for what is kept; NULL: in memory */
} hd_past_def;

/** Bytes that it keeps at most; of recomputed ones without the events, some tens of bytes each. */
double hd_past_bytes(const hd_past_def *def);

typedef struct hd_past hd_past;

/** HD_NO_MEMORY, HD_FILE_FAULT (errno). */
HD_MUST_CHECK hd_status hd_past_create(hd_past **out, const hd_past_def *def);
void hd_past_free(hd_past *past);

/** Forgets everything; the frame is that of the start. */
HD_MUST_CHECK hd_status hd_past_begin(hd_past *past, hd_columns frame, double time);

/** What an orthonormalisation leaves: R of the interval from t_begin to t_end of the log, and the
 * frame after it. There must be room (hd_past_is_full). */
HD_MUST_CHECK hd_status hd_past_add(hd_past *past, const double *factor, hd_columns frame,
                                    const hd_event_log *log, double t_begin, double t_end);
bool hd_past_is_full(const hd_past *past);

/** Keeps the frame and the state of the end of the last interval: q[2N], p[2N]. */
HD_MUST_CHECK hd_status hd_past_snapshot(hd_past *past, hd_columns frame, const double *q,
                                         const double *p);

/** Forgets the intervals that end at or before that time. */
void hd_past_drop(hd_past *past, double time);

/* Intervals are numbered since the beginning; those from first on, before end, are there. */

long hd_past_first(const hd_past *past);
long hd_past_end(const hd_past *past);
double hd_past_time(const hd_past *past, long interval); /**< of its end */
double hd_past_length(const hd_past *past, long interval);
bool hd_past_has_snapshot(const hd_past *past, long interval); /**< at its end */

/** R [n * n], row-major, of one interval. */
HD_MUST_CHECK hd_status hd_past_factor(hd_past *past, double *factor, long interval);
/** Vectors [4N * n] row-major, q[2N], p[2N] of a snapshot. */
HD_MUST_CHECK hd_status hd_past_vectors(hd_past *past, double *vectors, double *q, double *p,
                                        long interval);

#endif
