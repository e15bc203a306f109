/** The agenda of a run: the next simulated time at which something is due, and what. A measured
 * state is one at which a sample ends: the frame is orthonormal in dq and dp together, and
 * observables are measured. All times are simulated [time units]. */
#ifndef HD_AGENDA_H
#define HD_AGENDA_H

#include <stdbool.h>

#include "base/archive.h"
#include "hdlyap/scene.h"
#include "tangent/interval.h"

/** What is due at a time at which the particles stop: a set. */
enum {
    HD_DUE_INTERVAL = 1, /**< the frame has to be orthonormalised */
    HD_DUE_SAMPLE = 2,   /**< a sample of the averages ends, one or several intervals long */
    HD_DUE_REPORT = 4,   /**< a report is made */
    HD_DUE_FIELDS = 8,   /**< fields are due with this report */
    HD_DUE_STAGE = 16 /**< a stage ends with this report; the run leaves it when it has caught up */
};

/** The values that may change while a run goes on. */
typedef struct hd_live_values {
    hd_text target;
    double field_interval;
    bool changing; /**< true if other values have been asked for that are not in force yet */
} hd_live_values;

/** Says when the run has to do what. Others may read the members; they may change interval_end
 * alone. */
typedef struct hd_agenda {
    double length[HD_FINISHED]; /**< of each stage; INFINITY for an averaging without end */
    double report_interval;
    hd_stage stage;
    double start;  /**< time at which the stage began */
    double origin; /**< time from which reports are counted: the start of the stage, or a later
                      change of report_interval */
    long reports;  /**< number of whole report intervals since the origin */
    hd_live_values in_force; /**< the values that the run follows now */
    double interval_end;     /**< time of the next orthonormalisation */
    hd_limit limit;          /**< why that time is not later */
    double expected;         /**< expected length of the intervals after it */
    double sample_begin;     /**< time at which the present sample began, with a measured state */
    bool sample_ends;        /**< true if the sample ends with the present interval */
    double sample_max;       /**< longest length of a sample */
    double first_sample;     /**< length of the first samples of a run that is not short */
    /** Shortest block of the averages: 8 collisions of each particle, or the time that sound takes
     * through the box, because growth remembers both [T8]. */
    double block;
    /** What is due at the present time (set of HD_DUE_*), until the next advance begins;
     * HD_DUE_STAGE stays until the stage is left. */
    unsigned due;
} hd_agenda;

/** What observables and the carrier of the frame ask of the next interval. */
typedef struct hd_interval_request {
    double now;   /**< present time */
    bool framed;  /**< true if the frame is carried in this stage */
    bool sampled; /**< true if averages are taken, but no frame is carried */
    bool first; /**< true if nothing has been averaged yet; the first report then ends a sample, so
                   that it has averages to state */
    bool at_reports; /**< true if the frame must be orthonormal at each report */
    bool at_fields;  /**< true if it must be so at reports with which fields are due */
    double phases;   /**< longest time from one measured state to the next that observables allow;
                        INFINITY: any */
    double apart;    /**< that time as it is expected, also before phases are followed */
    double snapshot; /**< time at which an interval has to end for an observable; INFINITY: none */
    hd_norm norm;    /**< norm of the orthonormalisations that end no sample */
    hd_interval *interval;    /**< how long an interval may be, by the condition of the frame */
    double shortest, longest; /**< shortest and longest time that the particles may move at once */
} hd_interval_request;

/** Makes the agenda of a scene whose warm-up is chosen. rate: collisions of a particle [1/time
 * unit]. */
hd_agenda hd_agenda_of(const hd_scene_def *scene, double rate);
/** Samples are as long from the start as those of a run that has averaged for long. */
void hd_agenda_begin_grown(hd_agenda *agenda);
/** Length of the averaging for this duration of a scene, of which 0 is without end. */
double hd_agenda_averaging(double duration);

/** Time at which the stage ends; INFINITY if it has no end. */
double hd_agenda_stage_end(const hd_agenda *agenda);
/** The cut: the time of the next report, or of the end of the stage if that comes first. */
double hd_agenda_cut(const hd_agenda *agenda);
/** Time at which an interval of this length ends that begins at `now`; the cut itself if it is
 * nearly there, so that no tiny interval is left. */
double hd_agenda_snap(const hd_agenda *agenda, double now, double length);
/** Time of the next report that is the first one at or after a multiple of `interval` since the
 * stage began (0 is a multiple), or of the last report of the stage; with interval 0 of the next
 * report. */
double hd_agenda_next_multiple(const hd_agenda *agenda, double interval);
/** Begins, at the time `now`, the first stage at or after `stage` whose length is not 0. */
void hd_agenda_enter(hd_agenda *agenda, hd_stage stage, double now);

/** An advance begins: forgets what was due with the last one, except for HD_DUE_STAGE. */
void hd_agenda_begin(hd_agenda *agenda);
/** Plans when the next interval ends, and whether the sample ends with it, unless an interval is
 * under way. Returns the next time at which something is due: a report, the end of the interval, or
 * of a sample without a frame. */
double hd_agenda_plan(hd_agenda *agenda, const hd_interval_request *pace);
/** What is due at the time pace->now: a set of HD_DUE_INTERVAL, HD_DUE_SAMPLE and HD_DUE_REPORT. */
unsigned hd_agenda_reached(const hd_agenda *agenda, const hd_interval_request *pace);

/** A state is measured at the time `now`; a new sample begins. */
void hd_agenda_pass_sample(hd_agenda *agenda, double now);
/** A report is made: adds it to what is due, with fields and the end of the stage where these are
 * due with it. reached: the target of the run is reached. */
void hd_agenda_pass_report(hd_agenda *agenda, bool reached);

/** Length that a sample should have at most; INFINITY unless averages are taken. */
double hd_agenda_sample_longest(const hd_agenda *agenda, const hd_interval *interval);
/** The same during the averaging, whatever the stage, the intervals and the averaged time are. */
double hd_agenda_sample_most(const hd_agenda *agenda);
/** Length to which samples grow while the averaging is young; 0 if all are alike, in a short run.
 */
double hd_agenda_sample_grown(const hd_agenda *agenda);
/** Averaged time until the first report at or after `averaged`; that time itself if it is beyond
 * the duration. */
double hd_agenda_reported(const hd_agenda *agenda, double averaged);
/** Averaged time until the first report that states errors [T8], likewise. */
double hd_agenda_errors_after(const hd_agenda *agenda);

/* ---- changes ------------------------------------------------------------------------------- */

/** Other values have been asked for. framed: the run carries a frame; during the averaging its
 * sample then ends with the present interval. */
void hd_agenda_ask(hd_agenda *agenda, bool framed);
/** Time from which a change that is asked for now will hold: the end of the present interval while
 * a frame is carried and averages are taken, otherwise `now`. */
double hd_agenda_change_time(const hd_agenda *agenda, double now, bool framed);
/** True if the averaging can have this duration, 0 being without end, when it holds from the time
 * `from`. */
bool hd_agenda_can_last(const hd_agenda *agenda, double duration, double from);
/** Puts what was asked for in force, if it holds from now on; returns the next cut, or INFINITY if
 * nothing changes. If the averaging is over then, or its new target is reached, it ends: a report
 * and fields are due. */
double hd_agenda_change(hd_agenda *agenda, const hd_scene_def *scene, bool reached, double now,
                        bool framed);
/** Lets an averaging of a resumed run that has finished go on if its duration has become longer.
 * Returns false if `now` is beyond its end. */
bool hd_agenda_reopen(hd_agenda *agenda, double now);

/* ---- checkpoints --------------------------------------------------------------------------- */

/** Reads or writes the agenda in force; other values may have been asked for already. */
void hd_agenda_archive(hd_agenda *agenda, hd_archive *archive);
/** Expects that its times fit the time `now`, of which the last `pending` have not been
 * orthonormalised, so that the run can go on; `most` is the longest interval that may be planned.
 */
void hd_agenda_expect(const hd_agenda *agenda, hd_archive *archive, double now, double pending,
                      double most);

#endif
