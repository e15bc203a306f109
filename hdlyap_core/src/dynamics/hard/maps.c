/** Record of disks or spheres -> tangent maps -> blocks of columns, carried through the maps [T1],
 * [T3], [T4], [T21], [T22]. */
#include "dynamics/hard/maps.h"

#include <math.h>

#include "dynamics/hard/event.h"
#include "scene/kinds.h"
#if HD_DIM == 2
#include "dynamics/hard/kernel_2d.h"
#else
#include "dynamics/hard/kernel_3d.h"
#endif

enum { HD_HALF = HD_DIM };
typedef hd_event hd_entry;
#include "dynamics/hard/carry.h"

#if HD_MIXED
/** Weights maps by masses, and turns of the normal by the distance of two disks in contact. */
static void weigh(hd_maps *maps)
{
    const hd_kinds kinds = hd_kinds_of(maps->scene);
    for (size_t k = 0; k < maps->count; k++) {
        hd_tangent_map *map = &maps->map[k];
        if (map->j < 0) continue;
        const hd_kind *i = &kinds.kind[map->i >= kinds.kind[0].number],
                      *j = &kinds.kind[map->j >= kinds.kind[0].number];
        map->weight[0] = sqrt(2.0 * j->mass / (i->mass + j->mass));
        map->weight[1] = sqrt(2.0 * i->mass / (i->mass + j->mass));
        hd_map_turn(map, 2.0 / (i->diameter + j->diameter));
    }
}
#else
static void weigh(hd_maps *maps) { (void)maps; }
#endif

hd_status hd_maps_create(void **maps, const hd_scene_def *scene)
{
    return maps_create(maps, scene);
}

void hd_maps_free(void *maps) { maps_free(maps); }

hd_status hd_maps_fill(void *maps, const hd_record *record, double t_begin, double t_end)
{
    HD_TRY(maps_fill(maps, record, t_begin, t_end));
    weigh(maps);
    return HD_OK;
}

void hd_maps_carry(const void *maps, double *block, int width) { maps_carry(maps, block, width); }
