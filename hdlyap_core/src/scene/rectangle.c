/** A rectangle, in space a box: each direction is periodic or has walls. */
#include <math.h>
#include <stdio.h>

#include "base/check.h"
#include "scene/container.h"
#include "scene/ends.h"
#include "scene/fluid.h"
#include "scene/kinds.h"
#include "scene/plane_lattice.h"
#include "scene/polarisation.h"
#include "scene/scene.h"
#include "scene/space_lattice.h"

static const double PI = 3.14159265358979323846;

/** An edge [sigma] below this lets no two particles pass each other: no wave lies along it. */
static const double NARROW = 2.0;

static bool is_flat(const hd_scene_def *def) { return hd_scene_dimension(def) == 2; }

static bool has_walls(const hd_scene_def *def, int d) { return hd_is_wall(def->boundary[d]); }

/** The cube root by Newton's method from above, whose bits are the same everywhere. */
static double cube_root(double x)
{
    double root = fmax(x, 1.0);
    for (double next = root; (next = root - (root - x / (root * root)) / 3.0) < root;) root = next;
    return root;
}

static void rectangle_box(const hd_scene_def *def, double *box)
{
    const double square = (double)def->number / (def->density * def->aspect);
    box[0] = is_flat(def)
                 ? sqrt(square)
                 : cube_root((double)def->number / (def->density * def->aspect * def->aspect_z));
    box[1] = def->aspect * box[0];
    if (!is_flat(def)) box[2] = def->aspect_z * box[0];
}

static void rectangle_say(const hd_scene_def *def, char *text, size_t size)
{
    if (is_flat(def))
        snprintf(text, size, "aspect = %.15g and these boundaries", def->aspect);
    else
        snprintf(text, size, "aspect = %.15g, aspect_z = %.15g and these boundaries", def->aspect,
                 def->aspect_z);
}

static void rectangle_describe(const hd_scene_def *def, char *text, size_t size)
{
    double box[HD_DIMENSION_MAX];
    rectangle_box(def, box);
    if (is_flat(def))
        snprintf(text, size, "%.6g x %.6g", box[0], box[1]);
    else
        snprintf(text, size, "%.6g x %.6g x %.6g", box[0], box[1], box[2]);
}

static hd_status rectangle_check(const hd_scene_def *def, char *message, size_t size)
{
    const double largest = hd_kinds_largest(def);
    double box[HD_DIMENSION_MAX];
    rectangle_box(def, box);
    if (def->number < 2 && hd_scene_coordinates(def) == hd_scene_dimension(def))
        return hd_refuse(message, size,
                         "number = %d: must be an integer from 2 to 1000000 in a rectangle",
                         def->number);
    for (int d = 0; d < hd_scene_dimension(def); d++) {
        /* starts and waves count from the walls of a particle of diameter 1 */
        const bool walls = has_walls(def, d);
        const double least = walls ? fmax(largest, 1.0) : largest;
        if (walls ? box[d] - least >= HD_MEMORY_LIMIT_MIN : box[d] > least) continue;
        char said[24 + 24] = "";
        if (!is_flat(def)) snprintf(said, sizeof said, ", aspect_z = %.15g", def->aspect_z);
        return hd_refuse(message, size,
                         "density = %.15g with number = %d, aspect = %.15g%s: the box edge L%c = "
                         "%.15g must be above the disk diameter %.15g%s",
                         def->density, def->number, def->aspect, said, "xyz"[d], box[d], least,
                         !walls            ? ""
                         : least > largest ? " of the first kind, by 1e-9"
                                           : " by 1e-9");
    }
    return HD_OK;
}

static double rectangle_area(const hd_scene_def *def)
{
    double box[HD_DIMENSION_MAX], area = 1.0;
    rectangle_box(def, box);
    for (int d = 0; d < hd_scene_dimension(def); d++)
        area *= box[d] - (has_walls(def, d) ? hd_kinds_mean(def) : 0.0);
    return area;
}

/* ---- start ---------------------------------------------------------------------------------- */

static double rectangle_start_distance(const hd_scene_def *def)
{
    double box[HD_DIMENSION_MAX];
    rectangle_box(def, box);
    return is_flat(def) ? hd_plane_lattice_best(def->number, box, def->boundary).distance
                        : hd_space_lattice_best(def->number, box, def->boundary).distance;
}

static void rectangle_start(const hd_scene_def *def, double *q)
{
    double box[HD_DIMENSION_MAX];
    rectangle_box(def, box);
    if (is_flat(def)) {
        const hd_plane_lattice best = hd_plane_lattice_best(def->number, box, def->boundary);
        hd_plane_lattice_fill(&best, q, def->number, box, def->boundary);
    } else {
        const hd_space_lattice best = hd_space_lattice_best(def->number, box, def->boundary);
        hd_space_lattice_fill(&best, q, def->number, box, def->boundary);
    }
}

/** The highest density at which the lattice holds these N with these aspects and boundaries. */
static double rectangle_density_max(const hd_scene_def *def)
{
    enum { BISECTIONS = 30 };
    hd_scene_def trial = *def;
    double low = 0.0, high = hd_dynamics_of(def)->fluid->density_max * (1.0 + 1e-9);
    for (int k = 0; k < BISECTIONS; k++) {
        double box[HD_DIMENSION_MAX];
        trial.density = 0.5 * (low + high);
        rectangle_box(&trial, box);
        bool fits = true;
        for (int d = 0; d < hd_scene_dimension(def); d++) fits &= box[d] > 1.0;
        fits = fits && rectangle_start_distance(&trial) >= HD_START_DISTANCE_MIN;
        *(fits ? &low : &high) = trial.density;
    }
    return low;
}

/* ---- waves ---------------------------------------------------------------------------------- */

double hd_wave_component(const hd_scene_def *def, int d, int n)
{
    double box[HD_DIMENSION_MAX];
    rectangle_box(def, box);
    return has_walls(def, d) ? PI * n / (box[d] - 1.0) : 2.0 * PI * n / box[d];
}

/** The set of functions of one coordinate: bit 0 is the cosine, bit 1 the sine. */
static unsigned functions(const hd_scene_def *def, int d, int n, bool transverse)
{
    if (has_walls(def, d)) return transverse ? (n > 0 ? 2u : 0u) : 1u;
    return n > 0 ? 3u : 1u;
}

/** The set of products of one function of each coordinate; of[d] is the set of coordinate d. */
static hd_modulations products(const unsigned *of, int dimension)
{
    hd_modulations out = {0};
    for (unsigned bits = 0; bits < 1u << dimension; bits++) {
        bool there = true;
        for (int d = 0; d < dimension; d++) there &= of[d] >> (bits >> d & 1u) & 1u;
        if (there) out.bits[out.count++] = (unsigned char)bits;
    }
    return out;
}

static hd_modulations modulations(const hd_scene_def *def, const int *n, bool transverse)
{
    unsigned of[HD_DIMENSION_MAX];
    for (int d = 0; d < hd_scene_dimension(def); d++) of[d] = functions(def, d, n[d], transverse);
    return products(of, hd_scene_dimension(def));
}

/** Modulations of transverse fields in space. Each has one field less than it has components; a
 * wall forbids the component across it if that has no nodes [T22]. */
static hd_modulations transverse_in_space(const hd_scene_def *def, const int *n)
{
    const hd_modulations scalar = modulations(def, n, false);
    int components = 0;
    for (int d = 0; d < 3; d++) components += n[d] > 0 || !has_walls(def, d);
    hd_modulations out = {.count = scalar.count * (components - 1)};
    for (int c = 0; c < HD_TRANSVERSE_MAX && c < out.count; c++) {
        const int second = c < scalar.count ? 0 : HD_SECOND;
        out.bits[c] = (unsigned char)(scalar.bits[c % scalar.count] | second);
    }
    return out;
}

/** Largest number of nodes along d whose wave number is at most `limit`. */
static int nodes_within(const hd_scene_def *def, int d, double limit)
{
    double box[HD_DIMENSION_MAX];
    rectangle_box(def, box);
    if (box[d] < NARROW) return 0;
    return (int)fmin(floor(limit * (1.0 + 1e-12) / hd_wave_component(def, d, 1)), 1e6);
}

static hd_wave_limits rectangle_limits(const hd_scene_def *def)
{
    const double distances = is_flat(def) ? sqrt(def->density) : cbrt(def->density);
    hd_wave_limits limits = {INFINITY, PI * distances, 0};
    for (int d = 0; d < hd_scene_dimension(def); d++) {
        const int nodes = nodes_within(def, d, limits.largest);
        if (nodes > limits.node) limits.node = nodes;
        if (nodes > 0) limits.smallest = fmin(limits.smallest, hd_wave_component(def, d, 1));
    }
    return limits;
}

static hd_wave wave_of(const hd_scene_def *def, const int *n)
{
    hd_wave wave = {.number = 0.0};
    for (int d = 0; d < hd_scene_dimension(def); d++) {
        wave.n[d] = n[d];
        wave.k[d] = hd_wave_component(def, d, n[d]);
        wave.number = hypot(wave.number, wave.k[d]);
    }
    wave.transverse = is_flat(def) ? modulations(def, n, true) : transverse_in_space(def, n);
    wave.pairs = modulations(def, n, false);
    if (!is_flat(def)) hd_polarisations(wave.across, &wave, def);
    return wave;
}

/** The next numbers of nodes, x first; false after the last ones. */
static bool next_nodes(int *n, const int *most, int dimension)
{
    for (int d = 0; d < dimension; d++) {
        if (n[d]++ < most[d]) return true;
        n[d] = 0;
    }
    return false;
}

static void rectangle_waves(const hd_scene_def *def, hd_wave_taker take, void *to)
{
    const double limit = hd_wave_limit(def);
    int most[HD_DIMENSION_MAX], n[HD_DIMENSION_MAX] = {0};
    for (int d = 0; d < hd_scene_dimension(def); d++)
        most[d] = hd_wave_nodes(def, nodes_within(def, d, limit));
    while (next_nodes(n, most, hd_scene_dimension(def))) {
        const hd_wave wave = wave_of(def, n);
        if (!(wave.number > limit * (1.0 + 1e-12))) take(to, &wave);
    }
}

static int rectangle_waves_usual(const hd_scene_def *def) { return is_flat(def) ? 8 : 26; }

const hd_container_row hd_rectangle_row = {.say = rectangle_say,
                                           .describe = rectangle_describe,
                                           .check = rectangle_check,
                                           .box = rectangle_box,
                                           .area = rectangle_area,
                                           .start_distance = rectangle_start_distance,
                                           .density_max = rectangle_density_max,
                                           .start = rectangle_start,
                                           .limits = rectangle_limits,
                                           .waves = rectangle_waves,
                                           .waves_usual = rectangle_waves_usual};
