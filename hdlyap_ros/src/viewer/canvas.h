/** Points and texts -> markers: one list per layer, few layers per check box, stable ids. */
#ifndef HDLYAP_CANVAS_H
#define HDLYAP_CANVAS_H

#include <stdbool.h>

#include "hdlyap_ros/markers.h"

typedef struct canvas canvas;

/** False without memory. */
bool canvas_create(canvas **out);
void canvas_free(canvas *c);

/** Begins a picture. */
void canvas_clear(canvas *c);

/** Lines and texts that follow lie so high; 0 at the beginning. */
void canvas_level(canvas *c, double z);

/** The points that follow are of one marker of a list type; ns: at most 31 characters; thickness of
 * lines, or diameter [sigma]. */
void canvas_layer(canvas *c, const char *ns, int type, hdr_colour colour, double thickness);
/** Each point of the layer has the layer's colour as its own: rviz sheds light on triangles
 * without, which turns those black that are seen from their dark side. */
void canvas_unlit(canvas *c);
void canvas_point(canvas *c, double x, double y, double z);
void canvas_line(canvas *c, double x0, double y0, double x1, double y1);

/** A text round (x, y), in a marker of its own; format as for printf. */
#if defined(__GNUC__)
__attribute__((format(printf, 7, 8)))
#endif
void canvas_text(canvas *c, const char *ns, double x, double y, double height, hdr_colour colour,
                 const char *format, ...);

/** The picture: its markers, and the deletion of what was in one before and is not in it. Valid
 * until the next change. False if memory or room ran out: then it is not to be shown. */
bool canvas_markers(canvas *c, hdr_markers *out, const char *frame_id);

#endif
