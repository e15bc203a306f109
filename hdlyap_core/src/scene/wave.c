/** Scene -> the waves that it asks for [T10]. */
#include "hdlyap/wave.h"

#include <math.h>
#include <stdlib.h>

#include "scene/container.h"

/** Nodes that are classified if the scene does not say. */
enum { NODE_DEFAULT = 2 };

static int compare_waves(const void *a, const void *b)
{
    const hd_wave *x = a, *y = b;
    if (x->number != y->number) return x->number < y->number ? -1 : 1;
    int d = HD_DIM - 1;
    while (d > 0 && x->n[d] == y->n[d]) d--;
    return x->n[d] - y->n[d];
}

hd_wave_limits hd_wave_limits_of(const hd_scene_def *def)
{
    return hd_container_of(def)->limits(def);
}

double hd_wave_limit(const hd_scene_def *def)
{
    const double sampled = hd_wave_limits_of(def).largest;
    return def->max_wave_number > 0 ? fmin(def->max_wave_number, sampled) : sampled;
}

int hd_wave_nodes(const hd_scene_def *def, int most)
{
    const int wanted = def->max_mode_number > 0 ? def->max_mode_number : NODE_DEFAULT;
    return def->max_wave_number > 0 || most < wanted ? most : wanted;
}

typedef struct waves {
    hd_wave *out;
    int capacity, count;
} waves;

static void keep(void *to, const hd_wave *wave)
{
    waves *all = to;
    if (all->count < all->capacity) all->out[all->count] = *wave;
    all->count++;
}

int hd_waves(const hd_scene_def *def, hd_wave *out, int capacity)
{
    waves all = {out, capacity, 0};
    hd_container_of(def)->waves(def, keep, &all);
    if (out && all.count <= capacity) qsort(out, (size_t)all.count, sizeof *out, compare_waves);
    return all.count;
}
