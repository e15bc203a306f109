/** Frame -> vectors on each rank. */
#include "run/gathered.h"

#include "base/check.h"
#include "base/memory.h"
#include "observe/observables.h"
#include "scene/scene.h"

void hd_gathered_free(hd_gathered *g) { hd_memory_free(g->room); }

/** If half of the vectors are carried: bytes of both halves and of the half as it is gathered. */
double hd_gathered_bytes(const hd_scene_def *scene, int ranks)
{
    const double rows = 2.0 * hd_scene_coordinates(scene) * scene->number,
                 carried = hd_scene_carried(scene);
    const bool wanted = hd_observables_asked(scene, HD_NEEDS_ALL);
    if (ranks == 1 || !wanted || carried == hd_scene_vectors(scene)) return 0.0;
    return sizeof(double) * rows * 3.0 * carried;
}

static hd_status reserve(hd_gathered *g, const hd_carrier *c, size_t size)
{
    if (size > g->size) {
        hd_memory_free(g->room);
        g->room = hd_memory_alloc(size, sizeof *g->room);
        g->size = g->room ? size : 0;
    }
    return hd_communicator_agree(c->communicator, g->size >= size ? HD_OK : HD_NO_MEMORY);
}

/** Gathers the half that is carried, and completes it to all vectors. */
static hd_status gather_both_halves(hd_gathered *g, const hd_carrier *c)
{
    const int rows = hd_frame_rows(c->frame), n = c->carried;
    const size_t size = (size_t)rows * (size_t)n;
    HD_TRY(reserve(g, c, 3 * size));
    double *half = g->room + 2 * size;
    hd_frame_gather(c->frame, 0, n, half);
    hd_conjugate_fill(g->room, (hd_columns){half, n, 0, n}, rows, c->of->coordinates);
    g->columns = (hd_columns){g->room, rows, 0, rows};
    return HD_OK;
}

hd_status hd_gather(hd_gathered *g, const hd_carrier *c, int first)
{
    const int count = c->vectors - first;
    g->columns.count = 0;
    if (!c->communicator) g->columns = hd_carrier_vectors(c);
    if (!c->communicator || count == 0) return HD_OK;
    if (c->conjugate) return gather_both_halves(g, c);
    HD_TRY(reserve(g, c, (size_t)hd_frame_rows(c->frame) * (size_t)count));
    hd_frame_gather(c->frame, first, count, g->room);
    g->columns = (hd_columns){g->room, count, first, count};
    return HD_OK;
}
