/** How averages of exponents are taken. */
#ifndef HD_SPECTRUM_H
#define HD_SPECTRUM_H

#include "hdlyap/spectrum.h"

/** rows = 4N; vectors carried = n <= 4N. block: standard errors come from blocks of the averaged
 * time that are at least so long [time units], 0 for as long as the samples. */
HD_MUST_CHECK hd_status hd_spectrum_create(hd_spectrum **out, int rows, int vectors, double block);
void hd_spectrum_free(hd_spectrum *spectrum);
void hd_spectrum_clear(hd_spectrum *spectrum);
/** Clears it, for vectors that have been carried from a random start for so long: errors then count
 * with zero modes that outgrow small exponents [T8]. */
void hd_spectrum_begin(hd_spectrum *spectrum, double age);

/** Adds ln diag R of one orthonormalisation, dt >= 0 after the one before, to the sample that has
 * begun; log_stretch[n]. What is read below is of whole samples. */
void hd_spectrum_add(hd_spectrum *spectrum, const double *log_stretch, double dt);
/** Ends a sample: all that was added since the last call. Where it begins and ends the frame must
 * be orthonormal in the same norm: then those in between do not matter [T5]. Samples may be of any
 * length. */
void hd_spectrum_sample(hd_spectrum *spectrum);
/** Of the sample that has begun. */
double hd_spectrum_sample_time(const hd_spectrum *spectrum);
/** One part of a linear combination of exponents: factor times that of column `series`. */
typedef struct hd_part {
    int series;
    double factor;
} hd_part;

/** Standard error of sum_i factor_i lambda_i (a mean, a sum, a fit), which knows how the exponents
 * fluctuate together; negative while it cannot be known. O(count blocks). */
double hd_spectrum_error_of_sum(const hd_spectrum *spectrum, const hd_part *parts, int count);
/** Largest of the standard errors of the columns [begin, end); INFINITY while one is unknown, and
 * of none. */
double hd_spectrum_largest_error(const hd_spectrum *spectrum, int begin, int end);
void hd_spectrum_local_restart(hd_spectrum *spectrum);

#endif
