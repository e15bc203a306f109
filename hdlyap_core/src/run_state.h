/** What a run holds, for the files that make it up: run.c goes on, progress.c tells, checkpoint.c
 * keeps. */
#ifndef HD_RUN_STATE_H
#define HD_RUN_STATE_H

#include "hdlyap/covariant.h"
#include "hdlyap/run.h"
#include "interval.h"
#include "schedule.h"
#include "tail.h"

/** The step that the disks are in: what is learnt of it waits for its end, however often a watcher
 * stops it. */
typedef struct hd_step_plan {
    double begin, end; /**< simulated times */
    uint64_t events;   /**< before it */
} hd_step_plan;

/** What somebody looks at between orthonormalisations, see hd_run_watch. */
typedef struct hd_watch {
    double interval;    /**< INFINITY: nobody looks */
    int first;          /**< column from which vectors are wanted */
    hd_columns columns; /**< known at this very time */
} hd_watch;

struct hd_run {
    hd_scene_def scene;
    hd_trajectory *trajectory;
    hd_event_log *log;
    hd_frame *frame; /**< NULL without exponents, as the two below */
    hd_ortho *ortho;
    hd_spectrum *spectrum;
    hd_modes *modes; /**< NULL unless observed, as the next two */
    hd_steps *steps;
    hd_phases *phases;
    hd_tail *tail;           /**< NULL without phases, and where it does not apply */
    hd_covariant *covariant; /**< NULL unless observed */
    bool lookback_due;       /**< a window begins with the next interval */
    double *q, *p;           /**< [2N], state of a snapshot */
    unsigned observe;        /**< stages needed now */
    hd_schedule schedule;
    hd_interval interval;
    double interval_end; /**< simulated time at which the frame is orthonormalised next */
    double step_max; /**< longest step that keeps to EVENTS_PER_STEP, as far as events are known */
    double sample_max; /**< simulated time of COLLISIONS_PER_SAMPLE */
    hd_step_plan plan;
    hd_watch watch;
    int vectors, threads;
    double now; /**< simulated time */
    bool report_due, fields_due;
    bool phase_ends; /**< once the covariant vectors have gone their way back */
    double field_interval;
    double created, frame_started,
        frame_start_time; /**< wall clock, and simulated time, for estimates */
    double condition_max; /**< so far: how well the start of the averaging is known */
    double rounding;      /**< HD_ROUNDING times that and the conditions since, summed */
    hd_cost cost;
};

enum { SMALLEST_EXPONENTS = 8 };

/** Of one disk, at most. */
#define HD_COLLISIONS_PER_SAMPLE 64.0

/** Ends what a step has begun, so that the run can be kept: half of a way back is none. */
HD_MUST_CHECK hd_status hd_run_settle(hd_run *run);

/** More than a run of this scene learns of how long a step may be: several times the events of the
 * longest step. */
double hd_run_step_bound(const hd_run *run);

/** Largest standard error of the exponents nearest to zero; INFINITY while one is unknown. */
double hd_run_smallest_error(const hd_run *run);

#endif
