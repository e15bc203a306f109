/** All that a run observes. */
#ifndef HD_OBSERVABLES_H
#define HD_OBSERVABLES_H

#include "observe/observable.h"

/** The fields are observables.c's; seconds are kept by checkpoint.c. */
typedef struct hd_observables {
    hd_observing with;
    void *part[HD_OBSERVED]; /**< NULL: not asked for */
    unsigned looked_at;      /**< set of HD_OBSERVE_* */
    unsigned seen;           /**< and those that come with these */
    double seconds;          /**< wall seconds in those that follow intervals */
    double *q, *p;           /**< positions and momenta; NULL unless HD_NEEDS_STATE is asked for */
} hd_observables;

/* Of a scene (asked.c): */

/** A set of HD_OBSERVE_*, and those that come with these. */
unsigned hd_observables_with(unsigned set);
/** Without those that take longer than a trial. */
unsigned hd_observables_tried(unsigned set);
/** True if the scene asks for this one, or for what it comes with: without exponents, of the disks
 * alone. */
bool hd_observable_is_asked(hd_observed row, const hd_scene_def *scene);
/** True if it asks for one that has all of these needs (set of HD_NEEDS_*). */
bool hd_observables_asked(const hd_scene_def *scene, unsigned needs);
/** Bytes of what it asks for, on each of so many ranks. */
double hd_observables_bytes(const hd_scene_def *scene, int ranks);
/** See hd_extent_of; part: of a run. */
hd_extent hd_observables_extent(const hd_scene_def *scene, void *const *part);
/** HD_REFUSED with a line, of a scene that hd_scene_check has passed: what so many ranks cannot do,
 * and what intervals that may become so long leave no room for. */
HD_MUST_CHECK hd_status hd_observables_check_ranks(const hd_scene_def *scene, int ranks,
                                                   char *message, size_t size);
HD_MUST_CHECK hd_status hd_observables_check_longest(const hd_scene_def *scene, double longest,
                                                     char *message, size_t size);

/** What the scene asks for. Ranks agree. Fails as hd_observables_check_longest and as its rows. */
HD_MUST_CHECK hd_status hd_observables_create(hd_observables *observables, const hd_observing *with,
                                              char *message, size_t size);
void hd_observables_free(hd_observables *observables);

/** What a row's observable is; NULL unless asked for. */
void *hd_observables_part(const hd_observables *observables, hd_observed row);
/** What hd_run_parts gives of it. */
void *hd_observables_result(const hd_observables *observables, hd_observed row);

/** Which of them somebody looks at from now on (set of HD_OBSERVE_*); at first all. */
void hd_observables_look(hd_observables *observables, unsigned stages);
unsigned hd_observables_looked_at(const hd_observables *observables);

/* Of those that somebody looks at: */

bool hd_observables_any(const hd_observables *observables);
/** True if one has all of these needs (set of HD_NEEDS_*). */
bool hd_observables_need(const hd_observables *observables, unsigned needs);
/** First of the vectors that are read of all ranks; n if none are. */
int hd_observables_first(const hd_observables *observables);
/** Longest time from this measured state to the next, for those that follow something; INFINITY
 * without one. */
double hd_observables_sampling(const hd_observables *observables);
/** Takes a snapshot, of all ranks. What one rank cannot do, none does. */
HD_MUST_CHECK hd_status hd_observables_measure(hd_observables *observables, const hd_view *state);
/** The averages take up the snapshot of this state. */
void hd_observables_add(hd_observables *observables, const hd_view *state);
/** At a report; state->vectors[0] are the vectors that can be read, of all ranks. */
void hd_observables_report(hd_observables *observables, const hd_view *state);

/** Tells an interval to those that follow it. */
HD_MUST_CHECK hd_status hd_observables_follow(hd_observables *observables, const hd_leg *leg);
/** True if one begins to with the next interval. */
bool hd_observables_begin(const hd_observables *observables);
/** The first simulated time after now at which an interval shall end for one of them; INFINITY. */
double hd_observables_due(const hd_observables *observables, double now);
/** True while one has something to do before the run may go on. */
bool hd_observables_are_behind(const hd_observables *observables);
/** Goes on with it for a fraction of a second, or to its end. */
HD_MUST_CHECK hd_status hd_observables_catch_up(hd_observables *observables, bool to_its_end);
/** Wall seconds spent in these. */
double hd_observables_seconds(const hd_observables *observables);

/** The averages of all of them begin here. */
void hd_observables_clear(hd_observables *observables, const hd_view *here);

/** Arrays of those that need a frame, or of those that do not. */
void hd_observables_archive(hd_observables *observables, hd_archive *archive, bool of_frame,
                            const hd_trajectory *now);

#endif
