/** The simulated time between two orthonormalisations, and what limits it [T6]. [T6] is the tag of
 * an equation in THEORY.md. */
#ifndef HDLYAP_INTERVAL_H
#define HDLYAP_INTERVAL_H

/** Why an interval between two orthonormalisations was not longer. */
typedef enum hd_limit {
    /** It ended as planned: at the first report of the averaging, at a report for which an
     * observable needs all vectors, or at a sample of covariant vectors. */
    HD_LIMIT_SCHEDULE,
    HD_LIMIT_CONDITION, /**< rounding would have made the error of exponents larger than
                           hd_scene_def.accuracy */
    HD_LIMIT_GROWTH, /**< it was already twice as long as the one before; how fast rounding grows is
                        still being learnt */
    HD_LIMIT_OVERFLOW, /**< components of vectors would have become too large for a double */
    HD_LIMIT_SCENE,    /**< it was as long as hd_scene_def.interval allows */
    HD_LIMIT_EVENTS, /**< the record would have taken too much memory, or hd_run_advance too long */
    /** It was cut short: phases, fluctuations or a viewer (hd_run_measure) needed the vectors, or a
     * report did for which this was not planned, as one that reaches the target. */
    HD_LIMIT_LOOK,
    HD_LIMIT_REPAIR, /**< a longer interval lost too much accuracy, so that it was repeated in
                        pieces */
    HD_LIMIT_STAGE,  /**< warm-up or averaging ended */
    /** A sample of the averages ended. It lasts about 80 collisions of each particle or 1/32 of the
     * duration, less while little has been averaged; in short runs it lasts longer than that. */
    HD_LIMIT_SAMPLE,
    HD_LIMIT_NONE /**< there was no interval yet */
} hd_limit;

#endif
