/** What a picture is made of: what was heard of a run, and the modes that are to be seen. */
#ifndef HDLYAP_PICTURE_H
#define HDLYAP_PICTURE_H

#include "common/nodes.h"
#include "heard.h"

enum { PICTURE_MODES_MAX = 8 };
enum { PICTURE_NAME_SIZE = NODES_SIZE + 8 };

/** A mode by its name. */
typedef struct mode_name {
    uint8_t kind;        /**< HDR_MODE_T or HDR_MODE_LP */
    uint32_t nx, ny, nz; /**< nz is 0 of disks */
} mode_name;

typedef struct mode_choice {
    mode_name mode[PICTURE_MODES_MAX];
    int count; /**< 0: the lowest step of each kind */
} mode_choice;

/** One mode that is to be seen, in a panel of its own. */
typedef struct picture_mode {
    /** Name of its check box, the same in all pictures: T(1,0), or lowest T. */
    char box[PICTURE_NAME_SIZE];
    /** E.g. T(1,0); or of what is looked for, e.g. T. */
    char name[PICTURE_NAME_SIZE];
    uint8_t kind;       /**< HDR_MODE_T or HDR_MODE_LP */
    bool absent;        /**< it was asked for, and the run has no such step */
    bool found;         /**< its step is resolved; else nothing of the rest is known */
    uint32_t index;     /**< Lyapunov index of its vector, from 1 */
    double exponent;    /**< of its step, or else of the vector [1/time unit] */
    double error;       /**< of it; -1 while not known */
    const hdr_point *d; /**< [N] dq half of the vector; NULL: not known, nor the rest */
    const double *turn; /**< [N] of what turns: its part in the angles */
    heard_lp lp;        /**< of an LP mode, at the time of the picture if that is known */
    double momentum;    /**< part of the vector in the P fields, 0 .. 1; -1 if not known */
} picture_mode;

typedef struct picture {
    const heard *run;
    const char *note; /**< why it may not be what is now; "" otherwise */
    picture_mode mode[PICTURE_MODES_MAX];
    int modes;
} picture;

/** T(nx,ny), LP(nx,ny), or with three numbers, and nothing else; false otherwise. */
bool mode_name_parse(mode_name *out, const char *text);

/** Of a run that has begun. Points into what was heard. */
picture picture_of(const heard *h, const mode_choice *asked, const char *note);

#endif
