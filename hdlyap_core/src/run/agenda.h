/** When something is due in a run, and why. Times are simulated ones. */
#ifndef HD_AGENDA_H
#define HD_AGENDA_H

#include "run/schedule.h"
#include "tangent/interval.h"

/** Why the disks stop at a time: a set. */
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
    bool changing; /**< something else has been asked for */
} hd_wanted;

/** The fields are agenda.c's, and of checkpoint.c. */
typedef struct hd_agenda {
    hd_schedule schedule;
    hd_wanted in_force;
    double field_interval; /**< asked for; in_force has the one that holds */
    bool fields_said;      /**< an interval of fields was asked for; the first one holds at once */
    double interval_end;   /**< the frame is orthonormalised next */
    hd_limit limit;        /**< why not later */
    double sample_begin;   /**< the last measured state */
    bool sample_ends;      /**< with the interval under way */
    double sample_max;     /**< no sample is longer */
    double block;          /**< shortest of the averages */
    unsigned due; /**< by now, set of HD_DUE_*, until the next advance; a stage: until it is
                       left */
} hd_agenda;

/** What those who observe and those who carry have to say about the next interval. */
typedef struct hd_pace {
    double now;
    bool framed;     /**< vectors are carried in this stage */
    bool sampled;    /**< averages are taken without vectors */
    bool first;      /**< nothing has been averaged yet: the first report shall state something */
    bool at_reports; /**< the frame shall be orthonormal at every report */
    bool at_fields;  /**< at those where fields are due */
    double phases;   /**< longest time from one measured state to the next; INFINITY */
    double snapshot; /**< an interval shall end for who follows them; INFINITY */
    hd_norm norm;    /**< between two samples */
    hd_interval *interval;    /**< what the conditioning allows */
    double shortest, longest; /**< that the disks may move at once */
} hd_pace;

/** Of a scene, with its warm-up; rate: collisions of a disk [1/time unit]. */
hd_agenda hd_agenda_of(const hd_scene_def *scene, double rate);
/** Shortest block of the averages: growth follows the waves of density, too, which need that long
 * through the box [T8]. */
double hd_agenda_block(const hd_agenda *agenda);

hd_stage hd_agenda_stage(const hd_agenda *agenda);
/** Simulated time at which the stage began. */
double hd_agenda_stage_begin(const hd_agenda *agenda);
double hd_agenda_stage_end(const hd_agenda *agenda); /**< INFINITY: endless */
double hd_agenda_next_report(const hd_agenda *agenda);
/** The first stage at or after `stage` that has any length begins now. */
void hd_agenda_enter(hd_agenda *agenda, hd_stage stage, double now);

/** An advance begins: forgets what was due with the last one, but for the end of a stage. */
void hd_agenda_begin(hd_agenda *agenda);
/** Where the next interval ends, and whether the sample ends with it, unless one is under way. */
void hd_agenda_plan(hd_agenda *agenda, const hd_pace *pace);
/** The next time at which something is due. */
double hd_agenda_next(const hd_agenda *agenda, const hd_pace *pace);
/** What is due at this time: intervals and samples as planned, and HD_DUE_REPORT. */
unsigned hd_agenda_reached(const hd_agenda *agenda, const hd_pace *pace);

/** Why the interval under way is no longer. */
hd_limit hd_agenda_limit(const hd_agenda *agenda);
/** The frame has been orthonormalised now. */
void hd_agenda_pass_interval(hd_agenda *agenda, double now);
/** A state is measured now; what comes is a new sample. */
void hd_agenda_pass_sample(hd_agenda *agenda, double now);
/** True if the last measured state is that of now. */
bool hd_agenda_is_measured(const hd_agenda *agenda, double now);
/** A report is made now; what is due with it is remembered. reached: the target is. */
void hd_agenda_pass_report(hd_agenda *agenda, bool reached);

/** True if any of these is due by now. */
bool hd_agenda_is_due(const hd_agenda *agenda, unsigned why);

/** What a sample should last at most. */
double hd_agenda_sample_longest(const hd_agenda *agenda, const hd_interval *interval);
/** What intervals are expected to last: those at reports end early, and those before phases, which
 * are at most so far apart. */
double hd_agenda_interval_expected(const hd_agenda *agenda, const hd_interval *interval,
                                   bool at_reports, double phases);

/* ---- changes ------------------------------------------------------------------------------- */

/** Something else is asked for; framed: of a run with vectors, the sample ends with its interval
 * then. */
void hd_agenda_ask(hd_agenda *agenda, bool framed);
/** Another interval of fields is asked for. The first one holds at once, the others as what
 * hd_agenda_ask is told of. */
void hd_agenda_ask_fields(hd_agenda *agenda, double interval, bool framed);
/** Time from which a change holds that is asked for now. */
double hd_agenda_change_time(const hd_agenda *agenda, double now, bool framed);
/** True if the averaging can become so long. */
bool hd_agenda_can_last(const hd_agenda *agenda, double duration, double from);
/** Takes up what has been asked for: true if something has, and the schedule may be another one. */
bool hd_agenda_change(hd_agenda *agenda, const hd_scene_def *scene, double now);
/** The averaging is over, as the time is or the target is reached: reports and fields are due. */
void hd_agenda_end_averaging(hd_agenda *agenda, bool reached, double now);
const hd_text *hd_agenda_target(const hd_agenda *agenda); /**< that is in force */

#endif
