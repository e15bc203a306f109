/** The table of ends, and those without a rule of their own. */
#include "scene/ends.h"

#include "scene/scene.h"

const hd_ends hd_periodic_ends = {.word = "periodic", .symplectic = true};
const hd_ends hd_reflecting_ends = {.word = "reflecting", .is_wall = true, .symplectic = true};

/** The wall of a circle; scene/container.h has what it does. */
static const hd_ends curved = {.word = "curved", .symplectic = true};

/** A scene may not have been checked yet: a wrong number counts as periodic. */
const hd_ends *hd_ends_of(hd_boundary boundary)
{
#define ROW(NAME, name, what) &hd_##name##_ends,
    static const hd_ends *const rows[] = {HD_BOUNDARIES(ROW) & curved};
#undef ROW
    return rows[(unsigned)boundary <= HD_CURVED ? boundary : HD_PERIODIC];
}

bool hd_ends_drag(const hd_scene_def *def, int d)
{
    bool drag = false;
    for (int e = 0; e < hd_scene_dimension(def); e++)
        drag |= e != d && hd_ends_of(hd_scene_boundary(def, e))->drags;
    return drag;
}
