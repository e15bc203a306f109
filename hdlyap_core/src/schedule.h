/** When a run's phases, samples and reports end. Times are simulated ones. */
#ifndef HD_SCHEDULE_H
#define HD_SCHEDULE_H

#include <stdbool.h>

#include "hdlyap/run.h"

/** What ends at a cut. */
enum {
    HD_ENDS_REPORT = 1,       /**< a report is due */
    HD_ENDS_SAMPLE = 2,       /**< the last piece of a sample, or of its phase */
    HD_ENDS_WHOLE_SAMPLE = 4, /**< one of full length: the end of a phase may cut it short */
    HD_ENDS_PHASE = 8
};

typedef struct hd_schedule {
    double length[HD_FINISHED]; /**< of the phases; INFINITY for averaging without end */
    double report_interval;
    hd_phase phase;
    double start;           /**< of the phase */
    double sample_length;   /**< equal within a phase */
    int reports_per_sample; /**< this or the next is 1 */
    int samples_per_report;
    /** Of a sample, at whose ends (cuts) the run may look; a multiple of reports_per_sample */
    int pieces;
    int piece;    /**< whole ones since the sample began */
    long samples; /**< since the phase began */
} hd_schedule;

hd_schedule hd_schedule_of(const hd_scene_def *scene);

/** Enters the first phase at or after `phase` that has any length, at time `now`. Samples of the
 * averaging are as long as a multiple or a fraction of the report interval may be without exceeding
 * `sample_max`. */
void hd_schedule_enter(hd_schedule *schedule, hd_phase phase, double now, double sample_max);

double hd_schedule_phase_end(const hd_schedule *schedule); /**< INFINITY: endless */
double hd_schedule_sample_end(const hd_schedule *schedule);
double hd_schedule_cut(const hd_schedule *schedule); /**< end of the present piece */
int hd_schedule_cuts_per_report(const hd_schedule *schedule);

/** The time is that of the cut: goes on to the next piece; a set of HD_ENDS_*. Pieces of the next
 * sample are no longer than piece_max. The phase stays: see hd_schedule_enter. */
unsigned hd_schedule_pass(hd_schedule *schedule, double piece_max);

/** True if a report ends with the present piece that is the phase's first at or after a multiple of
 * `interval` since its start (the first report of all is, of 0), or its last. */
bool hd_schedule_reaches_multiple(const hd_schedule *schedule, double interval);

/** An averaging that has finished goes on if it has become longer. False if `now` is beyond its
 * end. */
bool hd_schedule_reopen(hd_schedule *schedule, double now);

#endif
