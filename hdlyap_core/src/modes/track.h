/** The phase of one vector (slot) of a step in one pair of fields, unwrapped [T13]. */
#ifndef HD_TRACK_H
#define HD_TRACK_H

#include <complex.h>

#include "averages/blocks.h"
#include "hdlyap/phases.h"

/** If a^2 + b^2 is below this there is no phase: noise of a few percent would turn it. */
#define HD_TRACK_WEAK 0.05

/** The track of one slot in one pair. The slope comes from regression: running means and centred
 * sums of time and phase. */
typedef struct hd_track {
    hd_phase out;
    double last;  /**< time of the last phase */
    double begin; /**< time of the first phase */
    long count;
    double mean_t, mean_phase, square_t, product;
    double rate_now, dt_now; /**< last increment of the phase over its time; that time */
    hd_blocks turns;         /**< one series: the increments; their weight is time */
} hd_track;

/** Starts anew with the next coefficients; `state` is reported until then. */
void hd_track_restart(hd_track *t, hd_phase_state state);

/** Adds z = a + i b at this time, with the sign of its slot; omega predicts the phase. After more
 * than `gap` without a phase it starts anew. True if the phase was continued. */
bool hd_track_add(hd_track *t, double complex z, double time, double omega, double gap);

/** The phase nearest to the prediction that differs from `phase` by whole turns. */
double hd_track_unwrapped(double phase, double predicted);

/** Reads or writes a track. `sampled`: time of the last sample that its rotor took. */
void hd_track_archive(hd_track *t, hd_archive *archive, int vectors, double sampled);

#endif
