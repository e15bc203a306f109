/** A picture -> the markers that show it. */
#include "draw.h"

#include <stdio.h>

#include "palette.h"
#include "panel.h"

static const double CAPTION_HEIGHT = 1.3; /* in units of the text's height */

static void write_box(char *text, size_t size, const heard *h)
{
    static const char *const end[] = {"reflecting", "periodic"};
    if (heard_has_spheres(h))
        snprintf(text, size, "%.4g x %.4g x %.4g, x %s, y %s, z %s", h->box[0], h->box[1],
                 h->box[2], end[h->periodic[0]], end[h->periodic[1]], end[h->periodic[2]]);
    else if (h->round)
        snprintf(text, size, "in a circle");
    else
        snprintf(text, size, "x %s, y %s", end[h->periodic[0]], end[h->periodic[1]]);
}

/** Where the run is. */
static void write_time(char *text, size_t size, const heard *h)
{
    const double time = h->time >= 0.0 ? h->time : h->status_time;
    const char *stage = h->stage < UINT8_MAX ? hdr_run_status_stage_text(h->stage)
                                             : "stage unknown";
    char done[24] = "";
    if (h->progress > 0.0) snprintf(done, sizeof done, " (%.0f %%)", 100.0 * h->progress);
    if (time >= 0.0)
        snprintf(text, size, "t = %.1f, %s%s", time, stage, done);
    else
        snprintf(text, size, "waiting for its first message");
}

static void caption(canvas *on, const layout *l, const picture *p)
{
    char time[80], box[100];
    write_box(box, sizeof box, p->run);
    write_time(time, sizeof time, p->run);
    canvas_text(on, "caption", l->caption_x, l->caption_y, CAPTION_HEIGHT * l->unit, PALETTE_INK,
                "%.60s: %u %s, %s\n%s%s%s", p->run->scene, (unsigned)p->run->disks,
                heard_has_spheres(p->run) ? "spheres" : "disks", box, time, *p->note ? "   " : "",
                p->note);
}

bool draw(canvas *on, hdr_markers *out, const picture *p, const char *frame_id)
{
    const layout l = layout_of(p);
    canvas_clear(on);
    panel_boxes(on, &l, p);
    panel_disks(on, &l, p);
    for (int k = 0; k < p->modes; k++) panel_mode(on, &l, p, k);
    canvas_level(on, p->run->box[2]);
    caption(on, &l, p);
    return canvas_markers(on, out, frame_id);
}
