/** A run of a scene. It has three stages: equilibration, in which only particles move; warm-up of
 * the frame, the tangent vectors that it carries; and averaging. hd_run_advance takes it on by one
 * interval between two orthonormalisations. Times are simulated, in time units, unless a comment
 * says wall time. n is the number of exponents, each of which has a vector (hd_counts.vectors), N
 * that of particles. Several runs may go on at once, each on a thread of its own; a run, and
 * everything that is read from it, belongs to one thread at a time. Tags as [T6] are those of
 * equations in THEORY.md. */
#ifndef HDLYAP_RUN_H
#define HDLYAP_RUN_H

#include <stdbool.h>

#include "hdlyap/averages.h"
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

/** Where the run stands on its way to its target: what is known of that quantity of the target
 * whose error is farthest from the wanted one. */
typedef struct hd_target_progress {
    /** Name of the quantity, e.g. c_T. "" if the run has no target; the other members then mean
     * nothing. */
    char name[HD_QUANTITY_NAME];
    double value;  /**< its present value; 0 while it is not known, and for the quantity smallest */
    double error;  /**< its present standard error; negative while it is not known */
    double wanted; /**< its wanted standard error, in the same unit; negative if that is a fraction
                      of a value that is not known yet */
    double open; /**< part of the error that stays however long the run averages; 0 except for c_T,
                    c_L and v */
    /** Averaged time that is left until all quantities of the target reach it, if errors fall with
     * the square root of time; INFINITY if that is unknown or never. */
    double left;
    bool reached; /**< true if all quantities of the target have reached it */
} hd_target_progress;

/** What the run costs, since its start unless a comment says otherwise. A number that is not known
 * is NaN, unless a comment says that it is negative. Seconds are of wall time. */
typedef struct hd_cost {
    double wall;     /**< seconds of the run so far, without those between saving and resuming */
    double events;   /**< seconds for moving the particles */
    double replay;   /**< seconds for carrying the tangent vectors */
    double ortho;    /**< seconds for orthonormalising them */
    double spectrum; /**< seconds for averages of exponents */
    double modes;    /**< seconds for weights, steps, phases, responses and widths */
    /** Seconds for covariant vectors. */
    double following;
    /** For several ranks: seconds, out of those above, for exchanging data and waiting; bytes that
     * this rank has sent; number of exchanges. 0 if a single rank has carried the whole run. */
    double communication, bytes, calls;
    double events_per_second; /**< pair collisions per second of `events` */
    double interval;          /**< length of the last interval between orthonormalisations */
    hd_limit limit;           /**< why that interval was not longer */
    double condition; /**< condition number of the frame at the last orthonormalisation [T6] */
    double defect;    /**< predicted deviation from orthogonality of the vectors that it made */
    /** Bound on what numerical errors may have added to an exponent: DBL_EPSILON times the
     * condition of each orthonormalisation, summed and enlarged as [T6] says, with a term of the
     * defect, over the averaged time [1/time unit]. */
    double error_bound;
    long orthonormalisations; /**< number of orthonormalisations */
    long second_passes; /**< number of orthonormalisations that needed a second pass for accuracy */
    long slow_vector_samples; /**< number of samples that ended early because of hd_run_measure */
    long repairs;             /**< number of intervals that were repeated in pieces for accuracy */
    /** Largest of the standard errors of the eight smallest positive exponents that are computed;
     * negative if it is not known [1/time unit]. */
    double std_error;
    /** Averaged time, at most an eighth of the present one, since which std_error has not fallen as
     * it does in a stationary run; negative while it falls so, or if that is not known. */
    double stalled_since;
    double stalled_error; /**< std_error at the time stalled_since */
    double progress;      /**< how much of the run, or of the way to its target, is done, 0 .. 1;
                             negative if not known */
    double remaining;     /**< predicted seconds to the end of the run; negative if not known */
    hd_target_progress target; /**< the quantity that is farthest from its wanted error */
} hd_cost;

/** A run. The caller makes it and frees it; the run owns its parts and their results. */
typedef struct hd_run hd_run;

/** Returns HD_OK if the target of a checked scene can be read and a run can know all its
 * quantities; otherwise HD_REFUSED with one line in message[size]. `message` may be NULL. */
HD_MUST_CHECK hd_status hd_target_check(const hd_scene_def *def, char *message, size_t size);

/** Makes a run of *def, which is copied, and writes it to *out; the caller frees it with
 * hd_run_free. Returns HD_OK; HD_REFUSED, with one line in message[size] unless `message` is NULL,
 * for what hd_scene_check or hd_target_check refuses, or if no start is found; or HD_NO_MEMORY.
 * *out is NULL after a failure. */
HD_MUST_CHECK hd_status hd_run_create(hd_run **out, const hd_scene_def *def, char *message,
                                      size_t size);
/** Makes a run that several ranks carry together, as hd_run_create. All ranks make this and all
 * later calls of the run at the same place, with the same arguments. Each rank can read all
 * results, but only some of the vectors. Returns HD_REFUSED also for what only a single rank can
 * do. `communicator` must last longer than the run. */
HD_MUST_CHECK hd_status hd_run_create_shared(hd_run **out, const hd_scene_def *def,
                                             hd_communicator *communicator, char *message,
                                             size_t size);
/** Frees a run and all its parts; `run` may be NULL. */
void hd_run_free(hd_run *run);

/** Takes the run on by one interval, which takes a fraction of a second of wall time for N below
 * 1000. While covariant vectors are carried back, a call does a part of that work and simulated
 * time stands still. Once the run is HD_FINISHED, the call does nothing. If it fails, every later
 * call returns the same status, and the run cannot be saved; hd_status_text says what it means. */
HD_MUST_CHECK hd_status hd_run_advance(hd_run *run);

/** True from a call of hd_run_advance that ended at a report to the next call. The results of
 * hd_run_parts are then those of the last sample, which ended hd_spectrum_time after the averaging
 * began. Samples end about every 80 collisions of each particle, or earlier, and with this report
 * if the scene asks for hydro or fields are due. Phases have samples of their own: see
 * hd_run_phase_time. */
bool hd_run_report_due(const hd_run *run);

/** Changes a parameter of the scene with hd_parameter.live, to a number or a text that `value`
 * holds. The new value is in hd_run_scene at once, but the run follows it from hd_run_change_time
 * on. Returns HD_REFUSED, with one line in message[size] unless NULL, if the parameter cannot
 * change or the value is not allowed; a duration must not be shorter than what will be averaged by
 * then. */
HD_MUST_CHECK hd_status hd_run_change(hd_run *run, const hd_parameter *row, const char *value,
                                      char *message, size_t size);
/** Simulated time from which a change that is made now holds: the end of the present interval while
 * the run is averaging, otherwise the present time. */
double hd_run_change_time(const hd_run *run);

/** The shortest duration to which hd_run_change can still set the run, which ends it as soon as
 * possible [time units]. NaN unless the run is averaging. */
double hd_run_shortest_duration(const hd_run *run);

/** True, until the next call of hd_run_advance, if the last one ended at a report with which fields
 * are due (field_interval of the scene). If somebody listens to the observable fields, the state is
 * a measured one, so that the caller can reconstruct L and P modes (hd_pmode_reconstruct). */
bool hd_run_fields_due(const hd_run *run);

/** Sets which of the scene's observables are computed from now on: `stages` is a set of
 * HD_OBSERVE_*. At first all are. Averages of the others leave out the time in which they are not
 * computed, and their phases begin again afterwards. */
void hd_run_observe(hd_run *run, unsigned stages);

/** For a viewer that shows the run while it goes on: from now on no call of hd_run_advance goes on
 * by more than `interval` [time units]; INFINITY ends this. */
void hd_run_watch(hd_run *run, double interval);

/** Has a measured state now: unless it is one, a sample of the averages ends here, and all n
 * vectors are orthonormalised with dq and dp together. It is then the sample of
 * hd_modes_coefficients. With several ranks each rank can read the vectors from column `first` on
 * (hd_run_vectors_now). Before the averaging, and after it, nothing is measured. Fails as
 * hd_run_advance does. */
HD_MUST_CHECK hd_status hd_run_measure(hd_run *run, int first);

/** All n vectors at the present time, orthonormal with dq and dp together, if the last call of
 * hd_run_advance or hd_run_measure ended a sample and an observable that is computed needs them, as
 * the weights of modes; otherwise count is 0. Valid until the next call of hd_run_advance. Their
 * coefficients are those of hd_modes_coefficients. With several ranks these are the vectors that
 * hd_run_measure gathered at this time, or at a report those that hydro has read. */
hd_columns hd_run_vectors_now(const hd_run *run);
/** Writes, for each vector in the last sample: to cos_theta[n] the cosine of the angle between its
 * halves dp and dq, NaN if one of them is 0; to dp_dq_ratio[n] |dp| / |dq|, NaN if dq is 0. */
void hd_run_dq_dp(const hd_run *run, double *cos_theta, double *dp_dq_ratio);
/** Mean divergence of the flow over hd_spectrum_time, which is hd_spectrum_sums.exponent_sum but
 * for errors of time steps [1/time unit]; NaN before the first sample, and if the row does not tell
 * it (hd_dynamics.divergence). */
double hd_run_divergence(const hd_run *run);
/** Standard error of hd_run_divergence [1/time unit]; negative while it is not known. */
double hd_run_divergence_error(const hd_run *run);

/** Begins all averages again at the present time, and forgets what was measured before; the
 * duration counts from now. It does nothing unless the run is averaging. Fails as hd_run_advance
 * does. */
HD_MUST_CHECK hd_status hd_run_reset_average(hd_run *run);

/** HD_OK, or the status of the call of hd_run_advance, hd_run_reset_average or hd_run_save that
 * made the run fail. */
hd_status hd_run_status(const hd_run *run);
/** One line that says what the functions of the row of dynamics did wrong, if the run has failed
 * with HD_DYNAMICS_FAULT; otherwise "". */
const char *hd_run_fault(const hd_run *run);
/** The stage in which the run is, or HD_FINISHED. */
hd_stage hd_run_stage(const hd_run *run);
/** Simulated time since the start of the run [time units]. */
double hd_run_time(const hd_run *run);
/** The scene, with its present parameters and the duration of the warm-up as chosen. */
const hd_scene_def *hd_run_scene(const hd_run *run);
/** Number n of vectors, each of which has an exponent; 0 if the scene asks for no exponents. With
 * hd_scene_def.exponents = HD_EXPONENTS_ALL half of them are carried (hd_counts.carried). */
int hd_run_vectors(const hd_run *run);
/** Number of ranks that carry the run. */
int hd_run_ranks(const hd_run *run);
/** Number of threads that the run uses on this rank. */
int hd_run_threads(const hd_run *run);
/** Number of threads that OpenMP did not grant to the run. */
int hd_run_threads_denied(const hd_run *run);

/** The results of the run; the pointers stay the same until the run is freed. */
hd_parts hd_run_parts(const hd_run *run);

/** Simulated time at which phases or fluctuations were last sampled [time units]; negative if they
 * have not been in this stage. */
double hd_run_phase_time(const hd_run *run);
/** What the run has cost so far, and how far it is. */
hd_cost hd_run_cost(const hd_run *run);
/** True if the particles keep their places, as in a crystal, so that standard errors hold for this
 * one arrangement only [T8]: at no report of the averaging a tenth of them had left its place.
 * False as long as the averaging is too short to tell. */
bool hd_run_is_caged(const hd_run *run);

HD_API_END
#endif
