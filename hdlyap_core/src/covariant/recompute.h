/** Triangles that are not kept but computed again, from some frames that are kept and the events
 * after each. */
#ifndef HD_RECOMPUTE_H
#define HD_RECOMPUTE_H

#include <stdbool.h>

#include "hdlyap/frame.h"
#include "dynamics/dynamics.h"

/** Slots 0 .. slots - 1 are used in turn, as a ring. */
typedef struct hd_recompute hd_recompute;

/** The number of slots between kept frames for which frames and triangles together take least
 * memory. */
long hd_recompute_stretch(long slots, int rows, int vectors);

typedef struct hd_recompute_def {
    const hd_dynamics *of;
    int rows, vectors, threads;
    bool conjugate;      /**< half of the vectors are carried: a triangle is R and Y [T18] */
    long slots, stretch; /**< a frame is kept for every `stretch` slots, which divides `slots` */
    double events;       /**< number of events with which it is full */
} hd_recompute_def;

/** Bytes that it takes at most. */
double hd_recompute_bytes(const hd_recompute_def *def);

HD_MUST_CHECK hd_status hd_recompute_create(hd_recompute **out, const hd_recompute_def *def);
void hd_recompute_free(hd_recompute *recompute);

/** True if a stretch begins with this slot, so that its frame is kept. */
bool hd_recompute_keeps(const hd_recompute *recompute, long slot);
/** Keeps the frame at the slot's start, if hd_recompute_keeps. Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_recompute_frame(hd_recompute *recompute, long slot, hd_columns columns);
/** Keeps the slot's events: those of the record from t_begin to t_end. Fails with HD_NO_MEMORY, or
 * HD_NO_ROOM if the interval has far more events than expected. */
HD_MUST_CHECK hd_status hd_recompute_events(hd_recompute *recompute, long slot,
                                            const hd_record *record, double t_begin, double t_end);
double hd_recompute_events_kept(const hd_recompute *recompute);
/** True if there are more events than `events`. */
bool hd_recompute_is_full(const hd_recompute *recompute);
/** Forgets the stretches before the one of this slot. */
void hd_recompute_forget(hd_recompute *recompute, long slot);

/** Fills in the slot's R [n * n], row-major, and Y [n * n] (NULL if all vectors are carried), both
 * from the diagonal on. Computes those of its stretch up to slot `last` with it. Fails with
 * HD_ILL_CONDITIONED or HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_recompute_factor(hd_recompute *recompute, double *factor,
                                            double *coupling, long slot, long last);

#endif
