/** Growth of vectors, sample by sample -> variances, covariances and the order of growth over
 * stretches of time [T25]. There are up to HD_TIMES_MAX lengths, k = 0 the shortest; stretches of
 * length k + 1 consist of two of length k. Memory does not grow with the run. */
#ifndef HD_DOUBLING_H
#define HD_DOUBLING_H

#include "base/archive.h"
#include "hdlyap/spectrum.h"

typedef struct hd_doubling hd_doubling;

/** What growth is given, and what is compared. */
typedef struct hd_doubling_def {
    /** number of vectors whose growth is given */
    int vectors;
    int first, count; /**< each pair of the columns first .. first + count - 1 is compared, too;
                         count 0: none */
    /** The shortest length [time units]: as many samples as come nearest to it; 0: one sample. */
    double shortest;
} hd_doubling_def;

/** Fails with HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_doubling_create(hd_doubling **out, hd_doubling_def def);
void hd_doubling_free(hd_doubling *doubling);
/** Bytes that it takes. */
double hd_doubling_bytes(hd_doubling_def def);
const hd_doubling_def *hd_doubling_of(const hd_doubling *doubling);
/** Forgets all growth. */
void hd_doubling_clear(hd_doubling *doubling);
/** Forgets the stretches that have begun, because the next sample does not follow the last one. */
void hd_doubling_break(hd_doubling *doubling);
/** Adds a sample: the growth[vectors] over a time dt > 0. Amortised O(vectors + count^2). */
void hd_doubling_add(hd_doubling *doubling, const double *growth, double dt);

/** Number of lengths of which at least one stretch has passed; k is below it. */
int hd_doubling_times(const hd_doubling *doubling);
/** Order of growth over stretches of length k; the arrays belong to the doubling. */
hd_order_over hd_doubling_order(const hd_doubling *doubling, int k);

/** Variance of the growth of a column over stretches of length k, divided by the length [1/time
 * unit]; NaN with a single stretch. */
double hd_doubling_variance(const hd_doubling *doubling, int k, int col);
/** Covariance of the growth of two compared columns, divided likewise. */
double hd_doubling_covariance(const hd_doubling *doubling, int k, int col, int other);
/** Fraction of the stretches of length k in which column `col` grew less than column `later`, which
 * comes after it; both are compared. */
double hd_doubling_reversed(const hd_doubling *doubling, int k, int col, int later);

void hd_doubling_archive(hd_doubling *doubling, hd_archive *archive);

#endif
