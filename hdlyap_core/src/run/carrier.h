/** Carries the tangent vectors of a run: owns the frame and the record since the last
 * orthonormalisation, and the results of orthonormalisations, which are spectrum, condition and
 * halves. */
#ifndef HD_CARRIER_H
#define HD_CARRIER_H

#include "averages/blocks.h"
#include "hdlyap/run.h"
#include "observe/observables.h"
#include "tangent/conjugate.h"
#include "tangent/interval.h"

/** What rounding may have added to the exponents. */
typedef struct hd_rounding {
    double condition_max; /**< largest condition so far, which says how exact the start of the
                             averaging is */
    /** HD_ROUNDING times the sum of condition_max when the averaging began and of all conditions
     * since. */
    double sum;
} hd_rounding;

/** Only carrier.c and checkpoint.c use the members. Without exponents pointers are NULL. */
typedef struct hd_carrier {
    hd_communicator *communicator; /**< NULL: a single rank */
    const hd_dynamics *of;
    bool symplectic, diverges; /**< see hd_scene_symplectic, hd_scene_diverges */
    bool dispersing; /**< see hd_dynamics.dispersing; not between walls that break pairs */
    int particles, vectors, carried, positive, zero, threads, threads_denied;
    /** The scene's accuracy [1/time unit]; mean time between two collisions of a particle. */
    double accuracy, collision;
    hd_record *record;
    hd_frame *frame;
    hd_ortho *ortho;
    hd_conjugate *conjugate; /**< NULL where all vectors are carried */
    double *dq_dp; /**< [2 * vectors], what hd_run_dq_dp writes, of the last measured state */
    hd_spectrum *spectrum;
    /** hd_trajectory_divergence where the averages begin, and at the last measured state. */
    double diverged[2];
    hd_blocks divergence; /**< of the spectrum's samples; empty if nothing is told */
    hd_interval interval;
    hd_rounding rounding;
    bool whole; /**< true if the last orthonormalisation was in the full norm, not in that of dq
                   alone */
    hd_cost *cost;
} hd_carrier;

/** How the frame is carried through a record. */
typedef struct hd_carrying {
    bool averaging; /**< averages are taken: growth is added to the spectrum */
    bool measured;  /**< the frame becomes orthonormal in the full norm, for a measured state */
    bool observed;  /**< an observable reads the measured vectors */
    bool whole;     /**< an observable needs every frame orthonormal in the full norm */
    hd_windows *windows; /**< they follow each interval; NULL: nobody listens to them */
    double expected;     /**< expected length of the next intervals [time units] */
    const hd_trajectory *trajectory;
} hd_carrying;

/** Creates the carrier of a scene. collision: time between two collisions of a particle; block:
 * shortest block of the averages. Its work is added to `cost`. Without exponents it has only its
 * interval. If one rank fails, all do. */
HD_MUST_CHECK hd_status hd_carrier_create(hd_carrier *carrier, const hd_scene_def *scene,
                                          double collision, double block,
                                          hd_communicator *communicator, hd_cost *cost);
void hd_carrier_free(hd_carrier *carrier);
/** Bytes on each of `ranks` ranks. */
double hd_carrier_bytes(const hd_scene_def *scene, int threads, int ranks);
/** Threads that this rank may use; communicator may be NULL. */
int hd_carrier_threads_most(const hd_scene_def *scene, const hd_communicator *communicator);

/** Whether orthonormalisations take as long as in a long run: the first one, or the first ones, are
 * others. */
bool hd_carrier_is_usual(const hd_carrier *carrier);
/** The norm of orthonormalisations that end no sample. whole: an observable needs the full norm. */
hd_norm hd_carrier_norm(const hd_carrier *carrier, bool whole);
/** The longest that intervals between orthonormalisations can become in a scene. */
double hd_carrier_longest(const hd_scene_def *scene);

/** Carries the frame through the whole record and orthonormalises it. Fails with HD_ILL_CONDITIONED
 * if no piece is short enough, with HD_NOT_FINITE if that is because `carry` gives no numbers. */
HD_MUST_CHECK hd_status hd_carrier_orthonormalise(hd_carrier *carrier, hd_carrying how);
/** Keeps the halves of this measured state, and ends the spectrum's sample. diverged:
 * hd_trajectory_divergence now. */
HD_MUST_CHECK hd_status hd_carrier_sample(hd_carrier *carrier, bool averaging, double diverged);

/** A stage begins; if it is the averaging, averages start anew. age: time for which the vectors
 * have been carried; diverged: hd_trajectory_divergence now. */
void hd_carrier_begin(hd_carrier *carrier, bool averaging, double age, double diverged);
/** Tells the interval control how much of the allowed numerical error the averaging has not used
 * yet. */
void hd_carrier_save_accuracy(hd_carrier *carrier, bool averaging);

/** All n vectors, with a single rank; none if partners are needed that nobody has asked for. */
hd_columns hd_carrier_vectors(const hd_carrier *carrier);
/** hd_frame_dq_dp of all n vectors at the last measured state; [n] each. */
void hd_carrier_dq_dp(const hd_carrier *carrier, double *cos_theta, double *dp_dq_ratio);
/** See hd_run_divergence. */
double hd_carrier_divergence(const hd_carrier *carrier);
/** See hd_run_divergence_error. */
double hd_carrier_divergence_error(const hd_carrier *carrier);
/** Averaged time, with that of the present sample. */
double hd_carrier_averaged(const hd_carrier *carrier);
/** Largest standard error of the positive exponents nearest to zero, or of the last ones carried if
 * the frame does not reach so far; INFINITY while one is unknown, and if there are none. */
double hd_carrier_smallest_error(const hd_carrier *carrier);
/** See hd_cost.error_bound; NaN before the averaging. */
double hd_carrier_error_bound(const hd_carrier *carrier);

#endif
