/** Modes and steps as observables: the weights of all vectors, then the degenerate sets. */
#include "base/check.h"
#include "modes/modes.h"
#include "modes/steps.h"
#include "observe/observable.h"
#include "observe/step_quantities.h"
#include "scene/scene.h"

/* ---- modes --------------------------------------------------------------------------------- */

static double modes_bytes(const hd_scene_def *scene, int ranks)
{
    (void)ranks;
    return hd_modes_bytes(scene, hd_scene_vectors(scene));
}

static void *modes_create(const hd_observing *with, hd_status *status)
{
    hd_modes *made;
    *status = hd_modes_create(&made, with->scene, with->vectors, with->threads);
    return made;
}

static void modes_free(void *self) { hd_modes_free(self); }

static void modes_clear(void *self, const hd_moment *now)
{
    (void)now;
    hd_modes_clear(self);
}

static hd_status modes_measure(void *self, const hd_moment *now)
{
    HD_TRY(hd_modes_measure(self, now->vectors[0], now->q, now->p));
    if (now->vectors[1].count == 0) return HD_OK;
    return hd_modes_measure(self, now->vectors[1], now->q, now->p);
}

static hd_status modes_share(void *self, const hd_moment *now)
{
    return hd_modes_share(self, now->with->communicator, now->with->width, now->with->carried);
}

static void modes_add(void *self, const hd_moment *now)
{
    (void)now;
    hd_modes_add(self);
}

static void modes_archive(void *self, const hd_moment *now)
{
    hd_modes_archive(self, now->archive);
}

const hd_observable hd_modes_row = {.with = HD_OBSERVE_STEPS,
                                    .needs = HD_NEEDS_FRAME | HD_NEEDS_VECTORS | HD_NEEDS_STATE |
                                             HD_NEEDS_BOX,
                                    .bytes = modes_bytes,
                                    .create = modes_create,
                                    .free = modes_free,
                                    .clear = modes_clear,
                                    .measure = modes_measure,
                                    .share = modes_share,
                                    .add = modes_add,
                                    .archive = modes_archive};

/* ---- steps --------------------------------------------------------------------------------- */

static double steps_bytes(const hd_scene_def *scene, int ranks)
{
    (void)ranks;
    return hd_steps_bytes(scene);
}

/** Adds a field for each step, which can show one vector. */
static void steps_extend(hd_result_counts *extent, const hd_scene_def *scene, const void *self)
{
    (void)scene;
    if (!self) return;
    extent->steps = hd_steps_count(self);
    for (int s = 0; s < extent->steps; s++) {
        const hd_step *step = hd_steps_step(self, s);
        if (step->kind == HD_MODE_ZERO || step->conjugate) continue;
        extent->examples++;
        extent->found += step->resolved;
        if (step->kind == HD_MODE_LP) extent->pairs += step->expected / 2;
    }
}

static void *steps_create(const hd_observing *with, hd_status *status)
{
    hd_steps *made;
    *status = hd_steps_create(&made, with->scene, with->part[HD_OBSERVED_modes]);
    return made;
}

static void steps_free(void *self) { hd_steps_free(self); }

static void steps_clear(void *self, const hd_moment *now)
{
    (void)now;
    hd_steps_clear(self);
}

static void steps_add(void *self, const hd_moment *now) { hd_steps_find(self, now->spectrum); }

static void steps_archive(void *self, const hd_moment *now)
{
    hd_steps_archive(self, now->archive);
}

const hd_observable hd_steps_row = {.with = HD_OBSERVE_MODES,
                                    .quantities = &hd_step_quantities,
                                    .needs = HD_NEEDS_FRAME | HD_NEEDS_VECTORS,
                                    .bytes = steps_bytes,
                                    .extend = steps_extend,
                                    .create = steps_create,
                                    .free = steps_free,
                                    .clear = steps_clear,
                                    .add = steps_add,
                                    .archive = steps_archive};
