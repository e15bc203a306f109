/** A picture -> the markers that show it. */
#include "view.h"

#include <stdlib.h>

#include "canvas.h"
#include "curves.h"
#include "panel.h"

struct view {
    canvas *on;
};

bool view_create(view **out)
{
    view *v = *out = calloc(1, sizeof *v);
    if (v && canvas_create(&v->on)) return true;
    view_free(v);
    *out = NULL;
    return false;
}

void view_free(view *v)
{
    if (!v) return;
    canvas_free(v->on);
    free(v);
}

bool view_draw(view *v, hdr_markers *out, const picture *p, const char *frame_id)
{
    const layout l = layout_of(p);
    canvas_clear(v->on);
    panel_boxes(v->on, &l, p);
    panel_disks(v->on, &l, p);
    for (int k = 0; k < p->modes; k++) panel_mode(v->on, &l, p, k);
    if (p->has_exponents) curves_spectrum(v->on, &l, p);
    if (p->steps) curves_dispersion(v->on, &l, p);
    curves_caption(v->on, &l, p);
    return canvas_markers(v->on, out, frame_id);
}
