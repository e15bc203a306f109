/** Conditioning of past intervals -> length of the next one. */
#include "tangent/interval.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

/** A condition below this is always allowed: a few collisions make as much, so shorter intervals
 * would not lower it, and more of them would add up. */
static const double CONDITION_MIN = 1e3;
/** Standard deviations of ln(condition) kept free below the maximum: few intervals are then
 * repaired, which costs less than shorter intervals would. At least a factor of 2. */
static const double MARGIN = 2.0, HEADROOM_MIN = 0.7;
/** Largest logarithm by which a column may grow: the square of e^150 is still far from overflow. */
static const double STRETCH_MAX = 150.0;
/** Saves an orthonormalisation: a remaining time up to this factor longer than the interval is not
 * cut in two. The condition is too large now and then, and repairing that costs less. */
static const double STRAIN = 1.06;
/** Limits of the error of one interval, in units of its usual share of the accuracy: at least MIN,
 * also if nothing was saved; at most MAX; at most BEFORE before the averaging, where only the
 * largest error counts, because eight intervals make up for it. */
static const double SHARES_MAX = 20.0, SHARES_MIN = 0.5, SHARES_BEFORE = 4.0;
static const double AIM_MIN = 0.3; /* of ln(condition) */
static const double GROW_MAX = 2.0, FORGET = 0.1, VARIANCE_FIRST = 0.5;

hd_interval hd_interval_first(double first, double limit, double accuracy)
{
    return (hd_interval){.limit = limit,
                         .accuracy = accuracy,
                         .last = fmin(first, limit),
                         .growth = {{.variance = VARIANCE_FIRST}, {.variance = VARIANCE_FIRST}},
                         .saved = INFINITY};
}

/** Growth of the condition in a norm; as long as nothing is known of it, that in the other norm. */
static hd_growth growth_of(const hd_interval *interval, hd_norm norm)
{
    const hd_norm other = norm == HD_NORM_FULL ? HD_NORM_DQ : HD_NORM_FULL;
    return interval->growth[interval->growth[norm].slope > 0 ? norm : other];
}

double hd_interval_counted(double condition, hd_norm norm)
{
    return norm == HD_NORM_DQ ? HD_ROUNDING_OF_DQ * condition : condition;
}

/** The condition that uses up the accuracy's share of this many time units. */
static double condition_of(const hd_interval *interval, double time)
{
    const double counted = interval->accuracy * time / (HD_ENLARGED * HD_ROUNDING);
    const double condition = counted / hd_interval_counted(1.0, interval->norm);
    return fmax(CONDITION_MIN, fmin(HD_CONDITION_MAX, condition));
}

double hd_interval_condition_max(const hd_interval *interval, double length)
{
    const double usual = fmax(length, interval->last);
    const double least = SHARES_MIN * usual,
                 most = (interval->saved < INFINITY ? SHARES_MAX : SHARES_BEFORE) * usual;
    return condition_of(interval, fmax(least, fmin(most, length + interval->saved)));
}

double hd_interval_piece_max(const hd_interval *interval, double length, double whole)
{
    const double most = hd_interval_condition_max(interval, length);
    return length < whole ? fmin(most, condition_of(interval, fmax(length, interval->last))) : most;
}

static double follow(double old, double seen) { return fmax(seen, old + FORGET * (seen - old)); }

/** The condition grows exponentially, times a factor from grazing collisions. That factor scatters
 * in the same way at all lengths, so it is kept apart. The first interval and a much longer one
 * start the mean anew; a much shorter one says little about usual ones. */
void hd_interval_learn(hd_interval *interval, double length, double condition, double stretch)
{
    const double seen = log(condition), slope = seen / length;
    hd_growth growth = growth_of(interval, interval->norm);
    const bool afresh = growth.slope == 0 || length > 1.5 * interval->last;
    const double off = afresh ? 0.0 : seen - growth.slope * length;
    const double usual = fmax(length, interval->last), weight = FORGET * length / usual;
    growth.slope = afresh ? slope : growth.slope + weight * off / usual;
    growth.variance += weight * (off * off - growth.variance);
    interval->growth[interval->norm] = growth;
    interval->stretch = follow(interval->stretch, stretch / usual);
    interval->last = follow(interval->last, length);
}

/** Learns as if the condition had been measured at the maximum. */
void hd_interval_failed(hd_interval *interval, double length)
{
    hd_growth growth = growth_of(interval, interval->norm);
    const double off = log(hd_interval_condition_max(interval, length)) - growth.slope * length;
    if (off > 0) growth.slope += FORGET * off / length;
    interval->growth[interval->norm] = growth;
}

double hd_interval_condition(const hd_interval *interval, double length)
{
    return exp(growth_of(interval, HD_NORM_FULL).slope * length);
}

static void shorten(hd_interval_length *chosen, double length, hd_limit limit)
{
    if (length < chosen->length) *chosen = (hd_interval_length){length, limit};
}

/** The longest interval that rarely exceeds the allowed condition, and what limits it. */
hd_interval_length hd_interval_longest(const hd_interval *interval)
{
    const hd_growth growth = growth_of(interval, interval->norm);
    const double most = log(hd_interval_condition_max(interval, interval->last));
    const double aim = most - fmax(MARGIN * sqrt(growth.variance), HEADROOM_MIN);
    hd_interval_length chosen = {GROW_MAX * interval->last, HD_LIMIT_GROWTH};
    shorten(&chosen, interval->limit, HD_LIMIT_SCENE);
    if (growth.slope > 0) shorten(&chosen, fmax(aim, AIM_MIN) / growth.slope, HD_LIMIT_CONDITION);
    if (interval->stretch > 0) shorten(&chosen, STRETCH_MAX / interval->stretch, HD_LIMIT_OVERFLOW);
    return chosen;
}

hd_interval_length hd_interval_next(const hd_interval *interval, double remaining)
{
    const hd_interval_length longest = hd_interval_longest(interval);
    const double strained = fmin(STRAIN * longest.length, interval->limit);
    if (strained >= remaining) return (hd_interval_length){remaining, HD_LIMIT_SCHEDULE};
    return (hd_interval_length){hd_equal_part(remaining, longest.length), longest.limit};
}

double hd_equal_part(double left, double most)
{
    return left < INFINITY ? left / ceil(left / most) : most;
}

void hd_interval_archive(hd_interval *interval, hd_archive *archive)
{
    bool learnt = true;
    for (int norm = 0; norm < 2; norm++) {
        hd_archive_double(archive, "interval slope", &interval->growth[norm].slope);
        hd_archive_double(archive, "interval variance", &interval->growth[norm].variance);
        learnt &= interval->growth[norm].slope >= 0 && interval->growth[norm].variance >= 0;
    }
    hd_archive_double(archive, "interval stretch", &interval->stretch);
    hd_archive_double(archive, "interval last", &interval->last);
    learnt &= interval->stretch >= 0;
    hd_archive_expect(archive, learnt && interval->last > 0, "interval", "it is negative");
}
