/** Lyapunov exponents, with standard errors that account for correlations in time. All functions,
 * those that read too, use one workspace: one thread at a time. */
#ifndef HDLYAP_SPECTRUM_H
#define HDLYAP_SPECTRUM_H

#include "hdlyap/status.h"

HD_API_BEGIN

typedef struct hd_spectrum hd_spectrum;

double hd_spectrum_time(const hd_spectrum *spectrum); /**< length of the averaging [time units] */
double hd_spectrum_exponent(const hd_spectrum *spectrum,
                            int col); /**< mean growth rate, sum of ln R_ll / time [1/time unit] */
/** Standard error of an exponent, from blocks that are joined until they are independent [T8].
 * Negative while it is not known: there are fewer than HD_SPECTRUM_BLOCKS_MIN blocks, or they are
 * not longer than the correlation time. Its own relative error is 7-10 % from 48 blocks on, 18 %
 * with 16. O(blocks). */
double hd_spectrum_std_error(const hd_spectrum *spectrum, int col);
/** Mean growth rate in the samples that ended since the last report; NaN if none did. */
double hd_spectrum_local(const hd_spectrum *spectrum, int col);

typedef struct hd_spectrum_sums {
    double local_time;       /**< length of the samples of hd_spectrum_local; 0 if there are none */
    double ks_entropy;       /**< sum of the positive exponents that are computed */
    double ks_entropy_error; /**< its standard error; negative if not yet known */
    /** Largest |lambda_l + lambda_m| of conjugate exponents; negative unless all are computed. 0 by
     * construction if half of them follow from the others [T18]. */
    double pairing_error;
} hd_spectrum_sums;
hd_spectrum_sums hd_spectrum_sum_up(const hd_spectrum *spectrum); /**< O(n blocks) */

/** Most times over which growth is compared; each is twice as long as the one before. */
enum { HD_TIMES_MAX = 20 };
/** How often vectors change their order over times of one length. */
typedef struct hd_order_over {
    double time; /**< mean length [time units] */
    long count;  /**< how often it has passed */
    /** Fraction of the times over which vector col grew less than col + 1, [n - 1]. */
    const double *violations;
    /** Fraction over which any vector up to col grew less than any later one, [n - 1]. At 0 the
     * splitting is dominated: vectors on either side are isolated from the other side. */
    const double *domination_violations;
} hd_order_over;

enum { HD_SPECTRUM_BLOCKS_MIN = 16 };

HD_API_END
#endif
