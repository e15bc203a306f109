/** When a run's stages, samples and reports end. Times are simulated ones. */
#ifndef HD_SCHEDULE_H
#define HD_SCHEDULE_H

#include <stdbool.h>

#include "base/archive.h"
#include "hdlyap/interval.h"
#include "hdlyap/scene.h"

/** What ends at a cut. */
enum {
    HD_ENDS_REPORT = 1,       /**< a report is due */
    HD_ENDS_SAMPLE = 2,       /**< the last piece of a sample, or of its stage */
    HD_ENDS_WHOLE_SAMPLE = 4, /**< one of full length: the end of a stage may cut it short */
    HD_ENDS_STAGE = 8
};

typedef struct hd_schedule {
    double length[HD_FINISHED]; /**< of the stages; INFINITY for averaging without end */
    double report_interval;
    hd_stage stage;
    double start;           /**< of the stage */
    double origin;          /**< from which samples and reports are counted: start, or a change */
    double sample_length;   /**< equal within a stage */
    int reports_per_sample; /**< this or the next is 1 */
    int samples_per_report;
    /** Of a sample, at whose ends (cuts) the run may look; a multiple of reports_per_sample */
    int pieces;
    int piece;    /**< whole ones since the sample began */
    long samples; /**< since the stage began */
} hd_schedule;

hd_schedule hd_schedule_of(const hd_scene_def *scene);

/** Enters the first stage at or after `stage` that has any length, at time `now`. Samples of the
 * averaging are as long as a multiple or a fraction of the report interval may be without exceeding
 * `sample_max`. */
void hd_schedule_enter(hd_schedule *schedule, hd_stage stage, double now, double sample_max);

/** Why samples of the averaging are no longer, where `sample_max` was what `limit` allowed. */
hd_limit hd_schedule_sample_limit(const hd_schedule *schedule, double sample_max, hd_limit limit);

double hd_schedule_stage_end(const hd_schedule *schedule); /**< INFINITY: endless */
double hd_schedule_sample_end(const hd_schedule *schedule);
double hd_schedule_cut(const hd_schedule *schedule); /**< end of the present piece */
int hd_schedule_cuts_per_report(const hd_schedule *schedule);
/** End of an interval of this length: a cut of the present sample if it falls on one but for
 * rounding, which would leave a crumb. */
double hd_schedule_snap(const hd_schedule *schedule, double now, double length);

/** The time is that of the cut: goes on to the next piece; a set of HD_ENDS_*. Pieces of the next
 * sample are no longer than piece_max. The stage stays: see hd_schedule_enter. */
unsigned hd_schedule_pass(hd_schedule *schedule, double piece_max);

/** What a scene with another duration or report interval says of it, at a cut: samples and reports
 * begin anew where their interval changes (true then), pieces no longer than piece_max. The time
 * averaged must not exceed the duration. */
bool hd_schedule_change(hd_schedule *schedule, const hd_scene_def *scene, double now,
                        double sample_max, double piece_max);
/** True if the end of the stage is not ahead. */
bool hd_schedule_is_over(const hd_schedule *schedule, double now);

/** True if a report ends with the present piece that is the stage's first at or after a multiple of
 * `interval` since its start (the first report of all is, of 0), or its last. */
bool hd_schedule_reaches_multiple(const hd_schedule *schedule, double interval);

/** An averaging that has finished goes on if it has become longer. False if `now` is beyond its
 * end. */
bool hd_schedule_reopen(hd_schedule *schedule, double now);

void hd_schedule_archive(hd_schedule *schedule, hd_archive *archive);

#endif
