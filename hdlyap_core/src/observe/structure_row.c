/** Structure factors of the vectors as an observable. */
#include "base/check.h"
#include "modes/modes.h"
#include "modes/structure.h"
#include "observe/observable.h"
#include "scene/scene.h"

static double structure_bytes(const hd_scene_def *scene, int ranks)
{
    (void)ranks;
    return hd_structure_bytes(scene, hd_scene_vectors(scene));
}

static void structure_extend(hd_result_counts *extent, const hd_scene_def *scene, const void *self)
{
    (void)self;
    extent->waves = hd_structure_waves_of(scene);
}

static void *structure_create(const hd_observing *with, hd_status *status)
{
    hd_structure *made;
    *status = hd_structure_create(&made, with->scene, with->vectors, with->threads);
    return made;
}

static void structure_free(void *self) { hd_structure_free(self); }

static void structure_clear(void *self, const hd_moment *now)
{
    (void)now;
    hd_structure_clear(self);
}

static hd_status structure_measure(void *self, const hd_moment *now)
{
    const double *norms = hd_modes_dq_norms(now->with->part[HD_OBSERVED_modes]);
    HD_TRY(hd_structure_measure(self, now->vectors[0], now->q, norms));
    if (now->vectors[1].count == 0) return HD_OK;
    return hd_structure_measure(self, now->vectors[1], now->q, norms);
}

static hd_status structure_share(void *self, const hd_moment *now)
{
    return hd_structure_share(self, now->with->communicator, now->with->width, now->with->carried);
}

static void structure_add(void *self, const hd_moment *now)
{
    (void)now;
    hd_structure_add(self);
}

static void structure_archive(void *self, const hd_moment *now)
{
    hd_structure_archive(self, now->archive);
}

const hd_observable hd_structure_row = {.with = HD_OBSERVE_MODES,
                                        .needs = HD_NEEDS_FRAME | HD_NEEDS_VECTORS |
                                                 HD_NEEDS_REPORTS | HD_NEEDS_STATE | HD_NEEDS_EDGES,
                                        .bytes = structure_bytes,
                                        .extend = structure_extend,
                                        .create = structure_create,
                                        .free = structure_free,
                                        .clear = structure_clear,
                                        .measure = structure_measure,
                                        .share = structure_share,
                                        .add = structure_add,
                                        .archive = structure_archive};
