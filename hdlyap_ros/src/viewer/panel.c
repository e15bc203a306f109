/** One panel of a picture. Arrows are flat triangles in one list: a shaft of two, a head of one. Of
 * spheres there is a second list, of the same arrows turned by a right angle, to be seen from all
 * sides. */
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
enum { DIALS = 4, DIAL_SIDES = 32, WALL_SIDES = 128 };
/** Part of black in the second arrows, without which two that overlap are one blot. */
static const double SHADE = 0.3;
/** How a flat arrow lies. */
typedef enum facing { LEVEL, UPRIGHT } facing;
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

static void posts(canvas *on, const rect *r, double height)
{
    for (int corner = 0; corner < 4; corner++) {
        const double x = r->x + corner % 2 * r->width, y = r->y + corner / 2 * r->height;
        canvas_point(on, x, y, 0.0);
        canvas_point(on, x, y, height);
    }
}

/** The upper and the upright edges of a box of spheres. */
static void lid(canvas *on, const rect *r, double height)
{
    canvas_level(on, height);
    outline(on, r);
    canvas_level(on, 0.0);
    posts(on, r, height);
}

void panel_boxes(canvas *on, const layout *l, const picture *p)
{
    canvas_layer(on, "box", HDR_MARKER_LINE_LIST, PALETTE_INK, LINE * l->unit);
    for (int k = 0; k < l->panels; k++) {
        const rect *r = &l->panel[k];
        if (p->run->round)
            circle(on, r->x + 0.5 * r->width, r->y + 0.5 * r->height, 0.5 * r->width, WALL_SIDES);
        else
            outline(on, r);
        if (heard_has_spheres(p->run)) lid(on, r, p->run->box[2]);
    }
}

void panel_disks(canvas *on, const layout *l, const picture *p)
{
    const bool spheres = heard_has_spheres(p->run);
    const double z = spheres ? 0.0 : DISKS_Z;
    canvas_layer(on, spheres ? "spheres" : "disks", HDR_MARKER_SPHERE_LIST,
                 spheres ? PALETTE_SPHERE : PALETTE_DISK, 1.0);
    for (int k = 0; k < l->panels; k++)
        for (uint32_t i = 0; i < p->run->disks && p->run->time >= 0.0; i++) {
            const hdr_point at = p->run->q[i];
            canvas_point(on, l->panel[k].x + at.x, l->panel[k].y + at.y, z + at.z);
        }
}

static double length_of(hdr_point d) { return hypot(hypot(d.x, d.y), d.z); }

/** From a by part of d. */
static hdr_point along(hdr_point a, double part, hdr_point d)
{
    return (hdr_point){a.x + part * d.x, a.y + part * d.y, a.z + part * d.z};
}

static void corner(canvas *on, hdr_point at) { canvas_point(on, at.x, at.y, at.z); }

/** From a tail by d; n: unit vector across, in whose plane with d it lies; s, h: half widths of
 * shaft and head. */
static void flat_arrow(canvas *on, hdr_point tail, hdr_point d, hdr_point n, double s, double h)
{
    const hdr_point tip = along(tail, 1.0, d), neck = along(tip, -HEAD, d);
    corner(on, along(tail, -s, n));
    corner(on, along(neck, -s, n));
    corner(on, along(neck, s, n));
    corner(on, along(tail, -s, n));
    corner(on, along(neck, s, n));
    corner(on, along(tail, s, n));
    corner(on, along(neck, -h, n));
    corner(on, tip);
    corner(on, along(neck, h, n));
}

/** Unit vector across d, which is so long: in the plane of the disks, or across that and d. */
static hdr_point across(hdr_point d, double length, facing which)
{
    const double level = hypot(d.x, d.y);
    const hdr_point n = level > 0.0 ? (hdr_point){-d.y / level, d.x / level, 0.0}
                                    : (hdr_point){1.0, 0.0, 0.0};
    if (which == LEVEL) return n;
    return (hdr_point){-n.y * d.z / length, n.x * d.z / length, (n.y * d.x - n.x * d.y) / length};
}

/** Round a place; width: mean distance of disks. */
static void arrow(canvas *on, hdr_point at, hdr_point d, double width, facing which)
{
    const double length = length_of(d);
    const double s = SHAFT_WIDTH * width, h = fmin(HEAD_WIDTH * width, 0.4 * length);
    if (length > 0.0) flat_arrow(on, along(at, -0.5, d), d, across(d, length, which), s, h);
}

/** An LP mode turns from L to P: its hue says so. */
static hdr_colour colour_of(const picture_mode *m)
{
    if (m->kind != HDR_MODE_LP) return palette_kind(m->kind);
    return m->momentum >= 0.0 ? palette_mix(PALETTE_L, PALETTE_P, m->momentum) : PALETTE_LP;
}

static bool is_of_before(const picture *p) { return p->run->vector_time != p->run->time; }

static hdr_colour colour_of_field(const picture *p, const picture_mode *m)
{
    const hdr_colour white = {1.0F, 1.0F, 1.0F, 1.0F}, colour = colour_of(m);
    return is_of_before(p) ? palette_mix(colour, white, PALE) : colour;
}

static double mean_square(const hdr_point *d, uint32_t count)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++) sum += d[i].x * d[i].x + d[i].y * d[i].y + d[i].z * d[i].z;
    return sum / count;
}

static void arrows(canvas *on, const layout *l, const rect *r, const picture *p,
                   const picture_mode *m, facing which)
{
    const double most = l->arrow, square = mean_square(m->d, p->run->disks);
    const double scale = square > 0.0 ? ARROW * most / sqrt(square) : 0.0;
    const hdr_point zero = {0.0, 0.0, 0.0}, corner_of = {r->x, r->y, 0.0};
    for (uint32_t i = 0; i < p->run->disks; i++) {
        const hdr_point d = along(zero, scale, m->d[i]);
        const double shorter = fmin(1.0, most / fmax(length_of(d), 1e-300));
        const hdr_point at = along(corner_of, 1.0, p->run->at[i]);
        arrow(on, at, along(zero, shorter, d), l->distance, which);
    }
}

/** In a layer of their own; rviz's light is for a plane. */
static void field(canvas *on, const char *ns, const layout *l, const picture *p, int k,
                  facing which)
{
    const hdr_colour black = {0.0F, 0.0F, 0.0F, 1.0F}, colour = colour_of_field(p, &p->mode[k]);
    canvas_layer(on, ns, HDR_MARKER_TRIANGLE_LIST,
                 which == LEVEL ? colour : palette_mix(colour, black, SHADE), 1.0);
    if (heard_has_spheres(p->run)) canvas_unlit(on);
    arrows(on, l, &l->panel[k], p, &p->mode[k], which);
}

/** Eight dials, of spheres, take no more room than four. */
static double smaller(uint32_t pairs) { return pairs > DIALS ? (double)DIALS / pairs : 1.0; }

/** Coefficients (a, b) of each pair in their unit circle, in a row that ends at x. */
static void dials(canvas *on, double x, double y, double unit, const picture_mode *m)
{
    const double radius = DIAL * unit * smaller(m->pairs);
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
static void write_vector(char *text, size_t size, const picture *p, const picture_mode *m)
{
    if (!m->d)
        snprintf(text, size, "vector %u not received", (unsigned)m->index);
    else if (is_of_before(p))
        snprintf(text, size, "vector %u of t = %.1f", (unsigned)m->index, p->run->vector_time);
    else
        snprintf(text, size, "vector %u", (unsigned)m->index);
}

/** Two lines round (x, y). */
static void title(canvas *on, const char *ns, double x, double y, const layout *l, const picture *p,
                  const picture_mode *m)
{
    char number[48], vector[96];
    const double height = TITLE_HEIGHT * l->unit;
    number_with_error(number, sizeof number, m->exponent, m->error);
    write_vector(vector, sizeof vector, p, m);
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
    const uint32_t pairs = m->d ? m->pairs : 0;
    const double row = pairs * DIAL_STEP * DIAL * l->unit * smaller(pairs); /* of dials */
    char ns[PICTURE_NAME_SIZE + 5];
    snprintf(ns, sizeof ns, "mode/%s", m->box);
    if (m->d) field(on, ns, l, p, k, LEVEL);
    if (m->d && heard_has_spheres(p->run)) field(on, ns, l, p, k, UPRIGHT);
    canvas_level(on, p->run->box[2]);
    if (pairs > 0) dials(on, r->x + r->width, top, l->unit, m);
    title(on, ns, r->x + 0.5 * (r->width - row), top, l, p, m);
    canvas_level(on, 0.0);
}
