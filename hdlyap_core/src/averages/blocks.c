/** Samples -> blocks -> standard errors that account for correlation between blocks [T8]. */
#include "averages/blocks.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "base/check.h"
#include "base/memory.h"

/** Rounding may leave the weight of a full block short of its length by this part. */
static const double CLOSE = 1e-9;
/** Neighbouring blocks count as correlated if their correlation exceeds this many of its standard
 * deviations. */
static const double SIGNIFICANT = 1.0;
/** With fewer blocks than this, neighbours are not joined any more. */
enum { FEW = 48 };
/** No error is stated if the correlation of neighbouring blocks exceeds this. */
static const double MEMORY_MAX = 0.75;
/** Least part of the variance of phase increments that is taken for diffusion, not for trembling.
 */
static const double TREMBLING_MIN = 0.25;

/* ---- history ------------------------------------------------------------------------------- */

hd_status hd_blocks_create(hd_blocks *blocks, int series, double least)
{
    HD_ASSERT(series >= 1 && least >= 0);
    *blocks = (hd_blocks){.series = series, .least = least, .length = least};
    blocks->sum = hd_memory_alloc((size_t)(HD_BLOCKS_MAX + 1) * (size_t)series, sizeof(double));
    return blocks->sum ? HD_OK : HD_NO_MEMORY;
}

void hd_blocks_clear(hd_blocks *blocks)
{
    hd_memory_free(blocks->sum);
    *blocks = (hd_blocks){0};
}

static double *row(const hd_blocks *blocks, int k)
{
    return blocks->sum + (size_t)k * (size_t)blocks->series;
}

static void begin(hd_blocks *blocks, int k)
{
    blocks->weight[k] = 0.0;
    memset(row(blocks, k), 0, (size_t)blocks->series * sizeof(double));
}

void hd_blocks_restart(hd_blocks *blocks)
{
    blocks->count = 0;
    blocks->length = blocks->least;
    begin(blocks, 0);
}

static void add(hd_blocks *blocks, int k, const double *sum, double weight)
{
    double *to = row(blocks, k);
    for (int s = 0; s < blocks->series; s++) to[s] += sum[s];
    blocks->weight[k] += weight;
}

static double whole_weight(const hd_blocks *blocks)
{
    double sum = 0.0;
    for (int k = 0; k < blocks->count; k++) sum += blocks->weight[k];
    return sum;
}

/** Joins each pair of neighbouring blocks into one. */
static void join(hd_blocks *blocks)
{
    for (int k = 0; 2 * k < HD_BLOCKS_MAX; k++) {
        const double first = blocks->weight[2 * k], second = blocks->weight[2 * k + 1];
        memmove(row(blocks, k), row(blocks, 2 * k), (size_t)blocks->series * sizeof(double));
        blocks->weight[k] = first;
        add(blocks, k, row(blocks, 2 * k + 1), second);
    }
    blocks->count = HD_BLOCKS_MAX / 2;
    blocks->length = whole_weight(blocks) / blocks->count;
    begin(blocks, blocks->count);
}

/** Ends the block unless another sample of this weight would bring it nearer to its length. */
void hd_blocks_add(hd_blocks *blocks, const double *sum, double weight)
{
    HD_ASSERT(weight > 0);
    add(blocks, blocks->count, sum, weight);
    const double enough = fmax(HD_BLOCKS_NEARLY * blocks->least, blocks->length - 0.5 * weight);
    if (blocks->weight[blocks->count] < enough * (1.0 - CLOSE)) return;
    if (blocks->length == 0) blocks->length = blocks->weight[0];
    blocks->count++;
    if (blocks->count == HD_BLOCKS_MAX)
        join(blocks);
    else
        begin(blocks, blocks->count);
}

const double *hd_blocks_sum(const hd_blocks *blocks, int k)
{
    HD_ASSERT(k >= 0 && k < blocks->count);
    return row(blocks, k);
}

void hd_blocks_forget(hd_blocks *blocks, int series)
{
    for (int k = 0; k <= blocks->count; k++) row(blocks, k)[series] = 0.0;
}

/* ---- errors -------------------------------------------------------------------------------- */

static double sum_of_squares(const double *x, int count)
{
    double sum = 0.0;
    for (int k = 0; k < count; k++) sum += x[k] * x[k];
    return sum;
}

/** The correlation of each deviation with the next one, -1 .. 1. */
static double correlation(const double *x, int count)
{
    double products = 0.0;
    for (int k = 1; k < count; k++) products += x[k - 1] * x[k];
    return products / sum_of_squares(x, count);
}

/** The correlation of few deviations, without its bias (Marriott and Pope, Biometrika 41, 390
 * (1954)). */
static double memory_of(const double *x, int count)
{
    return (correlation(x, count) + 1.0 / count) / (1.0 - 4.0 / count);
}

static double variance_of(const double *x, int count)
{
    return sum_of_squares(x, count) * count / (count - 1.0);
}

/** Adds neighbours up in pairs; the last one of an odd number stays. Returns how many are left. */
static int joined(double *x, int count)
{
    for (int k = 0; 2 * k < count; k++) x[k] = x[2 * k] + (2 * k + 1 < count ? x[2 * k + 1] : 0.0);
    return (count + 1) / 2;
}

static bool is_rounding(const double *x, int count, double rounding)
{
    return sum_of_squares(x, count) <= count * rounding * rounding;
}

double hd_deviations_error(double *deviation, int count, double rounding)
{
    if (count < HD_SPECTRUM_BLOCKS_MIN) return -1.0;
    if (is_rounding(deviation, count, rounding)) return sqrt(variance_of(deviation, count));
    while (count >= FEW && fabs(correlation(deviation, count)) > SIGNIFICANT / sqrt(count))
        count = joined(deviation, count);
    const double variance = variance_of(deviation, count);
    const double memory = count < FEW ? memory_of(deviation, count) : 0.0;
    if (!(memory > 1.0 / sqrt(count))) return sqrt(variance); /* true of NaN, which is returned */
    return memory <= MEMORY_MAX ? sqrt(variance * (1.0 + memory) / (1.0 - memory)) : -1.0;
}

/** deviation[count] of each block's sum from its mean; returns how much of it may be rounding. */
static double deviations_of(const hd_blocks *blocks, const hd_part *parts, int count,
                            double *deviation)
{
    double sum = 0.0, weight = 0.0, size = 0.0;
    for (int k = 0; k < blocks->count; k++) {
        const double *x = row(blocks, k);
        deviation[k] = 0.0;
        for (int p = 0; p < count; p++) {
            const double part = parts[p].factor * x[parts[p].series];
            deviation[k] += part;
            size += fabs(part);
        }
        sum += deviation[k];
        weight += blocks->weight[k];
    }
    for (int k = 0; k < blocks->count; k++) deviation[k] -= sum / weight * blocks->weight[k];
    return HD_BLOCKS_ROUNDING * size;
}

double hd_blocks_error(const hd_blocks *blocks, const hd_part *parts, int count)
{
    double deviation[HD_BLOCKS_MAX];
    const double rounding = deviations_of(blocks, parts, count, deviation);
    const double error = hd_deviations_error(deviation, blocks->count, rounding);
    return error < 0 ? error : error / whole_weight(blocks);
}

double hd_blocks_error_of_turns(const hd_blocks *blocks)
{
    double deviation[HD_BLOCKS_MAX];
    int count = blocks->count;
    const double rounding = deviations_of(blocks, &(hd_part){0, 1.0}, 1, deviation);
    if (count < HD_SPECTRUM_BLOCKS_MIN) return -1.0;
    while (count >= 2 * HD_SPECTRUM_BLOCKS_MIN) count = joined(deviation, count);
    const double error = sqrt(variance_of(deviation, count)) / whole_weight(blocks);
    if (is_rounding(deviation, count, rounding)) return error;
    const double memory = fmin(memory_of(deviation, count), 0.0);
    return error * sqrt(fmax(1.0 + 2.0 * memory, TREMBLING_MIN));
}

double hd_blocks_diffusion(const hd_blocks *blocks, double *error)
{
    double deviation[HD_BLOCKS_MAX];
    const int count = blocks->count;
    *error = -1.0;
    if (count < HD_SPECTRUM_BLOCKS_MIN) return -1.0;
    (void)deviations_of(blocks, &(hd_part){0, 1.0}, 1, deviation);
    const double diffusion = 0.5 * variance_of(deviation, count) / whole_weight(blocks);
    *error = diffusion * sqrt(2.0 / (count - 1.0));
    return diffusion;
}

/* ---- file ---------------------------------------------------------------------------------- */

void hd_blocks_archive(hd_blocks *blocks, hd_archive *archive)
{
    hd_archive_int(archive, "blocks count", &blocks->count, 0, HD_BLOCKS_MAX - 1);
    hd_archive_double(archive, "blocks length", &blocks->length);
    const size_t rows = (size_t)blocks->count + 1;
    hd_archive_doubles(archive, "blocks weight", blocks->weight, rows);
    hd_archive_doubles(archive, "blocks sum", blocks->sum, rows * (size_t)blocks->series);
    bool positive = blocks->length >= 0;
    for (int k = 0; hd_archive_good(archive) && k < blocks->count; k++)
        positive &= blocks->weight[k] > 0;
    hd_archive_expect(archive, positive, "blocks weight", "it is not positive");
}
