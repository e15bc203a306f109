/** A picture -> the markers that show it. */
#include "draw.h"

#include "curves.h"
#include "panel.h"

bool draw(canvas *on, hdr_markers *out, const picture *p, const char *frame_id)
{
    const layout l = layout_of(p);
    canvas_clear(on);
    panel_boxes(on, &l, p);
    panel_disks(on, &l, p);
    for (int k = 0; k < p->modes; k++) panel_mode(on, &l, p, k);
    if (p->has_exponents) curves_spectrum(on, &l, p);
    if (p->steps) curves_dispersion(on, &l, p);
    canvas_level(on, p->box[2]);
    curves_caption(on, &l, p);
    return canvas_markers(on, out, frame_id);
}
