/** How far ahead the turns of one LP step are foreseen: its mean rate, and by how much its phases
 * have missed it [T13]. */
#ifndef HD_FORESIGHT_H
#define HD_FORESIGHT_H

#include "base/archive.h"

typedef struct hd_foresight {
    double omega;    /**< mean turn of the whole step per time */
    double averaged; /**< over so long */
    /** Sums over phases, of which older ones are forgotten: dt, dt^2, dt miss^2. */
    double time, spans, misses;
    long samples; /**< that have been held against omega */
} hd_foresight;

/** Knows nothing. */
void hd_foresight_clear(hd_foresight *f);

/** The whole step has turned by `turn` in dt > 0. */
void hd_foresight_turn(hd_foresight *f, double turn, double dt);

/** A sample after dt > 0 is to be held against omega: forgets as much of the older ones. */
void hd_foresight_sample(hd_foresight *f, double dt);
/** One phase of it was off by `miss` from what omega had foreseen for its dt. */
void hd_foresight_miss(hd_foresight *f, double miss, double dt);

/** Time ahead at which phases are expected to be off by `error` (rms); 0 if not yet known. */
double hd_foresight_reach(const hd_foresight *f, double error);
/** Mean time that the misses are of, longer ones counting more; 0 if there is none. */
double hd_foresight_span(const hd_foresight *f);
/** Root mean square of the misses; 0 if there is none. */
double hd_foresight_scatter(const hd_foresight *f);

void hd_foresight_archive(hd_foresight *f, hd_archive *archive);

#endif
