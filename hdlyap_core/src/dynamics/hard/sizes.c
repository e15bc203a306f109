/** Scene -> how large and how heavy its disks are. */
#include "dynamics/hard/sizes.h"

#include "base/check.h"
#include "base/memory.h"
#include "dynamics/hard/kinds.h"
#include "scene/kinds.h"

hd_status hd_sizes_create(hd_sizes *sizes, const hd_scene_def *def, int radii)
{
    const hd_kinds kinds = hd_kinds_of(def);
    const double share = hd_hard_share(def);
    const size_t count = (size_t)(radii > 0 ? radii : kinds.count);
    *sizes = (hd_sizes){.first = kinds.kind[0].number, .share = {share, 2.0 - share}};
    sizes->radius = hd_memory_alloc(count, sizeof *sizes->radius);
    sizes->wall = hd_memory_alloc(count, sizeof *sizes->wall);
    if (!sizes->radius || !sizes->wall) return HD_NO_MEMORY;
    for (int k = 0; k < kinds.count; k++) {
        sizes->mass[k] = kinds.kind[k].mass;
        sizes->mean += 0.5 * kinds.kind[k].diameter * kinds.kind[k].number / def->number;
        sizes->fastest = fmax(sizes->fastest, 1.0 / kinds.root[k]);
        if (radii == 0) sizes->radius[k] = 0.5 * kinds.kind[k].diameter;
        if (radii == 0) sizes->wall[k] = hd_wall_of(def, sizes->radius[k]);
    }
    return HD_OK;
}

void hd_sizes_clear(hd_sizes *sizes)
{
    hd_memory_free(sizes->radius);
    hd_memory_free(sizes->wall);
}
