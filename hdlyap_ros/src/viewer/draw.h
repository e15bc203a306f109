/** A picture -> the markers that show it. */
#ifndef HDLYAP_DRAW_H
#define HDLYAP_DRAW_H

#include "canvas.h"
#include "picture.h"

/** Fills the markers of a picture, in the frame of the box. They are valid until the canvas is
 * drawn on again. Check boxes (namespaces) are box, disks, spheres or dumbbells, mode/<name>,
 * phases and caption. Returns false if there is not enough memory. */
bool draw(canvas *on, hdr_markers *out, const picture *p, const char *frame_id);

#endif
