/** Panels side by side, or above each other where the box is long. */
#include "layout.h"

#include <math.h>

/** In units of the text's height. */
static const double WIDTH_UNITS = 64.0, GAP = 3.0, TITLE = 3.5, CAPTION = 3.5;
static const double ARROW = 2.6; /* the longest, in mean distances of disks */
static const double LONG = 2.5;  /* boxes this much longer than high lie above each other */
static const double RISE = 0.7;  /* of what is above the plane, as seen from 55 degrees */

/** Of a box of spheres that is seen from above and from the front, as rviz's view begins: its
 * height on the screen, as of something flat. */
static double height_of(const heard *h) { return h->box[1] + RISE * h->box[2]; }

static double distance_of(const heard *h)
{
    return heard_has_spheres(h) ? cbrt(h->box[0] * h->box[1] * h->box[2] / h->disks)
                                : sqrt(h->box[0] * h->box[1] / h->disks);
}

/** Columns of a grid of panels that is not much higher than wide. */
static int columns_of(const heard *h, int panels)
{
    const double shape = h->box[0] / height_of(h);
    if (shape > LONG) return 1;
    const int columns = (int)ceil(sqrt(1.5 * panels / shape));
    return columns < panels ? columns : panels;
}

static double grid_width(const heard *h, const layout *l, int columns, double unit)
{
    return columns * h->box[0] + (columns - 1) * (GAP * unit + l->arrow);
}

/** Left to right, then downwards; panel 0 at the origin. */
static void place_panels(layout *l, const heard *h, int columns)
{
    for (int k = 0; k < l->panels; k++)
        l->panel[k] = (rect){
            .x = k % columns * (h->box[0] + GAP * l->unit + l->arrow),
            .y = -(k / columns) * (height_of(h) + TITLE * l->unit + l->arrow),
            .width = h->box[0],
            .height = h->box[1],
        };
}

layout layout_of(const picture *p)
{
    const heard *h = p->run;
    const double distance = distance_of(h);
    layout l = {
        .panels = p->modes > 0 ? p->modes : 1, .distance = distance, .arrow = ARROW * distance};
    const int columns = columns_of(h, l.panels);
    const double least = fmax(grid_width(h, &l, columns, 0.0), 0.8 * height_of(h));
    l.unit = least / (WIDTH_UNITS - (columns - 1) * GAP);
    place_panels(&l, h, columns);
    l.caption_x = 0.5 * grid_width(h, &l, columns, l.unit);
    l.caption_y = h->box[1] + 0.5 * l.arrow + (TITLE + 0.5 * CAPTION) * l.unit;
    return l;
}
