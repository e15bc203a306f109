/** How far ahead the turns of one step are foreseen: its mean rate, and by how much its phases
 * have missed it [T13]. `unseen` is the longest time between samples without any
 * foresight. */
#ifndef HD_FORESIGHT_H
#define HD_FORESIGHT_H

#include "base/archive.h"

/** Part of the time since the last sample that must have been foreseen: a sample that comes later
 * is too late. */
#define HD_FORESIGHT_PART 0.75

typedef struct hd_foresight {
    double off;      /**< that phases may be expected to be [rad] */
    double omega;    /**< mean turn of the whole step per time */
    double averaged; /**< over so long */
    /** Sums over phases, of which older ones are forgotten: dt, dt^2, dt miss^2, each times a^2 +
     * b^2. */
    double time, times, squares;
    long samples; /**< that have been held against omega */
    int far_off;  /**< last turns of the whole that were far from what had been foreseen */
} hd_foresight;

/** Knows nothing of a step with so many pairs. */
void hd_foresight_clear(hd_foresight *f, int pairs);

/** After dt > 0 there is a sample that is to be held against omega: forgets as much of the older
 * ones. */
void hd_foresight_sample(hd_foresight *f, double dt);
/** The whole step has turned by `turn` in dt > 0. If that is far off, the next sample is to come as
 * early as if nothing were foreseen. */
void hd_foresight_turn(hd_foresight *f, double turn, double dt);
/** One phase was off by `miss` from what omega had foreseen for dt > 0; strength: its a^2 + b^2. */
void hd_foresight_miss(hd_foresight *f, double miss, double dt, double strength);

/** Longest time to the next sample; at least `unseen`. */
double hd_foresight_sampling(const hd_foresight *f, double unseen);
/** Longest time that a phase may be weak before it is begun anew. */
double hd_foresight_gap(const hd_foresight *f, double unseen);
/** True if the whole was far off, and once more when it was asked again: omega is not its rate. */
bool hd_foresight_is_lost(const hd_foresight *f);

void hd_foresight_archive(hd_foresight *f, hd_archive *archive);

#endif
