/** Time between orthonormalisations: what limits it [T6]. */
#ifndef HDLYAP_INTERVAL_H
#define HDLYAP_INTERVAL_H

/** Why an interval between orthonormalisations is not longer. */
typedef enum hd_limit {
    HD_LIMIT_SCHEDULE,  /**< a sample ends: the next one would not fit whole between reports */
    HD_LIMIT_CONDITION, /**< rounding would exceed the accuracy asked for */
    HD_LIMIT_GROWTH,    /**< twice the one before: the conditioning is still being learnt */
    HD_LIMIT_OVERFLOW,  /**< vectors would outgrow their numbers */
    HD_LIMIT_SCENE,     /**< hd_scene_def.interval */
    HD_LIMIT_EVENTS, /**< the log of events would take too much memory, or the wait for an answer */
    HD_LIMIT_LOOK,   /**< vectors were wanted for a report */
    HD_LIMIT_REPAIR  /**< it was longer, and had to be taken back */
} hd_limit;

#endif
