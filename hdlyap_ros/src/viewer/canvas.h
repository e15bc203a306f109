/** Points and texts -> markers: one list per layer, few layers per check box. */
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

/** The points that follow are of one marker of a list type; ns: at most 31 characters; thickness of
 * lines, or diameter [sigma]. */
void canvas_layer(canvas *c, const char *ns, int type, hdr_colour colour, double thickness);
/** Each point of the layer has the layer's colour as its own: rviz sheds light on triangles
 * without, which turns those black that are seen from their dark side. */
void canvas_unlit(canvas *c);
void canvas_point(canvas *c, hdr_point at);

/** A text round a place, in a marker of its own; format as for printf. */
#if defined(__GNUC__)
__attribute__((format(printf, 6, 7)))
#endif
void canvas_text(canvas *c, const char *ns, hdr_point at, double height, hdr_colour colour,
                 const char *format, ...);

/** The picture, in place of the one before. Valid until the next change. False if memory or room
 * ran out: then it is not to be shown. */
bool canvas_markers(canvas *c, hdr_markers *out, const char *frame_id);

#endif
