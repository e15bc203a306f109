/** Localisation widths as an observable. Only vectors that are carried are measured, because
 * partners [T18] lie on the same particles. */
#include "base/check.h"
#include "observe/observable.h"
#include "scene/scene.h"
#include "tangent/localization.h"

static double localization_bytes(const hd_scene_def *scene, int ranks)
{
    (void)ranks;
    return hd_localization_bytes(hd_scene_vectors(scene));
}

static void *localization_create(const hd_observing *with, hd_status *status)
{
    hd_localization *made;
    *status = hd_localization_create(&made, with->scene->number, hd_scene_coordinates(with->scene),
                                     with->vectors, with->threads);
    return made;
}

static void localization_free(void *self) { hd_localization_free(self); }

static void localization_clear(void *self, const hd_moment *now)
{
    (void)now;
    hd_localization_clear(self);
}

static hd_status localization_measure(void *self, const hd_moment *now)
{
    if (now->carried.count > 0) hd_localization_measure(self, now->carried);
    return HD_OK;
}

static hd_status localization_share(void *self, const hd_moment *now)
{
    double *measured = hd_localization_measured(self);
    const size_t n = (size_t)now->with->vectors, carried = (size_t)now->with->carried;
    HD_TRY(hd_communicator_share(now->with->communicator, measured,
                                 (hd_shared){2, n, (size_t)now->with->width, carried, 0}));
    for (double *row = measured; row < measured + 2 * n; row += n)
        for (size_t col = carried; col < n; col++) row[col] = row[n - 1 - col];
    return HD_OK;
}

static void localization_add(void *self, const hd_moment *now)
{
    (void)now;
    hd_localization_add(self);
}

static void localization_archive(void *self, const hd_moment *now)
{
    hd_localization_archive(self, now->archive);
}

const hd_observable hd_localization_row = {.needs = HD_NEEDS_FRAME,
                                           .bytes = localization_bytes,
                                           .create = localization_create,
                                           .free = localization_free,
                                           .clear = localization_clear,
                                           .measure = localization_measure,
                                           .share = localization_share,
                                           .add = localization_add,
                                           .archive = localization_archive};
