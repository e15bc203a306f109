/** ln diag R -> exponents with their errors, and sums of exponents [T5] [T8]. One thread. */
#include "hdlyap/spectrum.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "averages/spectrum.h"
#include "averages/blocks.h"
#include "base/check.h"
#include "base/memory.h"

/** An exponent that is less than so many of its errors is taken as 0. */
static const double VANISHES = 4.0;

struct hd_spectrum {
    int rows, vectors;
    int positive;       /**< number of vectors with positive exponents, by theory */
    bool by_sign;       /**< theory does not say which are positive */
    double *sum;        /**< [vectors]: ln R_ll, summed over all whole samples */
    double *sample_sum; /**< [vectors]: ln R_ll, summed since the last sample ended */
    double *local_sum;  /**< [vectors]: ln R_ll, summed since hd_spectrum_local_restart */
    hd_part *parts;     /**< [vectors], workspace */
    double time, sample_time, local_time;
    double age; /**< for the error of columns in whose place a zero mode may be: age of the vectors
                   when the averaging began; negative: no zero mode can be there */
    hd_blocks blocks; /**< blocks of ln R_ll; their weight is time */
};

double hd_spectrum_bytes(double vectors)
{
    return (3.0 * sizeof(double) + sizeof(hd_part)) * vectors + hd_blocks_bytes(vectors);
}

static hd_status spectrum_allocate(hd_spectrum *spectrum, double block)
{
    double **arrays[] = {&spectrum->sum, &spectrum->sample_sum, &spectrum->local_sum};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) {
        *arrays[k] = hd_memory_alloc((size_t)spectrum->vectors, sizeof(double));
        if (!*arrays[k]) return HD_NO_MEMORY;
    }
    spectrum->parts = hd_memory_alloc((size_t)spectrum->vectors, sizeof *spectrum->parts);
    if (!spectrum->parts) return HD_NO_MEMORY;
    return hd_blocks_create(&spectrum->blocks, spectrum->vectors, block);
}

hd_status hd_spectrum_create(hd_spectrum **out, int rows, int vectors, int positive, double block)
{
    HD_ASSERT(vectors >= 1 && vectors <= rows && positive >= 0);
    hd_spectrum *spectrum = hd_memory_alloc(1, sizeof *spectrum);
    *out = NULL;
    if (!spectrum) return HD_NO_MEMORY;
    spectrum->rows = rows;
    spectrum->vectors = vectors;
    spectrum->positive = positive < vectors ? positive : vectors;
    spectrum->by_sign = positive == rows;
    spectrum->age = -1.0;
    const hd_status status = spectrum_allocate(spectrum, block);
    if (status == HD_OK)
        *out = spectrum;
    else
        hd_spectrum_free(spectrum);
    return status;
}

void hd_spectrum_free(hd_spectrum *spectrum)
{
    if (!spectrum) return;
    hd_memory_free(spectrum->sum);
    hd_memory_free(spectrum->sample_sum);
    hd_memory_free(spectrum->local_sum);
    hd_memory_free(spectrum->parts);
    hd_blocks_clear(&spectrum->blocks);
    hd_memory_free(spectrum);
}

void hd_spectrum_clear(hd_spectrum *spectrum)
{
    for (int col = 0; col < spectrum->vectors; col++)
        spectrum->sum[col] = spectrum->sample_sum[col] = 0.0;
    spectrum->time = spectrum->sample_time = 0.0;
    spectrum->age = -1.0;
    hd_spectrum_local_restart(spectrum);
    hd_blocks_restart(&spectrum->blocks);
}

void hd_spectrum_begin(hd_spectrum *spectrum, double age)
{
    HD_ASSERT(age >= 0);
    hd_spectrum_clear(spectrum);
    spectrum->age = age;
}

void hd_spectrum_add(hd_spectrum *spectrum, const double *log_stretch, double dt)
{
    HD_ASSERT(dt >= 0);
    for (int col = 0; col < spectrum->vectors; col++) spectrum->sample_sum[col] += log_stretch[col];
    spectrum->sample_time += dt;
}

void hd_spectrum_sample(hd_spectrum *spectrum)
{
    HD_ASSERT(spectrum->sample_time > 0);
    hd_blocks_add(&spectrum->blocks, spectrum->sample_sum, spectrum->sample_time);
    for (int col = 0; col < spectrum->vectors; col++) {
        spectrum->sum[col] += spectrum->sample_sum[col];
        spectrum->local_sum[col] += spectrum->sample_sum[col];
        spectrum->sample_sum[col] = 0.0;
    }
    spectrum->time += spectrum->sample_time;
    spectrum->local_time += spectrum->sample_time;
    spectrum->sample_time = 0.0;
}

void hd_spectrum_local_restart(hd_spectrum *spectrum)
{
    for (int col = 0; col < spectrum->vectors; col++) spectrum->local_sum[col] = 0.0;
    spectrum->local_time = 0.0;
}

double hd_spectrum_time(const hd_spectrum *spectrum) { return spectrum->time; }
double hd_spectrum_sample_time(const hd_spectrum *spectrum) { return spectrum->sample_time; }

const double *hd_spectrum_total(const hd_spectrum *spectrum) { return spectrum->sum; }

double hd_spectrum_exponent(const hd_spectrum *spectrum, int col)
{
    HD_ASSERT(col >= 0 && col < spectrum->vectors);
    return spectrum->time > 0 ? spectrum->sum[col] / spectrum->time : 0.0;
}

/** How much more than a vector of this exponent a zero mode may have grown at this age, as a
 * logarithm. */
static double outgrown(double exponent, double age)
{
    return fmax(log1p(age) - fabs(exponent) * age, 0.0);
}

/** Error of a column's exponent if a zero mode was in its place at the start of the averaging, or
 * is there now [T8]. */
static double displaced(const hd_spectrum *spectrum, int col)
{
    const double exponent = hd_spectrum_exponent(spectrum, col), age = spectrum->age;
    if (age < 0 || spectrum->time == 0) return 0.0;
    return fmax(outgrown(exponent, age), outgrown(exponent, age + spectrum->time)) / spectrum->time;
}

double hd_spectrum_std_error(const hd_spectrum *spectrum, int col)
{
    HD_ASSERT(col >= 0 && col < spectrum->vectors);
    return hd_spectrum_error_of_sum(spectrum, &(hd_part){col, 1.0}, 1);
}

double hd_spectrum_error_of_sum(const hd_spectrum *spectrum, const hd_part *parts, int count)
{
    const double error = hd_blocks_error(&spectrum->blocks, parts, count);
    double bias = 0.0;
    for (int p = 0; p < count; p++)
        bias += fabs(parts[p].factor) * displaced(spectrum, parts[p].series);
    return error < 0 ? error : hypot(error, bias);
}

double hd_spectrum_largest_error(const hd_spectrum *spectrum, int begin, int end)
{
    double worst = begin < end ? 0.0 : INFINITY;
    for (int col = begin; col < end; col++) {
        const double error = hd_spectrum_std_error(spectrum, col);
        worst = error >= 0 ? fmax(worst, error) : INFINITY; /* NaN counts as not known */
    }
    return worst;
}

double hd_spectrum_local(const hd_spectrum *spectrum, int col)
{
    HD_ASSERT(col >= 0 && col < spectrum->vectors);
    return spectrum->local_time > 0 ? spectrum->local_sum[col] / spectrum->local_time : NAN;
}

static bool is_positive(const hd_spectrum *spectrum, int col)
{
    return !spectrum->by_sign || hd_spectrum_exponent(spectrum, col) > 0;
}

static double ks_entropy(const hd_spectrum *spectrum)
{
    double sum = 0.0;
    for (int col = 0; col < spectrum->positive; col++)
        sum += is_positive(spectrum, col) ? hd_spectrum_exponent(spectrum, col) : 0.0;
    return sum;
}

static double ks_entropy_error(const hd_spectrum *spectrum)
{
    int count = 0;
    for (int col = 0; col < spectrum->positive; col++)
        if (is_positive(spectrum, col)) spectrum->parts[count++] = (hd_part){col, 1.0};
    return hd_spectrum_error_of_sum(spectrum, spectrum->parts, count);
}

static double pairing_error(const hd_spectrum *spectrum)
{
    if (spectrum->vectors < spectrum->rows || spectrum->by_sign) return -1.0;
    double worst = 0.0;
    for (int col = 0; col < spectrum->rows / 2; col++)
        worst = fmax(worst, fabs(hd_spectrum_exponent(spectrum, col) +
                                 hd_spectrum_exponent(spectrum, spectrum->rows - 1 - col)));
    return worst;
}

/** Sum of all exponents in *sum; returns its error. Zero modes in the place of others do not change
 * it. */
static double exponent_sum(const hd_spectrum *spectrum, double *sum)
{
    *sum = NAN;
    if (spectrum->vectors < spectrum->rows || spectrum->time == 0) return -1.0;
    *sum = 0.0;
    for (int col = 0; col < spectrum->vectors; col++) {
        *sum += hd_spectrum_exponent(spectrum, col);
        spectrum->parts[col] = (hd_part){col, 1.0};
    }
    return hd_blocks_error(&spectrum->blocks, spectrum->parts, spectrum->vectors);
}

/** Kaplan-Yorke dimension j + S / |lambda_(j+1)|, S the sum of the j exponents in front, j the most
 * for which it is not negative; in *out. Returns its error, to first order in those of the
 * exponents, which are correlated [T27]. Zero modes in the place of others do not change sums. */
static double kaplan_yorke(const hd_spectrum *spectrum, double *out)
{
    const int n = spectrum->vectors;
    double sum = 0.0, next = 0.0;
    int col = 0;
    *out = NAN;
    if (!spectrum->by_sign || spectrum->time == 0) return -1.0;
    for (; col < n; col++) {
        next = hd_spectrum_exponent(spectrum, col);
        if (sum + next < 0) break;
        sum += next;
    }
    if (col == n && n < spectrum->rows) return -1.0;
    *out = col < n ? col - sum / next : n;
    if (col == n)
        sum -= hd_spectrum_exponent(spectrum, --col); /* above 0 by chance, which has an error */
    if (!(next < 0)) return -1.0;
    for (int k = 0; k < col; k++) spectrum->parts[k] = (hd_part){k, -1.0 / next};
    spectrum->parts[col] = (hd_part){col, sum / (next * next)};
    return hd_blocks_error(&spectrum->blocks, spectrum->parts, col + 1);
}

hd_spectrum_sums hd_spectrum_sum_up(const hd_spectrum *spectrum)
{
    double sum, dimension;
    const double error = exponent_sum(spectrum, &sum);
    const double dimension_error = kaplan_yorke(spectrum, &dimension);
    return (hd_spectrum_sums){.local_time = spectrum->local_time,
                              .ks_entropy = ks_entropy(spectrum),
                              .ks_entropy_error = ks_entropy_error(spectrum),
                              .pairing_error = pairing_error(spectrum),
                              .exponent_sum = sum,
                              .exponent_sum_error = error,
                              .kaplan_yorke = dimension,
                              .kaplan_yorke_error = dimension_error};
}

/* ---- by sign ------------------------------------------------------------------------------- */

/** Whether a zero mode of this age may be in a column of such an exponent [T8]. */
static bool may_vanish(const hd_spectrum *spectrum, int col)
{
    const double age = spectrum->age, exponent = hd_spectrum_exponent(spectrum, col);
    return age >= 0 && outgrown(exponent, age + spectrum->time) > 0;
}

/** First column of those `zero` neighbours in the order whose sizes add up to least. */
static int smallest_together(const hd_spectrum *spectrum, int zero)
{
    double size = 0.0, least = INFINITY;
    int first = 0;
    for (int col = 0; col < spectrum->vectors; col++) {
        size += fabs(hd_spectrum_exponent(spectrum, col));
        if (col >= zero) size -= fabs(hd_spectrum_exponent(spectrum, col - zero));
        if (col < zero - 1 || !(size < least)) continue;
        least = size;
        first = col + 1 - zero;
    }
    return first;
}

/** Signs of which `zero` neighbours vanish and, with them, those beside them that cannot be told
 * from zero modes yet, as of a slowly damped momentum. Of a part of all vectors nothing vanishes
 * that can be told. */
static hd_signs signs_around(const hd_spectrum *spectrum, int zero)
{
    const int n = spectrum->vectors;
    hd_signs signs = {.positive = 0};
    for (int col = 0; col < n; col++) signs.positive += hd_spectrum_exponent(spectrum, col) > 0;
    if (zero == 0) return signs;
    if (zero >= n) return (hd_signs){.positive = 0};
    int first = smallest_together(spectrum, zero), end = first + zero;
    if (n < spectrum->rows && !may_vanish(spectrum, first)) return signs;
    while (first > 0 && may_vanish(spectrum, first - 1)) first--;
    while (end < n && may_vanish(spectrum, end)) end++;
    return (hd_signs){.positive = first, .zero = end - first};
}

/** Signs of which those vanish that are less than so many of their errors. */
static hd_signs signs_beyond(const hd_spectrum *spectrum, double errors)
{
    const hd_signs unknown = {.positive = 0};
    hd_signs signs = unknown;
    for (int col = 0; col < spectrum->vectors; col++) {
        const double error = hd_spectrum_std_error(spectrum, col),
                     exponent = hd_spectrum_exponent(spectrum, col);
        if (!(error >= 0)) return unknown;
        signs.zero += fabs(exponent) <= errors * error;
        signs.positive += exponent > errors * error;
    }
    return signs;
}

hd_signs hd_spectrum_signs(const hd_spectrum *spectrum, int zero)
{
    if (spectrum->time == 0) return (hd_signs){.positive = 0};
    return zero >= 0 ? signs_around(spectrum, zero) : signs_beyond(spectrum, VANISHES);
}

void hd_spectrum_archive(hd_spectrum *spectrum, hd_archive *archive)
{
    const size_t n = (size_t)spectrum->vectors;
    hd_archive_double(archive, "spectrum time", &spectrum->time);
    hd_archive_double(archive, "spectrum sample time", &spectrum->sample_time);
    hd_archive_double(archive, "spectrum local time", &spectrum->local_time);
    hd_archive_double(archive, "spectrum age", &spectrum->age);
    hd_archive_doubles(archive, "spectrum sum", spectrum->sum, n);
    hd_archive_doubles(archive, "spectrum sample sum", spectrum->sample_sum, n);
    hd_archive_doubles(archive, "spectrum local sum", spectrum->local_sum, n);
    hd_blocks_archive(&spectrum->blocks, archive);
    const bool forward = spectrum->time >= 0 && spectrum->sample_time >= 0 &&
                         spectrum->local_time >= 0;
    hd_archive_expect(archive, forward, "spectrum time", "it is negative");
}
