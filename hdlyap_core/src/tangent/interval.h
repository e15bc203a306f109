/** The time between orthonormalisations: as long as the measured conditioning allows, never longer.
 */
#ifndef HD_INTERVAL_H
#define HD_INTERVAL_H

#include <float.h>

#include "base/archive.h"
#include "hdlyap/interval.h"
#include "tangent/ortho.h"

/** The rounding of V enters the sum of one interval's logarithms as at most this times its
 * condition; seen: up to 1.4 eps [T6]. */
#define HD_ROUNDING (2.0 * DBL_EPSILON)

/** Factor by which a condition in the norm of dq counts: it is smaller by this, but the error is
 * not [T6]. */
#define HD_ROUNDING_OF_DQ 2.5

/** Factor by which the error grows if neighbouring vectors change places: up to 18 was seen [T6].
 */
#define HD_ENLARGED 20.0

/** Largest condition for an orthonormalisation by products: above it block Gram-Schmidt may meet
 * panels that Cholesky cannot factor. */
#define HD_CONDITION_MAX 1e12

/** Largest condition that repeated passes are given to factor: they are right to eps * condition,
 * 1e-3 in a single interval. */
#define HD_CONDITION_STABLE 1e13

/** How ln(condition) grows, in one norm. */
typedef struct hd_growth {
    double slope;    /**< per time unit, mean over the last intervals */
    double variance; /**< about slope * length, over the last intervals */
} hd_growth;

/** Adapts to ln(condition) per time unit as it is measured [T6]. */
typedef struct hd_interval {
    double limit;        /**< longest interval that is allowed [time units] */
    double accuracy;     /**< error of an exponent that rounding may make [1/time unit] */
    hd_norm norm;        /**< norm of the next orthonormalisation */
    hd_growth growth[2]; /**< in each norm */
    double stretch;      /**< largest |ln R_ll| per time unit: rises at once, falls slowly */
    double last;         /**< longest of the last intervals, or the first guess; falls slowly */
    /** Averaged time whose share of the accuracy has not been used; negative: more was used than
     * was there; INFINITY before the averaging */
    double saved;
} hd_interval;

hd_interval hd_interval_first(double first, double limit, double accuracy);

/** The condition that counts for rounding, from one measured in this norm. */
double hd_interval_counted(double condition, hd_norm norm);

/** Largest condition of an interval this long that keeps the means as accurate as the scene asks
 * for, with the share that is saved. Part of a usual interval's share is always allowed. */
double hd_interval_condition_max(const hd_interval *interval, double length);

/** Largest condition of a piece of an interval of length `whole` that is repaired: a piece uses no
 * more than the share of a usual interval. Intervals mostly stay far below their limit, but pieces
 * of repaired ones come close to it. */
double hd_interval_piece_max(const hd_interval *interval, double length, double whole);

/** Adds the condition and growth that an interval of `length` showed. */
void hd_interval_learn(hd_interval *interval, double length, double condition, double stretch);

/** An interval of `length` turned out too long, and its condition could not be measured. */
void hd_interval_failed(hd_interval *interval, double length);

/** Condition to be expected after `length`, in the whole norm. */
double hd_interval_condition(const hd_interval *interval, double length);

typedef struct hd_interval_length {
    double length;
    hd_limit limit; /**< why it is not longer */
} hd_interval_length;

/** The longest next interval that conditioning allows. */
hd_interval_length hd_interval_longest(const hd_interval *interval);

/** The length of the parts if `left` is divided into equal parts, none longer than `most`. */
double hd_equal_part(double left, double most);

/** The next interval: `remaining` divided into as few equal shares as conditioning allows; the
 * whole of it (HD_LIMIT_SCHEDULE) if possible. */
hd_interval_length hd_interval_next(const hd_interval *interval, double remaining);

void hd_interval_archive(hd_interval *interval, hd_archive *archive);

#endif
