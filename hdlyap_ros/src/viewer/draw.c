/** Draws a picture. It has a panel for each mode, at least one, side by side, or above each other
 * if the box is long. The first panel is where the box is. An arrow is three triangles in one list:
 * two for the shaft, one for the head. For spheres a second list has the same arrows turned by a
 * right angle, so that they are seen from all sides. */
#include "draw.h"

#include <math.h>
#include <stdio.h>

#include "common/numbers.h"

/* Colours of Okabe and Ito, which colour-blind readers can distinguish. The hue shows the kind, as
 * in the figures of hdlyap plot. */
static const hdr_colour PALETTE_T = {0.0F, 0.447F, 0.698F, 1.0F};  /* #0072B2 */
static const hdr_colour PALETTE_LP = {0.835F, 0.369F, 0.0F, 1.0F}; /* #D55E00 */
/* Colours of an LP mode that is all L, #E69F00, and of one that is all P: */
static const hdr_colour PALETTE_L = {0.902F, 0.624F, 0.0F, 1.0F};
static const hdr_colour PALETTE_P = {0.40F, 0.12F, 0.02F, 1.0F};
static const hdr_colour PALETTE_DISK = {0.86F, 0.86F, 0.86F, 1.0F};
/** Colours of the fastest rotation to the left, which is counterclockwise, and to the right. */
static const hdr_colour PALETTE_LEFT = {0.50F, 0.75F, 0.48F, 1.0F};  /* #7FBF7B */
static const hdr_colour PALETTE_RIGHT = {0.69F, 0.55F, 0.76F, 1.0F}; /* #AF8DC3 */
/** Transparent, so that arrows are seen through spheres. */
static const hdr_colour PALETTE_SPHERE = {0.5F, 0.5F, 0.5F, 0.3F};
/** Colour of what belongs to no step. It is legible on white and on rviz's dark grey. */
static const hdr_colour PALETTE_INK = {0.42F, 0.42F, 0.42F, 1.0F};
static const hdr_colour WHITE = {1.0F, 1.0F, 1.0F, 1.0F}, BLACK = {0.0F, 0.0F, 0.0F, 1.0F};
static const double PALE = 0.3; /* part of white in arrows of another time than the picture's */
/** Part of black in the second arrows of spheres, so that overlapping arrows can be told apart. */
static const double SHADE = 0.3;

/* Lengths in units of the text's height: the picture's width; space between panels, and above */
static const double WIDTH = 64.0, GAP = 3.0, ABOVE = 3.5;
static const double CAPTION = 1.75, CAPTION_HEIGHT = 1.3, TITLE = 1.8, TITLE_HEIGHT = 1.1;
static const double LINE = 0.12;
static const double DIAL = 1.2, DIAL_STEP = 2.4; /* radius; distance of dials in radii */
enum { DIALS = 4, DIAL_SIDES = 32, SHADES = 4 };

static const double LONG = 2.5;    /* panels of boxes longer than this lie above each other */
static const double RISE = 0.7;    /* how high z = 1 appears, seen from 55 degrees */
static const double LONGEST = 2.6; /* longest arrow, in mean distances of particles */
static const double ARROW = 0.5;   /* root mean square length of arrows over the longest */
/** Head of an arrow over its length; widths over the mean distance of particles. */
static const double HEAD = 0.4, HEAD_WIDTH = 0.2, SHAFT_WIDTH = 0.07;
static const double DISKS_Z = -1.0; /* below the arrows, which they would hide */
static const double UNDER = -0.1;   /* second disk of a dumbbell, so that the two do not mix */
static const double BOND_Z = -0.48; /* just above the disks */
static const double BOND = 0.12;    /* thickness of a bond [sigma] */
static const double KT = 2.0 / 3.0; /* temperature of particles in the plane that rotate */
static const double TURN = 6.283185307179586;

/** The canvas, and where parts of the picture lie on it, in the frame of the box [sigma]. */
typedef struct sheet {
    canvas *on;
    const picture *p;
    const heard *h;
    bool spheres;
    int panels, columns;
    double unit;        /**< height of text */
    double distance;    /**< mean distance of particles */
    double longest;     /**< longest arrow; around a panel half of it is left free */
    double right, down; /**< from one panel to the next */
} sheet;

/** The colour that is the part 0 .. 1 of the way from a to b. */
static hdr_colour mix(hdr_colour a, hdr_colour b, double part)
{
    const float p = (float)part;
    return (hdr_colour){a.r + p * (b.r - a.r), a.g + p * (b.g - a.g), a.b + p * (b.b - a.b), 1.0F};
}

/** a + part * d. */
static hdr_point along(hdr_point a, double part, hdr_point d)
{
    return (hdr_point){a.x + part * d.x, a.y + part * d.y, a.z + part * d.z};
}

/* ---- panels -------------------------------------------------------------------------------- */

/** The number of columns with which a grid of panels is not much higher than wide. */
static int columns_of(double shape, int panels)
{
    if (shape > LONG) return 1;
    const int columns = (int)ceil(sqrt(1.5 * panels / shape));
    return columns < panels ? columns : panels;
}

static sheet sheet_of(canvas *on, const picture *p)
{
    const heard *h = p->run;
    const double *box = h->box;
    const bool spheres = heard_has_spheres(h);
    const int panels = p->modes > 0 ? p->modes : 1;
    /* height on the screen, where rviz first shows spheres from above and from the front */
    const double height = box[1] + RISE * box[2];
    const int columns = columns_of(box[0] / height, panels), gaps = columns - 1;
    const double distance = spheres ? cbrt(box[0] * box[1] * box[2] / h->number)
                                    : sqrt(box[0] * box[1] / h->number);
    const double longest = LONGEST * distance;
    const double least = fmax(columns * box[0] + gaps * longest, 0.8 * height);
    const double unit = least / (WIDTH - gaps * GAP);
    const double right = box[0] + GAP * unit + longest, down = height + ABOVE * unit + longest;
    return (sheet){on, p, h, spheres, panels, columns, unit, distance, longest, right, down};
}

/** The lower left corner of panel k. Panels go from left to right, then downwards. */
static hdr_point panel(const sheet *s, int k)
{
    return (hdr_point){k % s->columns * s->right, -(k / s->columns) * s->down, 0.0};
}

static void line(canvas *on, hdr_point from, hdr_point to)
{
    canvas_point(on, from);
    canvas_point(on, to);
}

static hdr_point on_circle(hdr_point middle, double radius, double turns)
{
    const double angle = TURN * turns;
    return along(middle, radius, (hdr_point){cos(angle), sin(angle), 0.0});
}

static void circle(canvas *on, hdr_point middle, double radius)
{
    for (int k = 0; k < DIAL_SIDES; k++)
        line(on, on_circle(middle, radius, (double)k / DIAL_SIDES),
             on_circle(middle, radius, (double)(k + 1) / DIAL_SIDES));
}

/** A corner of the box. Bits of k: whether it is at the upper end along x, y, z. */
static hdr_point corner(const sheet *s, hdr_point origin, int k)
{
    const double *box = s->h->box;
    return along(origin, 1.0,
                 (hdr_point){(k & 1) * box[0], (k >> 1 & 1) * box[1], (k >> 2) * box[2]});
}

static void edges(const sheet *s, hdr_point origin)
{
    const int end = s->spheres ? 8 : 4;
    for (int from = 0; from < end; from++)
        for (int d = 1; d < end; d *= 2)
            if (!(from & d)) line(s->on, corner(s, origin, from), corner(s, origin, from | d));
}

static void outline(const sheet *s, hdr_point origin)
{
    const hdr_point *at = s->h->outline;
    for (uint32_t k = 0; k < s->h->corners; k++)
        line(s->on, along(origin, 1.0, at[k]), along(origin, 1.0, at[(k + 1) % s->h->corners]));
}

static void draw_boxes(const sheet *s)
{
    canvas_layer(s->on, "box", HDR_MARKER_LINE_LIST, PALETTE_INK, LINE * s->unit);
    for (int k = 0; k < s->panels; k++)
        if (s->h->corners > 0)
            outline(s, panel(s, k));
        else
            edges(s, panel(s, k));
}

/** Root mean square, over particles, of a vector's dq half with its part in the angles. */
static double strength_of(const heard *h, const picture_mode *m)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < h->number; i++) {
        sum += m->d[i].x * m->d[i].x + m->d[i].y * m->d[i].y + m->d[i].z * m->d[i].z;
        if (heard_turns(h)) sum += m->turn[i] * m->turn[i];
    }
    return sqrt(sum / h->number);
}

/** How the particles of a panel rotate: by the vector, or by their spin if there is none. full:
 * what has the full colour: strength_of the vector, or twice the thermal spin. */
typedef struct turns {
    const double *of;
    double full;
} turns;

static turns turns_of(const sheet *s, int k)
{
    const picture_mode *m = &s->p->mode[k];
    if (m->d) return (turns){m->turn, strength_of(s->h, m)};
    return (turns){s->h->spin, 2.0 * sqrt(KT / s->h->inertia)};
}

/** The shade of particle i, -SHADES .. SHADES; positive: it rotates to the left. */
static int shade_of(turns t, uint32_t i)
{
    const double part = t.full > 0.0 ? t.of[i] / t.full : 0.0;
    return (int)round(SHADES * fmax(-1.0, fmin(part, 1.0)));
}

/** The vector from the middle of a particle that turns to a place on its arm. */
static hdr_point on_arm(const heard *h, uint32_t i, double site)
{
    return on_circle((hdr_point){0.0, 0.0, 0.0}, site, h->angle[i] / TURN);
}

/** Draws the disks of panel k that have this shade. */
static void particles_of_shade(const sheet *s, int k, int shade)
{
    const heard *h = s->h;
    const turns t = turns_of(s, k);
    const hdr_point below = {0.0, 0.0, DISKS_Z}, under = {0.0, 0.0, UNDER};
    for (uint32_t i = 0; i < h->number; i++) {
        if (shade_of(t, i) != shade) continue;
        const hdr_point at = along(along(panel(s, k), 1.0, h->q[i]), 1.0, below);
        for (int n = h->sites - 1; n >= 0; n--)
            canvas_point(s->on, along(along(at, 1.0, on_arm(h, i, h->site[n])),
                                      (double)(h->sites - 1 - n), under));
        if (h->sites == 0) canvas_point(s->on, at);
    }
}

/** Draws disks that rotate, in a layer for each shade: with one colour per point, rviz would draw
 * transparent spheres. */
static void turning_particles(const sheet *s, const char *ns)
{
    for (int shade = -SHADES; shade <= SHADES; shade++) {
        const hdr_colour full = shade > 0 ? PALETTE_LEFT : PALETTE_RIGHT;
        canvas_layer(s->on, ns, HDR_MARKER_SPHERE_LIST,
                     mix(PALETTE_DISK, full, fabs((double)shade / SHADES)), 1.0);
        for (int k = 0; k < s->panels; k++) particles_of_shade(s, k, shade);
    }
}

/** Draws the arms, from the first disk to the last. */
static void draw_arms(const sheet *s, const char *ns)
{
    canvas_layer(s->on, ns, HDR_MARKER_LINE_LIST, PALETTE_INK, BOND);
    for (int k = 0; k < s->panels; k++)
        for (uint32_t i = 0; i < s->h->number; i++) {
            const hdr_point above = {0.0, 0.0, BOND_Z},
                            at = along(along(panel(s, k), 1.0, s->h->q[i]), 1.0, above);
            line(s->on, along(at, 1.0, on_arm(s->h, i, s->h->site[0])),
                 along(at, 1.0, on_arm(s->h, i, s->h->site[s->h->sites - 1])));
        }
}

static void draw_round(const sheet *s)
{
    const hdr_point below = {0.0, 0.0, s->spheres ? 0.0 : DISKS_Z};
    uint32_t begin = 0;
    for (const heard_kind *kind = s->h->kind; kind < s->h->kind + s->h->kinds; kind++) {
        canvas_layer(s->on, s->spheres ? "spheres" : "disks", HDR_MARKER_SPHERE_LIST,
                     s->spheres ? PALETTE_SPHERE : PALETTE_DISK, kind->diameter);
        for (int k = 0; k < s->panels; k++)
            for (uint32_t i = begin; i < kind->end; i++)
                canvas_point(s->on, along(along(panel(s, k), 1.0, s->h->q[i]), 1.0, below));
        begin = kind->end;
    }
}

static void draw_particles(const sheet *s)
{
    if (s->h->time < 0.0) return;
    if (!heard_turns(s->h)) {
        draw_round(s);
        return;
    }
    const bool several = s->h->sites > 1;
    turning_particles(s, several ? s->h->particles : "disks");
    if (several) draw_arms(s, s->h->particles);
}

/* ---- arrows -------------------------------------------------------------------------------- */

static double length_of(hdr_point d) { return hypot(hypot(d.x, d.y), d.z); }

/** Draws an arrow from its tail by d. n: unit vector perpendicular to d, in the plane of the arrow;
 * s, h: half widths of shaft and head. */
static void flat_arrow(canvas *on, hdr_point tail, hdr_point d, hdr_point n, double s, double h)
{
    const hdr_point tip = along(tail, 1.0, d), neck = along(tip, -HEAD, d);
    const hdr_point outline[] = {
        along(tail, -s, n), along(neck, -s, n), along(neck, s, n),  along(tail, -s, n),
        along(neck, s, n),  along(tail, s, n),  along(neck, -h, n), tip,
        along(neck, h, n),
    };
    for (size_t k = 0; k < sizeof outline / sizeof *outline; k++) canvas_point(on, outline[k]);
}

/** A unit vector perpendicular to d, whose length is `length`. It is in the plane z = 0; if
 * upright, it is perpendicular to that one, too. */
static hdr_point across(hdr_point d, double length, bool upright)
{
    const double level = hypot(d.x, d.y);
    const hdr_point n = level > 0.0 ? (hdr_point){-d.y / level, d.x / level, 0.0}
                                    : (hdr_point){1.0, 0.0, 0.0};
    if (!upright) return n;
    return (hdr_point){-n.y * d.z / length, n.x * d.z / length, (n.y * d.x - n.x * d.y) / length};
}

/** Draws an arrow whose middle is at a place. It is at most as long as the longest one. */
static void arrow(const sheet *s, hdr_point at, hdr_point d, bool upright)
{
    const double full = length_of(d), length = fmin(full, s->longest);
    if (!(full > 0.0)) return;
    const hdr_point n = across(d, full, upright);
    d = along((hdr_point){0.0, 0.0, 0.0}, length / full, d);
    flat_arrow(s->on, along(at, -0.5, d), d, n, SHAFT_WIDTH * s->distance,
               fmin(HEAD_WIDTH * s->distance, 0.4 * length));
}

/** The factor between a vector and the length of its arrows [sigma]. */
static double scale_of(const sheet *s, const picture_mode *m)
{
    const double strength = strength_of(s->h, m);
    return strength > 0.0 ? ARROW * s->longest / strength : 0.0;
}

static hdr_colour colour_of_kind(int kind) { return kind == HDR_MODE_T ? PALETTE_T : PALETTE_LP; }

/** An LP mode turns from L to P, and its hue shows how far. */
static hdr_colour colour_of(const picture_mode *m)
{
    const bool is_known = m->kind == HDR_MODE_LP && m->momentum >= 0.0;
    return is_known ? mix(PALETTE_L, PALETTE_P, m->momentum) : colour_of_kind(m->kind);
}

static bool is_of_before(const heard *h) { return h->vector_time != h->time; }

/** Draws the arrows of a mode in one layer. Those of spheres are not shaded, because that looks
 * right in a plane only. */
static void arrows(const sheet *s, const char *ns, int k, bool upright)
{
    const picture_mode *m = &s->p->mode[k];
    const hdr_point zero = {0.0, 0.0, 0.0};
    const double scale = scale_of(s, m);
    const hdr_colour colour = mix(colour_of(m), WHITE, is_of_before(s->h) ? PALE : 0.0);
    canvas_layer(s->on, ns, HDR_MARKER_TRIANGLE_LIST, mix(colour, BLACK, upright ? SHADE : 0.0),
                 1.0);
    if (s->spheres) canvas_unlit(s->on);
    for (uint32_t i = 0; i < s->h->number; i++)
        arrow(s, along(panel(s, k), 1.0, s->h->at[i]), along(zero, scale, m->d[i]), upright);
}

/* ---- dials and texts ------------------------------------------------------------------------- */

/** Radius of a dial. The eight dials of spheres take no more room than four. */
static double dial_of(const sheet *s, uint32_t pairs)
{
    return DIAL * s->unit * (pairs > DIALS ? (double)DIALS / pairs : 1.0);
}

/** Draws the coefficients (a, b) of each pair in a unit circle, in a row that begins at a place. */
static void dials(const sheet *s, hdr_point at, const picture_mode *m)
{
    const double radius = dial_of(s, m->lp.pairs);
    const hdr_point step = {DIAL_STEP * radius, 0.0, 0.0};
    canvas_layer(s->on, "phases", HDR_MARKER_LINE_LIST, PALETTE_INK, LINE * s->unit);
    for (uint32_t k = 0; k < m->lp.pairs; k++) circle(s->on, along(at, k + 0.5, step), radius);
    canvas_layer(s->on, "phases", HDR_MARKER_LINE_LIST, colour_of(m), 3.0 * LINE * s->unit);
    for (uint32_t k = 0; k < m->lp.pairs; k++) {
        const hdr_point middle = along(at, k + 0.5, step);
        line(s->on, middle, along(middle, radius, (hdr_point){m->lp.a[k], m->lp.b[k], 0.0}));
    }
}

/** Writes the title of a mode: its exponent; then which vector is drawn, and at which time that was
 * computed if it is not the picture's. */
static void title(const sheet *s, const char *ns, hdr_point at, const picture_mode *m)
{
    const double height = TITLE_HEIGHT * s->unit;
    char number[48], when[32] = "";
    number_with_error(number, sizeof number, m->exponent, m->error);
    if (m->d && is_of_before(s->h)) snprintf(when, sizeof when, " of t = %.1f", s->h->vector_time);
    if (m->found)
        canvas_text(s->on, ns, at, height, colour_of_kind(m->kind), "%s   lambda = %s\nvector %u%s",
                    m->name, number, (unsigned)m->index, m->d ? when : " not received");
    else
        canvas_text(s->on, ns, at, height, PALETTE_INK, "%s: %s", m->name,
                    m->absent ? "this run does not look for it" : "not resolved");
}

/** Draws arrows, title and phases of a mode. */
static void draw_mode(const sheet *s, int k)
{
    const picture_mode *m = &s->p->mode[k];
    const uint32_t pairs = m->d ? m->lp.pairs : 0;
    const double *box = s->h->box, row = pairs * DIAL_STEP * dial_of(s, pairs);
    const hdr_point above = {0.5 * (box[0] - row), box[1] + 0.5 * s->longest + TITLE * s->unit,
                             box[2]};
    const hdr_point at = along(panel(s, k), 1.0, above);
    char ns[PICTURE_NAME_SIZE + 5];
    snprintf(ns, sizeof ns, "mode/%s", m->box);
    if (m->d) arrows(s, ns, k, false);
    if (m->d && s->spheres) arrows(s, ns, k, true);
    if (pairs > 0) dials(s, (hdr_point){panel(s, k).x + box[0] - row, at.y, at.z}, m);
    title(s, ns, at, m);
}

static const char *end_of(const heard *h, int d)
{
    return h->periodic[d] ? "periodic" : *h->wall[d] ? h->wall[d] : "reflecting";
}

static void write_box(char *text, size_t size, const heard *h)
{
    if (heard_has_spheres(h))
        snprintf(text, size, "%.4g x %.4g x %.4g, x %s, y %s, z %s", h->box[0], h->box[1],
                 h->box[2], end_of(h, 0), end_of(h, 1), end_of(h, 2));
    else if (h->corners > 0)
        snprintf(text, size, "%s", h->container);
    else
        snprintf(text, size, "x %s, y %s", end_of(h, 0), end_of(h, 1));
}

/** Writes the time, stage and progress of the run. */
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

/** What the colours of particles mean; "" if they do not rotate. */
static const char *legend(const sheet *s)
{
    bool any = false, all = s->p->modes > 0;
    if (!heard_turns(s->h) || s->h->time < 0.0) return "";
    for (int k = 0; k < s->p->modes; k++) {
        any |= s->p->mode[k].d != NULL;
        all &= s->p->mode[k].d != NULL;
    }
    return all   ? "\ngreen: the vector turns the particle to the left, purple: to the right"
           : any ? "\ngreen: the vector, or without one the spin, turns the particle to the left, "
                   "purple: to the right"
                 : "\ngreen: the particle spins to the left, purple: to the right";
}

static void draw_caption(const sheet *s)
{
    const heard *h = s->h;
    const char *colours = legend(s);
    const int lines = (*colours != 0) + (*h->own != 0);
    const double more = 0.5 * CAPTION_HEIGHT * lines; /* a text is drawn around its middle */
    const hdr_point at = {
        0.5 * ((s->columns - 1) * s->right + h->box[0]),
        h->box[1] + 0.5 * s->longest + (ABOVE + CAPTION + more) * s->unit,
        h->box[2],
    };
    char time[80], box[180], particles[80];
    snprintf(particles, sizeof particles, "%u %s", (unsigned)h->number, h->particles);
    write_box(box, sizeof box, h);
    write_time(time, sizeof time, h);
    canvas_text(s->on, "caption", at, CAPTION_HEIGHT * s->unit, PALETTE_INK,
                "%.60s: %s, %s\n%s%s%s%s%s%s", h->scene, particles, box, h->own,
                *h->own ? "\n" : "", time, *s->p->note ? "   " : "", s->p->note, colours);
}

bool draw(canvas *on, hdr_markers *out, const picture *p, const char *frame_id)
{
    const sheet s = sheet_of(on, p);
    canvas_clear(on);
    draw_boxes(&s);
    draw_particles(&s);
    for (int k = 0; k < p->modes; k++) draw_mode(&s, k);
    draw_caption(&s);
    return canvas_markers(on, out, frame_id);
}
