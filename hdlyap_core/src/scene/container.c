/** Scene -> the row of its container. */
#include "scene/container.h"

#include <stdio.h>

#include "scene/ends.h"
#include "scene/scene.h"

/** The scene may not have been checked yet: a wrong number counts as a rectangle. */
static hd_container number_of(const hd_scene_def *def)
{
    return (unsigned)def->container < HD_CONTAINERS_END ? def->container : HD_RECTANGLE;
}

const hd_container_row *hd_container_of(const hd_scene_def *def)
{
#define ROW(NAME, name, what) &hd_##name##_row,
    static const hd_container_row *const rows[] = {HD_CONTAINERS(ROW)};
#undef ROW
    return rows[number_of(def)];
}

const char *hd_container_name(const hd_scene_def *def)
{
#define NAME_OF(NAME, name, what) #name,
    static const char *const names[] = {HD_CONTAINERS(NAME_OF)};
#undef NAME_OF
    return names[number_of(def)];
}

void hd_scene_box(const hd_scene_def *def, double *box) { hd_container_of(def)->box(def, box); }

void hd_scene_describe(const hd_scene_def *def, char *text, size_t size)
{
    if (hd_scene_dimension(def) == 0)
        snprintf(text, size, "no box");
    else
        hd_container_of(def)->describe(def, text, size);
}

hd_boundary hd_scene_boundary(const hd_scene_def *def, int d)
{
    return hd_container_of(def)->wall ? HD_CURVED : def->boundary[d];
}

const char *hd_scene_boundary_word(const hd_scene_def *def, int d)
{
    return d < hd_scene_dimension(def) ? hd_ends_of(hd_scene_boundary(def, d))->word : "";
}

int hd_scene_outline(const hd_scene_def *def, double *x, double *y)
{
    const hd_container_row *container = hd_container_of(def);
    if (!container->outline) return 0;
    for (int k = 0; k < HD_OUTLINE; k++) {
        double place[2];
        container->outline(def, (double)k / HD_OUTLINE, place);
        x[k] = place[0], y[k] = place[1];
    }
    return HD_OUTLINE;
}

hd_wall hd_wall_of(const hd_scene_def *def, double particle)
{
    const hd_container_row *container = hd_container_of(def);
    return container->wall ? container->wall(def, particle) : (hd_wall){.wait = NULL};
}
