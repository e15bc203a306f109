/** One thing that a scene can have observed. Its row says what it needs of a run, how many bytes it
 * takes, and what is to be done with it; the rows stand in hdlyap/observables.inc. A run knows rows
 * alone: what is off is a row that nobody calls. */
#ifndef HD_OBSERVABLE_H
#define HD_OBSERVABLE_H

#include "base/archive.h"
#include "hdlyap/communicator.h"
#include "hdlyap/observables.h"
#include "hdlyap/frame.h"
#include "hdlyap/spectrum.h"
#include "hdlyap/trajectory.h"
#include "observe/quantity.h"
#include "tangent/frame.h"
#include "tangent/ortho.h"

/** What an observable needs: a set. */
enum {
    HD_NEEDS_FRAME = 1,   /**< vectors; else the disks alone, and it is on as long as the run */
    HD_NEEDS_VECTORS = 2, /**< all n at measured states, and where somebody watches */
    HD_NEEDS_REPORTS = 4, /**< a measured state at every report */
    HD_NEEDS_FIELDS = 8,  /**< a measured state where fields are due */
    HD_NEEDS_ALL = 16,    /**< vectors of all ranks at these reports, on each rank */
    HD_NEEDS_CLOSE = 32,  /**< measured states no farther apart than `sampling` says */
    HD_NEEDS_STATE = 64,  /**< positions and momenta, to measure and report */
    HD_NEEDS_BOX = 128,   /**< positions in a box */
    HD_NEEDS_EDGES = 256, /**< plane waves: a box with edges, no curved wall */
    HD_NEEDS_WHOLE = 512  /**< a frame that is always orthonormal in the whole norm; where half of
                             the vectors are carried, to rounding [T18] */
};

/** What an observable is made from, and what it goes on to know. */
typedef struct hd_observing {
    const hd_scene_def *scene;
    int vectors, carried, threads;
    int width;                     /**< columns that each rank carries, the last one fewer */
    hd_communicator *communicator; /**< NULL: a single rank */
    double block;                  /**< shortest block of averages [time units] */
    hd_ortho *ortho;               /**< NULL without exponents */
    double longest;                /**< no interval between orthonormalisations will be longer */
    void *const *part;             /**< of each row; of those above it when one is created */
} hd_observing;

/** A state that is observed. */
typedef struct hd_view {
    const hd_trajectory *trajectory;
    const hd_spectrum *spectrum; /**< up to now; NULL without exponents */
    hd_columns carried;          /**< orthonormal vectors that this rank carries */
    /** A single rank: all n, and none. One of several: those that it carries, and their partners,
     * if only half of the vectors are carried. */
    hd_columns vectors[2];
    const double *q, *p; /**< positions and momenta, for HD_NEEDS_STATE, else NULL */
} hd_view;

/** An interval of the averaging, through which the frame is carried. */
typedef struct hd_leg {
    enum {
        HD_LEG_BEGINS, /**< the frame is still that of its start */
        HD_LEG_PIECE,  /**< an orthonormalisation, after the part of the record before it */
        HD_LEG_ENDS,
        HD_LEG_LOST /**< the triangle of the next one is not that of the frame any more */
    } at;
    const hd_frame *frame;
    const hd_ortho *ortho;
    const hd_record *record;
    const hd_trajectory *trajectory;
    double from, to; /**< of a piece, in the record */
    double expected; /**< time units that the next intervals are expected to last */
} hd_leg;

/** Functions may be NULL: then there is nothing to do. `self` is what `create` made. */
typedef struct hd_observable {
    unsigned with;                   /**< set of HD_OBSERVE_* that come with it */
    unsigned needs;                  /**< set of HD_NEEDS_* */
    const hd_quantities *quantities; /**< by which a run can be ended; NULL: none */
    /** That it will take on each of so many ranks; on the safe side by some percent. */
    double (*bytes)(const hd_scene_def *scene, int ranks);
    /** Adds how many there are of what it tells; `self` is NULL where a run has none of it. */
    void (*extend)(hd_extent *extent, const hd_scene_def *scene, const void *self);
    /** Least time with the frame before averages, if the scene leaves it open. */
    double (*warmup)(const hd_scene_def *scene);
    /** HD_REFUSED with a line: what it needs of a scene; of several ranks; of intervals between
     * orthonormalisations that may become so long. */
    hd_status (*check)(const hd_scene_def *scene, char *message, size_t size);
    hd_status (*check_ranks)(const hd_scene_def *scene, int ranks, char *message, size_t size);
    hd_status (*check_longest)(const hd_scene_def *scene, double longest, char *message,
                               size_t size);
    /** What it returns is freed, whatever the status: HD_NO_MEMORY. */
    void *(*create)(const hd_observing *with, hd_status *status);
    void (*free)(void *self);
    /** Its averages begin here. */
    void (*clear)(void *self, const hd_view *here);
    /** Nobody looked at it for a while: what has to be followed without a gap begins anew. */
    void (*resume)(void *self);
    /** A snapshot of the vectors that this rank has; then what all ranks have measured. */
    hd_status (*measure)(void *self, const hd_observing *with, const hd_view *state);
    hd_status (*share)(void *self, const hd_observing *with);
    /** The averages take the snapshot up. */
    void (*add)(void *self, const hd_observing *with, const hd_view *state);
    /** At a report at which the vectors are known: state->vectors[0] are those that can be read, of
     * all ranks. */
    void (*report)(void *self, const hd_observing *with, const hd_view *state);
    /** First of the vectors that it reads of all ranks; NULL: 0. */
    int (*first)(void *self, const hd_observing *with);
    /** Longest time from this measured state to the next; INFINITY. */
    double (*sampling)(void *self, const hd_observing *with);
    /** Each interval, while somebody looks. HD_NO_MEMORY, HD_NO_ROOM. Ranks agree. */
    hd_status (*follow)(void *self, const hd_leg *leg);
    /** True if it begins to follow with the next interval: a half of the vectors that stands for
     * all is made so to rounding before [T18]. */
    bool (*begins)(const void *self);
    /** Simulated time at which an interval shall end for it, of one that begins now. */
    double (*due)(const void *self, double now);
    /** True while it has something to do before the run may go on; a step of that. Ranks agree. */
    bool (*is_behind)(const void *self);
    hd_status (*catch_up)(void *self);
    void (*archive)(void *self, hd_archive *archive, const hd_trajectory *now);
    /** What hd_run_parts gives of it; NULL: itself. */
    void *(*result)(void *self);
} hd_observable;

/** The number of each row. */
typedef enum hd_observed {
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) HD_OBSERVED_##name,
#include "hdlyap/observables.inc"
    HD_OBSERVED
} hd_observed;

#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) extern const hd_observable hd_##name##_row;
#include "hdlyap/observables.inc"
extern const hd_observable *const hd_observable_rows[HD_OBSERVED];
extern const unsigned hd_observable_bits[HD_OBSERVED]; /**< HD_OBSERVE_* of each */

#endif
