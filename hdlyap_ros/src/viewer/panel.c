/** One panel of a picture. Arrows are flat triangles in one list: a shaft of two, a head of one. */
#include "panel.h"

#include <math.h>
#include <stdio.h>

#include "common/numbers.h"
#include "palette.h"

static const double DISKS_Z = -1.0; /* below the arrows, which they would hide */
static const double ARROW = 0.5;    /* root mean square length, as a part of the longest */
/** Of an arrow, as parts of its length or of the mean distance. */
static const double HEAD = 0.4, HEAD_WIDTH = 0.2, SHAFT_WIDTH = 0.07;
static const double LINE = 0.12;                     /* in units of the text's height */
static const double DIAL = 1.2, DIAL_STEP = 2.4;     /* radius and, in radii, distance */
static const double TITLE = 1.8, TITLE_HEIGHT = 1.1; /* above a panel's arrows, in the same */
static const double PALE = 0.3; /* part of white in what is not of the picture's time */
enum { DIAL_SIDES = 32, WALL_SIDES = 128 };
/** Of a strip: part of its half height that the root mean square takes; size of a dot. */
static const double STRIP_SCALE = 0.3, STRIP_DOT = 0.35;
static const double TURN = 6.283185307179586;

static void circle(canvas *on, double x, double y, double radius, int sides)
{
    for (int side = 0; side < sides; side++) {
        const double from = TURN * side / sides, to = TURN * (side + 1) / sides;
        canvas_line(on, x + radius * cos(from), y + radius * sin(from), x + radius * cos(to),
                    y + radius * sin(to));
    }
}

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
    canvas_layer(on, "box", HDR_MARKER_LINE_LIST, PALETTE_INK, LINE * l->unit);
    for (int k = 0; k < l->panels; k++) {
        const rect *r = &l->panel[k];
        if (p->round)
            circle(on, r->x + 0.5 * r->width, r->y + 0.5 * r->height, 0.5 * r->width, WALL_SIDES);
        else
            outline(on, r);
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
    if (m->kind != HDR_MODE_LP) return palette_kind(m->kind);
    return m->momentum >= 0.0 ? palette_mix(PALETTE_L, PALETTE_P, m->momentum) : PALETTE_LP;
}

static bool is_of_before(const picture *p) { return p->vector_time != p->time; }

static hdr_colour colour_of_field(const picture *p, const picture_mode *m)
{
    const hdr_colour white = {1.0F, 1.0F, 1.0F, 1.0F}, colour = colour_of(m);
    return is_of_before(p) ? palette_mix(colour, white, PALE) : colour;
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

static void arrows(canvas *on, const rect *r, const picture *p, const picture_mode *m, double most)
{
    const double distance = sqrt(p->box[0] * p->box[1] / p->disks);
    const double square = mean_square(m), scale = square > 0.0 ? ARROW * most / sqrt(square) : 0.0;
    for (uint32_t i = 0; i < m->dx.count; i++) {
        const double dx = scale * element(&m->dx, i), dy = scale * element(&m->dy, i);
        const double shorter = fmin(1.0, most / fmax(hypot(dx, dy), 1e-300));
        arrow(on, r->x + element(&p->at_x, i), r->y + element(&p->at_y, i), shorter * dx,
              shorter * dy, distance);
    }
}

/** One component against x, between the edges of a strip. */
static void dots(canvas *on, const rect *strip, const picture *p, const hdr_doubles *d,
                 double scale)
{
    for (uint32_t i = 0; i < d->count; i++) {
        const double off = fmax(-1.0, fmin(1.0, scale * element(d, i)));
        canvas_point(on, strip->x + element(&p->at_x, i),
                     strip->y + 0.5 * (1.0 + off) * strip->height, 0.0);
    }
}

/** Both components of a long box's mode: along it in colour, across it in grey. */
static void components(canvas *on, const layout *l, const picture *p, int k, const char *ns)
{
    const picture_mode *m = &p->mode[k];
    const double square = mean_square(m), scale = square > 0.0 ? STRIP_SCALE / sqrt(square) : 0.0;
    canvas_layer(on, ns, HDR_MARKER_POINTS, PALETTE_INK, STRIP_DOT * l->unit);
    dots(on, &l->strip[k], p, &m->dy, scale);
    canvas_layer(on, ns, HDR_MARKER_POINTS, colour_of_field(p, m), STRIP_DOT * l->unit);
    dots(on, &l->strip[k], p, &m->dx, scale);
}

/** Coefficients (a, b) of each pair in their unit circle, in a row that ends at x. */
static void dials(canvas *on, double x, double y, double unit, const picture_mode *m)
{
    const double radius = DIAL * unit;
    canvas_layer(on, "phases", HDR_MARKER_LINE_LIST, PALETTE_INK, LINE * unit);
    for (uint32_t k = 0; k < m->pairs; k++) {
        const double at = x - (DIAL_STEP * (m->pairs - k - 0.5)) * radius;
        circle(on, at, y, radius, DIAL_SIDES);
    }
    canvas_layer(on, "phases", HDR_MARKER_LINE_LIST, colour_of(m), 3.0 * LINE * unit);
    for (uint32_t k = 0; k < m->pairs; k++) {
        const double at = x - (DIAL_STEP * (m->pairs - k - 0.5)) * radius;
        canvas_line(on, at, y, at + radius * m->a[k], y + radius * m->b[k]);
    }
}

/** Which vector is drawn, and of which time if that is not the picture's. */
static void write_vector(char *text, size_t size, const layout *l, const picture *p,
                         const picture_mode *m)
{
    const char *strips = l->strips ? "; below: dq along the box, across it grey" : "";
    if (!m->known)
        snprintf(text, size, "vector %u not received", (unsigned)m->index);
    else if (is_of_before(p))
        snprintf(text, size, "vector %u of t = %.1f%s", (unsigned)m->index, p->vector_time, strips);
    else
        snprintf(text, size, "vector %u%s", (unsigned)m->index, strips);
}

/** Two lines round (x, y). */
static void title(canvas *on, const char *ns, double x, double y, const layout *l, const picture *p,
                  const picture_mode *m)
{
    char number[48], vector[96];
    const double height = TITLE_HEIGHT * l->unit;
    number_with_error(number, sizeof number, m->exponent, m->error);
    write_vector(vector, sizeof vector, l, p, m);
    if (m->found)
        canvas_text(on, ns, x, y, height, palette_kind(m->kind), "%s   lambda = %s\n%s", m->name,
                    number, vector);
    else
        canvas_text(on, ns, x, y, height, PALETTE_INK, "%s: %s", m->name,
                    m->absent ? "this run looks for none" : "not resolved");
}

void panel_mode(canvas *on, const layout *l, const picture *p, int k)
{
    const picture_mode *m = &p->mode[k];
    const rect *r = &l->panel[k];
    const double top = r->y + r->height + 0.5 * l->arrow + TITLE * l->unit;
    const uint32_t pairs = m->known ? m->pairs : 0;
    const double row = pairs * DIAL_STEP * DIAL * l->unit; /* of dials */
    char ns[32];
    snprintf(ns, sizeof ns, "mode/%s", m->box);
    if (m->known && l->strips) {
        components(on, l, p, k, ns);
    } else if (m->known) {
        canvas_layer(on, ns, HDR_MARKER_TRIANGLE_LIST, colour_of_field(p, m), 1.0);
        arrows(on, r, p, m, l->arrow);
    }
    if (pairs > 0) dials(on, r->x + r->width, top, l->unit, m);
    title(on, ns, r->x + 0.5 * (r->width - row), top, l, p, m);
}
