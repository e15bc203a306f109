/** Lyapunov exponents, with standard errors that take correlations in time into account. An
 * exponent is the mean growth rate of a vector; columns col = 0 .. n - 1 are in the order of the
 * exponents, largest first. The functions of one run share a workspace: only one thread at a time
 * may call them for the same run. Tags as [T8] are those of equations in THEORY.md. */
#ifndef HDLYAP_SPECTRUM_H
#define HDLYAP_SPECTRUM_H

#include "hdlyap/status.h"

HD_API_BEGIN

/** The exponents of a run, or of its covariant vectors; owned by the run. */
typedef struct hd_spectrum hd_spectrum;

/** Averaged time: the length of all samples [time units]. */
double hd_spectrum_time(const hd_spectrum *spectrum);
/** Exponent of vector col: the sum of ln R_ll over the averaged time, divided by that time [1/time
 * unit]; 0 before the first sample. */
double hd_spectrum_exponent(const hd_spectrum *spectrum, int col);
/** Standard error of an exponent [1/time unit], from blocks of samples that are joined until they
 * are independent [T8]. Negative while it is not known: with fewer than HD_SPECTRUM_BLOCKS_MIN
 * blocks, or while blocks are not longer than the correlation time. It is itself known to 18 % with
 * 16 blocks and to 7-10 % from 48 blocks on. */
double hd_spectrum_std_error(const hd_spectrum *spectrum, int col);
/** Growth rate of vector col over the samples that ended since the last report [1/time unit]; NaN
 * if none did. */
double hd_spectrum_local(const hd_spectrum *spectrum, int col);

/** Sums over all exponents that are computed. */
typedef struct hd_spectrum_sums {
    double local_time; /**< time over which hd_spectrum_local averages; 0 if no sample ended [time
                          units] */
    double ks_entropy; /**< Kolmogorov-Sinai entropy: sum of the exponents that are computed in
                          front of those that vanish, by their number; of those above 0 if they are
                          not in pairs of opposite sign [1/time unit] */
    double ks_entropy_error; /**< standard error of ks_entropy; negative while it is not known */
    /** Largest |lambda_l + lambda_m| of two conjugate exponents, whose sum vanishes in theory
     * [1/time unit]; negative unless all exponents are computed, and if they are not in pairs of
     * opposite sign. 0 by construction if half of them follow from the others [T18]. */
    double pairing_error;
    /** Sum of all exponents, which is the mean divergence of the flow (hd_run_divergence) [1/time
     * unit]; NaN unless all are computed. */
    double exponent_sum;
    double
        exponent_sum_error; /**< standard error of exponent_sum; negative while it is not known */
    /** Kaplan-Yorke dimension [T27]; NaN if exponents are in pairs of opposite sign, where it would
     * be that of phase space, and unless so many are computed that their sum falls below 0. */
    double kaplan_yorke;
    double
        kaplan_yorke_error; /**< standard error of kaplan_yorke; negative while it is not known */
} hd_spectrum_sums;
/** Computes the sums. O(n blocks). */
hd_spectrum_sums hd_spectrum_sum_up(const hd_spectrum *spectrum);

/** Most lengths of time over which growth is compared; each length is twice the one before. */
enum { HD_TIMES_MAX = 20 };
/** How often vectors change the order of their growth over times of one length. */
typedef struct hd_order_over {
    double time; /**< mean length of these times [time units] */
    long count;  /**< number of times of this length that have passed */
    /** Fraction of these times over which vector col grew less than vector col + 1, [n - 1]. */
    const double *violations;
    /** Fraction of these times over which some vector 0 .. col grew less than some later one, [n -
     * 1]. If it is 0, the splitting between col and col + 1 is dominated: over such times the
     * vectors on one side stay apart from those on the other. */
    const double *domination_violations;
} hd_order_over;

/** Fewest blocks that give a standard error. */
enum { HD_SPECTRUM_BLOCKS_MIN = 16 };

HD_API_END
#endif
