/** Vectors -> the fractions of their dq halves that are in a part of the coordinates. */
#include "modes/shares.h"

#include <string.h>

#include "modes/modes.h"
#include "scene/scene.h"

/** The coordinates of a particle from a first one on, in the particles from a first one on. */
typedef struct part {
    int particle, coordinate;
} part;

static part part_of(const hd_scene_def *scene, hd_share share)
{
    hd_kind kind[HD_KINDS_MAX];
    if (share == HD_SHARE_TURNING) return (part){0, hd_scene_dimension(scene)};
    return (part){hd_scene_kinds(scene, kind) > 1 ? kind[0].number : scene->number, 0};
}

size_t hd_shares_before(const hd_scene_def *scene, hd_share end)
{
    size_t count = 0;
    for (int share = 0; share < (int)end; share++) {
        const part of = part_of(scene, (hd_share)share);
        count += of.particle < scene->number && of.coordinate < hd_scene_coordinates(scene);
    }
    return count;
}

bool hd_shares_has(const hd_scene_def *scene, hd_share share)
{
    return hd_shares_before(scene, share + 1) > hd_shares_before(scene, share);
}

void hd_shares_measure(double *share, const hd_scene_def *scene, hd_share which,
                       const double *dq_norm, hd_columns v)
{
    const part of = part_of(scene, which);
    const int coordinates = hd_scene_coordinates(scene);
    memset(share + v.first, 0, (size_t)v.count * sizeof *share);
    for (int j = of.particle; j < scene->number; j++)
        for (int d = of.coordinate; d < coordinates; d++) {
            const double *row = v.data + (size_t)(2 * coordinates * j + d) * (size_t)v.stride;
            for (int l = 0; l < v.count; l++) share[v.first + l] += row[l] * row[l];
        }
    for (int l = v.first; l < v.first + v.count; l++) {
        const double norm = dq_norm[l];
        share[l] = norm > HD_MODES_DQ_MIN ? share[l] / (norm * norm) : 0.0;
    }
}
