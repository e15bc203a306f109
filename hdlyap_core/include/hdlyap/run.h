/** A whole run of a scene: equilibration, warm-up of the frame, averaging, one interval at a time.
 * Two threads may have a run each; one run, and all that is read of it, is one thread's at a time.
 */
#ifndef HDLYAP_RUN_H
#define HDLYAP_RUN_H

#include <stdbool.h>

#include "hdlyap/communicator.h"
#include "hdlyap/covariant.h"
#include "hdlyap/frame.h"
#include "hdlyap/gas.h"
#include "hdlyap/hydro.h"
#include "hdlyap/interval.h"
#include "hdlyap/localization.h"
#include "hdlyap/observables.h"
#include "hdlyap/parameters.h"
#include "hdlyap/phases.h"
#include "hdlyap/pmode.h"
#include "hdlyap/spectrum.h"
#include "hdlyap/steps.h"
#include "hdlyap/structure.h"

HD_API_BEGIN

/** Of the quantities of a target, the one whose error is farthest from what is asked for. */
typedef struct hd_standing {
    char name[HD_QUANTITY_NAME]; /**< "": there is no target, and nothing else is said */
    double value;                /**< 0 while nothing is known, and of the smallest exponents */
    double error;                /**< standard error; negative while not known */
    double wanted; /**< error that is asked for, in the same unit; negative while it is a
                      part of a value that is not known */
    double open;   /**< part of the error that no averaging takes away; 0 but of c_T, c_L and v */
    double left;   /**< averaged time still to come until all are reached, as errors fall with its
                      root; INFINITY while that is not known, or if it is never */
    bool reached;  /**< all of them are */
} hd_standing;

/** What the run pays for, since its start unless said otherwise. What is not measured (yet) is
 * NaN. */
typedef struct hd_cost {
    double wall;     /**< seconds */
    double events;   /**< seconds in the trajectory */
    double replay;   /**< seconds in the tangent frame */
    double ortho;    /**< seconds in the factorisation */
    double spectrum; /**< seconds in averages */
    double modes;    /**< seconds in classification, steps, phases, responses, widths */
    /** Seconds in what follows each interval: for covariant vectors what is kept, and the way back.
     */
    double following;
    /** Seconds of the above in exchange with other ranks, waiting included; bytes that this rank
     * has handed over; calls. 0 with a single rank */
    double communication, bytes, calls;
    double events_per_second; /**< pair events over seconds in the trajectory */
    double interval;          /**< time units between orthonormalisations, last used */
    hd_limit limit;           /**< why it was not longer */
    double condition;         /**< of the last orthonormalisation [T6] */
    double defect;            /**< predicted loss of orthogonality of the last one */
    double error_bound; /**< (sum of eps * condition, enlarged as [T6] says, + defect) / averaged
                           time: what rounding may have done to a mean */
    long orthonormalisations; /**< number of them */
    long second_passes;       /**< how many needed a second pass */
    long slow_vector_samples; /**< samples that ended early for who watches the vectors */
    long repairs;             /**< intervals that turned out too long and were replayed in pieces */
    /** largest of the eight positive exponents nearest to zero, or of the last ones carried if
     * fewer are; negative if unknown */
    double std_error;
    /** Averaged time since which std_error does not fall as it does in a stationary run, an eighth
     * of the averaged time or less; negative while it falls, or that cannot be said yet */
    double stalled_since;
    double stalled_error; /**< std_error then */
    double progress;      /**< 0 .. 1 of the time asked for, or to the target; negative if
                              unknown */
    double remaining;     /**< predicted wall seconds to the end, or to the target; negative if
                              unknown */
    hd_standing target;   /**< the quantity of the target whose error is farthest from what is
                              asked for */
} hd_cost;

typedef struct hd_run hd_run;

/** Of a checked scene. HD_REFUSED with one line in `message`: the target cannot be read, or names
 * what such a run never knows. */
HD_MUST_CHECK hd_status hd_target_check(const hd_scene_def *def, char *message, size_t size);

/** HD_REFUSED with its line in `message` as by hd_scene_check and hd_target_check (`message` may be
 * NULL). */
HD_MUST_CHECK hd_status hd_run_create(hd_run **out, const hd_scene_def *def, char *message,
                                      size_t size);
/** A run that several ranks carry: they make this and all later calls together, in the same order.
 * What is read of the run is on each of them, but for vectors: of those each has some. HD_REFUSED
 * also for what one rank alone can do. */
HD_MUST_CHECK hd_status hd_run_create_shared(hd_run **out, const hd_scene_def *def,
                                             hd_communicator *communicator, char *message,
                                             size_t size);
void hd_run_free(hd_run *run);

/** Goes on by one interval; short enough (a fraction of a second for N below 1000) to be
 * interrupted between two calls. Does nothing once HD_FINISHED. A run that has failed is of no use
 * any more: each later call says the same status, and it is not saved. */
HD_MUST_CHECK hd_status hd_run_advance(hd_run *run);

/** True if the last call ended at a multiple of the report interval. Spectrum, modes and steps are
 * then those of the last measured state, hd_spectrum_time after the averaging began: some
 * 80 collisions of each disk ago, at once if the hydrodynamic response is looked at, or fields that
 * are due. Phases are those of hd_run_followed. */
bool hd_run_report_due(const hd_run *run);

/** Fields are due with the first report at or after each multiple of so many time units since the
 * averaging began, 0 included, and with the last one; with 0 (as at first) at every report. The
 * interval is 0 or more, and finite. The first call holds at once, another one from
 * hd_run_change_time on. A run that goes on from a checkpoint has them as often as before, until
 * its first call. */
void hd_run_fields_every(hd_run *run, double interval);

/** Of several ranks, each knows the vectors of the steps where fields are due: and from now on all
 * others from this column on. */
void hd_run_fields_from(hd_run *run, int first);

/** Asks for another value of a parameter of the scene whose row is a live one, a number from end to
 * end or a text. It holds from
 * hd_run_change_time on, and hd_run_scene has it at once. HD_REFUSED with one line in `message`: it
 * is read at the start, or the value is not allowed; a duration must not be shorter than what will
 * have been averaged by then. */
HD_MUST_CHECK hd_status hd_run_change(hd_run *run, const hd_parameter *row, const char *value,
                                      char *message, size_t size);
/** Simulated time from which on a change holds that is asked for now: while averages are taken the
 * end of the present interval between orthonormalisations, else at once. */
double hd_run_change_time(const hd_run *run);

/** The shortest duration that the run can still be given: it ends as soon as it can then. NaN but
 * while averages are taken. */
double hd_run_shortest_duration(const hd_run *run);

/** True if the last call ended at such a report: if fields are looked at, the frame is
 * orthonormalised at this very time. */
bool hd_run_fields_due(const hd_run *run);

/** Which of the stages that the scene asks for (HD_OBSERVE_*) are needed from now on; at first all.
 * A stage that nobody looks at is skipped: its averages miss that time, phases begin anew. */
void hd_run_observe(hd_run *run, unsigned stages);

/** For who watches: from now on no call goes on by more than `interval` [time units; INFINITY:
 * nobody watches], and while the modes are observed each ends with all vectors known,
 * orthonormalised at that time, if `first` is a column of theirs (hd_run_vectors or more: disks are
 * enough); of several ranks those from `first` on. The averages take these states up as any other.
 */
void hd_run_watch(hd_run *run, double interval, int first);

/** The vectors known at the very time of the last call: all of them, of several ranks those that
 * somebody wants, or none (count 0). Their coefficients are in the snapshot of the modes. */
hd_columns hd_run_columns(const hd_run *run);

/** All n vectors of the last orthonormalisation, if modes are observed; valid until the next call
 * of hd_run_advance. Orthonormal in the whole norm at measured states: as for fields that are due.
 * Of several ranks, those of the modes, where fields or the hydrodynamic response are due. */
hd_columns hd_run_frame_columns(const hd_run *run);
/** Of each vector at the last measured state, [n]: cosine of the angle between its dp and dq
 * halves, NaN if one of them vanishes, and |dp| / |dq|, NaN if dq vanishes. */
void hd_run_halves(const hd_run *run, double *cos_theta, double *dp_dq_ratio);

/** Starts the averages afresh at the present time. Fails as hd_run_advance does. */
HD_MUST_CHECK hd_status hd_run_reset_average(hd_run *run);

/** HD_OK; or what the run has failed with, in hd_run_advance, hd_run_reset_average, or on the way
 * back that hd_run_save ends. */
hd_status hd_run_status(const hd_run *run);
hd_stage hd_run_stage(const hd_run *run);
double hd_run_time(const hd_run *run); /**< simulated time since the start */
const hd_scene_def *hd_run_scene(const hd_run *run);
int hd_run_vectors(const hd_run *run);        /**< n, 0 without exponents */
int hd_run_ranks(const hd_run *run);          /**< 1 unless shared */
int hd_run_threads(const hd_run *run);        /**< in use, of this rank */
int hd_run_threads_denied(const hd_run *run); /**< wanted, but not granted by OpenMP; 0: none */

hd_parts hd_run_parts(const hd_run *run);

/** Simulated time of the phases; negative while none have been followed. */
double hd_run_followed(const hd_run *run);
hd_cost hd_run_cost(const hd_run *run);
/** True if averages have been taken for so long (without exponents, as long as with them) and less
 * than a tenth of the disks was seen away from its place since: all errors are those of this one
 * state of the disks, as of a crystal [T8]. */
bool hd_run_is_caged(const hd_run *run);

HD_API_END
#endif
