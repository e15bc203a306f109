/** The simulated time between two orthonormalisations, and what limits it [T6]. */
#ifndef HDLYAP_INTERVAL_H
#define HDLYAP_INTERVAL_H

/** Why an interval between orthonormalisations was not longer. */
typedef enum hd_limit {
    HD_LIMIT_SCHEDULE,  /**< it ended at a report that needs all vectors, or at the first report */
    HD_LIMIT_CONDITION, /**< rounding would have exceeded the accuracy */
    HD_LIMIT_GROWTH,    /**< twice the previous interval, while the conditioning is learnt */
    HD_LIMIT_OVERFLOW,  /**< vectors would have exceeded the range of numbers */
    HD_LIMIT_SCENE,     /**< hd_scene_def.interval */
    HD_LIMIT_EVENTS,    /**< the record would have taken too much memory, or the call too long */
    HD_LIMIT_LOOK,      /**< a report, a viewer or the phases needed the vectors */
    HD_LIMIT_REPAIR,    /**< a longer interval lost too much accuracy and was repeated in pieces */
    HD_LIMIT_STAGE,     /**< warm-up or averaging ended */
    HD_LIMIT_SAMPLE,    /**< a sample for standard errors ended, after about 80 collisions of each
                             particle or 1/32 of the duration */
    HD_LIMIT_NONE       /**< there was no interval yet */
} hd_limit;

#endif
