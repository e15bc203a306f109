/** What was heard of a run, and which modes are asked for -> a picture. */
#ifndef HDLYAP_COMPOSE_H
#define HDLYAP_COMPOSE_H

#include "picture.h"

/** A mode by its name. */
typedef struct mode_name {
    uint8_t kind;        /**< HDR_MODE_T or HDR_MODE_LP */
    uint32_t nx, ny, nz; /**< nz is 0 of disks */
} mode_name;

typedef struct mode_choice {
    mode_name mode[PICTURE_MODES_MAX];
    int count; /**< 0: the lowest step of each kind */
} mode_choice;

/** T(nx,ny), LP(nx,ny), or with three numbers, and nothing else; false otherwise. */
bool mode_name_parse(mode_name *out, const char *text);

/** Of a run that has begun; note: as in the picture. Points into what was heard. */
picture compose(const heard *h, const mode_choice *asked, const char *note);

#endif
