/** Orthonormalisations of a run -> covariant vectors of its windows. */
#include "run/windows.h"

#include <math.h>

#include "base/check.h"
#include "base/clock.h"
#include "hdlyap/covariant.h"

/** Collisions of each disk between two orthonormalisations that no accuracy and no density exceed.
 */
static const double COLLISIONS_MOST = 60.0;
static const double GO_SECONDS = 0.1;

hd_status hd_windows_create(hd_run *run, char *message, size_t size)
{
    const hd_scene_def *scene = &run->scene;
    const double longest = COLLISIONS_MOST * run->sample_max / HD_COLLISIONS_PER_SAMPLE;
    if (!(scene->observe & HD_OBSERVE_COVARIANT)) return HD_OK;
    HD_TRY(hd_covariant_check_room(scene, fmin(longest, run->interval.limit), message, size));
    HD_TRY(hd_ortho_keep_factor(run->ortho));
    run->window_due = true;
    return hd_covariant_create(&run->covariant, scene, run->threads);
}

bool hd_windows_is_watched(const hd_run *run)
{
    return run->covariant && (run->observe & HD_OBSERVE_COVARIANT) &&
           run->schedule.stage == HD_AVERAGING;
}

void hd_windows_clear(hd_run *run)
{
    if (!run->covariant) return;
    hd_covariant_clear(run->covariant);
    run->window_due = true;
}

void hd_windows_interrupt(hd_run *run) { run->window_due = true; }

/** What the next intervals are expected to be: equal shares of a sample, or of a report that needs
 * all vectors. */
static double expected(const hd_run *run)
{
    const bool at_reports = run->observe & (HD_OBSERVE_HYDRO | HD_OBSERVE_FIELDS);
    const double sample = run->schedule.sample_length;
    return hd_interval_next(&run->interval,
                            at_reports ? fmin(sample, run->scene.report_interval) : sample)
        .length;
}

/** Adds the seconds since then to the cost. */
static hd_status timed(hd_run *run, double start, hd_status status)
{
    run->cost.covariant += hd_clock_now() - start;
    return status;
}

hd_status hd_windows_start(hd_run *run)
{
    const double start = hd_clock_now();
    if (!hd_windows_is_watched(run) || !run->window_due) return HD_OK;
    run->window_due = false;
    const double begin = run->now - run->log->duration;
    return timed(
        run, start,
        hd_covariant_begin(run->covariant, hd_frame_columns(run->frame), begin, expected(run)));
}

hd_status hd_windows_add(hd_run *run, double t_begin, double t_end)
{
    const double start = hd_clock_now();
    const hd_columns columns = hd_frame_columns(run->frame);
    if (!hd_windows_is_watched(run)) return HD_OK;
    return timed(run, start,
                 hd_covariant_add(run->covariant, run->ortho, columns, run->log, t_begin, t_end));
}

hd_status hd_windows_end(hd_run *run)
{
    const double start = hd_clock_now();
    if (!hd_windows_is_watched(run) || !hd_covariant_wants_state(run->covariant)) return HD_OK;
    return timed(run, start,
                 hd_covariant_state(run->covariant, hd_frame_columns(run->frame), run->trajectory));
}

bool hd_windows_is_going(const hd_run *run)
{
    return hd_windows_is_watched(run) && !run->window_due &&
           hd_covariant_is_going_back(run->covariant);
}

hd_status hd_windows_go(hd_run *run, bool to_its_end)
{
    const double start = hd_clock_now();
    if (!hd_windows_is_going(run)) return HD_OK;
    while (hd_windows_is_going(run) && (to_its_end || hd_clock_now() - start < GO_SECONDS))
        HD_TRY(hd_covariant_step(run->covariant));
    run->cost.covariant += hd_clock_now() - start;
    return HD_OK;
}
