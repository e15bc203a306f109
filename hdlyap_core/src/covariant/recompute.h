/** Triangles that are not kept but computed again, from frames kept here and there and the events
 * since. */
#ifndef HD_RECOMPUTE_H
#define HD_RECOMPUTE_H

#include <stdbool.h>

#include "hdlyap/frame.h"
#include "dynamics/dynamics.h"

/** Slots 0 .. slots - 1 are used in turn, as a ring. */
typedef struct hd_recompute hd_recompute;

/** The number of slots after which a frame should be kept for frames and triangles together to be
 * fewest. */
long hd_recompute_stretch(long slots, int rows, int vectors);

typedef struct hd_recompute_def {
    const hd_dynamics *of;
    int rows, vectors, threads;
    bool conjugate;      /**< half of the vectors are carried: a triangle is R and Y [T18] */
    long slots, stretch; /**< a frame is kept for every `stretch` slots, which divides `slots` */
    double events;       /**< with which it is full: entries */
} hd_recompute_def;

/** Bytes that it takes at most. */
double hd_recompute_bytes(const hd_recompute_def *def);

HD_MUST_CHECK hd_status hd_recompute_create(hd_recompute **out, const hd_recompute_def *def);
void hd_recompute_free(hd_recompute *recompute);

/** True if a slot begins with a frame that is kept: with a stretch. */
bool hd_recompute_keeps(const hd_recompute *recompute, long slot);
/** The frame where the slot begins, if it is kept. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_recompute_frame(hd_recompute *recompute, long slot, hd_columns columns);
/** The slot's events: those of the record from t_begin to t_end. HD_NO_MEMORY; HD_NO_ROOM for an
 * interval of far more events than there should be. */
HD_MUST_CHECK hd_status hd_recompute_events(hd_recompute *recompute, long slot,
                                            const hd_record *record, double t_begin, double t_end);
double hd_recompute_events_kept(const hd_recompute *recompute);
/** True with more events than there should be. */
bool hd_recompute_is_full(const hd_recompute *recompute);
/** Stretches before that of this slot are not asked for any more. */
void hd_recompute_forget(hd_recompute *recompute, long slot);

/** The slot's R [n * n], row-major, and Y [n * n], both from the diagonal on (NULL where all
 * vectors are carried). Those of its stretch up to slot `last` are computed with it.
 * HD_ILL_CONDITIONED, HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_recompute_factor(hd_recompute *recompute, double *factor,
                                            double *coupling, long slot, long last);

#endif
