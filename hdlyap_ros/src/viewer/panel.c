/** One panel of a picture. Arrows are flat triangles in one list: a shaft of two, a head of one. */
#include "panel.h"

#include <math.h>
#include <stdio.h>

#include "palette.h"

static const double DISKS_Z = -1.0; /* below the arrows, which they would hide */
/** Root mean square length of an arrow, as a part of the mean distance of disks; the longest one
 * may have. */
static const double ARROW = 1.3, ARROW_MAX = 3.5;
/** Of an arrow, as parts of its length or of the mean distance. */
static const double HEAD = 0.4, HEAD_WIDTH = 0.16, SHAFT_WIDTH = 0.05;
static const double LINE = 0.12; /* in units of the text's height */
static const double DIAL = 1.2;  /* radius, in the same */
enum { DIAL_SIDES = 32 };
/** Of a strip: part of its half height that the root mean square takes; size of a dot. */
static const double STRIP_SCALE = 0.3, STRIP_DOT = 0.35;
static const double TURN = 6.283185307179586;

static void outline(canvas *on, const rect *r)
{
    const double x = r->x + r->width, y = r->y + r->height;
    canvas_line(on, r->x, r->y, x, r->y);
    canvas_line(on, x, r->y, x, y);
    canvas_line(on, x, y, r->x, y);
    canvas_line(on, r->x, y, r->x, r->y);
}

void panel_boxes(canvas *on, const layout *l, const picture *p)
{
    (void)p;
    canvas_layer(on, "box", HDR_MARKER_LINE_LIST, PALETTE_INK, LINE * l->unit);
    for (int k = 0; k < l->panels; k++) {
        outline(on, &l->panel[k]);
        if (l->strips) outline(on, &l->strip[k]);
    }
}

static double element(const hdr_doubles *array, uint32_t i)
{
    return array->data[(size_t)i * array->stride];
}

void panel_disks(canvas *on, const layout *l, const picture *p)
{
    canvas_layer(on, "disks", HDR_MARKER_SPHERE_LIST, PALETTE_DISK, 1.0);
    for (int k = 0; k < l->panels; k++)
        for (uint32_t i = 0; i < p->x.count; i++)
            canvas_point(on, l->panel[k].x + element(&p->x, i), l->panel[k].y + element(&p->y, i),
                         DISKS_Z);
}

/** From (x, y) by (dx, dy); width: mean distance of disks. */
static void arrow(canvas *on, double x, double y, double dx, double dy, double width)
{
    const double length = hypot(dx, dy), nx = -dy / length, ny = dx / length;
    const double s = SHAFT_WIDTH * width, h = fmin(HEAD_WIDTH * width, 0.4 * length);
    const double x0 = x - 0.5 * dx, y0 = y - 0.5 * dy, x1 = x0 + dx, y1 = y0 + dy;
    const double neck_x = x1 - HEAD * dx, neck_y = y1 - HEAD * dy;
    if (!(length > 0.0)) return;
    canvas_point(on, x0 - s * nx, y0 - s * ny, 0.0);
    canvas_point(on, neck_x - s * nx, neck_y - s * ny, 0.0);
    canvas_point(on, neck_x + s * nx, neck_y + s * ny, 0.0);
    canvas_point(on, x0 - s * nx, y0 - s * ny, 0.0);
    canvas_point(on, neck_x + s * nx, neck_y + s * ny, 0.0);
    canvas_point(on, x0 + s * nx, y0 + s * ny, 0.0);
    canvas_point(on, neck_x - h * nx, neck_y - h * ny, 0.0);
    canvas_point(on, x1, y1, 0.0);
    canvas_point(on, neck_x + h * nx, neck_y + h * ny, 0.0);
}

/** An LP mode turns from L to P: its hue says so. */
static hdr_colour colour_of(const picture_mode *m)
{
    double l = 0.0, p = 0.0;
    if (m->kind != HDR_MODE_LP) return palette_kind(m->kind);
    for (uint32_t k = 0; k < m->pairs; k++) {
        l += m->a[k] * m->a[k];
        p += m->b[k] * m->b[k];
    }
    return l + p > 0.0 ? palette_mix(PALETTE_L, PALETTE_P, p / (l + p)) : PALETTE_LP;
}

static double mean_square(const picture_mode *m)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < m->dx.count; i++) {
        const double dx = element(&m->dx, i), dy = element(&m->dy, i);
        sum += dx * dx + dy * dy;
    }
    return m->dx.count > 0 ? sum / m->dx.count : 0.0;
}

static void arrows(canvas *on, const rect *r, const picture *p, const picture_mode *m)
{
    const double distance = sqrt(p->box[0] * p->box[1] / fmax(p->x.count, 1.0));
    const double square = mean_square(m), most = ARROW_MAX * distance;
    const double scale = square > 0.0 ? ARROW * distance / sqrt(square) : 0.0;
    for (uint32_t i = 0; i < m->dx.count; i++) {
        const double dx = scale * element(&m->dx, i), dy = scale * element(&m->dy, i);
        const double shorter = fmin(1.0, most / fmax(hypot(dx, dy), 1e-300));
        arrow(on, r->x + element(&p->x, i), r->y + element(&p->y, i), shorter * dx, shorter * dy,
              distance);
    }
}

/** One component against x, between the edges of a strip. */
static void dots(canvas *on, const rect *strip, const picture *p, const hdr_doubles *d,
                 double scale)
{
    for (uint32_t i = 0; i < d->count; i++) {
        const double off = fmax(-1.0, fmin(1.0, scale * element(d, i)));
        canvas_point(on, strip->x + element(&p->x, i), strip->y + 0.5 * (1.0 + off) * strip->height,
                     0.0);
    }
}

/** Both components of a long box's mode: along it in colour, across it in grey. */
static void components(canvas *on, const layout *l, const picture *p, int k, const char *ns)
{
    const picture_mode *m = &p->mode[k];
    const double square = mean_square(m), scale = square > 0.0 ? STRIP_SCALE / sqrt(square) : 0.0;
    canvas_layer(on, ns, HDR_MARKER_POINTS, PALETTE_INK, STRIP_DOT * l->unit);
    dots(on, &l->strip[k], p, &m->dy, scale);
    canvas_layer(on, ns, HDR_MARKER_POINTS, colour_of(m), STRIP_DOT * l->unit);
    dots(on, &l->strip[k], p, &m->dx, scale);
}

/** Coefficients (a, b) of each pair in their unit circle, in a row that ends at x. */
static void dials(canvas *on, double x, double y, double unit, const picture_mode *m)
{
    const double radius = DIAL * unit;
    canvas_layer(on, "phases", HDR_MARKER_LINE_LIST, PALETTE_INK, LINE * unit);
    for (uint32_t k = 0; k < m->pairs; k++) {
        const double at = x - (2.4 * (m->pairs - k) - 1.2) * radius;
        for (int side = 0; side < DIAL_SIDES; side++) {
            const double from = TURN * side / DIAL_SIDES, to = TURN * (side + 1) / DIAL_SIDES;
            canvas_line(on, at + radius * cos(from), y + radius * sin(from), at + radius * cos(to),
                        y + radius * sin(to));
        }
    }
    canvas_layer(on, "phases", HDR_MARKER_LINE_LIST, colour_of(m), 3.0 * LINE * unit);
    for (uint32_t k = 0; k < m->pairs; k++) {
        const double at = x - (2.4 * (m->pairs - k) - 1.2) * radius;
        canvas_line(on, at, y, at + radius * m->a[k], y + radius * m->b[k]);
    }
}

void panel_mode(canvas *on, const layout *l, const picture *p, int k)
{
    const picture_mode *m = &p->mode[k];
    const rect *r = &l->panel[k];
    const double top = r->y + r->height + 1.8 * l->unit;
    char ns[32];
    snprintf(ns, sizeof ns, "mode/%s", m->name);
    if (m->known && l->strips) {
        components(on, l, p, k, ns);
    } else if (m->known) {
        canvas_layer(on, ns, HDR_MARKER_TRIANGLE_LIST, colour_of(m), 1.0);
        arrows(on, r, p, m);
    }
    if (m->known && m->pairs > 0) dials(on, r->x + r->width, top, l->unit, m);
    if (m->found)
        canvas_text(on, ns, r->x + 0.5 * r->width, top, 1.2 * l->unit, palette_kind(m->kind),
                    "%s   index %u   lambda = %.4f%s%s", m->name, (unsigned)m->index, m->exponent,
                    m->known ? "" : "   (vector not known now)",
                    l->strips ? "   below: dq along the box, across it grey" : "");
    else
        canvas_text(on, ns, r->x + 0.5 * r->width, top, 1.2 * l->unit, PALETTE_INK,
                    "%s: not resolved", m->name);
}
