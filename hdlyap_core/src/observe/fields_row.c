/** L and P modes as an observable. They are reconstructed, step by step, when they are read, at
 * reports at which fields are due. */
#include "modes/pmode.h"
#include "modes/steps.h"
#include "observe/observable.h"

static double fields_bytes(const hd_scene_def *scene, int ranks)
{
    (void)ranks;
    return hd_pmode_bytes(scene);
}

static void *fields_create(const hd_observing *with, hd_status *status)
{
    hd_pmode *made;
    *status = hd_pmode_create(&made, with->scene);
    return made;
}

static void fields_free(void *self) { hd_pmode_free(self); }

const hd_observable hd_fields_row = {.with = HD_OBSERVE_STEPS,
                                     .needs = HD_NEEDS_FRAME | HD_NEEDS_VECTORS | HD_NEEDS_ALL,
                                     .bytes = fields_bytes,
                                     .create = fields_create,
                                     .free = fields_free};
