/** The history of additive quantities in at most 96 blocks of about equal length, from which the
 * standard error of anything that is linear in their means follows, however its parts fluctuate
 * together [T8]. */
#ifndef HD_BLOCKS_H
#define HD_BLOCKS_H

#include "averages/spectrum.h"
#include "base/archive.h"

enum { HD_BLOCKS_MAX = 96 };
/** A block may end with this part of its least weight, because samples rarely end exactly there. */
#define HD_BLOCKS_NEARLY 0.92

typedef struct hd_blocks {
    int series;
    int count;     /**< whole blocks */
    double length; /**< weight at which a block ends, about; doubles when neighbours are joined */
    double least;  /**< least weight of a block; blocks may be shorter by up to 8 % */
    /** Weight of each whole block, and of the one that is being filled. */
    double weight[HD_BLOCKS_MAX + 1];
    /** [HD_BLOCKS_MAX + 1][series]: sums over each whole block, and over the one that is being
     * filled. */
    double *sum;
} hd_blocks;

/** Makes empty blocks. least: weight below which no block falls, but for 8 %; 0: any. Fails with
 * HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_blocks_create(hd_blocks *blocks, int series, double least);
void hd_blocks_clear(hd_blocks *blocks);
/** Bytes that the blocks of this number of series take. */
static inline double hd_blocks_bytes(double series)
{
    return (HD_BLOCKS_MAX + 1.0) * series * sizeof(double);
}
void hd_blocks_restart(hd_blocks *blocks);

/** Adds sum[series] of a sample of this weight (a time, or a number). Amortised O(series). */
void hd_blocks_add(hd_blocks *blocks, const double *sum, double weight);

/** Sums [series] over whole block k, 0 .. count - 1. */
const double *hd_blocks_sum(const hd_blocks *blocks, int k);

/** Sets a series to zero in all blocks so far. */
void hd_blocks_forget(hd_blocks *blocks, int series);

/** Standard error of (sum of the parts) / (sum of weights) [T8]; negative if not yet known: below
 * HD_SPECTRUM_BLOCKS_MIN blocks, or if blocks are correlated however they are joined. O(count times
 * blocks). */
double hd_blocks_error(const hd_blocks *blocks, const hd_part *parts, int count);

/** Standard error of the mean of series 0, which holds the increments of a phase. The phase
 * diffuses, and it trembles: what trembling adds to one block is missing in the next. */
double hd_blocks_error_of_turns(const hd_blocks *blocks);

/** Diffusion constant D of the phase in series 0: about its mean rate it moves by a mean square of
 * 2 D weight. Sets the standard error, too; negative below HD_SPECTRUM_BLOCKS_MIN blocks. Trembling
 * adds its mean square divided by the weight of a block. */
double hd_blocks_diffusion(const hd_blocks *blocks, double *error);

/** Standard error of a sum from deviation[count] of its blocks from their mean, as hd_blocks_error
 * takes it; count at most HD_BLOCKS_MAX. The array is used as workspace. Deviations below
 * `rounding` count as uncorrelated. */
double hd_deviations_error(double *deviation, int count, double rounding);
/** Rounding of a deviation, relative to the sum of the numbers that it was computed from. */
#define HD_BLOCKS_ROUNDING 1e-15

void hd_blocks_archive(hd_blocks *blocks, hd_archive *archive);

#endif
