/** A picture: the last messages of a run, and the modes to be drawn. */
#ifndef HDLYAP_PICTURE_H
#define HDLYAP_PICTURE_H

#include "common/nodes.h"
#include "heard.h"

enum { PICTURE_MODES_MAX = 8 };
enum { PICTURE_NAME_SIZE = NODES_SIZE + 8 };

/** The name of a mode. */
typedef struct mode_name {
    uint8_t kind;        /**< HDR_MODE_T or HDR_MODE_LP */
    uint32_t nx, ny, nz; /**< nz is 0 in the plane */
} mode_name;

typedef struct mode_choice {
    mode_name mode[PICTURE_MODES_MAX];
    int count; /**< 0: the lowest step of each kind */
} mode_choice;

/** A mode to be drawn in one panel. */
typedef struct picture_mode {
    /** Name of its check box, the same in all pictures: T(1,0), or lowest T. */
    char box[PICTURE_NAME_SIZE];
    /** Its title, e.g. T(1,0); only the kind if its wave is not known yet. */
    char name[PICTURE_NAME_SIZE];
    uint8_t kind;       /**< HDR_MODE_T or HDR_MODE_LP */
    bool absent;        /**< the user wants it, but the run does not classify it */
    bool found;         /**< its step is resolved; otherwise nothing below is known */
    uint32_t index;     /**< Lyapunov index of its vector, from 1 */
    double exponent;    /**< exponent of its step, otherwise of the vector [1/time unit] */
    double error;       /**< standard error of exponent; -1 if not known */
    const hdr_point *d; /**< [N] displacements by the vector; NULL: nothing from here on is known */
    const double *turn; /**< [N] part of the vector in the angles of particles that rotate */
    heard_lp lp;        /**< coefficients of an LP mode, at the time of the picture if known */
    double momentum;    /**< part of the vector in the P fields, 0 .. 1; -1 if not known */
} picture_mode;

typedef struct picture {
    const heard *run;
    const char *note; /**< says that the picture may be old; "" otherwise */
    picture_mode mode[PICTURE_MODES_MAX];
    int modes;
} picture;

/** Reads T(nx,ny) or LP(nx,ny), or a name with three numbers. Returns false for any other text. */
bool mode_name_parse(mode_name *out, const char *text);

/** The picture of a run that has begun. It points to data in h. */
picture picture_of(const heard *h, const mode_choice *asked, const char *note);

#endif
