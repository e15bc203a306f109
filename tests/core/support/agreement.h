/** Whether standard errors are true: how far the same numbers scatter over independent runs,
 * against what each run states. */
#ifndef HD_TEST_AGREEMENT_H
#define HD_TEST_AGREEMENT_H

#include "numbers.h"

/** Fewer seeds than this with a standard error say nothing. */
enum { AGREEMENT_LEAST = 10 };

/** Of a row of several numbers: each by itself, then the median over them, or sums over them.
 * Ratios and parts are negative where too few seeds state an error. */
typedef struct agreement {
    uint64_t of;  /**< what most seeds found the first number of the row from: only these count */
    int taken;    /**< seeds, median */
    int stated;   /**< of these, those with a standard error, median */
    double mean;  /**< of the first number */
    double error; /**< root mean square of its stated errors */
    double ratio; /**< standard deviation over the seeds / root mean square error: median */
    double within[2]; /**< part of them that lie within one and two errors of the mean */
} agreement;

/** Number k of a seed s is numbers[s * stride + k]. */
agreement agreement_of(const number *numbers, int seeds, int stride, int first, int count);

/** The rule: scatter / stated is 0.8 to 1.25, and the parts within one and two errors are those of
 * a normal distribution, or of errors that are themselves known from a dozen blocks, but for three
 * standard errors of a part of so many seeds. Of 100 seeds with true errors 1 % break it. */
bool agreement_holds(const agreement *a, int seeds);

#endif
