/** Standard error of the mean of a correlated series, one sample at a time, for many series at
 * once: averages of blocks of 1, 2, 4, .. samples (Flyvbjerg and Petersen, J. Chem. Phys. 91, 461
 * (1989)). */
#ifndef HD_BLOCK_AVERAGE_H
#define HD_BLOCK_AVERAGE_H

#include "base/archive.h"

enum { HD_BLOCK_AVERAGE_LEVELS = 32 };

typedef struct hd_block_average {
    int series;
    long samples;
    double *mean,
        *square;  /**< [levels][series]: running mean and sum of squared deviations of blocks */
    double *half; /**< [levels][series]: first half of the next block */
    long count[HD_BLOCK_AVERAGE_LEVELS]; /**< whole blocks of 2^level samples */
} hd_block_average;

HD_MUST_CHECK hd_status hd_block_average_create(hd_block_average *blocks, int series);
void hd_block_average_clear(hd_block_average *blocks);
void hd_block_average_restart(hd_block_average *blocks);

/** Adds one sample of every series; sample[series] is used as workspace. Amortised O(series). */
void hd_block_average_add(hd_block_average *blocks, double *sample);

/** Standard error of the mean of one series [T8]; negative below 16 samples. */
double hd_block_average_std_error(const hd_block_average *blocks, int series);

/** Running mean of one series; 0 without samples. */
double hd_block_average_mean(const hd_block_average *blocks, int series);

/** Standard error of the mean from the longest blocks of which there are 16; negative below 16
 * samples. For the increments of a bounded or diffusing quantity, whose errors fall with the length
 * of the blocks. */
double hd_block_average_long_error(const hd_block_average *blocks, int series);

void hd_block_average_archive(hd_block_average *blocks, hd_archive *archive);

#endif
