/** Scene, condition of the frame, and what observables need -> the next time at which something is
 * due.
 *
 * Stages follow each other at fixed times: equilibration (trajectory alone), warm-up of the frame,
 * averaging. Reports are due at multiples of their interval and where a stage ends. The frame is
 * orthonormalised as late as its condition allows, whenever reports are, or early where all vectors
 * must be known. A sample consists of as many intervals as come nearest to the length that it
 * should have, or of fewer if observables, as phases, need a measured state earlier. Without a
 * frame a sample is a stretch of time. */
#include "run/agenda.h"

#include <float.h>
#include <limits.h>
#include <math.h>

#include "averages/blocks.h"
#include "scene/scene.h"

/** Decides what is reported as the limit of an interval that takes all of the remaining time: its
 * condition, if that would have allowed less than DIVIDED times the remaining time; otherwise the
 * end of that time. */
static const double DIVIDED = 1.25;
/** Intervals are shortened by at most this factor to save a measured state. */
static const double WORTH_A_STATE = 0.875;
/** Two times that differ by less than this part are the same: of the report interval for a report
 * and the end of its stage; of its interval for an orthonormalisation. */
static const double CLOSE = 1e-6;
/** Relative difference below which the present time counts as the end of the stage: a duration that
 * is written with 15 digits is known to 23 eps, and sums of times are rounded. */
static const double ROUNDING = 64.0 * DBL_EPSILON;
/** Longest sample, in collisions of a particle. */
static const double COLLISIONS_PER_SAMPLE = 80.0;
/** Growth remembers this many collisions of each particle; shorter blocks would give errors that
 * are too small. */
static const double COLLISIONS_PER_BLOCK = 8.0;
/** A duration is divided into at least this many samples: with fewer, errors would be known late
 * and be rough. */
static const double SAMPLES_MIN = 32.0;
/** Samples may be a little shorter than planned; a block is aimed at this many times its least
 * length, so that they fill it. */
static const double WHOLE_BLOCK = 1.05;
/** Fewest samples in a block in a short run. */
static const double IN_A_BLOCK = 2.0;
/** The first samples are aimed at this many shortest blocks. The whole number of intervals, none
 * longer, that comes nearest is at least 0.92 of a block, which fills one. */
static const double FIRST_SAMPLE = 1.5 * HD_BLOCKS_NEARLY;
/** Length of the first blocks of such samples, in shortest ones: 0.92 to 1.84, as intervals fit. */
static const double FIRST_BLOCK = 1.3;
/** If a sample has more intervals than this, its length is not rounded to a whole number of them.
 */
static const double IN_A_SAMPLE = 3.0;

static hd_live_values in_force(const hd_scene_def *scene)
{
    return (hd_live_values){.target = scene->target, .field_interval = scene->field_interval};
}

hd_agenda hd_agenda_of(const hd_scene_def *scene, double rate)
{
    const double sample = COLLISIONS_PER_SAMPLE / rate, collision = sample / COLLISIONS_PER_SAMPLE;
    const double sound = hd_scene_sound_crossing(scene);
    const double block = fmax(COLLISIONS_PER_BLOCK * collision, sound);
    return (hd_agenda){
        .length = {scene->equilibration, scene->warmup, hd_agenda_averaging(scene->duration)},
        .report_interval = scene->report_interval,
        .in_force = in_force(scene),
        .sample_max = sample,
        .first_sample = FIRST_SAMPLE * block,
        .block = block};
}

void hd_agenda_begin_grown(hd_agenda *a) { a->first_sample = INFINITY; }

double hd_agenda_averaging(double duration) { return duration > 0 ? duration : INFINITY; }

/* ---- stages and reports -------------------------------------------------------------------- */

static void count_reports_from(hd_agenda *a, double now)
{
    a->origin = now;
    a->reports = 0;
}

void hd_agenda_enter(hd_agenda *a, hd_stage stage, double now)
{
    while (stage < HD_AVERAGING && a->length[stage] == 0) stage++;
    a->due &= ~(unsigned)HD_DUE_STAGE;
    a->stage = stage;
    hd_agenda_pass_sample(a, now);
    if (stage == HD_FINISHED) return;
    a->start = now;
    count_reports_from(a, now);
}

double hd_agenda_stage_end(const hd_agenda *a)
{
    return a->start + a->length[a->stage == HD_FINISHED ? HD_AVERAGING : a->stage];
}

/** Time of a report, as a product, so that rounding does not add up. */
static double report_at(const hd_agenda *a, double count)
{
    const double end = a->origin + count * a->report_interval, last = hd_agenda_stage_end(a);
    return end < last - CLOSE * a->report_interval ? end : last;
}

double hd_agenda_cut(const hd_agenda *a) { return report_at(a, (double)a->reports + 1.0); }

double hd_agenda_snap(const hd_agenda *a, double now, double length)
{
    const double end = now + length, count = round((end - a->origin) / a->report_interval);
    const double cut = report_at(a, fmax(count, (double)a->reports + 1.0));
    return fabs(end - cut) <= CLOSE * length ? cut : end;
}

double hd_agenda_next_multiple(const hd_agenda *a, double interval)
{
    const double r = a->report_interval, gone = a->origin - a->start;
    const bool first = a->reports == 0 && a->origin == a->start;
    if (first || interval <= r) return hd_agenda_cut(a);
    const double passed = floor((gone + ((double)a->reports + CLOSE) * r) / interval);
    const double count = ceil(((passed + 1.0) * interval - gone) / r - CLOSE);
    return report_at(a, fmax(count, (double)a->reports + 1.0));
}

/** True if `now` is at or beyond the end of the stage, but for rounding. */
static bool is_over(const hd_agenda *a, double now)
{
    return now >= hd_agenda_stage_end(a) * (1.0 - ROUNDING);
}

/** True if `now` is at or before the end of the stage, but for rounding. */
static bool reaches(const hd_agenda *a, double now)
{
    return now <= hd_agenda_stage_end(a) * (1.0 + ROUNDING);
}

/* ---- the next interval --------------------------------------------------------------------- */

double hd_agenda_sample_most(const hd_agenda *a)
{
    const double block = WHOLE_BLOCK * a->block;
    const double wanted = fmax(a->length[HD_AVERAGING] / SAMPLES_MIN, block / IN_A_BLOCK);
    return fmin(a->sample_max, wanted);
}

/** A sample lasts 80 collisions of each particle, or 1/32 of the duration; but at first a block,
 * then a 16th of what has been averaged: errors are known as soon as they can be, and never from
 * fewer samples. In a short run, where it would be less than a block, it is a block, or the equal
 * part of one that comes nearest to a single interval. */
double hd_agenda_sample_longest(const hd_agenda *a, const hd_interval *interval)
{
    const double block = WHOLE_BLOCK * a->block, averaged = a->sample_begin - a->start;
    const double young = fmax(a->first_sample, averaged / HD_SPECTRUM_BLOCKS_MIN);
    const double most = fmin(hd_agenda_sample_most(a), young);
    if (a->stage != HD_AVERAGING) return INFINITY;
    const double usual = hd_interval_longest(interval).length;
    if (most >= block) return most;
    return hd_equal_part(block, usual < most && usual > most / IN_A_SAMPLE ? usual : most);
}

double hd_agenda_sample_grown(const hd_agenda *a)
{
    const double most = hd_agenda_sample_most(a);
    return most > WHOLE_BLOCK * a->block ? most : 0.0;
}

/** The next time at which all vectors must be known: the end of the stage, or a report at which
 * observables need them. */
static double next_stop(const hd_agenda *a, const hd_interval_request *p)
{
    const bool at_cut = p->at_reports || (p->first && a->stage == HD_AVERAGING);
    const double stop = at_cut ? hd_agenda_cut(a) : hd_agenda_stage_end(a);
    return p->at_fields ? fmin(stop, hd_agenda_next_multiple(a, a->in_force.field_interval)) : stop;
}

/** Time until observables need a measured state; INFINITY if they need none, or if that time has
 * passed. */
static double phases_left(const hd_agenda *a, const hd_interval_request *p)
{
    const double left = a->sample_begin + p->phases - p->now;
    return left > 0 ? left : INFINITY;
}

/** Shortens an interval a little if a whole number of intervals then fits into the time `left`
 * until observables need a measured state. */
static double rounded_down(double length, double left)
{
    if (!(left < INFINITY)) return length;
    const double part = left / ceil(left / length * (1.0 - CLOSE));
    return part < length && part > WORTH_A_STATE * length ? part : length;
}

/** The next interval if it ends with an orthonormalisation in this norm: at most `left` long, and
 * why it is not longer. */
static hd_interval_length next_interval(const hd_agenda *a, const hd_interval_request *p,
                                        double left, hd_norm norm)
{
    p->interval->norm = norm;
    const double sample = hd_agenda_sample_longest(a, p->interval), phases = phases_left(a, p);
    hd_interval_length next = hd_interval_next(p->interval, left);
    if (next.length > sample)
        next = (hd_interval_length){hd_equal_part(left, sample), HD_LIMIT_SAMPLE};
    if (next.length > p->longest)
        next = (hd_interval_length){hd_equal_part(left, p->longest), HD_LIMIT_EVENTS};
    double rounded = next.length < left ? rounded_down(next.length, phases) : next.length;
    rounded = fmin(rounded, phases);
    if (rounded < next.length) next = (hd_interval_length){rounded, HD_LIMIT_LOOK};
    next.length = fmax(next.length, p->shortest);
    return next;
}

/** True if the sample should end with an interval of this length: no other end would come closer to
 * the length that it should have, or observables would wait too long. */
static bool is_last(const hd_agenda *a, const hd_interval_request *p, double length)
{
    const double gone = p->now + length - a->sample_begin, close = CLOSE * length;
    return gone + 0.5 * length >= hd_agenda_sample_longest(a, p->interval) ||
           gone + length > p->phases + close;
}

/** True if `length` takes all of `left` but for rounding. */
static bool is_rest(double length, double left) { return length >= left * (1.0 - CLOSE); }

/** Why an interval that takes all of the remaining time `left` is not longer. */
static hd_limit limit_of_rest(const hd_agenda *a, const hd_interval_request *p, double left)
{
    const hd_interval_length longest = hd_interval_longest(p->interval);
    if (longest.length < DIVIDED * left) return longest.limit;
    return p->now + left < hd_agenda_stage_end(a) ? HD_LIMIT_SCHEDULE : HD_LIMIT_STAGE;
}

/** Plans the interval that begins now. */
static void plan_interval(hd_agenda *a, const hd_interval_request *p)
{
    const double measured = next_stop(a, p), left = fmin(measured, p->snapshot) - p->now;
    hd_interval_length next = next_interval(a, p, left, p->norm);
    a->sample_ends = is_rest(next.length, measured - p->now) || is_last(a, p, next.length);
    if (a->sample_ends) next = next_interval(a, p, left, HD_NORM_FULL);
    a->interval_end = is_rest(next.length, left) ? fmin(measured, p->snapshot)
                                                 : hd_agenda_snap(a, p->now, next.length);
    a->limit = next.limit == HD_LIMIT_SCHEDULE ? limit_of_rest(a, p, left) : next.limit;
}

/** Time at which a sample without a frame ends. After a checkpoint was read it may have passed; it
 * is then now. */
static double sample_end(const hd_agenda *a, const hd_interval_request *p)
{
    if (!p->sampled) return INFINITY;
    return fmax(a->sample_begin + hd_agenda_sample_longest(a, p->interval), p->now);
}

double hd_agenda_plan(hd_agenda *a, const hd_interval_request *p)
{
    if (p->framed && p->now >= a->interval_end) plan_interval(a, p);
    a->expected = fmin(hd_interval_longest(p->interval).length,
                       fmin(hd_agenda_sample_longest(a, p->interval), p->apart));
    return fmin(hd_agenda_cut(a), p->framed ? a->interval_end : sample_end(a, p));
}

/* ---- when errors are known ----------------------------------------------------------------- */

double hd_agenda_reported(const hd_agenda *a, double averaged)
{
    const double report = a->report_interval, last = a->length[HD_AVERAGING];
    return averaged < last ? fmin(report * ceil(averaged / report), last) : averaged;
}

double hd_agenda_errors_after(const hd_agenda *a)
{
    const double most = hd_agenda_sample_most(a);
    const bool is_short = most < WHOLE_BLOCK * a->block;
    const double block = is_short ? WHOLE_BLOCK * a->block : fmin(FIRST_BLOCK * a->block, most);
    return hd_agenda_reported(a, HD_SPECTRUM_BLOCKS_MIN * block);
}

/* ---- what is due --------------------------------------------------------------------------- */

unsigned hd_agenda_reached(const hd_agenda *a, const hd_interval_request *p)
{
    const unsigned report = p->now >= hd_agenda_cut(a) ? HD_DUE_REPORT : 0u;
    const bool sampled = p->sampled && (report || p->now >= sample_end(a, p));
    if (!p->framed) return report | (sampled ? HD_DUE_SAMPLE : 0u);
    const unsigned sample = a->sample_ends ? HD_DUE_SAMPLE : 0u;
    return report | (p->now >= a->interval_end ? HD_DUE_INTERVAL | sample : 0u);
}

void hd_agenda_begin(hd_agenda *a) { a->due &= HD_DUE_STAGE; }

void hd_agenda_pass_sample(hd_agenda *a, double now)
{
    a->sample_begin = now;
    a->sample_ends = false;
}

/** A report that is cut short by the end of the stage does not count as passed, because the stage
 * may be made longer. */
void hd_agenda_pass_report(hd_agenda *a, bool reached)
{
    const double cut = hd_agenda_cut(a), last = hd_agenda_stage_end(a);
    const double whole = a->origin + ((double)a->reports + 1.0) * a->report_interval;
    const bool multiple = hd_agenda_next_multiple(a, a->in_force.field_interval) <= cut;
    const bool fields = a->stage == HD_AVERAGING && (reached || multiple);
    const bool ends = cut >= last || reached;
    if (whole <= last + CLOSE * a->report_interval) a->reports++;
    a->due |= HD_DUE_REPORT | (fields ? HD_DUE_FIELDS : 0u) | (ends ? HD_DUE_STAGE : 0u);
}

/* ---- changes ------------------------------------------------------------------------------- */

double hd_agenda_change_time(const hd_agenda *a, double now, bool framed)
{
    return framed && a->stage == HD_AVERAGING ? fmax(now, a->interval_end) : now;
}

void hd_agenda_ask(hd_agenda *a, bool framed)
{
    a->in_force.changing = true;
    a->sample_ends |= framed && a->stage == HD_AVERAGING;
}

bool hd_agenda_can_last(const hd_agenda *a, double duration, double from)
{
    hd_agenda asked = *a;
    asked.length[HD_AVERAGING] = duration;
    return asked.stage != HD_AVERAGING || duration == 0 || reaches(&asked, from);
}

double hd_agenda_change(hd_agenda *a, const hd_scene_def *scene, bool reached, double now,
                        bool framed)
{
    if (!a->in_force.changing || now < hd_agenda_change_time(a, now, framed)) return INFINITY;
    const bool reports = a->report_interval != scene->report_interval && a->stage != HD_FINISHED;
    a->in_force = in_force(scene);
    a->length[HD_AVERAGING] = hd_agenda_averaging(scene->duration);
    if (reports) a->report_interval = scene->report_interval;
    if (reports) count_reports_from(a, now);
    if (a->stage != HD_AVERAGING) return hd_agenda_cut(a);
    a->due &= ~(unsigned)HD_DUE_STAGE;
    if (reached || is_over(a, now)) a->due |= HD_DUE_REPORT | HD_DUE_FIELDS | HD_DUE_STAGE;
    return hd_agenda_cut(a);
}

bool hd_agenda_reopen(hd_agenda *a, double now)
{
    const double last = hd_agenda_stage_end(a);
    if (a->stage == HD_FINISHED && !is_over(a, now)) a->stage = HD_AVERAGING;
    if (a->stage == HD_AVERAGING && now >= last) a->stage = HD_FINISHED;
    return reaches(a, now);
}

/* ---- checkpoints --------------------------------------------------------------------------- */

/** Reads or writes when stages and reports end. */
static void stages_archive(hd_agenda *a, hd_archive *archive)
{
    int stage = (int)a->stage;
    double duration = a->length[HD_AVERAGING] < INFINITY ? a->length[HD_AVERAGING] : 0.0;
    hd_archive_int(archive, "schedule stage", &stage, HD_EQUILIBRATING, HD_FINISHED);
    a->stage = (hd_stage)stage;
    hd_archive_double(archive, "schedule start", &a->start);
    hd_archive_double(archive, "schedule duration", &duration);
    hd_archive_expect(archive, duration >= 0, "schedule duration", "it is negative");
    a->length[HD_AVERAGING] = hd_agenda_averaging(duration);
    hd_archive_double(archive, "schedule origin", &a->origin);
    hd_archive_double(archive, "schedule report interval", &a->report_interval);
    hd_archive_long(archive, "schedule reports", &a->reports, 0, LONG_MAX / 2);
    hd_archive_expect(archive, a->report_interval > 0 && a->report_interval < INFINITY,
                      "schedule report interval", "it is not positive");
}

void hd_agenda_archive(hd_agenda *a, hd_archive *archive)
{
    hd_live_values *now = &a->in_force;
    int reported = (a->due & HD_DUE_REPORT) != 0, ends = a->sample_ends, limit = (int)a->limit,
        changing = now->changing;
    stages_archive(a, archive);
    hd_archive_int(archive, "run reported", &reported, 0, 1);
    if (!archive->writing) a->due = reported ? HD_DUE_REPORT : 0u;
    hd_archive_double(archive, "run sample begin", &a->sample_begin);
    hd_archive_int(archive, "run sample ends", &ends, 0, 1);
    a->sample_ends = ends;
    hd_archive_double(archive, "run interval end", &a->interval_end);
    hd_archive_int(archive, "run limit", &limit, HD_LIMIT_SCHEDULE, HD_LIMIT_NONE);
    a->limit = (hd_limit)limit;
    hd_archive_text(archive, "run target", now->target.line, sizeof now->target);
    hd_archive_double(archive, "run fields", &now->field_interval);
    hd_archive_int(archive, "run changing", &changing, 0, 1);
    now->changing = changing;
    hd_archive_expect(archive, now->field_interval >= 0, "run fields", "it is negative");
}

void hd_agenda_expect(const hd_agenda *a, hd_archive *archive, double now, double pending,
                      double most)
{
    const char *const other = "it does not fit the time of the checkpoint";
    const bool finished = a->stage == HD_FINISHED;
    const double cut = hd_agenda_cut(a), last = hd_agenda_stage_end(a);
    const bool no_more = cut >= now && last <= now; /* a stage of no length */
    const bool ahead = finished || cut > now || no_more;
    const double end = fmax(now, fmin(finished ? now : last, now + most)),
                 planned = fmin(a->interval_end, fmax(now, last));
    hd_archive_expect(archive, a->start >= 0 && a->start <= a->origin && a->origin <= now && ahead,
                      "schedule", "its times do not fit the time of the checkpoint");
    hd_archive_expect(archive, a->sample_begin <= now, "run sample begin", other);
    hd_archive_expect(archive, planned <= end && (pending <= 0 || planned >= now),
                      "run interval end", other);
}
