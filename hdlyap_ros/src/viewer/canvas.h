/** Points and texts -> markers. A layer is one marker; a check box of rviz has few layers. */
#ifndef HDLYAP_CANVAS_H
#define HDLYAP_CANVAS_H

#include <stdbool.h>

#include "hdlyap_ros/markers.h"

typedef struct canvas canvas;

/** Returns false if there is no memory. */
bool canvas_create(canvas **out);
void canvas_free(canvas *c);

/** Begins a new picture. */
void canvas_clear(canvas *c);

/** Begins a layer: a marker of a list type, to which the points that follow belong. ns: its check
 * box, at most 31 characters; thickness: of lines, or diameter of spheres [sigma]. */
void canvas_layer(canvas *c, const char *ns, int type, hdr_colour colour, double thickness);
/** Gives each point of the layer the layer's colour. rviz shades triangles whose points have no
 * colours, and shows them black from their dark side. */
void canvas_unlit(canvas *c);
void canvas_point(canvas *c, hdr_point at);

/** Adds a layer with a text around a place; format as for printf. */
#if defined(__GNUC__)
__attribute__((format(printf, 6, 7)))
#endif
void canvas_text(canvas *c, const char *ns, hdr_point at, double height, hdr_colour colour,
                 const char *format, ...);

/** Fills the markers of the picture, which replaces the one before. They are valid until the canvas
 * changes. Returns false if there was not enough memory or room; the picture must not be shown
 * then. */
bool canvas_markers(canvas *c, hdr_markers *out, const char *frame_id);

#endif
