/** Conditioning of past intervals -> length of the next one. */
#include "interval.h"

#include <float.h>
#include <math.h>

/** Cholesky of the Gram matrix loses orthogonality as 16 eps condition^2: at 1e7 a second pass still heals it. */
static const double CONDITION_CHOLESKY = 1e7;
/** ln(condition) fluctuates by less than 2 between intervals: aim this factor below the maximum, so that
 *  repairs are rare. */
static const double HEADROOM = 8.0;
/** A column may grow to e^150 before its square comes near overflow. */
static const double STRETCH_MAX = 150.0;
static const double GROW_MAX = 2.0, FORGET = 0.1;

hd_interval hd_interval_first(double first, double limit, double accuracy)
{
    return (hd_interval){.limit = limit, .accuracy = accuracy, .last = fmin(first, limit)};
}

double hd_interval_condition_max(const hd_interval *interval, double length)
{
    return fmax(2.0, fmin(CONDITION_CHOLESKY,
                          interval->accuracy * fmax(length, interval->last) / DBL_EPSILON));
}

static double follow(double old, double seen) { return fmax(seen, old + FORGET * (seen - old)); }

void hd_interval_learn(hd_interval *interval, double length, double condition, double stretch)
{
    const double slope = log(condition) /
                         length; /* falls with the length: a short one tells little */
    interval->slope = length > 1.1 * interval->last ? slope : follow(interval->slope, slope);
    interval->stretch = follow(interval->stretch, stretch / length);
    interval->last = length;
}

double hd_interval_next(const hd_interval *interval, double remaining)
{
    const double aim = fmax(hd_interval_condition_max(interval, interval->last) / HEADROOM, 2.0);
    double length = fmin(interval->limit, GROW_MAX * interval->last);
    if (interval->slope > 0) length = fmin(length, log(aim) / interval->slope);
    if (interval->stretch > 0) length = fmin(length, STRETCH_MAX / interval->stretch);
    if (length >= remaining) return remaining;
    return remaining / ceil(remaining / length);
}
