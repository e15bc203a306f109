/** What a picture is made of: the run's numbers as the messages have them. Who draws it knows no
 * run. */
#ifndef HDLYAP_PICTURE_H
#define HDLYAP_PICTURE_H

#include <stdbool.h>

#include "common/nodes.h"
#include "hdlyap_ros/messages.h"

enum { PICTURE_MODES_MAX = 8, PICTURE_PAIRS_MAX = 8 };
enum { PICTURE_NAME_SIZE = NODES_SIZE + 8 };

/** One mode that is to be seen, in a panel of its own. */
typedef struct picture_mode {
    /** Name of its check box, the same in all pictures: T(1,0), or lowest T. */
    char box[PICTURE_NAME_SIZE];
    /** E.g. T(1,0); or of what is looked for, e.g. T. */
    char name[PICTURE_NAME_SIZE];
    uint8_t kind;           /**< HDR_MODE_T or HDR_MODE_LP */
    bool absent;            /**< it was asked for, and the run has no such step */
    bool found;             /**< its step is resolved; else nothing of the rest is known */
    uint32_t index;         /**< Lyapunov index of its vector, from 1 */
    double exponent;        /**< of its step, or else of the vector [1/time unit] */
    double error;           /**< of it; -1 while not known */
    bool known;             /**< the vector; else nothing of the rest is */
    hdr_doubles dx, dy, dz; /**< [N] dq half of the vector; dz is empty of disks, as all of z */
    uint32_t pairs;         /**< of an LP mode, at the time of the picture if that is known */
    double a[PICTURE_PAIRS_MAX], b[PICTURE_PAIRS_MAX]; /**< as in LpPhase */
    double momentum; /**< part of the vector in the P fields, 0 .. 1; -1 if not known */
} picture_mode;

typedef struct picture {
    const char *scene, *stage; /**< names */
    uint32_t disks;            /**< 1 or more */
    double box[3];             /**< [sigma]; 0 along z of disks, spheres otherwise */
    bool periodic[3];
    bool round;                   /**< the wall is a circle, which the box holds */
    double time;                  /**< [time units]; -1 before the first message */
    double progress;              /**< 0 .. 1; negative if unknown */
    const char *note;             /**< why it may not be what is now; "" otherwise */
    hdr_doubles x, y, z;          /**< [N] positions [sigma]; count 0 while there are none */
    double vector_time;           /**< of the vectors of all modes */
    hdr_doubles at_x, at_y, at_z; /**< [N] positions at that time */
    picture_mode mode[PICTURE_MODES_MAX];
    int modes;
} picture;

static inline bool picture_has_spheres(const picture *p) { return p->box[2] > 0.0; }

#endif
