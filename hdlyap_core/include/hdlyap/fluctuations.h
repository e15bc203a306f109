/** Fluctuations of the growth of the Gram-Schmidt vectors over finite times [T25] (Kuptsov and
 * Politi, Phys. Rev. Lett. 107, 114101 (2011)). The growth of vector i over a time t is the
 * logarithm of the factor by which it grows, the sum of ln R_ii over the orthonormalisations in t;
 * its mean is lambda_i t. This header has variances and covariances of growth, their limits for
 * long times, and how often vectors change the order of their growth. Vectors are columns of the
 * frame, col 0 .. n - 1, largest exponent first. Several threads may read at once while no thread
 * calls the run. [T25] is the tag of an equation in THEORY.md. */
#ifndef HDLYAP_FLUCTUATIONS_H
#define HDLYAP_FLUCTUATIONS_H

#include "hdlyap/steps.h"

HD_API_BEGIN

/** Most columns whose pairs are compared. They are the last ones, that is those of the smallest
 * exponents, among the columns of positive exponents that the run has. */
enum { HD_FLUCTUATING = 96 };

/** Sums of growth over times of up to HD_TIMES_MAX lengths; owned by the run. */
typedef struct hd_fluctuations hd_fluctuations;

/** Number of lengths of time over which growth has been summed at least once, 0 .. HD_TIMES_MAX.
 * Length k = 0 is that of one sample, or about fluctuation_time if the scene gives it; a time of
 * length k + 1 consists of two of length k. */
int hd_fluctuations_times(const hd_fluctuations *fluctuations);
/** Mean length of the times of length k, their number, and how often vectors changed the order of
 * their growth over them. Its arrays belong to `fluctuations`. */
hd_order_over hd_fluctuations_order(const hd_fluctuations *fluctuations, int k);

/** Variance of the growth of vector col over times of length k, divided by the length [1/time
 * unit]; NaN if there was only one such time. */
double hd_fluctuations_variance(const hd_fluctuations *fluctuations, int k, int col);

/** The limit, for long times, of a variance or covariance of growth divided by the time [1/time
 * unit]. */
typedef struct hd_diffusion {
    double value; /**< the limit; 0 while it is not known */
    double error; /**< standard error of the limit; negative while it is not known */
} hd_diffusion;

/** Diffusion of the exponent of vector col: D_ii = lim var(growth_i) / t. An exponent averaged over
 * a long time t has the variance D_ii / t. */
hd_diffusion hd_fluctuations_diffusion(const hd_fluctuations *fluctuations, int col);

/** Which columns belong to which step: for the resolved steps of positive exponents, in the order
 * of their first columns. Only columns whose pairs are compared are in it, and of these a column
 * belongs to the step that hd_steps_of_vector says. */
typedef struct hd_step_columns {
    int count;
    int step[HD_FLUCTUATING]; /**< step[count]: index of each step in hd_steps */
    /** Number of columns of each step, [count]. */
    int columns[HD_FLUCTUATING];
    /** own[k][columns[k]]: the columns of step k, ascending. */
    int own[HD_FLUCTUATING][HD_FLUCTUATING];
} hd_step_columns;
/** Finds the columns of each step of `steps`, which are those of the same run. */
hd_step_columns hd_fluctuations_steps(const hd_fluctuations *fluctuations, const hd_steps *steps);

/** Mean of D_ij = lim cov(growth_i, growth_j) / t over columns i of step a and j of step b, which
 * are numbers in `of`, 0 .. of->count - 1. If a equals b, the mean is over i and j that differ; for
 * a step of a single column it is then not known. */
hd_diffusion hd_fluctuations_covariance(const hd_fluctuations *fluctuations,
                                        const hd_step_columns *of, int a, int b);
/** How often columns of steps a and b change their order: the fraction, over all times of length k
 * and all pairs of a column of a and a column of b, in which the column of smaller index grew less.
 * If a equals b, pairs of two different columns. NaN if there is no pair. */
double hd_fluctuations_reversed(const hd_fluctuations *fluctuations, int k,
                                const hd_step_columns *of, int a, int b);

HD_API_END
#endif
