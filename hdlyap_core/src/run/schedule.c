/** Scene -> ends of stages and reports.
 *
 * Stages follow each other at fixed times: equilibration (trajectory alone), warm-up of the frame,
 * averaging. Reports are due at multiples of their interval and where a stage ends.
 * Orthonormalisations do not depend on them. */
#include "run/schedule.h"

#include <float.h>
#include <limits.h>
#include <math.h>

/** Two ends are the same if they differ by less than this part: of the report interval for a report
 * and the end of its stage; of its interval for an orthonormalisation and a cut. */
static const double CLOSE = 1e-6;
/** The present time is the end of the stage if they differ by less than this part: a duration of 15
 * digits is known to 23 eps, and some sums are rounded. */
static const double ROUNDING = 64.0 * DBL_EPSILON;

hd_schedule hd_schedule_of(const hd_scene_def *scene)
{
    return (hd_schedule){
        .length = {scene->equilibration, scene->warmup,
                   scene->duration > 0 ? scene->duration : INFINITY},
        .report_interval = scene->report_interval,
    };
}

static void count_from(hd_schedule *s, double now)
{
    s->origin = now;
    s->reports = 0;
}

void hd_schedule_enter(hd_schedule *s, hd_stage stage, double now)
{
    while (stage < HD_AVERAGING && s->length[stage] == 0) stage++;
    s->stage = stage;
    if (stage == HD_FINISHED) return;
    s->start = now;
    count_from(s, now);
}

double hd_schedule_stage_end(const hd_schedule *s)
{
    return s->start + s->length[s->stage == HD_FINISHED ? HD_AVERAGING : s->stage];
}

/** Time of a report, as a product, so that rounding does not add up. */
static double report_at(const hd_schedule *s, double count)
{
    const double end = s->origin + count * s->report_interval, last = hd_schedule_stage_end(s);
    return end < last - CLOSE * s->report_interval ? end : last;
}

double hd_schedule_cut(const hd_schedule *s) { return report_at(s, (double)s->reports + 1.0); }

double hd_schedule_snap(const hd_schedule *s, double now, double length)
{
    const double end = now + length, count = round((end - s->origin) / s->report_interval);
    const double cut = report_at(s, fmax(count, (double)s->reports + 1.0));
    return fabs(end - cut) <= CLOSE * length ? cut : end;
}

/** A report that is cut short by the end of the stage does not count as passed, because the stage
 * may be made longer. */
bool hd_schedule_pass(hd_schedule *s)
{
    const double last = hd_schedule_stage_end(s);
    const double whole = s->origin + ((double)s->reports + 1.0) * s->report_interval;
    const bool ends = hd_schedule_cut(s) >= last;
    if (whole <= last + CLOSE * s->report_interval) s->reports++;
    return ends;
}

void hd_schedule_change(hd_schedule *s, const hd_scene_def *scene, double now)
{
    s->length[HD_AVERAGING] = hd_schedule_of(scene).length[HD_AVERAGING];
    if (s->report_interval == scene->report_interval || s->stage == HD_FINISHED) return;
    s->report_interval = scene->report_interval;
    count_from(s, now);
}

bool hd_schedule_is_over(const hd_schedule *s, double now)
{
    return now >= hd_schedule_stage_end(s) * (1.0 - ROUNDING);
}

bool hd_schedule_reaches(const hd_schedule *s, double now)
{
    return now <= hd_schedule_stage_end(s) * (1.0 + ROUNDING);
}

double hd_schedule_next_multiple(const hd_schedule *s, double interval)
{
    const double r = s->report_interval, gone = s->origin - s->start;
    const bool first = s->reports == 0 && s->origin == s->start;
    if (first || interval <= r) return hd_schedule_cut(s);
    const double passed = floor((gone + ((double)s->reports + CLOSE) * r) / interval);
    const double count = ceil(((passed + 1.0) * interval - gone) / r - CLOSE);
    return report_at(s, fmax(count, (double)s->reports + 1.0));
}

bool hd_schedule_reopen(hd_schedule *s, double now)
{
    const double last = hd_schedule_stage_end(s);
    if (s->stage == HD_FINISHED && !hd_schedule_is_over(s, now)) s->stage = HD_AVERAGING;
    if (s->stage == HD_AVERAGING && now >= last) s->stage = HD_FINISHED;
    return hd_schedule_reaches(s, now);
}

/** Reads or writes the schedule in force; other values may have been asked for already. */
void hd_schedule_archive(hd_schedule *s, hd_archive *archive)
{
    int stage = (int)s->stage;
    hd_archive_int(archive, "schedule stage", &stage, HD_EQUILIBRATING, HD_FINISHED);
    s->stage = (hd_stage)stage;
    hd_archive_double(archive, "schedule start", &s->start);
    double duration = s->length[HD_AVERAGING] < INFINITY ? s->length[HD_AVERAGING] : 0.0;
    hd_archive_double(archive, "schedule duration", &duration);
    hd_archive_expect(archive, duration >= 0, "schedule duration", "it is negative");
    s->length[HD_AVERAGING] = duration > 0 ? duration : INFINITY;
    hd_archive_double(archive, "schedule origin", &s->origin);
    hd_archive_double(archive, "schedule report interval", &s->report_interval);
    hd_archive_long(archive, "schedule reports", &s->reports, 0, LONG_MAX / 2);
    hd_archive_expect(archive, s->report_interval > 0 && s->report_interval < INFINITY,
                      "schedule report interval", "it is not positive");
}
