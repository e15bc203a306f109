/** How far ahead the turns of one step can be predicted, from its mean rate and from how much its
 * phases have missed it [T13]. `unseen` is the longest time between samples without prediction. */
#ifndef HD_PHASE_PREDICTOR_H
#define HD_PHASE_PREDICTOR_H

#include "base/archive.h"

/** The predicted time must be at least this part of the time since the last sample; otherwise the
 * sample came too late. */
#define HD_PHASE_PREDICTOR_PART 0.75

typedef struct hd_phase_predictor {
    double off;      /**< largest expected miss of a phase [rad] */
    double omega;    /**< mean turn of the whole step per time */
    double averaged; /**< time over which omega is the mean */
    /** Sums over phases of dt, dt^2 and dt miss^2, each times a^2 + b^2; older ones are forgotten.
     */
    double time, times, squares;
    long samples; /**< samples that were compared with omega */
    int far_off;  /**< how many of the last turns of the whole were far from the prediction */
} hd_phase_predictor;

/** Starts anew, for a step with this many pairs. */
void hd_phase_predictor_clear(hd_phase_predictor *f, int pairs);

/** Announces a sample, dt > 0 after the last one, whose phases will be compared with omega; forgets
 * older misses accordingly. */
void hd_phase_predictor_sample(hd_phase_predictor *f, double dt);
/** Adds a turn of the whole step by `turn` in dt > 0. If that is far off the prediction, the next
 * sample has to come as early as without prediction. */
void hd_phase_predictor_turn(hd_phase_predictor *f, double turn, double dt);
/** Adds one phase's miss: its difference from what omega predicted for dt > 0; strength: its
 * a^2 + b^2. */
void hd_phase_predictor_miss(hd_phase_predictor *f, double miss, double dt, double strength);

/** Longest time to the next sample; at least `unseen`. */
double hd_phase_predictor_sampling(const hd_phase_predictor *f, double unseen);
/** Longest time for which a phase may be weak before it is started anew. */
double hd_phase_predictor_gap(const hd_phase_predictor *f, double unseen);
/** True if the turn of the whole step was far from the prediction twice in a row: omega is then not
 * its rate. */
bool hd_phase_predictor_is_lost(const hd_phase_predictor *f);

void hd_phase_predictor_archive(hd_phase_predictor *f, hd_archive *archive);

#endif
