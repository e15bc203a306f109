/** The time between orthonormalisations: as long as the measured conditioning allows, never longer.
 */
#ifndef HD_INTERVAL_H
#define HD_INTERVAL_H

#include <float.h>

#include "hdlyap/interval.h"
#include "tangent/ortho.h"

/** The rounding of V enters the sum of one interval's logarithms as at most this times its
 * condition; seen: up to 1.4 eps [T6]. */
#define HD_ROUNDING (2.0 * DBL_EPSILON)

/** What a condition in the norm of dq counts: it is so much smaller, the error is not [T6]. */
#define HD_ROUNDING_OF_DQ 2.5

/** Neighbouring vectors that change places enlarge that: seen up to 18 times [T6]. */
#define HD_ENLARGED 20.0

/** Most that an orthonormalisation by products may leave: beyond, block Gram-Schmidt may meet
 * panels that Cholesky cannot factor. */
#define HD_CONDITION_MAX 1e12

/** Most that repeated passes are asked to factor: they stay right to eps * condition, 1e-3 of one
 * interval, once. */
#define HD_CONDITION_STABLE 1e13

/** Of ln(condition), in one norm. */
typedef struct hd_growth {
    double slope;    /**< per time unit, mean of the last ones */
    double variance; /**< about slope * length, likewise */
} hd_growth;

/** Adapts to ln(condition) per time unit as it is measured [T6]. */
typedef struct hd_interval {
    double limit;        /**< never longer [time units] */
    double accuracy;     /**< of an exponent that rounding may spoil [1/time unit] */
    hd_norm norm;        /**< of the next step, and of what is learnt */
    hd_growth growth[2]; /**< in each norm */
    double stretch;      /**< largest |ln R_ll| per time unit: rises at once, falls slowly */
    double last;         /**< longest of the last intervals, or the first guess; falls slowly */
    /** Averaged time whose share of the accuracy is not used up; negative: used in advance;
     * INFINITY before the averaging */
    double saved;
} hd_interval;

hd_interval hd_interval_first(double first, double limit, double accuracy);

/** A condition as it counts for rounding, whatever its norm. */
double hd_interval_counted(double condition, hd_norm norm);

/** Largest condition that leaves the means as accurate as asked, with what is saved, after an
 * interval this long; some part of the share of one as long as usual is always given. */
double hd_interval_condition_max(const hd_interval *interval, double length);

/** Largest condition that a piece of an interval of `whole` may have: it uses no more than the
 * share of a usual interval. Intervals that were not taken back mostly stay far below what they are
 * allowed, pieces of the others just below. */
double hd_interval_piece_max(const hd_interval *interval, double length, double whole);

/** What an interval of `length` showed. */
void hd_interval_learn(hd_interval *interval, double length, double condition, double stretch);

/** An interval of `length` turned out too long: its condition was not even measured. */
void hd_interval_failed(hd_interval *interval, double length);

/** Condition to be expected after `length`, in the whole norm. */
double hd_interval_condition(const hd_interval *interval, double length);

typedef struct hd_interval_length {
    double length;
    hd_limit limit; /**< why not longer */
} hd_interval_length;

/** What the conditioning allows the next interval to be. */
hd_interval_length hd_interval_longest(const hd_interval *interval);

/** The next interval: an equal share of `remaining`, as few shares as the conditioning allows; all
 * of it (HD_LIMIT_SCHEDULE) if it can. */
hd_interval_length hd_interval_next(const hd_interval *interval, double remaining);

#endif
