/** A picture -> the markers that show it. */
#ifndef HDLYAP_VIEW_H
#define HDLYAP_VIEW_H

#include <stdbool.h>

#include "hdlyap_ros/markers.h"
#include "picture.h"

typedef struct view view;

/** False without memory. */
bool view_create(view **out);
void view_free(view *v);

/** The markers, in the frame of the box; valid until the next call. Check boxes (namespaces): box,
 * disks, mode/<name>, phases, spectrum, dispersion, text. False if memory ran out. */
bool view_draw(view *v, hdr_markers *out, const picture *p, const char *frame_id);

#endif
