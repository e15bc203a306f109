/** Scene -> ends of stages, samples, pieces and reports.
 *
 * Stages follow each other at fixed times: equilibration (trajectory alone), warm-up of the frame,
 * averaging. A stage is cut into samples of equal length: before the averaging, where nothing is
 * measured, one for all of it; then as long as the interval between orthonormalisations may be, so
 * that reports in between need none of their own. A sample is cut into pieces, at whose ends a
 * report can be due. */
#include "run/schedule.h"

#include <limits.h>
#include <math.h>

/** Of samples, for standard errors: fewer in an averaging of this many would make them late and
 * rough. */
static const double SAMPLES_MIN = 32.0;
/** Ends that are this close, as a part of a sample, are one. */
static const double CLOSE = 1e-6;
static const double COUNT_MAX = 1e9;
/** Samples that could be longer by this factor are cut short by the reports; else what they have to
 * give way is rounding. */
static const double CUT_SHORT = 1.25;

hd_schedule hd_schedule_of(const hd_scene_def *scene)
{
    return (hd_schedule){
        .length = {scene->equilibration, scene->warmup,
                   scene->duration > 0 ? scene->duration : INFINITY},
        .report_interval = scene->report_interval,
    };
}

/** Without a duration the errors can wait. */
static double sample_longest(const hd_schedule *s, double sample_max)
{
    return fmin(sample_max, s->length[HD_AVERAGING] / SAMPLES_MIN);
}

static void sample_measure(hd_schedule *s)
{
    s->sample_length = s->report_interval * s->reports_per_sample / s->samples_per_report;
}

/** From the origin on. */
static void samples_lay_out(hd_schedule *s, double sample_max)
{
    const double r = s->report_interval, left = s->length[s->stage] - (s->origin - s->start);
    double reports = 1.0, samples = 1.0;
    s->samples = 0;
    s->piece = 0;
    if (s->stage != HD_AVERAGING)
        reports = ceil(left / r * (1.0 - CLOSE));
    else if (sample_max >= r)
        reports = floor(fmax(1.0, sample_longest(s, sample_max) / r * (1.0 + CLOSE)));
    else
        samples = ceil(r / sample_max * (1.0 - CLOSE));
    s->reports_per_sample = (int)fmin(fmax(reports, 1.0), COUNT_MAX);
    s->samples_per_report = (int)fmin(samples, COUNT_MAX);
    sample_measure(s);
    s->pieces = s->reports_per_sample;
}

void hd_schedule_enter(hd_schedule *s, hd_stage stage, double now, double sample_max)
{
    while (stage < HD_AVERAGING && s->length[stage] == 0) stage++;
    s->stage = stage;
    if (stage == HD_FINISHED) return;
    s->start = s->origin = now;
    samples_lay_out(s, sample_max);
}

hd_limit hd_schedule_sample_limit(const hd_schedule *s, double sample_max, hd_limit limit)
{
    const double for_errors = sample_longest(s, sample_max);
    const bool of_reports = sample_max >= s->report_interval; /* whole ones make a sample */
    const double most = of_reports ? for_errors : sample_max;
    if (s->sample_length * CUT_SHORT < most || s->sample_length > most * (1.0 + CLOSE))
        return HD_LIMIT_SCHEDULE;
    return most < sample_max ? HD_LIMIT_SAMPLE : limit;
}

double hd_schedule_stage_end(const hd_schedule *s)
{
    return s->start + s->length[s->stage == HD_FINISHED ? HD_AVERAGING : s->stage];
}

/** Products, not sums: rounding does not add up. */
static double end_after(const hd_schedule *s, double samples)
{
    const double end = s->origin + samples * s->sample_length, last = hd_schedule_stage_end(s);
    return end < last - CLOSE * s->sample_length ? end : last;
}

double hd_schedule_sample_end(const hd_schedule *s) { return end_after(s, (double)s->samples + 1); }

static double samples_at_cut(const hd_schedule *s)
{
    return (double)s->samples + (double)(s->piece + 1) / s->pieces;
}

double hd_schedule_cut(const hd_schedule *s) { return end_after(s, samples_at_cut(s)); }

double hd_schedule_snap(const hd_schedule *s, double now, double length)
{
    const double end = now + length, piece = s->sample_length / s->pieces;
    const double cut = end_after(s, round((end - s->origin) / piece) / s->pieces);
    return fabs(end - cut) <= CLOSE * length ? cut : end;
}

int hd_schedule_cuts_per_report(const hd_schedule *s)
{
    return s->pieces / s->reports_per_sample * s->samples_per_report;
}

static void pieces_lay_out(hd_schedule *s, double piece_max)
{
    s->pieces = s->reports_per_sample *
                (int)fmax(1.0, ceil(s->sample_length / s->reports_per_sample / piece_max));
}

/** A piece that the end of the stage cuts short is not passed: it would go on if the stage were
 * made longer. */
unsigned hd_schedule_pass(hd_schedule *s, double piece_max)
{
    const double last = hd_schedule_stage_end(s), close = CLOSE * s->sample_length;
    const double whole = s->origin + samples_at_cut(s) * s->sample_length;
    const int per_report = s->pieces / s->reports_per_sample;
    const unsigned stage_ends = HD_ENDS_STAGE | HD_ENDS_REPORT | HD_ENDS_SAMPLE;
    unsigned ends = hd_schedule_cut(s) >= last ? stage_ends : 0;
    if (whole > last + close) return ends;
    s->piece++;
    if (s->piece < s->pieces) return s->piece % per_report == 0 ? ends | HD_ENDS_REPORT : ends;
    s->samples++;
    s->piece = 0;
    pieces_lay_out(s, piece_max);
    ends |= HD_ENDS_SAMPLE | HD_ENDS_WHOLE_SAMPLE;
    return s->samples % s->samples_per_report == 0 ? ends | HD_ENDS_REPORT : ends;
}

bool hd_schedule_change(hd_schedule *s, const hd_scene_def *scene, double now, double sample_max,
                        double piece_max)
{
    s->length[HD_AVERAGING] = hd_schedule_of(scene).length[HD_AVERAGING];
    if (s->report_interval == scene->report_interval || s->stage == HD_FINISHED) return false;
    s->report_interval = scene->report_interval;
    s->origin = now;
    samples_lay_out(s, sample_max);
    pieces_lay_out(s, piece_max);
    return true;
}

bool hd_schedule_is_over(const hd_schedule *s, double now)
{
    return now >= hd_schedule_stage_end(s) - CLOSE * s->sample_length;
}

/** Since the origin, by the end of so many pieces of the present sample. */
static long reports_after(const hd_schedule *s, int pieces)
{
    const int per_report = s->pieces / s->reports_per_sample;
    return (s->samples * s->reports_per_sample + pieces / per_report) / s->samples_per_report;
}

bool hd_schedule_reaches_multiple(const hd_schedule *s, double interval)
{
    const long before = reports_after(s, s->piece), after = reports_after(s, s->piece + 1);
    const double multiples = s->report_interval / interval; /* in a report */
    const double gone = (s->origin - s->start) / interval + CLOSE;
    const bool first = before == 0 && s->origin == s->start;
    if (hd_schedule_cut(s) >= hd_schedule_stage_end(s)) return true;
    if (after == before || first || interval <= s->report_interval) return after > before;
    return floor((double)after * multiples + gone) > floor((double)before * multiples + gone);
}

bool hd_schedule_reopen(hd_schedule *s, double now)
{
    const double last = hd_schedule_stage_end(s), close = CLOSE * s->sample_length;
    if (s->stage == HD_FINISHED && now < last - close) s->stage = HD_AVERAGING;
    if (s->stage == HD_AVERAGING && now >= last) s->stage = HD_FINISHED;
    return now <= last + close;
}

/** What the scene does not say of it. */
void hd_schedule_archive(hd_schedule *s, hd_archive *archive)
{
    int stage = (int)s->stage;
    hd_archive_int(archive, "schedule stage", &stage, HD_EQUILIBRATING, HD_FINISHED);
    s->stage = (hd_stage)stage;
    hd_archive_double(archive, "schedule start", &s->start);
    hd_archive_double(archive, "schedule origin", &s->origin);
    hd_archive_double(archive, "schedule report interval", &s->report_interval);
    hd_archive_int(archive, "schedule reports", &s->reports_per_sample, 1, (int)COUNT_MAX);
    hd_archive_int(archive, "schedule samples per report", &s->samples_per_report, 1,
                   (int)COUNT_MAX);
    hd_archive_int(archive, "schedule pieces", &s->pieces, 1, INT_MAX);
    hd_archive_int(archive, "schedule piece", &s->piece, 0, INT_MAX - 1);
    hd_archive_long(archive, "schedule samples", &s->samples, 0, LONG_MAX / 2);
    sample_measure(s);
    hd_archive_expect(archive, s->report_interval > 0 && s->report_interval < INFINITY,
                      "schedule report interval", "it is not positive");
    hd_archive_expect(archive, s->piece < s->pieces && s->pieces % s->reports_per_sample == 0,
                      "schedule pieces", "they do not make up a sample");
}
