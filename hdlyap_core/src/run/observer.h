/** What a run that observes its modes needs for it. */
#ifndef HD_OBSERVER_H
#define HD_OBSERVER_H

#include "hdlyap/phases.h"
#include "hdlyap/structure.h"
#include "hdlyap/trajectory.h"

/** Kinds of steps whose phases can be followed. */
enum { HD_FOLLOWED_LP, HD_FOLLOWED_T, HD_FOLLOWED };

/** Any of them. */
enum { HD_OBSERVE_OF_PHASES = HD_OBSERVE_PHASES | HD_OBSERVE_T_PHASES };
/** HD_OBSERVE_* of each. */
extern const unsigned hd_observer_stage[HD_FOLLOWED];

typedef struct hd_observer {
    hd_modes *modes; /**< NULL unless observed, as all others */
    hd_steps *steps;
    hd_structure *structure;        /**< NULL unless asked for */
    hd_phases *phases[HD_FOLLOWED]; /**< NULL unless they are observed */
    double *q, *p;                  /**< [2N], state of a snapshot */
    hd_columns known;               /**< vectors that are known at this very time */
} hd_observer;

/** HD_NO_MEMORY. */
HD_MUST_CHECK hd_status hd_observer_create(hd_observer *observer, const hd_scene_def *scene,
                                           int vectors, int threads);
void hd_observer_free(hd_observer *observer);

/** Empties the averages. */
void hd_observer_clear(hd_observer *observer);

/* Of the phases that are in a set of HD_OBSERVE_*: */

/** Follows them to the snapshot at this time. */
void hd_observer_follow(hd_observer *observer, unsigned stages, double time);
/** They begin anew. */
void hd_observer_forget_phases(hd_observer *observer, unsigned stages);
/** Longest time to the next sample; INFINITY if none. */
double hd_observer_sampling(const hd_observer *observer, unsigned stages);

/** The modes, and of these stages the structure factors, of orthonormal vectors. Fails as
 * hd_modes_measure. */
HD_MUST_CHECK hd_status hd_observer_measure(hd_observer *observer, unsigned stages,
                                            hd_columns vectors, const hd_trajectory *trajectory);
/** Of vectors of several ranks. Fails as hd_modes_share. */
HD_MUST_CHECK hd_status hd_observer_share(hd_observer *observer, unsigned stages,
                                          hd_communicator *communicator, int width, int carried);
/** Adds what has been measured to the averages. */
void hd_observer_add(hd_observer *observer, unsigned stages);

#endif
