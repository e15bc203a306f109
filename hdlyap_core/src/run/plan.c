/** A run's state -> where the next orthonormalisation falls, and whether the sample ends there.
 *
 * An interval is as long as the conditioning allows. It ends early where all vectors must be known.
 * A sample is as many intervals as come nearest to what it should be, or fewer, if phases cannot
 * wait so long. */
#include "run/plan.h"

#include <math.h>

#include "run/factorise.h"

/** A rest that could be longer by less than this factor is an equal share. */
static const double DIVIDED = 1.25;
/** Orthonormalisations that come earlier by this factor are cheaper than to measure every state. */
static const double WORTH_A_STATE = 0.875;
/** Times that are this close, as a part of an interval, are one. */
static const double CLOSE = 1e-6;
/** Of samples, for standard errors: fewer in an averaging would make them late and rough. */
static const double SAMPLES_MIN = 32.0;
/** Of a block, so that samples that are a little shorter fill it; samples in a block, however short
 * the run; and intervals in a sample that need not fit it. */
static const double WHOLE_BLOCK = 1.05, IN_A_BLOCK = 2.0, IN_A_SAMPLE = 3.0;

/** Longest time from one look at the phases to the next; INFINITY if nobody looks. */
static double phases_sampling(const hd_run *run)
{
    const unsigned phases = run->observe & HD_OBSERVE_OF_PHASES;
    const double wanted = run->scene.phase_interval;
    if (!hd_run_is_observing(run) || !phases) return INFINITY;
    const double needed = hd_observer_sampling(&run->observer, phases);
    return wanted > 0 ? fmin(wanted, needed) : needed;
}

/** An equal part of what is left, none longer than `most`. */
static double share(double left, double most)
{
    return left < INFINITY ? left / ceil(left / most) : most;
}

/** In a run that is not much longer than errors need, samples fill the blocks of the averages: each
 * one interval, where intervals are not much shorter. */
double hd_run_sample_longest(const hd_run *run)
{
    const hd_schedule *s = &run->schedule;
    const double block = WHOLE_BLOCK * hd_run_block_least(run);
    if (s->stage != HD_AVERAGING) return INFINITY;
    const double wanted = fmax(s->length[HD_AVERAGING] / SAMPLES_MIN, block / IN_A_BLOCK);
    const double most = fmin(run->sample_max, wanted);
    const double usual = hd_interval_longest(&run->interval).length;
    if (most >= block) return most;
    return share(block, usual < most && usual > most / IN_A_SAMPLE ? usual : most);
}

/** The next time at which all vectors must be known: the end of the stage, or a report for which
 * somebody wants them; the first one has something to say, too. */
static double next_stop(const hd_run *run)
{
    const hd_schedule *s = &run->schedule;
    const bool averaging = s->stage == HD_AVERAGING, observing = hd_run_is_observing(run);
    double stop = hd_schedule_stage_end(s);
    if (averaging && hd_spectrum_time(run->spectrum) == 0) stop = hd_schedule_cut(s);
    if (observing && (run->observe & HD_OBSERVE_AT_REPORTS)) stop = hd_schedule_cut(s);
    if (observing && (run->observe & HD_OBSERVE_FIELDS))
        stop = fmin(stop, hd_schedule_next_multiple(s, run->in_force.field_interval));
    return stop;
}

/** The next time at which covariant vectors are looked at. */
static double next_snapshot(const hd_run *run)
{
    const double now = hd_run_time(run);
    const double due = hd_run_is_windowing(run) ? hd_windows_due(&run->windows, now) : INFINITY;
    return due > now ? due : INFINITY;
}

/** Time until the phases must be known; INFINITY if they need not. */
static double phases_left(const hd_run *run)
{
    const double left = run->sample.begin + phases_sampling(run) - hd_run_time(run);
    return left > 0 ? left : INFINITY;
}

/** A little shorter, if that saves a measured state before the phases must be known. */
static double rounded_down(double length, double left)
{
    if (!(left < INFINITY)) return length;
    const double part = left / ceil(left / length * (1.0 - CLOSE));
    return part < length && part > WORTH_A_STATE * length ? part : length;
}

/** The next interval, up to `left` long; why not longer. */
static hd_interval_length next_interval(const hd_run *run, double left)
{
    const double sample = hd_run_sample_longest(run), most = hd_advance_longest(&run->advance);
    hd_interval_length next = hd_interval_next(&run->interval, left);
    if (next.length > sample) next = (hd_interval_length){share(left, sample), HD_LIMIT_SAMPLE};
    if (next.length > most) next = (hd_interval_length){share(left, most), HD_LIMIT_EVENTS};
    const double phases = phases_left(run);
    double rounded = next.length < left ? rounded_down(next.length, phases) : next.length;
    rounded = fmin(rounded, phases);
    if (rounded < next.length) next = (hd_interval_length){rounded, HD_LIMIT_LOOK};
    next.length = fmax(next.length, hd_advance_shortest(&run->advance));
    return next;
}

/** True if the sample should end with an interval of this length: no other end would come closer to
 * what it should be, or the phases cannot wait. */
static bool is_last(const hd_run *run, double length)
{
    const double gone = hd_run_time(run) + length - run->sample.begin, close = CLOSE * length;
    return gone + 0.5 * length >= hd_run_sample_longest(run) ||
           gone + length > phases_sampling(run) + close;
}

/** True if nothing but rounding would be left of it. */
static bool is_rest(double length, double left) { return length >= left * (1.0 - CLOSE); }

/** Why an interval that takes all of what is left is no longer. */
static hd_limit limit_of_rest(const hd_run *run, double left)
{
    const hd_interval_length longest = hd_interval_longest(&run->interval);
    if (longest.length < DIVIDED * left) return longest.limit;
    return hd_run_time(run) + left < hd_schedule_stage_end(&run->schedule) ? HD_LIMIT_SCHEDULE
                                                                           : HD_LIMIT_STAGE;
}

void hd_run_plan(hd_run *run)
{
    const double now = hd_run_time(run), measured = next_stop(run);
    const double stop = fmin(measured, next_snapshot(run)), left = stop - now;
    run->interval.norm = hd_run_norm(run, false);
    hd_interval_length next = next_interval(run, left);
    run->sample.ends = is_rest(next.length, measured - now) || is_last(run, next.length);
    if (run->sample.ends) {
        run->interval.norm = HD_NORM_FULL;
        next = next_interval(run, left);
    }
    run->interval_end = is_rest(next.length, left)
                            ? stop
                            : hd_schedule_snap(&run->schedule, now, next.length);
    run->limit = next.limit == HD_LIMIT_SCHEDULE ? limit_of_rest(run, left) : next.limit;
}
