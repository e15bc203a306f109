/** Where the parts of a picture lie, in the frame of the box [sigma]: the first panel is the box
 * itself. */
#ifndef HDLYAP_LAYOUT_H
#define HDLYAP_LAYOUT_H

#include "picture.h"

typedef struct rect {
    double x, y, width, height; /**< lower left corner, size */
} rect;

typedef struct layout {
    double unit;     /**< height of text */
    double distance; /**< of neighbouring disks, about */
    double
        arrow; /**< length of the longest; half of it may stand out of a panel, where no text is */
    rect panel[PICTURE_MODES_MAX];
    int panels;                  /**< one per mode, at least one */
    double caption_x, caption_y; /**< middle of the caption's text */
} layout;

layout layout_of(const picture *p);

#endif
