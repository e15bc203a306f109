/** When something is due in a run, and why. All times are simulated. */
#ifndef HD_AGENDA_H
#define HD_AGENDA_H

#include "run/schedule.h"
#include "tangent/interval.h"

/** A set of reasons why the particles stop at a time. */
enum {
    HD_DUE_INTERVAL = 1, /**< the frame is orthonormalised */
    HD_DUE_SAMPLE = 2,   /**< a sample of the averages ends, which is one or several intervals */
    HD_DUE_REPORT = 4,
    HD_DUE_FIELDS = 8, /**< with a report */
    HD_DUE_STAGE = 16  /**< a stage ends, with a report; it is left once all is done for it */
};

/** What may change while a run goes on. */
typedef struct hd_wanted {
    hd_text target;
    double field_interval;
    bool changing; /**< other values have been asked for */
} hd_wanted;

/** Only agenda.c and checkpoint.c use the members. */
typedef struct hd_agenda {
    hd_schedule schedule;
    hd_wanted in_force;
    double field_interval; /**< the one asked for; in_force has the one in force */
    bool fields_said;      /**< one was asked for while the run goes on; the first holds at once */
    double interval_end;   /**< time of the next orthonormalisation */
    hd_limit limit;        /**< why it is not later */
    double sample_begin;   /**< time of the last measured state */
    bool sample_ends;      /**< the sample ends with the present interval */
    double sample_max;     /**< longest sample */
    double block;          /**< shortest block of the averages */
    unsigned due; /**< by now, set of HD_DUE_*, until the next advance; a stage: until it is
                       left */
} hd_agenda;

/** What observables and the carrier require of the next interval. */
typedef struct hd_pace {
    double now;
    bool framed;  /**< vectors are carried in this stage */
    bool sampled; /**< averages are taken without vectors */
    bool first;   /**< nothing has been averaged yet, but the first report has to state something */
    bool at_reports; /**< the frame must be orthonormal at every report */
    bool at_fields;  /**< the frame must be orthonormal at reports at which fields are due */
    double phases;   /**< longest time from one measured state to the next; INFINITY: any */
    double snapshot; /**< time at which an observable needs an interval to end; INFINITY: none */
    hd_norm norm;    /**< norm of orthonormalisations between two samples */
    hd_interval *interval;    /**< the longest interval that conditioning allows */
    double shortest, longest; /**< times that the particles may move at once */
} hd_pace;

/** The agenda of a scene, with its warm-up; rate: collisions of a particle [1/time unit]. */
hd_agenda hd_agenda_of(const hd_scene_def *scene, double rate);
/** Shortest block of the averages: the time that a density wave, which growth follows, takes
 * through the box [T8]. */
double hd_agenda_block(const hd_agenda *agenda);

hd_stage hd_agenda_stage(const hd_agenda *agenda);
/** Simulated time at which the stage began. */
double hd_agenda_stage_begin(const hd_agenda *agenda);
double hd_agenda_stage_end(const hd_agenda *agenda); /**< INFINITY: endless */
double hd_agenda_next_report(const hd_agenda *agenda);
/** Begins, now, the first stage at or after `stage` that has any length. */
void hd_agenda_enter(hd_agenda *agenda, hd_stage stage, double now);

/** Begins an advance: forgets what was due with the last one, except for the end of a stage. */
void hd_agenda_begin(hd_agenda *agenda);
/** Plans where the next interval ends, and whether the sample ends with it, unless an interval is
 * under way. */
void hd_agenda_plan(hd_agenda *agenda, const hd_pace *pace);
/** The next time at which something is due. */
double hd_agenda_next(const hd_agenda *agenda, const hd_pace *pace);
/** What is due at this time: intervals and samples as planned, and HD_DUE_REPORT. */
unsigned hd_agenda_reached(const hd_agenda *agenda, const hd_pace *pace);

/** Why the present interval is not longer. */
hd_limit hd_agenda_limit(const hd_agenda *agenda);
/** Says that the frame has been orthonormalised now. */
void hd_agenda_pass_interval(hd_agenda *agenda, double now);
/** Says that a state is measured now; a new sample begins. */
void hd_agenda_pass_sample(hd_agenda *agenda, double now);
/** True if the present state is a measured one. */
bool hd_agenda_is_measured(const hd_agenda *agenda, double now);
/** Says that a report is made now, and remembers what is due with it. reached: the target is
 * reached. */
void hd_agenda_pass_report(hd_agenda *agenda, bool reached);

/** True if any of these reasons is due. */
bool hd_agenda_is_due(const hd_agenda *agenda, unsigned why);

/** Longest time that a sample should last. */
double hd_agenda_sample_longest(const hd_agenda *agenda, const hd_interval *interval);
/** Expected length of intervals. Intervals before reports end early, and so do those before samples
 * of phases, which are at most `phases` apart. */
double hd_agenda_interval_expected(const hd_agenda *agenda, const hd_interval *interval,
                                   bool at_reports, double phases);

/* ---- changes ------------------------------------------------------------------------------- */

/** Says that other values have been asked for. framed: in a run with vectors the sample then ends
 * with its present interval. */
void hd_agenda_ask(hd_agenda *agenda, bool framed);
/** Asks for another field_interval. The first one holds at once, later ones when other changes do.
 */
void hd_agenda_ask_fields(hd_agenda *agenda, double interval, bool framed);
/** Time from which a change that is asked for now will hold. */
double hd_agenda_change_time(const hd_agenda *agenda, double now, bool framed);
/** True if the averaging can have this length. */
bool hd_agenda_can_last(const hd_agenda *agenda, double duration, double from);
/** Puts changes in force; true if there are any, and the schedule may differ. */
bool hd_agenda_change(hd_agenda *agenda, const hd_scene_def *scene, double now);
/** Ends the averaging, because its time is over or the target is reached: report and fields are
 * due. */
void hd_agenda_end_averaging(hd_agenda *agenda, bool reached, double now);
const hd_text *hd_agenda_target(const hd_agenda *agenda); /**< the target in force */

#endif
