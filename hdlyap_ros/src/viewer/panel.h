/** One panel of a picture: the box, its disks, and the vector field of a mode. */
#ifndef HDLYAP_PANEL_H
#define HDLYAP_PANEL_H

#include "canvas.h"
#include "layout.h"

/** Outlines of all panels, and the disks in them, in one layer each. */
void panel_boxes(canvas *on, const layout *l, const picture *p);
void panel_disks(canvas *on, const layout *l, const picture *p);

/** Arrows of mode k, its title, and of an LP mode its phases: its name's check box. */
void panel_mode(canvas *on, const layout *l, const picture *p, int k);

#endif
