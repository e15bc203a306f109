/** An observable: something that a scene can ask for. Its row says what it needs of a run, how many
 * bytes it takes, and which functions serve it; hdlyap/observables.inc lists the rows. A run knows
 * rows alone, and calls no row that the scene does not ask for. */
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
    HD_NEEDS_FRAME = 1,   /**< vectors; a row without this needs particles alone and is computed
                             whether anyone listens or not */
    HD_NEEDS_VECTORS = 2, /**< all n vectors at measured states, and where a viewer shows them */
    HD_NEEDS_REPORTS = 4, /**< a measured state at every report */
    HD_NEEDS_ALL = 16, /**< at these reports, or if it does not need them at those with which fields
                          are due: a measured state, and the vectors of all ranks on each rank */
    HD_NEEDS_CLOSE = 32,  /**< measured states no farther apart than `sampling` says */
    HD_NEEDS_STATE = 64,  /**< positions and momenta, for `measure` and `report` */
    HD_NEEDS_BOX = 128,   /**< positions in a box */
    HD_NEEDS_EDGES = 256, /**< waves in a box with edges; no curved wall */
    /** The frame is always orthonormalised with dq and dp together; if half of the vectors are
     * carried, to rounding [T18]. */
    HD_NEEDS_WHOLE = 512,
    HD_NEEDS_TOTALS = 1024,  /**< hd_dynamics.totals */
    HD_NEEDS_AVERAGES = 2048 /**< hd_dynamics.averages */
};

/** What an observable is created from, and may use from then on. */
typedef struct hd_observing {
    const hd_scene_def *scene;
    int vectors, carried, threads;
    int width; /**< number of vectors that each rank carries; the last rank may carry fewer */
    hd_communicator *communicator; /**< NULL: a single rank */
    double block;                  /**< shortest block of averages [time units] */
    double sample;               /**< length to which samples grow; 0: all are alike [time units] */
    hd_ortho *ortho;             /**< NULL without exponents */
    const hd_spectrum *spectrum; /**< averages up to now; NULL without exponents */
    void *const *part; /**< the observables of all rows, NULL for those not asked for; in `create`,
                          only those of earlier rows */
} hd_observing;

/** A state that is observed: what the functions of a row are called with. */
typedef struct hd_moment {
    const hd_observing *with;
    const hd_trajectory *trajectory;
    const hd_spectrum *spectrum; /**< averages up to now; NULL without exponents */
    hd_columns carried;          /**< orthonormal vectors that this rank carries */
    /** With a single rank: all n vectors, and none. With several: the vectors that this rank
     * carries, and their partners if only half of all are carried. */
    hd_columns vectors[2];
    const double *q, *p; /**< positions and momenta, for HD_NEEDS_STATE, else NULL */
    hd_archive *archive; /**< for `archive` */
} hd_moment;

/** A row. A function that is NULL has nothing to do. `self` is what `create` made. `measure` and
 * `share` see a whole moment, `add` all of it but q and p; others `with` and what they name. */
typedef struct hd_observable {
    unsigned with;                   /**< the observables that it needs, a set of HD_OBSERVE_* */
    unsigned needs;                  /**< set of HD_NEEDS_* */
    const hd_quantities *quantities; /**< quantities that a target can name; NULL: none */
    /** Bytes that it takes on each of `ranks` ranks, a few percent too many rather than too few. */
    double (*bytes)(const hd_scene_def *scene, int ranks);
    /** Adds the numbers of its results to *extent. `self` is NULL if a run does not have it. */
    void (*extend)(hd_result_counts *extent, const hd_scene_def *scene, const void *self);
    /** Returns HD_OK, or HD_REFUSED with a line that says why it cannot be computed in this scene.
     */
    hd_status (*check)(const hd_scene_def *scene, char *message, size_t size);
    /** Makes it; the caller frees what is returned, whatever *status is. Fails with HD_NO_MEMORY.
     */
    void *(*create)(const hd_observing *with, hd_status *status);
    void (*free)(void *self);
    /** Its averages begin here; now->trajectory. */
    void (*clear)(void *self, const hd_moment *now);
    /** It was not computed for a while, as nobody listened, and is from now on: what needs samples
     * without a gap begins again. */
    void (*resume)(void *self, const hd_moment *now);
    /** Take a snapshot of the vectors that this rank carries; give all ranks what each has
     * measured. */
    hd_status (*measure)(void *self, const hd_moment *now);
    hd_status (*share)(void *self, const hd_moment *now);
    /** The next time at which it glances at the particles, however intervals end; INFINITY: never.
     */
    double (*next)(const void *self);
    /** Glances at them, at that time. Fails as hd_trajectory_measure. */
    hd_status (*glance)(void *self, hd_trajectory *trajectory);
    /** Adds the snapshot to its averages. */
    void (*add)(void *self, const hd_moment *now);
    /** Called at a report at which the vectors are known; now->vectors[0] are those of all ranks
     * that can be read, with now->trajectory, q and p. */
    void (*report)(void *self, const hd_moment *now);
    /** The first vector of those of all ranks that `report` reads; if NULL, none. */
    int (*first)(void *self, const hd_moment *now);
    /** Longest time from one measured state to the next that a scene asks for; INFINITY: any. If
     * NULL, any. */
    double (*apart)(const hd_scene_def *scene);
    /** Longest time from this measured state to the next that it allows; INFINITY if it allows any.
     */
    double (*sampling)(void *self, const hd_moment *now);
    /** Reads or writes it; now->archive, now->trajectory. */
    void (*archive)(void *self, const hd_moment *now);
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

/** True if the scene asks for this observable, or for one that needs it (asked.c). If the scene
 * asks for no exponents, only observables of particles alone count. */
bool hd_observable_is_asked(hd_observed row, const hd_scene_def *scene);

#endif
