/** The rows of a scene's observables -> how much they tell. */
#include "hdlyap/extent.h"

#include "observe/observables.h"
#include "scene/scene.h"

hd_extent hd_observables_extent(const hd_scene_def *scene, void *const *part)
{
    hd_extent extent = {.dimension = hd_scene_dimension(scene),
                        .disks = scene->disks,
                        .vectors = hd_scene_vectors(scene)};
    for (int k = 0; k < HD_OBSERVED; k++) {
        const hd_observable *row = hd_observable_rows[k];
        if (row->extend && hd_observable_is_asked((hd_observed)k, scene))
            row->extend(&extent, scene, part[k]);
    }
    return extent;
}
