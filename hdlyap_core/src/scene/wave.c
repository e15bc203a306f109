/** Scene -> the waves that it asks for [T10]. */
#include "scene/wave.h"

#include <math.h>
#include <stdlib.h>

#include "scene/container.h"
#include "scene/scene.h"

static int compare_waves(const void *a, const void *b)
{
    const hd_wave *x = a, *y = b;
    if (x->number != y->number) return x->number < y->number ? -1 : 1;
    int d = HD_DIMENSION_MAX - 1; /* 0 along z in the plane */
    while (d > 0 && x->n[d] == y->n[d]) d--;
    return x->n[d] - y->n[d];
}

hd_wave_limits hd_wave_limits_of(const hd_scene_def *def)
{
    if (hd_scene_dimension(def) == 0) return (hd_wave_limits){.smallest = INFINITY};
    return hd_container_of(def)->limits(def);
}

/** Wave numbers of the longest waves, ascending; those that were not taken are INFINITY. */
typedef struct longest {
    double number[HD_WAVES_USUAL_MAX];
    int count;
} longest;

static void take_longer(void *to, const hd_wave *wave)
{
    longest *l = to;
    double number = wave->number;
    for (int k = 0; k < l->count; k++) {
        const double other = l->number[k];
        l->number[k] = fmin(other, number);
        number = fmax(other, number);
    }
}

/** Wave number of the last of the container's waves_usual waves. None of them has more nodes along
 * a direction than there are waves, because that many longer waves lie along it. */
static double usual_limit(const hd_scene_def *def)
{
    const hd_container_row *container = hd_container_of(def);
    longest l = {.count = container->waves_usual(def)};
    hd_scene_def few = *def;
    few.max_mode_number = l.count;
    for (int k = 0; k < l.count; k++) l.number[k] = INFINITY;
    container->waves(&few, take_longer, &l);
    return l.number[l.count - 1];
}

double hd_wave_limit(const hd_scene_def *def)
{
    const double sampled = hd_wave_limits_of(def).largest;
    if (def->max_wave_number > 0) return fmin(def->max_wave_number, sampled);
    return def->max_mode_number > 0 ? sampled : fmin(usual_limit(def), sampled);
}

int hd_wave_nodes(const hd_scene_def *def, int most)
{
    const int wanted = def->max_mode_number;
    return wanted > 0 && wanted < most ? wanted : most;
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
    if (hd_scene_dimension(def) == 0) return 0;
    hd_container_of(def)->waves(def, keep, &all);
    if (out && all.count <= capacity) qsort(out, (size_t)all.count, sizeof *out, compare_waves);
    return all.count;
}
