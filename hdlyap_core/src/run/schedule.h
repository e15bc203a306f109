/** When the stages and reports of a run end. All times are simulated [time units]. */
#ifndef HD_SCHEDULE_H
#define HD_SCHEDULE_H

#include <math.h>
#include <stdbool.h>

#include "base/archive.h"
#include "hdlyap/scene.h"

typedef struct hd_schedule {
    /** Length of each stage; INFINITY for an averaging without end. */
    double length[HD_FINISHED];
    double report_interval;
    hd_stage stage;
    double start;  /**< time at which the stage began */
    double origin; /**< time from which reports are counted: the start of the stage, or a later
                      change of report_interval */
    long reports;  /**< number of whole report intervals since the origin */
} hd_schedule;

/** The length of the parts if `left` is divided into equal parts, none longer than `most`. */
static inline double hd_equal_part(double left, double most)
{
    return left < INFINITY ? left / ceil(left / most) : most;
}

hd_schedule hd_schedule_of(const hd_scene_def *scene);

/** Enters the first stage at or after `stage` that has any length, at time `now`. */
void hd_schedule_enter(hd_schedule *schedule, hd_stage stage, double now);

/** Time at which the stage ends; INFINITY if it has no end. */
double hd_schedule_stage_end(const hd_schedule *schedule);
/** The cut: the time of the next report, or of the end of the stage if that comes first. */
double hd_schedule_cut(const hd_schedule *schedule);
/** Time at which an interval of this length ends that begins at `now`; the cut itself if it is
 * nearly there, so that no tiny interval is left. */
double hd_schedule_snap(const hd_schedule *schedule, double now, double length);

/** The cut is reached: goes on to the next one. Returns true if the stage ends here;
 * hd_schedule_enter then leaves it. */
bool hd_schedule_pass(hd_schedule *schedule);

/** Takes the duration and the report interval of a scene, at any time; the duration must not be
 * less than what is averaged. If the report interval changes, reports are counted from `now` on. */
void hd_schedule_change(hd_schedule *schedule, const hd_scene_def *scene, double now);
/** True if `now` is at or beyond the end of the stage, but for rounding. */
bool hd_schedule_is_over(const hd_schedule *schedule, double now);
/** True if `now` is at or before the end of the stage, but for rounding. */
bool hd_schedule_reaches(const hd_schedule *schedule, double now);

/** Time of the next report that is the first one at or after a multiple of `interval` since the
 * stage began (0 is a multiple), or of the last report of the stage; with interval 0 of the next
 * report. */
double hd_schedule_next_multiple(const hd_schedule *schedule, double interval);

/** Lets an averaging that has finished go on if its duration has become longer. Returns false if
 * `now` is beyond its end. */
bool hd_schedule_reopen(hd_schedule *schedule, double now);

void hd_schedule_archive(hd_schedule *schedule, hd_archive *archive);

#endif
