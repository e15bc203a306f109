/** The history of additive quantities in at most 96 blocks of about equal length, from which the
 * standard error of anything that is linear in their means follows, however its parts fluctuate
 * together [T8]. */
#ifndef HD_BLOCKS_H
#define HD_BLOCKS_H

#include "averages/spectrum.h"
#include "base/archive.h"

enum { HD_BLOCKS_MAX = 96 };

typedef struct hd_blocks {
    int series;
    int count;     /**< whole blocks */
    double length; /**< of a block, about: that of the first; their mean when two become one */
    double least;  /**< that none falls below, but for less than a tenth */
    double weight[HD_BLOCKS_MAX + 1]; /**< of the whole ones, and of the one that is being filled */
    double *sum;                      /**< [HD_BLOCKS_MAX + 1][series] */
} hd_blocks;

/** least: weight that no block falls below, or 0. HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_blocks_create(hd_blocks *blocks, int series, double least);
void hd_blocks_clear(hd_blocks *blocks);
/** That so many series take. */
static inline double hd_blocks_bytes(double series)
{
    return (HD_BLOCKS_MAX + 1.0) * series * sizeof(double);
}
void hd_blocks_restart(hd_blocks *blocks);

/** Adds sum[series] of a sample of this weight (a time, or a number). Amortised O(series). */
void hd_blocks_add(hd_blocks *blocks, const double *sum, double weight);

/** Whole block k < count: sum[series]. */
const double *hd_blocks_sum(const hd_blocks *blocks, int k);

/** Makes a series zero up to now. */
void hd_blocks_forget(hd_blocks *blocks, int series);

/** Standard error of (sum of the parts) / (sum of weights) [T8]; negative if not yet known: below
 * HD_SPECTRUM_BLOCKS_MIN blocks, or with a memory as long as they are. O(count times blocks). */
double hd_blocks_error(const hd_blocks *blocks, const hd_part *parts, int count);

/** Standard error of the mean of series 0 where it holds the increments of a phase that diffuses
 * and, beside that, trembles: what a block has too much, the next has too little. */
double hd_blocks_error_of_turns(const hd_blocks *blocks);

/** D of such a phase, mean square 2 D weight about its mean rate, from all blocks, and its standard
 * error; negative below HD_SPECTRUM_BLOCKS_MIN blocks. What trembles adds its mean square over the
 * weight of a block. */
double hd_blocks_diffusion(const hd_blocks *blocks, double *error);

/** Standard error of a sum from deviations of its blocks from their mean, deviation[count], which
 * is used as workspace; count at most HD_BLOCKS_MAX. As hd_blocks_error. Deviations within
 * `rounding` have no memory. */
double hd_deviations_error(double *deviation, int count, double rounding);
/** Rounding of deviations as a part of the sum of what they came from. */
#define HD_BLOCKS_ROUNDING 1e-15

void hd_blocks_archive(hd_blocks *blocks, hd_archive *archive);

#endif
