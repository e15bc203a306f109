/** Growth of vectors, sample by sample -> variances, covariances and the order of growth over
 * finite times; each time is twice as long as the one before [T25]. Memory does not grow with the
 * run. */
#ifndef HD_DOUBLING_H
#define HD_DOUBLING_H

#include "base/archive.h"
#include "hdlyap/spectrum.h"

typedef struct hd_doubling hd_doubling;

/** What a doubling is made for. */
typedef struct hd_doubling_def {
    int vectors;
    int first, count; /**< each pair of these columns is compared, too; count 0: none */
    double shortest;  /**< the first time: as many samples as come nearest to it; 0: one sample */
} hd_doubling_def;

HD_MUST_CHECK hd_status hd_doubling_create(hd_doubling **out, hd_doubling_def def);
void hd_doubling_free(hd_doubling *doubling);
double hd_doubling_bytes(hd_doubling_def def);
const hd_doubling_def *hd_doubling_of(const hd_doubling *doubling);
void hd_doubling_clear(hd_doubling *doubling);
/** Drops times that have begun, because the next sample does not follow the last one. */
void hd_doubling_break(hd_doubling *doubling);
/** Adds growth[vectors] over dt > 0. Amortised O(vectors + count^2). */
void hd_doubling_add(hd_doubling *doubling, const double *growth, double dt);

/** Number of times that have passed at least once; k counts them, shortest first. */
int hd_doubling_times(const hd_doubling *doubling);
hd_order_over hd_doubling_order(const hd_doubling *doubling, int k);

/** Variance of the growth over time k, divided by the time; NaN if it has passed once only. */
double hd_doubling_variance(const hd_doubling *doubling, int k, int col);
/** Covariance of two columns that are compared, divided by the time. */
double hd_doubling_covariance(const hd_doubling *doubling, int k, int col, int other);
/** Fraction of the times over which `col` grew less than `later`; both are compared. */
double hd_doubling_reversed(const hd_doubling *doubling, int k, int col, int later);

void hd_doubling_archive(hd_doubling *doubling, hd_archive *archive);

#endif
