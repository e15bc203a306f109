/** All observables of a run. */
#ifndef HD_OBSERVABLES_H
#define HD_OBSERVABLES_H

#include "observe/windows.h"

/** Only observables.c changes the members. */
typedef struct hd_observables {
    hd_observing with;
    void *part[HD_OBSERVED]; /**< NULL: not asked for */
    unsigned looked_at;      /**< set of HD_OBSERVE_* that somebody listens to */
    unsigned seen;           /**< these and the observables that they need */
    double *q, *p;           /**< positions and momenta; NULL unless HD_NEEDS_STATE is asked for */
} hd_observables;

/* For a scene (asked.c): */

/** The set, with the observables that it needs. */
unsigned hd_observables_with(unsigned set);
/** True if the scene asks for an observable that has all of these needs (set of HD_NEEDS_*). */
bool hd_observables_asked(const hd_scene_def *scene, unsigned needs);
/** Bytes of the observables that the scene asks for, on each of `ranks` ranks. */
double hd_observables_bytes(const hd_scene_def *scene, int ranks);
/** See hd_result_counts_of; part[HD_OBSERVED] are the observables of a run. */
hd_result_counts hd_observables_extent(const hd_scene_def *scene, void *const *part);

/** Longest time from one measured state to the next that the observables of a set allow in a scene,
 * with its reports and its own intervals; INFINITY: any. */
double hd_observables_apart(const hd_scene_def *scene, unsigned set);

/** Creates the observables that the scene asks for. Ranks agree. Fails as the rows do. */
HD_MUST_CHECK hd_status hd_observables_create(hd_observables *observables,
                                              const hd_observing *with);
void hd_observables_free(hd_observables *observables);

/** The observable of a row; NULL if the scene does not ask for it. */
void *hd_observables_part(const hd_observables *observables, hd_observed row);
/** The windows of covariant vectors; NULL if nobody listens to them. */
hd_windows *hd_observables_windows(const hd_observables *observables);

/** Sets which observables somebody listens to from now on (set of HD_OBSERVE_*); at first all. */
void hd_observables_look(hd_observables *observables, unsigned stages);

/* For the observables that somebody listens to. Moments that are passed lack `with`, q and p. */

/** True if one has all of these needs (set of HD_NEEDS_*); 0: if there is any. */
bool hd_observables_need(const hd_observables *observables, unsigned needs);
/** The first vector that is read from all ranks; n if none is. */
int hd_observables_first(const hd_observables *observables);
/** Longest time from this measured state to the next that all of them allow; INFINITY if they allow
 * any. */
double hd_observables_sampling(const hd_observables *observables);
/** Takes a snapshot on all ranks; if one rank fails, all do. add: and adds it to the averages. */
HD_MUST_CHECK hd_status hd_observables_measure(hd_observables *observables, hd_moment now,
                                               bool add);
/** The next time at which one glances at the particles; INFINITY: none does. */
double hd_observables_next(const hd_observables *observables);
/** Those whose time this is, which the trajectory has reached but for rounding, glance at the
 * particles. Fails as they do. */
HD_MUST_CHECK hd_status hd_observables_glance(hd_observables *observables,
                                              hd_trajectory *trajectory, double now);
/** Called at a report; now.vectors[0] are the vectors of all ranks that can be read. */
void hd_observables_report(hd_observables *observables, hd_moment now);

/** The averages of all of them begin here. */
void hd_observables_clear(hd_observables *observables, hd_moment now);

/** Reads or writes the observables that need a frame, or those that do not. */
void hd_observables_archive(hd_observables *observables, hd_archive *archive, bool of_frame,
                            const hd_trajectory *trajectory);

#endif
