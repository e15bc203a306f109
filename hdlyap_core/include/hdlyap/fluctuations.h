/** Fluctuations of the growth of the Gram-Schmidt vectors: variances, covariances and order over
 * finite times [T25] (Kuptsov and Politi, Phys. Rev. Lett. 107, 114101 (2011)). Several threads may
 * read at once while no thread advances the run. */
#ifndef HDLYAP_FLUCTUATIONS_H
#define HDLYAP_FLUCTUATIONS_H

#include "hdlyap/steps.h"

HD_API_BEGIN

/** Each pair of so many columns is compared: the last ones of the positive half that the run has.
 */
enum { HD_FLUCTUATING = 96 };

typedef struct hd_fluctuations hd_fluctuations;

/** Number of times over which growth has been taken, shortest first. Each is about twice as long as
 * the one before. */
int hd_fluctuations_times(const hd_fluctuations *fluctuations);
hd_order_over hd_fluctuations_order(const hd_fluctuations *fluctuations, int k);

/** Variance of a column's growth over time k, divided by the time [1/time unit]; NaN if the time
 * has passed once only. */
double hd_fluctuations_variance(const hd_fluctuations *fluctuations, int k, int col);

/** The limit of a variance or covariance per time for long times [1/time unit]. */
typedef struct hd_diffusion {
    double value; /**< 0 while it is not known */
    double error; /**< standard error; negative while the limit is not known */
} hd_diffusion;

/** D_ii = lim var(growth) / time of a column. */
hd_diffusion hd_fluctuations_diffusion(const hd_fluctuations *fluctuations, int col);

/** Resolved steps of the positive half, in the order of their columns. A column is a step's own if
 * hd_steps_of_vector says so and its pairs are compared. */
typedef struct hd_step_columns {
    int count;
    int step[HD_FLUCTUATING]; /**< index in hd_steps */
    int columns[HD_FLUCTUATING];
    int own[HD_FLUCTUATING][HD_FLUCTUATING]; /**< [columns] of each step */
} hd_step_columns;
hd_step_columns hd_fluctuations_steps(const hd_fluctuations *fluctuations, const hd_steps *steps);

/** Mean of D_ij = lim cov(growth_i, growth_j) / time over columns i of step a and j of step b. If a
 * equals b, i and j differ; a step of one column has no such pair, and the mean is not known. */
hd_diffusion hd_fluctuations_covariance(const hd_fluctuations *fluctuations,
                                        const hd_step_columns *of, int a, int b);
/** Fraction, over all passed times k and all such pairs, in which the column in front grew less;
 * NaN without a pair. */
double hd_fluctuations_reversed(const hd_fluctuations *fluctuations, int k,
                                const hd_step_columns *of, int a, int b);

HD_API_END
#endif
