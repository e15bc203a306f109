/** A run of a scene: equilibration, warm-up of the frame, averaging; it goes on by one interval at
 * a time. Each thread may have a run of its own; a run, and everything read of it, belongs to one
 * thread at a time. */
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

/** Where the run stands on its way to the target: the quantity that is farthest from its wanted
 * error. */
typedef struct hd_standing {
    char name[HD_QUANTITY_NAME]; /**< e.g. c_T; "" without a target: nothing below has a meaning */
    double value;                /**< its value; 0 while it is not known, and for smallest */
    double error;                /**< its standard error; negative while not known */
    double wanted; /**< wanted error, in the same unit; negative while it is a fraction of an
                      unknown value */
    double open;   /**< part of the error that no averaging reduces; 0 except for c_T, c_L, v */
    double left;   /**< averaged time until all quantities reach the target, as errors fall with
                      its square root; INFINITY if unknown or never [time units] */
    bool reached;  /**< all quantities have reached the target */
} hd_standing;

/** What the run costs, since its start unless a field says otherwise. A number that is not known is
 * NaN. Seconds are wall seconds. */
typedef struct hd_cost {
    double wall;     /**< seconds of the whole run */
    double events;   /**< seconds for moving the particles */
    double replay;   /**< seconds for carrying the tangent vectors */
    double ortho;    /**< seconds for orthonormalisations */
    double spectrum; /**< seconds for averages of exponents */
    double modes;    /**< seconds for weights, steps, phases, responses, widths */
    /** Seconds for observables that follow every interval: covariant vectors. */
    double following;
    /** Part of these seconds for exchange with other ranks and waiting; bytes that this rank has
     * sent; number of exchanges. 0 for a single rank. */
    double communication, bytes, calls;
    double events_per_second; /**< pair collisions per second of moving */
    double interval;          /**< last interval between orthonormalisations [time units] */
    hd_limit limit;           /**< why that interval was not longer */
    double condition;         /**< condition of the last orthonormalisation [T6] */
    double defect;            /**< predicted loss of orthogonality of its vectors */
    /** What rounding may have added to an exponent: the sum of eps * condition, enlarged as [T6]
     * says, and of defects, per averaged time. */
    double error_bound;
    long orthonormalisations; /**< number of orthonormalisations */
    long second_passes;       /**< number of those that needed a second pass */
    long slow_vector_samples; /**< samples that ended early because of hd_run_watch */
    long repairs;             /**< intervals that were repeated in pieces for accuracy */
    /** Largest standard error of the eight smallest positive exponents that are computed; negative
     * if unknown [1/time unit]. */
    double std_error;
    /** Averaged time, at most an eighth of the present one, since when std_error has not fallen as
     * in a stationary run; negative while it falls, or while that is unknown. */
    double stalled_since;
    double stalled_error; /**< std_error at that time */
    double progress;      /**< fraction of the run, or of the way to the target, 0 .. 1; negative
                              if unknown */
    double remaining;     /**< predicted seconds to the end; negative if unknown */
    hd_standing target;   /**< the quantity that is farthest from its wanted error */
} hd_cost;

typedef struct hd_run hd_run;

/** Checks the target of a checked scene. HD_REFUSED with one line in `message` if it cannot be
 * read, or names a quantity that such a run never knows. */
HD_MUST_CHECK hd_status hd_target_check(const hd_scene_def *def, char *message, size_t size);

/** Makes a run. HD_REFUSED, with one line in `message` unless that is NULL, for a scene that
 * hd_scene_check or hd_target_check refuses; HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_run_create(hd_run **out, const hd_scene_def *def, char *message,
                                      size_t size);
/** Makes a run that several ranks carry. They make this and all later calls together, in the same
 * order. Each rank can read all results, but only some of the vectors. HD_REFUSED also for what
 * only a single rank can do. */
HD_MUST_CHECK hd_status hd_run_create_shared(hd_run **out, const hd_scene_def *def,
                                             hd_communicator *communicator, char *message,
                                             size_t size);
void hd_run_free(hd_run *run);

/** Goes on by one interval, which takes a fraction of a second for N below 1000. It does nothing
 * once the run is HD_FINISHED. If it fails, each later call fails with the same status, and the run
 * cannot be saved. */
HD_MUST_CHECK hd_status hd_run_advance(hd_run *run);

/** True if the last call ended at a report. Spectrum, modes and steps are then those of the last
 * sample, hd_spectrum_time after the averaging began. A sample ends about every 80 collisions of
 * each particle, and at this report if hydro is asked for or fields are due. Phases are those of
 * hd_run_followed. */
bool hd_run_report_due(const hd_run *run);

/** Sets how often fields are due: with the first report of the averaging, with the first report at
 * or after each multiple of `interval` [time units] since then, and with the last; 0, the default,
 * is every report. The interval is finite. The first call holds at once, a later one from
 * hd_run_change_time on. A resumed run keeps its interval until the first call. */
void hd_run_fields_every(hd_run *run, double interval);

/** With several ranks, each rank has the vectors of the steps when fields are due. After this call
 * it also has all vectors from column `first` on. */
void hd_run_fields_from(hd_run *run, int first);

/** Changes a parameter of the scene whose row is live, a number or a text. The new value holds from
 * hd_run_change_time on; hd_run_scene has it at once. HD_REFUSED with one line in `message` if the
 * parameter cannot change, or the value is not allowed; a duration must not be shorter than what
 * will be averaged by then. */
HD_MUST_CHECK hd_status hd_run_change(hd_run *run, const hd_parameter *row, const char *value,
                                      char *message, size_t size);
/** Simulated time from which a change holds that is made now: the end of the present interval
 * during the averaging, otherwise the present time. */
double hd_run_change_time(const hd_run *run);

/** The shortest duration that the run can still be given, with which it ends as soon as possible.
 * NaN unless the run is averaging. */
double hd_run_shortest_duration(const hd_run *run);

/** True if the last call ended at a report with which fields are due. If fields are needed, the
 * frame was orthonormalised at this time. */
bool hd_run_fields_due(const hd_run *run);

/** Sets which of the observables that the scene asks for (HD_OBSERVE_*) are computed from now on;
 * at first all are. The averages of the others miss that time, and phases begin again afterwards.
 */
void hd_run_observe(hd_run *run, unsigned stages);

/** For a viewer: from now on no call goes on by more than `interval` [time units]; INFINITY ends
 * this. If `first` is below hd_run_vectors and modes are computed, all vectors are orthonormalised
 * at the end of each call; with several ranks each has those from column `first` on. The averages
 * use these states like any other. */
void hd_run_watch(hd_run *run, double interval, int first);

/** The vectors at the time of the last call: all of them, with several ranks those that were
 * requested, or none (count 0). Their coefficients are in the last sample of the modes. */
hd_columns hd_run_columns(const hd_run *run);

/** All n vectors of the last orthonormalisation, if modes are computed; valid until the next call
 * of hd_run_advance. They are orthonormal in the norm of dq and dp together at samples, as when
 * fields are due. With several ranks: those of the modes, when fields or the response are due. */
hd_columns hd_run_frame_columns(const hd_run *run);
/** Writes, for each vector in the last sample, [n], the cosine of the angle between its halves dp
 * and dq, NaN if one vanishes, and |dp| / |dq|, NaN if dq vanishes. */
void hd_run_halves(const hd_run *run, double *cos_theta, double *dp_dq_ratio);

/** Begins all averages again at the present time. Fails as hd_run_advance does. */
HD_MUST_CHECK hd_status hd_run_reset_average(hd_run *run);

/** HD_OK, or the status with which hd_run_advance, hd_run_reset_average or hd_run_save made the run
 * fail. */
hd_status hd_run_status(const hd_run *run);
hd_stage hd_run_stage(const hd_run *run);
double hd_run_time(const hd_run *run); /**< simulated time since the start [time units] */
const hd_scene_def *hd_run_scene(const hd_run *run);
int hd_run_vectors(const hd_run *run);        /**< number n of vectors; 0 without exponents */
int hd_run_ranks(const hd_run *run);          /**< number of ranks */
int hd_run_threads(const hd_run *run);        /**< threads that this rank uses */
int hd_run_threads_denied(const hd_run *run); /**< threads that OpenMP did not grant */

hd_parts hd_run_parts(const hd_run *run);

/** Simulated time of the last sample of phases; negative without one. */
double hd_run_followed(const hd_run *run);
hd_cost hd_run_cost(const hd_run *run);
/** True if the averaging is long enough to tell, and less than a tenth of the particles has left
 * its place since it began, as in a crystal: errors then hold for this one arrangement only [T8].
 */
bool hd_run_is_caged(const hd_run *run);

HD_API_END
#endif
