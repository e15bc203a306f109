/** Lyapunov exponents with standard errors that see the correlation time. One thread at a time, to
 * read as well: there is a workspace in it. */
#ifndef HDLYAP_SPECTRUM_H
#define HDLYAP_SPECTRUM_H

#include "hdlyap/status.h"

HD_API_BEGIN

typedef struct hd_spectrum hd_spectrum;

double hd_spectrum_time(const hd_spectrum *spectrum); /**< averaged time */
double hd_spectrum_exponent(const hd_spectrum *spectrum,
                            int col); /**< running mean of ln R_ll / t */
/** Standard error of the mean, from blocks that are joined while they remember each other [T8];
 * negative while it cannot be known: fewer than HD_SPECTRUM_BLOCKS_MIN blocks, or a memory that is
 * as long as they are. It is itself known to 7-10 % from 48 blocks on, to 18 % from 16. O(blocks).
 */
double hd_spectrum_std_error(const hd_spectrum *spectrum, int col);
/** Mean over the samples that have ended since the last report (or since the averaging
 * began), NaN if none has. */
double hd_spectrum_local(const hd_spectrum *spectrum, int col);

typedef struct hd_spectrum_sums {
    double local_time;       /**< averaged time of hd_spectrum_local; 0 without any */
    double ks_entropy;       /**< sum of the positive exponents carried */
    double ks_entropy_error; /**< its standard error; negative if not yet known */
    /** max over pairs of |lambda_l + lambda_(4N+1-l)|; negative unless there are all 4N. Zero by
     * construction where half of them follow from the others [T18]. */
    double pairing_error;
} hd_spectrum_sums;
hd_spectrum_sums hd_spectrum_sum_up(const hd_spectrum *spectrum); /**< O(n blocks) */

enum { HD_SPECTRUM_BLOCKS_MIN = 16 };

HD_API_END
#endif
