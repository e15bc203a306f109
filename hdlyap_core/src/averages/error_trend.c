/** In a stationary run a standard error falls to 0.35 of its value while the averaged time grows to
 * eight times, and to 0.18 while it grows to 32 times. Errors from few blocks are uncertain
 * themselves, so the first ones are not used: without them the ratio was 0.55 or less in all of 420
 * runs (15 scenes, many seeds), with them it reached 2.1 in one. */
#include "averages/error_trend.h"

#include <math.h>

static const double GROWTH = 8.0;
/** The error has stalled if it is still above this part of what it was at an eighth of the averaged
 * time. */
static const double STALLED_RATIO = 0.8;
/** Errors are used from this many times the averaged time at which the first error was known. */
static const double SETTLING = 4.0;
/** The first mark is of an averaged time of 2 to this power. */
enum { FIRST_EXPONENT = -20 };

static int mark_of(double time)
{
    const int k = ilogb(time) - FIRST_EXPONENT;
    return k < 0 ? 0 : k < HD_ERROR_TREND_MARKS ? k : HD_ERROR_TREND_MARKS - 1;
}

void hd_error_trend_add(hd_error_trend *trend, double time, double error)
{
    if (time < trend->last.time) *trend = (hd_error_trend){.first = 0.0};
    if (!(time > 0.0) || !(error >= 0.0)) return;
    trend->last = (hd_error_at){time, error};
    if (trend->first == 0.0) trend->first = time;
    if (time < SETTLING * trend->first) return;
    hd_error_at *mark = &trend->mark[mark_of(time)];
    if (mark->time == 0.0) *mark = trend->last;
}

bool hd_error_trend_stalled(const hd_error_trend *trend, hd_error_at *since)
{
    const hd_error_at *last = &trend->last;
    if (last->time == 0.0) return false;
    for (int k = mark_of(last->time); k >= 0; k--) {
        *since = trend->mark[k];
        if (since->time > 0.0 && since->time * GROWTH <= last->time)
            return !(last->error < STALLED_RATIO * since->error);
    }
    return false;
}

static void error_archive(hd_error_at *error, hd_archive *archive)
{
    hd_archive_next_doubles(archive, &error->time, 1);
    hd_archive_next_doubles(archive, &error->error, 1);
    hd_archive_expect(archive, error->time >= 0 && error->error >= 0, "error trend",
                      "it is negative");
}

void hd_error_trend_archive(hd_error_trend *trend, hd_archive *archive)
{
    hd_archive_double(archive, "error trend first", &trend->first);
    hd_archive_of_doubles(archive, "error trend", 2 * (HD_ERROR_TREND_MARKS + 1));
    for (int k = 0; k < HD_ERROR_TREND_MARKS; k++) error_archive(&trend->mark[k], archive);
    error_archive(&trend->last, archive);
    hd_archive_expect(archive, trend->first >= 0, "error trend first", "it is negative");
}
