/** Record of disks or spheres -> tangent maps -> blocks of columns, carried through the maps [T1],
 * [T3], [T4], [T21], [T22]. */
#include "dynamics/hard/maps.h"

#include "dynamics/hard/event.h"
#if HD_DIM == 2
#include "dynamics/hard/kernel_2d.h"
#else
#include "dynamics/hard/kernel_3d.h"
#endif

enum { HD_HALF = HD_DIM };
typedef hd_event hd_entry;
#include "dynamics/hard/carry.h"

hd_status hd_maps_create(void **maps, const hd_scene_def *scene)
{
    return maps_create(maps, scene->number);
}

void hd_maps_free(void *maps) { maps_free(maps); }

hd_status hd_maps_fill(void *maps, const hd_record *record, double t_begin, double t_end)
{
    return maps_fill(maps, record, t_begin, t_end);
}

void hd_maps_carry(const void *maps, double *block, int width) { maps_carry(maps, block, width); }
