/** When a run's stages and reports end. All times are simulated. */
#ifndef HD_SCHEDULE_H
#define HD_SCHEDULE_H

#include <math.h>
#include <stdbool.h>

#include "base/archive.h"
#include "hdlyap/scene.h"

typedef struct hd_schedule {
    double length[HD_FINISHED]; /**< of the stages; INFINITY for averaging without end */
    double report_interval;
    hd_stage stage;
    double start;  /**< of the stage */
    double origin; /**< from which reports are counted: start, or a change */
    long reports;  /**< whole ones since the origin */
} hd_schedule;

/** The length of equal parts of `left`, none longer than `most`. */
static inline double hd_equal_part(double left, double most)
{
    return left < INFINITY ? left / ceil(left / most) : most;
}

hd_schedule hd_schedule_of(const hd_scene_def *scene);

/** Enters the first stage at or after `stage` that has any length, at time `now`. */
void hd_schedule_enter(hd_schedule *schedule, hd_stage stage, double now);

double hd_schedule_stage_end(const hd_schedule *schedule); /**< INFINITY: endless */
/** The next report, or the end of the stage. */
double hd_schedule_cut(const hd_schedule *schedule);
/** End of an interval of this length; the cut itself if it is nearly there, so that no tiny
 * interval is left. */
double hd_schedule_snap(const hd_schedule *schedule, double now, double length);

/** Goes on to the next cut, at the time of the present one; true if the stage ends here, which
 * hd_schedule_enter then leaves. */
bool hd_schedule_pass(hd_schedule *schedule);

/** Takes the duration and the report interval of another scene, at any time. Reports are counted
 * from now on if their interval changes. The averaged time must not exceed the duration. */
void hd_schedule_change(hd_schedule *schedule, const hd_scene_def *scene, double now);
/** True if the end of the stage is not ahead, but for rounding. */
bool hd_schedule_is_over(const hd_schedule *schedule, double now);
/** True if the end of the stage is not behind, but for rounding. */
bool hd_schedule_reaches(const hd_schedule *schedule, double now);

/** The next report that is the first one at or after a multiple of `interval` since the stage began
 * (0 is a multiple), or the stage's last one; with interval 0 the next report. */
double hd_schedule_next_multiple(const hd_schedule *schedule, double interval);

/** Lets an averaging that has finished go on if it has become longer. False if `now` is beyond its
 * end. */
bool hd_schedule_reopen(hd_schedule *schedule, double now);

void hd_schedule_archive(hd_schedule *schedule, hd_archive *archive);

#endif
