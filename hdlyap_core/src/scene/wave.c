/** Scene -> wave vectors and modulations [T10]. */
#include "hdlyap/wave.h"

#include <math.h>
#include <stdlib.h>

#include "base/check.h"

static const double PI = 3.14159265358979323846;

/** A direction in which disks cannot pass each other has no waves of its own. */
static const double NARROW = 2.0;

/** Nodes along each direction that are classified if the scene does not say. */
enum { NODE_DEFAULT = 2 };

double hd_wave_component(const hd_scene_def *def, int d, int n)
{
    double box[HD_DIM];
    hd_scene_box(def, box);
    return def->boundary[d] == HD_PERIODIC ? 2.0 * PI * n / box[d] : PI * n / (box[d] - 1.0);
}

/** Functions of one coordinate as a set: bit 0 cosine, bit 1 sine. */
static unsigned functions(int n, hd_boundary boundary, bool transverse)
{
    if (boundary == HD_REFLECTING) return transverse ? (n > 0 ? 2u : 0u) : 1u;
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

hd_modulations hd_wave_transverse(const hd_wave *wave, const hd_boundary boundary[HD_DIM])
{
    return products(functions(wave->n[0], boundary[0], true),
                    functions(wave->n[1], boundary[1], true));
}

hd_modulations hd_wave_pairs(const hd_wave *wave, const hd_boundary boundary[HD_DIM])
{
    return products(functions(wave->n[0], boundary[0], false),
                    functions(wave->n[1], boundary[1], false));
}

static int compare_waves(const void *a, const void *b)
{
    const hd_wave *x = a, *y = b;
    if (x->number != y->number) return x->number < y->number ? -1 : 1;
    return x->n[1] - y->n[1];
}

/** Largest number of nodes along d whose wave is not longer than `limit`. */
static int nodes_within(const hd_scene_def *def, int d, double limit)
{
    double box[HD_DIM];
    hd_scene_box(def, box);
    if (box[d] < NARROW) return 0;
    return (int)fmin(floor(limit * (1.0 + 1e-12) / hd_wave_component(def, d, 1)), 1e6);
}

hd_wave_limits hd_wave_limits_of(const hd_scene_def *def)
{
    hd_wave_limits limits = {INFINITY, PI * sqrt(def->density), 0};
    for (int d = 0; d < HD_DIM; d++) {
        const int nodes = nodes_within(def, d, limits.largest);
        if (nodes > limits.node) limits.node = nodes;
        if (nodes > 0) limits.smallest = fmin(limits.smallest, hd_wave_component(def, d, 1));
    }
    return limits;
}

int hd_waves(const hd_scene_def *def, hd_wave *out, int capacity)
{
    const double sampled = hd_wave_limits_of(def).largest;
    const double limit = def->max_wave_number > 0 ? fmin(def->max_wave_number, sampled) : sampled;
    int node[HD_DIM], count = 0;
    for (int d = 0; d < HD_DIM; d++) {
        node[d] = nodes_within(def, d, limit);
        if (def->max_wave_number > 0) continue;
        const int wanted = def->max_mode_number > 0 ? def->max_mode_number : NODE_DEFAULT;
        if (node[d] > wanted) node[d] = wanted;
    }
    for (int ny = 0; ny <= node[1]; ny++)
        for (int nx = ny == 0; nx <= node[0]; nx++) {
            const double k[HD_DIM] = {hd_wave_component(def, 0, nx), hd_wave_component(def, 1, ny)};
            const double number = hypot(k[0], k[1]);
            if (number > limit * (1.0 + 1e-12)) continue;
            if (count < capacity) out[count] = (hd_wave){{nx, ny}, {k[0], k[1]}, number};
            count++;
        }
    if (out && count <= capacity) qsort(out, (size_t)count, sizeof *out, compare_waves);
    return count;
}
