/** Time between orthonormalisations: what limits it [T6]. */
#ifndef HDLYAP_INTERVAL_H
#define HDLYAP_INTERVAL_H

/** Why an interval between orthonormalisations is not longer. */
typedef enum hd_limit {
    /** Intervals end with reports, or fit a whole number of times between two: a quarter more would
     * be allowed otherwise */
    HD_LIMIT_SCHEDULE,
    HD_LIMIT_CONDITION, /**< rounding would exceed the accuracy asked for */
    HD_LIMIT_GROWTH,    /**< twice the one before: the conditioning is still being learnt */
    HD_LIMIT_OVERFLOW,  /**< vectors would outgrow their numbers */
    HD_LIMIT_SCENE,     /**< hd_scene_def.interval */
    HD_LIMIT_EVENTS, /**< the log of events would take too much memory, or the wait for an answer */
    HD_LIMIT_LOOK,   /**< vectors were wanted for a report */
    HD_LIMIT_REPAIR, /**< it was longer, and had to be taken back */
    HD_LIMIT_STAGE,  /**< warm-up or averaging ends */
    /** A sample for standard errors ends: at most 64 collisions of each disk, and 1/32 of the
     * duration */
    HD_LIMIT_SAMPLE,
    HD_LIMIT_NONE /**< there was no interval yet */
} hd_limit;

#endif
