/** A picture -> the markers that show it. */
#ifndef HDLYAP_DRAW_H
#define HDLYAP_DRAW_H

#include "canvas.h"
#include "picture.h"

/** The markers, in the frame of the box; valid until the canvas is drawn on again. Check boxes
 * (namespaces): box, disks, spheres or dumbbells, mode/<name>, phases, caption. False if
 * memory ran out. */
bool draw(canvas *on, hdr_markers *out, const picture *p, const char *frame_id);

#endif
