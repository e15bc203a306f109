/** A picture -> the markers that show it. */
#include "draw.h"

#include <stdio.h>

#include "palette.h"
#include "panel.h"

static const double CAPTION_HEIGHT = 1.3; /* in units of the text's height */

static void write_box(char *text, size_t size, const picture *p)
{
    static const char *const end[] = {"reflecting", "periodic"};
    if (picture_has_spheres(p))
        snprintf(text, size, "%.4g x %.4g x %.4g, x %s, y %s, z %s", p->box[0], p->box[1],
                 p->box[2], end[p->periodic[0]], end[p->periodic[1]], end[p->periodic[2]]);
    else if (p->round)
        snprintf(text, size, "in a circle");
    else
        snprintf(text, size, "x %s, y %s", end[p->periodic[0]], end[p->periodic[1]]);
}

/** Where the run is. */
static void write_time(char *text, size_t size, const picture *p)
{
    char done[24] = "";
    if (p->progress > 0.0) snprintf(done, sizeof done, " (%.0f %%)", 100.0 * p->progress);
    if (p->time >= 0.0)
        snprintf(text, size, "t = %.1f, %s%s", p->time, p->stage, done);
    else
        snprintf(text, size, "waiting for its first message");
}

static void caption(canvas *on, const layout *l, const picture *p)
{
    char time[80], box[100];
    write_box(box, sizeof box, p);
    write_time(time, sizeof time, p);
    canvas_text(on, "caption", l->caption_x, l->caption_y, CAPTION_HEIGHT * l->unit, PALETTE_INK,
                "%.60s: %u %s, %s\n%s%s%s", p->scene, (unsigned)p->disks,
                picture_has_spheres(p) ? "spheres" : "disks", box, time, *p->note ? "   " : "",
                p->note);
}

bool draw(canvas *on, hdr_markers *out, const picture *p, const char *frame_id)
{
    const layout l = layout_of(p);
    canvas_clear(on);
    panel_boxes(on, &l, p);
    panel_disks(on, &l, p);
    for (int k = 0; k < p->modes; k++) panel_mode(on, &l, p, k);
    canvas_level(on, p->box[2]);
    caption(on, &l, p);
    return canvas_markers(on, out, frame_id);
}
