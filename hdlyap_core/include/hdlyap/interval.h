/** Time between orthonormalisations: what limits it [T6]. */
#ifndef HDLYAP_INTERVAL_H
#define HDLYAP_INTERVAL_H

/** Why an interval between orthonormalisations is not longer. */
typedef enum hd_limit {
    HD_LIMIT_SCHEDULE,  /**< it ends with a report that needs all vectors, the first one of all, too
                         */
    HD_LIMIT_CONDITION, /**< rounding would exceed the accuracy asked for */
    HD_LIMIT_GROWTH,    /**< twice the one before: the conditioning is still being learnt */
    HD_LIMIT_OVERFLOW,  /**< vectors would outgrow their numbers */
    HD_LIMIT_SCENE,     /**< hd_scene_def.interval */
    HD_LIMIT_EVENTS, /**< the log of events would take too much memory, or the wait for an answer */
    HD_LIMIT_LOOK,   /**< vectors were wanted: for a report, a viewer, or the phases */
    HD_LIMIT_REPAIR, /**< it was longer, and had to be taken back */
    HD_LIMIT_STAGE,  /**< warm-up or averaging ends */
    /** A sample for standard errors ends: about 80 collisions of each disk, at most 1/32 of the
     * duration */
    HD_LIMIT_SAMPLE,
    HD_LIMIT_NONE /**< there was no interval yet */
} hd_limit;

#endif
