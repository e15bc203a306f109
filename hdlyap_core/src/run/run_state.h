/** What a run holds, for the files that make it up: run.c goes on, query.c tells, checkpoint.c
 * keeps.
 */
#ifndef HD_RUN_STATE_H
#define HD_RUN_STATE_H

#include "hdlyap/run.h"
#include "run/advance.h"
#include "run/observer.h"
#include "run/schedule.h"
#include "run/windows.h"
#include "tangent/conjugate.h"
#include "tangent/interval.h"

/** What somebody watches between orthonormalisations, see hd_run_watch. */
typedef struct hd_watch {
    double interval; /**< INFINITY: nobody does */
    int first;       /**< column from which vectors are wanted */
} hd_watch;

/** What falls due with the step under way. */
typedef struct hd_due {
    bool report, fields;
    bool stage_end; /**< once the covariant vectors have gone their way back */
} hd_due;

/** What rounding may have done. */
typedef struct hd_rounding {
    double condition_max; /**< so far: how well the start of the averaging is known */
    double sum;           /**< HD_ROUNDING times that and the conditions since, summed */
} hd_rounding;

/** For estimates of the time left. */
typedef struct hd_clocks {
    double created, frame_started; /**< wall clock [s]; 0 before the frame starts */
    double frame_start_time;       /**< simulated time */
} hd_clocks;

/** What of the scene may change while it runs, as it is now in force: the rest of it is in the
 * schedule, and what is asked for in the scene. */
typedef struct hd_in_force {
    double target_std_error, field_interval;
    bool changing; /**< something else has been asked for */
} hd_in_force;

/** One or several intervals, from one measured state to the next. */
typedef struct hd_sample {
    double begin; /**< simulated time */
    bool ends;    /**< with the interval under way */
} hd_sample;

struct hd_run {
    hd_communicator *communicator; /**< NULL: a single rank */
    hd_scene_def scene;
    int vectors, carried, threads, threads_denied;
    hd_advance advance;
    hd_columns gathered; /**< vectors of several ranks that are known to each now; count 0: none */
    int fields_first;    /**< from there on, beside those of the steps, where fields are due */
    double *gathered_room;
    size_t gathered_size;
    hd_event_log
        *log; /**< since the last orthonormalisation; NULL without exponents, as the next */
    hd_frame *frame;
    hd_ortho *ortho;
    hd_conjugate *conjugate; /**< NULL where all vectors are carried */
    double *halves; /**< [2 * vectors], of the last measured state: as hd_run_halves gives them */
    hd_spectrum *spectrum;
    hd_observer observer;
    hd_windows windows;
    hd_gas *gas;            /**< NULL unless observed, as the next */
    hd_localization *shape; /**< of the vectors */
    hd_schedule schedule;
    hd_interval interval;
    double interval_end; /**< simulated time at which the frame is orthonormalised next */
    hd_limit limit;      /**< why not later */
    double sample_max;   /**< simulated time of HD_COLLISIONS_PER_SAMPLE */
    hd_sample sample;
    bool whole; /**< the frame was orthonormalised in the whole norm, not in that of dq alone */
    double followed;  /**< simulated time at which the phases were known last; negative: never */
    unsigned observe; /**< set of HD_OBSERVE_* that is needed now */
    hd_watch watch;
    hd_due due;
    hd_in_force in_force;
    double field_interval; /**< asked for */
    bool fields_said;      /**< by a first call, which holds at once */
    hd_clocks clocks;
    hd_rounding rounding;
    hd_cost cost;
};

enum { SMALLEST_EXPONENTS = 8 };

/** Kept for what is no number. */
#define HD_NO_HALF (-2.0)

/** Of one disk, at most. */
#define HD_COLLISIONS_PER_SAMPLE 80.0

/** hd_run_create_shared and hd_run_free within a call that the other ranks make, too. */
HD_MUST_CHECK hd_status hd_run_make(hd_run **out, const hd_scene_def *def,
                                    hd_communicator *communicator, char *message, size_t size);
void hd_run_drop(hd_run *run);

/** Ends what a step has begun, so that the run can be kept: half of a way back is none. */
HD_MUST_CHECK hd_status hd_run_settle(hd_run *run);

/** Averaged time, that of the sample under way included. */
double hd_run_averaged(const hd_run *run);

/** What a sample should last at most. */
double hd_run_sample_longest(const hd_run *run);

/** Shortest block of the averages: growth follows the waves of density, too, which need that long
 * through the box [T8]. */
double hd_run_block_least(const hd_run *run);

/** Largest standard error of the exponents nearest to zero; INFINITY while one is unknown. */
double hd_run_smallest_error(const hd_run *run);

#endif
