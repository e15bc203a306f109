/** A circular container: start positions, what is conserved, wave numbers [T21]. Of the
 * trajectory's start + - * / sqrt only. */
#define _XOPEN_SOURCE 700 /* jn */

#include "scene/circle.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

#include "base/check.h"
#include "scene/container.h"

static const double PI = 3.14159265358979323846;

double hd_circle_radius(const hd_scene_def *def) { return sqrt(def->disks / (PI * def->density)); }

static double reach_of(const hd_scene_def *def) { return hd_circle_radius(def) - 0.5; }

static void circle_box(const hd_scene_def *def, double *box)
{
    box[0] = box[1] = 2.0 * hd_circle_radius(def);
}

static double circle_area(const hd_scene_def *def) { return PI * reach_of(def) * reach_of(def); }

/** Energy and time; rotation and angular momentum. */
static int circle_symmetries(const hd_scene_def *def)
{
    (void)def;
    return 2;
}

static void circle_say(const hd_scene_def *def, char *text, size_t size)
{
    (void)def;
    snprintf(text, size, "container = circle");
}

/** What cannot be in a circle. */
static hd_status check_parameters(const hd_scene_def *def, char *message, size_t size)
{
    const hd_scene_def usual = hd_scene_def_default();
    if (def->aspect != usual.aspect)
        return hd_refuse(message, size, "aspect = %.15g: must not be given with container = circle",
                         def->aspect);
    for (int d = 0; d < 2; d++)
        if (def->boundary[d] != usual.boundary[d])
            return hd_refuse(message, size,
                             "boundary_%c = reflecting: must not be given with container = circle, "
                             "whose wall reflects",
                             "xy"[d]);
    if (def->observe & (HD_OBSERVE_HYDRO | HD_OBSERVE_STRUCTURE))
        return hd_refuse(message, size,
                         "observables = %s: must not be given with container = circle: it is of "
                         "waves in a rectangle",
                         def->observe & HD_OBSERVE_HYDRO ? "hydro" : "structure");
    return HD_OK;
}

static hd_status circle_check(const hd_scene_def *def, char *message, size_t size)
{
    HD_TRY(check_parameters(def, message, size));
    if (!(reach_of(def) >= HD_ROOM_MIN))
        return hd_refuse(message, size,
                         "density = %.15g with disks = %d: the radius %.15g of the container must "
                         "be above that of a disk, 1/2, by 1e-9",
                         def->density, def->disks, hd_circle_radius(def));
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

/** The least circle about one of the points of symmetry with at least so many sites. */
static hexagons densest(int disks)
{
    enum { POINTS = 3, BISECTIONS = 100 };
    static const double point[POINTS][2] = {{0, 0}, {0.5, 0}, {0.5, 0.28867513459481288225}};
    hexagons best = {.square = INFINITY};
    for (int k = 0; k < POINTS; k++) {
        hexagons h = {point[k][0], point[k][1], 0.0};
        double low = 0.0, high = disks + 2.0; /* sites lie at least as dense as their squares */
        for (int b = 0; b < BISECTIONS && low < high; b++) {
            const double middle = 0.5 * (low + high);
            *(sites_within(&h, middle) >= disks ? &high : &low) = middle;
        }
        h.square = high;
        if (h.square < best.square) best = h;
    }
    return best;
}

/** Spacing of sites; a little less than fits, for the rounding of the outermost. */
static double spacing_of(const hexagons *h, double reach)
{
    return reach / sqrt(h->square) * (1.0 - 8.0 * DBL_EPSILON);
}

static double circle_start_distance(const hd_scene_def *def)
{
    const hexagons h = densest(def->disks);
    return def->disks > 1 ? spacing_of(&h, reach_of(def)) : INFINITY;
}

static double circle_density_max(const hd_scene_def *def)
{
    const hexagons h = densest(def->disks);
    const double spacing = HD_START_DISTANCE_MIN * (1.0 + 16.0 * DBL_EPSILON);
    const double radius = 0.5 + (def->disks > 1 ? spacing * sqrt(h.square) : 1e-9);
    return def->disks / (PI * radius * radius);
}

/** Spare sites are left empty evenly. */
static void circle_start(const hd_scene_def *def, double *q)
{
    const hexagons h = densest(def->disks);
    const double centre = hd_circle_radius(def), spacing = spacing_of(&h, reach_of(def));
    const int64_t sites = (int64_t)sites_within(&h, h.square), disks = def->disks;
    const int rows = rows_of(h.square);
    int64_t site = 0;
    for (int j = -rows; j <= rows; j++) {
        double first;
        const int count = (int)row_of(&h, h.square, j, &first);
        for (int i = 0; i < count; i++, site++) {
            if (hd_site_is_spare(site, sites, disks)) continue;
            *q++ = centre + spacing * (first + i + (j % 2 != 0 ? 0.5 : 0.0) - h.x0);
            *q++ = centre + spacing * (j * ROW - h.y0);
        }
    }
}

static void circle_still(const hd_scene_def *def, const double *q, double *p)
{
    const double centre = hd_circle_radius(def);
    double angular = 0.0, inertia = 0.0;
    for (int k = 0; k < 2 * def->disks; k += 2) {
        const double x = q[k] - centre, y = q[k + 1] - centre;
        angular += x * p[k + 1] - y * p[k];
        inertia += x * x + y * y;
    }
    const double rate = inertia > 0 ? angular / inertia : 0.0;
    for (int k = 0; k < 2 * def->disks; k += 2) {
        p[k] += rate * (q[k + 1] - centre);
        p[k + 1] -= rate * (q[k] - centre);
    }
}

/* ---- waves ---------------------------------------------------------------------------------- */

/** T: no tangential stress at the wall, of the flow that hd_circle_modulations gives. LP: J_m',
 * nothing through the wall. Up to a factor. */
static double at_wall(bool transverse, int m, double x)
{
    if (transverse) return m > 0 ? m * jn(m, x) - jn(m + 2, x) : jn(2, x);
    return m > 0 ? jn(m - 1, x) - jn(m + 1, x) : jn(1, x);
}

/** The next root above x; roots are more than pi / 2 apart. By chords, of which an end that stays
 * counts half the next time (Illinois). */
static double next_root(bool transverse, int m, double x)
{
    const double STEP = 0.5, CLOSE = 1e-14;
    double low = x + 1e-3, high = low + STEP;
    double below = at_wall(transverse, m, low), above = at_wall(transverse, m, high);
    while (below * above > 0) {
        low = high, below = above;
        above = at_wall(transverse, m, high += STEP);
    }
    for (int stays = 0; high - low > CLOSE * high && above != 0;) {
        const double at = (low * above - high * below) / (above - below);
        if (!(at > low && at < high)) break;
        const double here = at_wall(transverse, m, at);
        const int moves = here * below > 0 ? -1 : 1; /* the low end, or the high one */
        *(moves < 0 ? &low : &high) = at;
        *(moves < 0 ? &below : &above) = here;
        if (stays == -moves) *(moves < 0 ? &above : &below) *= 0.5;
        stays = -moves;
    }
    return fabs(below) < fabs(above) ? low : high;
}

/** Where to begin: the first root of J_m' is above m, that of T above m + 1; J_0' = -J_1 has one at
 * 0, which is none. T of m = 1 has those of LP of 2, to the last bit. */
static double before_roots(bool transverse, int m) { return transverse ? m + 1 : fmax(m, 0.1); }

static hd_modulations modulations_of(int m)
{
    return (hd_modulations){m > 0 ? 2 : 1, {HD_COS_M, HD_SIN_M}};
}

/** A wave with fields of one kind; n[0] = m, n[1]: which root of it. */
static hd_wave wave_of(double reach, bool transverse, int m, int n, double root)
{
    const double k = root / reach;
    hd_wave wave = {.n = {m, n}, .k = {k, 0.0}, .number = k};
    *(transverse ? &wave.transverse : &wave.pairs) = modulations_of(m);
    return wave;
}

/** Of the waves with m nodes LP has the longest. */
static hd_wave_limits circle_limits(const hd_scene_def *def)
{
    hd_wave_limits limits = {INFINITY, PI * sqrt(def->density), 0};
    const double reach = reach_of(def), most = limits.largest * reach;
    limits.node = (int)fmin(most, 1e6);
    while (limits.node > 0 &&
           next_root(false, limits.node, before_roots(false, limits.node)) > most)
        limits.node--;
    if (limits.node > 0) limits.smallest = next_root(false, 1, before_roots(false, 1)) / reach;
    return limits;
}

static void circle_waves(const hd_scene_def *def, hd_wave_taker take, void *to)
{
    const double reach = reach_of(def), limit = hd_wave_limit(def) * (1.0 + 1e-12);
    const int nodes = hd_wave_nodes(def, circle_limits(def).node);
    for (int transverse = 0; transverse < 2; transverse++)
        for (int m = 0; m <= nodes; m++) {
            double root = before_roots(transverse, m);
            for (int n = 1; n <= nodes; n++) {
                root = next_root(transverse, m, root);
                if (root > limit * reach) break;
                const hd_wave wave = wave_of(reach, transverse, m, n, root);
                take(to, &wave);
            }
        }
}

static int circle_waves_usual(const hd_scene_def *def)
{
    (void)def;
    return 12;
}

const hd_container_row hd_circle_row = {.say = circle_say,
                                        .check = circle_check,
                                        .box = circle_box,
                                        .area = circle_area,
                                        .symmetries = circle_symmetries,
                                        .start_distance = circle_start_distance,
                                        .density_max = circle_density_max,
                                        .start = circle_start,
                                        .still = circle_still,
                                        .limits = circle_limits,
                                        .waves = circle_waves,
                                        .waves_usual = circle_waves_usual};
