/** How averages of exponents are taken. */
#ifndef HD_SPECTRUM_H
#define HD_SPECTRUM_H

#include "base/archive.h"
#include "hdlyap/spectrum.h"

/** Makes an empty spectrum. rows: number of all exponents (4N for two coordinates); vectors: number
 * n of vectors whose exponents are averaged, at most rows; positive: number of positive ones among
 * all, `rows` if theory does not say. block: shortest block of averaged time from which standard
 * errors are taken [time units]; 0: the length of a sample. */
HD_MUST_CHECK hd_status hd_spectrum_create(hd_spectrum **out, int rows, int vectors, int positive,
                                           double block);
void hd_spectrum_free(hd_spectrum *spectrum);
void hd_spectrum_clear(hd_spectrum *spectrum);
/** Clears the averages. age: time for which the vectors have been carried from a random start.
 * Errors then allow for zero modes that outgrow small exponents [T8]. */
void hd_spectrum_begin(hd_spectrum *spectrum, double age);

/** Adds log_stretch[n] = ln diag R of one orthonormalisation to the present sample, dt >= 0 after
 * the orthonormalisation before. The functions below see whole samples only. */
void hd_spectrum_add(hd_spectrum *spectrum, const double *log_stretch, double dt);
/** Ends the present sample. The frame must be orthonormal in the same norm where a sample begins
 * and where it ends; orthonormalisations in between may use another norm [T5]. Samples may have any
 * length. */
void hd_spectrum_sample(hd_spectrum *spectrum);
/** Time since the present sample began. */
double hd_spectrum_sample_time(const hd_spectrum *spectrum);
/** Sums of ln R_ll over all whole samples, [vectors]. */
const double *hd_spectrum_total(const hd_spectrum *spectrum);
/** One part of a linear combination of exponents: factor times that of column `series`. */
typedef struct hd_part {
    int series;
    double factor;
} hd_part;

/** Standard error of sum_i factor_i lambda_i (a mean, a sum, a fit), with the correlation of the
 * exponents' fluctuations; negative while it cannot be known. O(count blocks). */
double hd_spectrum_error_of_sum(const hd_spectrum *spectrum, const hd_part *parts, int count);
/** Largest standard error of the columns [begin, end); INFINITY while one is unknown, or if begin
 * equals end. */
double hd_spectrum_largest_error(const hd_spectrum *spectrum, int begin, int end);
void hd_spectrum_local_restart(hd_spectrum *spectrum);

/** Numbers of vectors with positive and with vanishing exponents; all others are negative. */
typedef struct hd_signs {
    int positive, zero;
} hd_signs;
/** Counts them by value. zero: how many vanish, where theory says so; more do that cannot be told
 * from them yet. Negative: by their errors. None of either while that is not known, or if not more
 * than those that vanish are computed. O(n), with errors O(n blocks). */
hd_signs hd_spectrum_signs(const hd_spectrum *spectrum, int zero);

void hd_spectrum_archive(hd_spectrum *spectrum, hd_archive *archive);
double hd_spectrum_bytes(double vectors);

#endif
