/** Standard error of the mean of a correlated series, one sample at a time, for many series at
 * once: averages of blocks of 1, 2, 4, .. samples (Flyvbjerg and Petersen, J. Chem. Phys. 91, 461
 * (1989)). */
#ifndef HD_BLOCKS_H
#define HD_BLOCKS_H

#include "hdlyap/status.h"

enum { HD_BLOCKS_LEVELS = 32 };

typedef struct hd_blocks {
    int series;
    long samples;
    double *mean,
        *square;  /**< [levels][series]: running mean and sum of squared deviations of blocks */
    double *half; /**< [levels][series]: first half of the next block */
    long count[HD_BLOCKS_LEVELS]; /**< whole blocks of 2^level samples */
} hd_blocks;

HD_MUST_CHECK hd_status hd_blocks_create(hd_blocks *blocks, int series);
void hd_blocks_clear(hd_blocks *blocks);
void hd_blocks_restart(hd_blocks *blocks);

/** Adds one sample of every series; sample[series] is used as workspace. Amortised O(series). */
void hd_blocks_add(hd_blocks *blocks, double *sample);

/** Standard error of the mean of one series [T8]; negative below 16 samples. */
double hd_blocks_std_error(const hd_blocks *blocks, int series);

/** Running mean of one series; 0 without samples. */
double hd_blocks_mean(const hd_blocks *blocks, int series);

/** Standard error of the mean from the longest blocks of which there are 16; negative below 16
 * samples. For the increments of a bounded or diffusing quantity, whose errors fall with the length
 * of the blocks. */
double hd_blocks_long_error(const hd_blocks *blocks, int series);

#endif
