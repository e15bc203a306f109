/** What a picture is made of: the run's numbers as the messages have them. Who draws it knows no
 * run. */
#ifndef HDLYAP_PICTURE_H
#define HDLYAP_PICTURE_H

#include <stdbool.h>

#include "hdlyap_ros/messages.h"

enum { PICTURE_MODES_MAX = 8, PICTURE_PAIRS_MAX = 4 };

/** One mode that is to be seen, in a panel of its own. */
typedef struct picture_mode {
    char name[24];      /**< e.g. T(1,0); or of what is looked for, e.g. T */
    uint8_t kind;       /**< HDR_MODE_T or HDR_MODE_LP */
    bool found;         /**< its step is resolved; else nothing of the rest is known */
    uint32_t index;     /**< Lyapunov index of its vector, from 1 */
    double exponent;    /**< of it [1/time unit] */
    bool known;         /**< the vector, at this very time; else nothing of the rest is */
    hdr_doubles dx, dy; /**< [N] dq half of the vector */
    uint32_t pairs;     /**< of an LP mode */
    double a[PICTURE_PAIRS_MAX], b[PICTURE_PAIRS_MAX]; /**< as in LpPhase */
} picture_mode;

typedef struct picture {
    const char *scene, *stage; /**< names */
    double box[2];             /**< [sigma] */
    bool periodic[2];
    double time, averaged;  /**< [time units] */
    double progress;        /**< 0 .. 1; negative if unknown */
    hdr_doubles x, y;       /**< [N] positions [sigma] */
    bool has_exponents;     /**< now or later */
    hdr_doubles exponents;  /**< of index 1, 2 ..; count 0 while there are none */
    const hdr_steps *steps; /**< NULL unless they are observed */
    picture_mode mode[PICTURE_MODES_MAX];
    int modes;
} picture;

#endif
