/** A rectangular container: each direction is periodic or has walls. */
#include <math.h>
#include <stdio.h>

#include "base/check.h"
#include "scene/container.h"
#include "scene/lattice.h"

static const double PI = 3.14159265358979323846;

/** A direction in which disks cannot pass each other has no waves of its own. */
static const double NARROW = 2.0;

static bool has_walls(const hd_scene_def *def, int d) { return def->boundary[d] == HD_REFLECTING; }

static void rectangle_box(const hd_scene_def *def, double box[HD_DIM])
{
    box[0] = sqrt((double)def->disks / (def->density * def->aspect));
    box[1] = def->aspect * box[0];
}

static void rectangle_say(const hd_scene_def *def, char *text, size_t size)
{
    snprintf(text, size, "aspect = %.15g and these boundaries", def->aspect);
}

static hd_status rectangle_check(const hd_scene_def *def, char *message, size_t size)
{
    double box[HD_DIM];
    rectangle_box(def, box);
    if (def->disks < 2)
        return hd_refuse(message, size,
                         "disks = %d: must be an integer from 2 to 1000000 in a rectangle",
                         def->disks);
    for (int d = 0; d < HD_DIM; d++) {
        if (has_walls(def, d) ? box[d] - 1.0 >= HD_ROOM_MIN : box[d] > 1.0) continue;
        return hd_refuse(message, size,
                         "density = %.15g with disks = %d, aspect = %.15g: the box edge L%c = "
                         "%.15g must be above the disk diameter 1%s",
                         def->density, def->disks, def->aspect, "xy"[d], box[d],
                         has_walls(def, d) ? " by 1e-9" : "");
    }
    return HD_OK;
}

static double rectangle_area(const hd_scene_def *def)
{
    double box[HD_DIM];
    rectangle_box(def, box);
    for (int d = 0; d < HD_DIM; d++) box[d] -= has_walls(def, d);
    return box[0] * box[1];
}

static double rectangle_wall_rate(const hd_scene_def *def)
{
    double box[HD_DIM], rate = 0.0;
    rectangle_box(def, box);
    for (int d = 0; d < HD_DIM; d++)
        if (has_walls(def, d)) rate += 1.0 / (box[d] - 1.0);
    return rate;
}

/** Energy and time; a uniform motion and its momentum along each periodic direction. */
static int rectangle_symmetries(const hd_scene_def *def)
{
    return 1 + !has_walls(def, 0) + !has_walls(def, 1);
}

/* ---- start ---------------------------------------------------------------------------------- */

static hd_lattice lattice_of(const hd_scene_def *def)
{
    double box[HD_DIM];
    rectangle_box(def, box);
    return hd_lattice_best(def->disks, box, def->boundary);
}

static double rectangle_start_distance(const hd_scene_def *def) { return lattice_of(def).distance; }

static void rectangle_start(const hd_scene_def *def, double *q)
{
    const hd_lattice lattice = lattice_of(def);
    double box[HD_DIM];
    rectangle_box(def, box);
    hd_lattice_fill(&lattice, q, def->disks, box, def->boundary);
}

static void rectangle_still(const hd_scene_def *def, const double *q, double *p)
{
    double mean[HD_DIM] = {0, 0};
    (void)q;
    for (int k = 0; k < HD_DIM * def->disks; k++) mean[k % HD_DIM] += p[k];
    for (int k = 0; k < HD_DIM * def->disks; k++)
        if (!has_walls(def, k % HD_DIM)) p[k] -= mean[k % HD_DIM] / def->disks;
}

/* ---- waves ---------------------------------------------------------------------------------- */

double hd_wave_component(const hd_scene_def *def, int d, int n)
{
    double box[HD_DIM];
    rectangle_box(def, box);
    return has_walls(def, d) ? PI * n / (box[d] - 1.0) : 2.0 * PI * n / box[d];
}

/** Functions of one coordinate as a set: bit 0 cosine, bit 1 sine. */
static unsigned functions(const hd_scene_def *def, int d, int n, bool transverse)
{
    if (has_walls(def, d)) return transverse ? (n > 0 ? 2u : 0u) : 1u;
    return n > 0 ? 3u : 1u;
}

static hd_modulations products(unsigned of_x, unsigned of_y)
{
    hd_modulations out = {0};
    for (unsigned bits = 0; bits < HD_MODULATIONS_MAX; bits++)
        if ((of_x >> (bits & HD_SIN_X) & 1u) && (of_y >> (bits >> 1) & 1u))
            out.bits[out.count++] = (unsigned char)bits;
    return out;
}

static hd_modulations modulations(const hd_scene_def *def, const int n[HD_DIM], bool transverse)
{
    return products(functions(def, 0, n[0], transverse), functions(def, 1, n[1], transverse));
}

/** Largest number of nodes along d whose wave is not longer than `limit`. */
static int nodes_within(const hd_scene_def *def, int d, double limit)
{
    double box[HD_DIM];
    rectangle_box(def, box);
    if (box[d] < NARROW) return 0;
    return (int)fmin(floor(limit * (1.0 + 1e-12) / hd_wave_component(def, d, 1)), 1e6);
}

static hd_wave_limits rectangle_limits(const hd_scene_def *def)
{
    hd_wave_limits limits = {INFINITY, PI * sqrt(def->density), 0};
    for (int d = 0; d < HD_DIM; d++) {
        const int nodes = nodes_within(def, d, limits.largest);
        if (nodes > limits.node) limits.node = nodes;
        if (nodes > 0) limits.smallest = fmin(limits.smallest, hd_wave_component(def, d, 1));
    }
    return limits;
}

static hd_wave wave_of(const hd_scene_def *def, int nx, int ny)
{
    hd_wave wave = {.n = {nx, ny}};
    for (int d = 0; d < HD_DIM; d++) wave.k[d] = hd_wave_component(def, d, wave.n[d]);
    wave.number = hypot(wave.k[0], wave.k[1]);
    wave.transverse = modulations(def, wave.n, true);
    wave.pairs = modulations(def, wave.n, false);
    return wave;
}

static int rectangle_waves(const hd_scene_def *def, hd_wave *out, int capacity)
{
    const double limit = hd_wave_limit(def);
    int node[HD_DIM], count = 0;
    for (int d = 0; d < HD_DIM; d++) node[d] = hd_wave_nodes(def, nodes_within(def, d, limit));
    for (int ny = 0; ny <= node[1]; ny++)
        for (int nx = ny == 0; nx <= node[0]; nx++) {
            const hd_wave wave = wave_of(def, nx, ny);
            if (wave.number > limit * (1.0 + 1e-12)) continue;
            if (count < capacity) out[count] = wave;
            count++;
        }
    return count;
}

const hd_container_row hd_rectangle_row = {.say = rectangle_say,
                                           .check = rectangle_check,
                                           .box = rectangle_box,
                                           .area = rectangle_area,
                                           .wall_rate = rectangle_wall_rate,
                                           .symmetries = rectangle_symmetries,
                                           .start_distance = rectangle_start_distance,
                                           .density_max = hd_lattice_density_max,
                                           .start = rectangle_start,
                                           .still = rectangle_still,
                                           .limits = rectangle_limits,
                                           .waves = rectangle_waves};
