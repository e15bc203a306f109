/** A coordinate -> its cosines and sines [T10]. */
#include "modes/harmonics.h"

#include <math.h>

#include "base/memory.h"
#include "scene/ends.h"

hd_status hd_harmonics_create(hd_harmonics *h, const hd_scene_def *def, int d, int nodes)
{
    const size_t size = 2 * ((size_t)nodes + 1);
    h->nodes = nodes;
    h->offset = hd_is_wall(def->boundary[d]) ? 0.5 : 0.0;
    h->k = hd_wave_component(def, d, 1);
    h->value = hd_memory_alloc(size, sizeof(double));
    h->derivative = hd_memory_alloc(size, sizeof(double));
    return h->value && h->derivative ? HD_OK : HD_NO_MEMORY;
}

void hd_harmonics_clear(hd_harmonics *h)
{
    hd_memory_free(h->value);
    hd_memory_free(h->derivative);
}

void hd_harmonics_fill(hd_harmonics *h, double coordinate)
{
    for (int n = 0; n <= h->nodes; n++) {
        const double k = h->k * n, angle = k * (coordinate - h->offset);
        h->value[2 * n] = cos(angle);
        h->value[2 * n + 1] = sin(angle);
        h->derivative[2 * n] = -k * h->value[2 * n + 1];
        h->derivative[2 * n + 1] = k * h->value[2 * n];
    }
}
