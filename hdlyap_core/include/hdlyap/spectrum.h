/** Lyapunov exponents with standard errors that see the correlation time. */
#ifndef HDLYAP_SPECTRUM_H
#define HDLYAP_SPECTRUM_H

#include "hdlyap/status.h"

HD_API_BEGIN

typedef struct hd_spectrum hd_spectrum;

/** One part of a linear combination of exponents: factor times that of column `series`. */
typedef struct hd_part {
    int series;
    double factor;
} hd_part;

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

double hd_spectrum_time(const hd_spectrum *spectrum); /**< averaged time */
/** Of the sample that has begun. */
double hd_spectrum_sample_time(const hd_spectrum *spectrum);
double hd_spectrum_exponent(const hd_spectrum *spectrum,
                            int col); /**< running mean of ln R_ll / t */
/** Standard error of the mean, from blocks that are joined while they remember each other [T8];
 * negative while it cannot be known: fewer than HD_SPECTRUM_BLOCKS_MIN blocks, or a memory that is
 * as long as they are. It is itself known to 7-10 % from 48 blocks on, to 18 % from 16. O(blocks).
 */
double hd_spectrum_std_error(const hd_spectrum *spectrum, int col);
/** Standard error of sum_i factor_i lambda_i (a mean, a sum, a fit), which knows how the exponents
 * fluctuate together; negative while it cannot be known. O(count blocks). */
double hd_spectrum_error_of_sum(const hd_spectrum *spectrum, const hd_part *parts, int count);
/** Largest of the standard errors of the columns [begin, end); INFINITY while one is unknown, and
 * of none. */
double hd_spectrum_largest_error(const hd_spectrum *spectrum, int begin, int end);
/** Mean over the samples that have ended since hd_spectrum_local_restart (or since the averaging
 * began), NaN if none has; and how long they were together, 0 if none has. */
double hd_spectrum_local(const hd_spectrum *spectrum, int col);
double hd_spectrum_local_time(const hd_spectrum *spectrum);
void hd_spectrum_local_restart(hd_spectrum *spectrum);
double hd_spectrum_lambda_max(const hd_spectrum *spectrum); /**< exponent of col 0 */
double hd_spectrum_ks_entropy(const hd_spectrum *spectrum); /**< sum of the positive ones carried */
double hd_spectrum_ks_entropy_error(
    const hd_spectrum *spectrum); /**< its standard error; negative if not yet known */
/** max over pairs of |lambda_l + lambda_(4N+1-l)|; negative unless there are all 4N. Zero by
 * construction where half of them follow from the others [T18]. */
double hd_spectrum_pairing_error(const hd_spectrum *spectrum);

enum { HD_SPECTRUM_BLOCKS_MIN = 16 };

HD_API_END
#endif
