/** Samples -> standard errors that see the correlation time [T8]. */
#include "averages/block_average.h"

#include <limits.h>
#include <math.h>
#include <stddef.h>

#include "base/check.h"
#include "base/memory.h"

/** Levels with fewer blocks are too noisy to be asked: 8 blocks know their error to 27 %. */
enum { SAMPLES_MIN = 16, BLOCKS_MIN = 8 };

hd_status hd_block_average_create(hd_block_average *blocks, int series)
{
    const size_t size = (size_t)HD_BLOCK_AVERAGE_LEVELS * (size_t)series;
    *blocks = (hd_block_average){.series = series};
    blocks->mean = hd_memory_alloc(size, sizeof(double));
    blocks->square = hd_memory_alloc(size, sizeof(double));
    blocks->half = hd_memory_alloc(size, sizeof(double));
    return blocks->mean && blocks->square && blocks->half ? HD_OK : HD_NO_MEMORY;
}

void hd_block_average_clear(hd_block_average *blocks)
{
    hd_memory_free(blocks->mean);
    hd_memory_free(blocks->square);
    hd_memory_free(blocks->half);
    *blocks = (hd_block_average){0};
}

void hd_block_average_restart(hd_block_average *blocks)
{
    blocks->samples = 0;
    for (int level = 0; level < HD_BLOCK_AVERAGE_LEVELS; level++) blocks->count[level] = 0;
}

/** Welford's update of one level by one block of every series. */
static void level_add(hd_block_average *blocks, int level, const double *block)
{
    const long count = ++blocks->count[level];
    double *mean = blocks->mean + (size_t)level * (size_t)blocks->series;
    double *square = blocks->square + (size_t)level * (size_t)blocks->series;
    for (int k = 0; k < blocks->series; k++) {
        if (count == 1) mean[k] = square[k] = 0.0;
        const double off = block[k] - mean[k];
        mean[k] += off / (double)count;
        square[k] += off * (block[k] - mean[k]);
    }
}

void hd_block_average_add(hd_block_average *blocks, double *sample)
{
    blocks->samples++;
    for (int level = 0; level < HD_BLOCK_AVERAGE_LEVELS; level++) {
        double *half = blocks->half + (size_t)level * (size_t)blocks->series;
        level_add(blocks, level, sample);
        if (blocks->count[level] % 2 == 1) {
            for (int k = 0; k < blocks->series; k++) half[k] = sample[k];
            return;
        }
        for (int k = 0; k < blocks->series; k++) sample[k] = 0.5 * (half[k] + sample[k]);
    }
}

static double level_error(const hd_block_average *blocks, int level, int series)
{
    const double count = (double)blocks->count[level];
    const double square = blocks->square[(size_t)level * (size_t)blocks->series + (size_t)series];
    return sqrt(square / (count * (count - 1.0)));
}

/** The shortest blocks whose length B obeys B^3 > 2 samples (error_B / error_1)^4: longer ones
 * would add more noise than they remove bias (Lee et al., Phys. Rev. E 83, 066706 (2011)). While no
 * level does, the series is too short to know its correlation time: the largest error of all, made
 * larger by the noise of the longest blocks. */
double hd_block_average_std_error(const hd_block_average *blocks, int series)
{
    if (blocks->samples < SAMPLES_MIN) return -1.0;
    const double naive = level_error(blocks, 0, series);
    double largest = 0.0, noise = 0.0;
    for (int level = 0; level < HD_BLOCK_AVERAGE_LEVELS && blocks->count[level] >= BLOCKS_MIN;
         level++) {
        const double error = level_error(blocks, level, series), ratio = error / naive;
        const double length = ldexp(1.0, level);
        if (length * length * length > 2.0 * (double)blocks->samples * pow(ratio, 4.0))
            return error;
        largest = fmax(largest, error);
        noise = 1.0 / sqrt(2.0 * (double)(blocks->count[level] - 1));
    }
    return largest * (1.0 + noise);
}

double hd_block_average_mean(const hd_block_average *blocks, int series)
{
    return blocks->samples > 0 ? blocks->mean[series] : 0.0;
}

double hd_block_average_long_error(const hd_block_average *blocks, int series)
{
    if (blocks->samples < SAMPLES_MIN) return -1.0;
    int level = 0;
    while (level + 1 < HD_BLOCK_AVERAGE_LEVELS && blocks->count[level + 1] >= SAMPLES_MIN) level++;
    return level_error(blocks, level, series);
}

/** Levels that have never had a block hold nothing. */
void hd_block_average_archive(hd_block_average *blocks, hd_archive *archive)
{
    const long most = LONG_MAX / 2;
    int levels = 0;
    while (levels < HD_BLOCK_AVERAGE_LEVELS && blocks->count[levels] > 0) levels++;
    hd_archive_long(archive, "blocks samples", &blocks->samples, 0, most);
    hd_archive_int(archive, "blocks levels", &levels, 0, HD_BLOCK_AVERAGE_LEVELS);
    for (int k = 0; k < levels; k++) {
        const size_t first = (size_t)k * (size_t)blocks->series, n = (size_t)blocks->series;
        hd_archive_long(archive, "blocks count", &blocks->count[k], 1, most);
        hd_archive_doubles(archive, "blocks mean", blocks->mean + first, n);
        hd_archive_doubles(archive, "blocks square", blocks->square + first, n);
        hd_archive_doubles(archive, "blocks half", blocks->half + first, n);
    }
}
