/** A circular container: size, start positions, its wall, and its row [T21]. What the trajectory
 * uses has only + - * / sqrt. */
#include "scene/circle.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

#include "base/check.h"
#include "scene/container.h"
#include "scene/kinds.h"

static const double PI = 3.14159265358979323846;

double hd_circle_radius(const hd_scene_def *def) { return sqrt(def->number / (PI * def->density)); }

double hd_circle_reach(const hd_scene_def *def) { return hd_circle_radius(def) - 0.5; }

static void circle_box(const hd_scene_def *def, double *box)
{
    box[0] = box[1] = 2.0 * hd_circle_radius(def);
}

static double circle_area(const hd_scene_def *def)
{
    const double reach = hd_circle_radius(def) - 0.5 * hd_kinds_mean(def);
    return PI * reach * reach;
}

static void circle_say(const hd_scene_def *def, char *text, size_t size)
{
    (void)def;
    snprintf(text, size, "container = circle");
}

static void circle_describe(const hd_scene_def *def, char *text, size_t size)
{
    snprintf(text, size, "a circle of radius %.6g", hd_circle_radius(def));
}

static hd_status circle_check(const hd_scene_def *def, char *message, size_t size)
{
    if (def->aspect != hd_scene_def_default().aspect)
        return hd_refuse(message, size, "aspect = %.15g: must not be given with container = circle",
                         def->aspect);
    /* starts and waves count from the wall of a particle of diameter 1 */
    const double largest = 0.5 * fmax(hd_kinds_largest(def), 1.0);
    if (!(hd_circle_radius(def) - largest >= HD_MEMORY_LIMIT_MIN))
        return hd_refuse(message, size,
                         "density = %.15g with number = %d: the radius %.15g of the container must "
                         "be above that of a disk, %s%.15g, by 1e-9",
                         def->density, def->number, hd_circle_radius(def),
                         largest == 0.5 ? "1/" : "", largest == 0.5 ? 2.0 : largest);
    return HD_OK;
}

/* ---- start ---------------------------------------------------------------------------------- */

/** A hexagonal lattice of spacing 1 about one of its points of symmetry: rows at y = j ROW - y0, in
 * which sites lie at x = i + (j odd) / 2 - x0. */
typedef struct hexagons {
    double x0, y0;
    double square; /**< least radius squared with enough sites */
} hexagons;

static const double ROW = 0.86602540378443864676;

/** First column and number of sites of row j within a radius. */
static double row_of(const hexagons *h, double square, int j, double *first)
{
    const double y = j * ROW - h->y0, x = (j % 2 != 0 ? 0.5 : 0.0) - h->x0;
    if (y * y > square) return 0.0;
    const double half = sqrt(square - y * y);
    *first = ceil(-half - x);
    return floor(half - x) - *first + 1.0;
}

static int rows_of(double square) { return (int)(sqrt(square) / ROW) + 1; }

static double sites_within(const hexagons *h, double square)
{
    const int rows = rows_of(square);
    double sites = 0.0, first;
    for (int j = -rows; j <= rows; j++) sites += row_of(h, square, j, &first);
    return sites;
}

/** The smallest circle about a point of symmetry that holds at least `particles` sites. */
static hexagons densest(int particles)
{
    enum { POINTS = 3, BISECTIONS = 100 };
    static const double point[POINTS][2] = {{0, 0}, {0.5, 0}, {0.5, 0.28867513459481288225}};
    hexagons best = {.square = INFINITY};
    for (int k = 0; k < POINTS; k++) {
        hexagons h = {point[k][0], point[k][1], 0.0};
        double low = 0.0, high = particles + 2.0; /* a circle of this squared radius has sites
                                                 enough: they are denser than a square lattice */
        for (int b = 0; b < BISECTIONS && low < high; b++) {
            const double middle = 0.5 * (low + high);
            *(sites_within(&h, middle) >= particles ? &high : &low) = middle;
        }
        h.square = high;
        if (h.square < best.square) best = h;
    }
    return best;
}

/** Spacing of sites, a little less than fits, so that rounding puts no centre beyond the wall. */
static double spacing_of(const hexagons *h, double reach)
{
    return reach / sqrt(h->square) * (1.0 - 8.0 * DBL_EPSILON);
}

static double circle_start_distance(const hd_scene_def *def)
{
    const hexagons h = densest(def->number);
    return def->number > 1 ? spacing_of(&h, hd_circle_reach(def)) : INFINITY;
}

static double circle_density_max(const hd_scene_def *def)
{
    const hexagons h = densest(def->number);
    const double spacing = HD_START_DISTANCE_MIN * (1.0 + 16.0 * DBL_EPSILON);
    const double radius = 0.5 + (def->number > 1 ? spacing * sqrt(h.square) : 1e-9);
    return def->number / (PI * radius * radius);
}

/** Start positions; sites that are not needed stay empty, evenly spread. */
static void circle_start(const hd_scene_def *def, double *q)
{
    const hexagons h = densest(def->number);
    const double centre = hd_circle_radius(def), spacing = spacing_of(&h, hd_circle_reach(def));
    const int64_t sites = (int64_t)sites_within(&h, h.square), particles = def->number;
    const int rows = rows_of(h.square);
    int64_t site = 0;
    for (int j = -rows; j <= rows; j++) {
        double first;
        const int count = (int)row_of(&h, h.square, j, &first);
        for (int i = 0; i < count; i++, site++) {
            if (hd_site_is_spare(site, sites, particles)) continue;
            *q++ = centre + spacing * (first + i + (j % 2 != 0 ? 0.5 : 0.0) - h.x0);
            *q++ = centre + spacing * (j * ROW - h.y0);
        }
    }
}

/* ---- wall ----------------------------------------------------------------------------------- */

/** Entries of hd_wall.own: centres stay within REACH of (CENTRE, CENTRE). */
enum { CENTRE, REACH };

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1]; }

/** r: the vector from the centre to q; returns its length. */
static double from_centre(double *r, const hd_wall *wall, const double *q)
{
    for (int d = 0; d < 2; d++) r[d] = q[d] - wall->own[CENTRE];
    return sqrt(dot(r, r));
}

static double wall_excess(const hd_wall *wall, const double *q)
{
    double r[2];
    return from_centre(r, wall, q) - wall->own[REACH];
}

/** The later root s of |r + p s| = reach, by the form that does not cancel. p^2 reach^2 - (r x p)^2
 * is the square of r.p at the wall; if the centre is at the wall within rounding, r.p itself
 * serves.
 */
static double wall_wait(const hd_wall *wall, const double *q, const double *p)
{
    double at[2];
    const double r = from_centre(at, wall, q), rp = dot(at, p), p2 = dot(p, p);
    const double room = (wall->own[REACH] - r) * (wall->own[REACH] + r);
    const double square = rp * rp + p2 * room, root = sqrt(square > 0 ? square : 0.0);
    const double wait = rp > 0 ? room / (rp + root) : (root - rp) / p2;
    return p2 > 0 ? (wait > 0 ? wait : 0.0) : INFINITY;
}

static double wall_meet(const hd_wall *wall, double *q, double *n)
{
    double r[2];
    const double distance = from_centre(r, wall, q);
    for (int d = 0; d < 2; d++) {
        n[d] = r[d] / distance;
        q[d] = wall->own[CENTRE] + wall->own[REACH] * n[d];
    }
    return wall->own[REACH];
}

static hd_wall circle_wall(const hd_scene_def *def, double particle)
{
    double box[2];
    circle_box(def, box);
    const double centre = 0.5 * box[0], reach = centre - particle;
    return (hd_wall){
        {[CENTRE] = centre, [REACH] = reach}, reach, reach, wall_excess, wall_wait, wall_meet};
}

static void circle_outline(const hd_scene_def *def, double turn, double *place)
{
    const double radius = hd_circle_radius(def), angle = 2.0 * PI * turn;
    place[0] = radius + radius * cos(angle);
    place[1] = radius + radius * sin(angle);
}

/** T steps lie up to 1.5 % below the dispersion relation of boxes. LP steps lie below it by 31 %
 * (LP(1,1), density 0.4) down to nothing (LP(0,1)), so they follow none. */
const hd_container_row hd_circle_row = {.say = circle_say,
                                        .describe = circle_describe,
                                        .check = circle_check,
                                        .box = circle_box,
                                        .area = circle_area,
                                        .rotates = true,
                                        .start_distance = circle_start_distance,
                                        .density_max = circle_density_max,
                                        .start = circle_start,
                                        .wall = circle_wall,
                                        .outline = circle_outline,
                                        .limits = hd_circle_limits,
                                        .waves = hd_circle_waves,
                                        .waves_usual = hd_circle_waves_usual,
                                        .of_wave = hd_circle_of_wave,
                                        .modulations = hd_circle_modulations,
                                        .t_strays = 0.015,
                                        .lp_strays = NAN};
