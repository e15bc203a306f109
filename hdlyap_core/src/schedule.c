/** Scene -> ends of phases, samples, pieces and reports.
 *
 *  Phases follow each other at fixed times: equilibration (trajectory alone), warm-up of the frame,
 *  averaging. A phase is cut into samples of equal length: before the averaging, where nothing is measured,
 *  one for all of it; then as long as the interval between orthonormalisations may be, so that
 *  reports in between need none of their own. A sample is cut into pieces, at whose ends a report
 *  can be due. */
#include "schedule.h"

#include <math.h>

/** Of samples, for standard errors: fewer in an averaging of this many would make them late and rough. */
static const double SAMPLES_MIN = 32.0;
/** Ends that are this close, as a part of a sample, are one. */
static const double CLOSE = 1e-6;
static const double COUNT_MAX = 1e9;

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

static void samples_lay_out(hd_schedule *s, double sample_max)
{
    const double r = s->report_interval;
    double reports = 1.0, samples = 1.0;
    if (s->phase != HD_AVERAGING)
        reports = ceil(s->length[s->phase] / r * (1.0 - CLOSE));
    else if (sample_max >= r)
        reports = floor(fmax(1.0, sample_longest(s, sample_max) / r * (1.0 + CLOSE)));
    else
        samples = ceil(r / sample_max * (1.0 - CLOSE));
    s->reports_per_sample = (int)fmin(fmax(reports, 1.0), COUNT_MAX);
    s->samples_per_report = (int)fmin(samples, COUNT_MAX);
    s->sample_length = r * s->reports_per_sample / s->samples_per_report;
    s->pieces = s->reports_per_sample;
}

void hd_schedule_enter(hd_schedule *s, hd_phase phase, double now, double sample_max)
{
    while (phase < HD_AVERAGING && s->length[phase] == 0) phase++;
    s->phase = phase;
    s->start = now;
    s->samples = 0;
    s->piece = 0;
    if (phase != HD_FINISHED) samples_lay_out(s, sample_max);
}

double hd_schedule_phase_end(const hd_schedule *s)
{
    return s->phase == HD_FINISHED ? s->start : s->start + s->length[s->phase];
}

/** Products, not sums: rounding does not add up. */
static double end_after(const hd_schedule *s, double samples)
{
    const double end = s->start + samples * s->sample_length, last = hd_schedule_phase_end(s);
    return end < last - CLOSE * s->sample_length ? end : last;
}

double hd_schedule_sample_end(const hd_schedule *s) { return end_after(s, (double)s->samples + 1); }

double hd_schedule_cut(const hd_schedule *s)
{
    return end_after(s, (double)s->samples + (double)(s->piece + 1) / s->pieces);
}

int hd_schedule_cuts_per_report(const hd_schedule *s)
{
    return s->pieces / s->reports_per_sample * s->samples_per_report;
}

unsigned hd_schedule_pass(hd_schedule *s, double piece_max)
{
    const double end = hd_schedule_cut(s);
    const int per_report = s->pieces / s->reports_per_sample;
    unsigned ends = end >= hd_schedule_phase_end(s) ? HD_ENDS_PHASE | HD_ENDS_REPORT : 0;
    s->piece++;
    if (s->piece < s->pieces && !ends) return s->piece % per_report == 0 ? HD_ENDS_REPORT : 0;
    const double length = end - (s->start + (double)s->samples * s->sample_length);
    ends |= HD_ENDS_SAMPLE;
    if (length > 0.999 * s->sample_length) ends |= HD_ENDS_WHOLE_SAMPLE;
    s->samples++;
    s->piece = 0;
    s->pieces = s->reports_per_sample *
                (int)fmax(1.0, ceil(s->sample_length / s->reports_per_sample / piece_max));
    return s->samples % s->samples_per_report == 0 ? ends | HD_ENDS_REPORT : ends;
}
