/** Phases of LP steps and of T steps: two observables of one kind. */
#include <math.h>

#include "modes/fields.h"
#include "modes/phases.h"
#include "observe/observable.h"
#include "observe/step_quantities.h"

static double lp_bytes(const hd_scene_def *scene, int ranks)
{
    (void)ranks;
    return hd_phases_bytes(hd_fields_count_of(scene).lp_phases);
}

static double t_bytes(const hd_scene_def *scene, int ranks)
{
    (void)ranks;
    return hd_phases_bytes(hd_fields_count_of(scene).t_phases);
}

static void lp_extend(hd_result_counts *extent, const hd_scene_def *scene, const void *self)
{
    (void)scene;
    if (self) extent->phases = hd_phases_count(self);
}

static void t_extend(hd_result_counts *extent, const hd_scene_def *scene, const void *self)
{
    (void)scene;
    if (self) extent->t_phases = hd_phases_count(self);
}

static void *lp_create(const hd_observing *with, hd_status *status)
{
    hd_phases *made;
    *status = hd_phases_create(&made, with->part[HD_OBSERVED_steps], HD_MODE_LP);
    return made;
}

static void *t_create(const hd_observing *with, hd_status *status)
{
    hd_phases *made;
    *status = hd_phases_create(&made, with->part[HD_OBSERVED_steps], HD_MODE_T);
    return made;
}

static void phases_free(void *self) { hd_phases_free(self); }

static void phases_clear(void *self, const hd_moment *now)
{
    (void)now;
    hd_phases_clear(self);
}

static void phases_add(void *self, const hd_moment *now)
{
    hd_phases_add(self, now->with->part[HD_OBSERVED_steps], hd_trajectory_time(now->trajectory));
}

static double phases_apart(const hd_scene_def *scene)
{
    return scene->phase_interval > 0 ? scene->phase_interval : INFINITY;
}

static double phases_sampling(void *self, const hd_moment *now)
{
    const double needed = hd_phases_sampling(self, now->with->part[HD_OBSERVED_steps]),
                 wanted = now->with->scene->phase_interval;
    return wanted > 0 && needed < INFINITY ? fmin(wanted, needed) : needed;
}

static void phases_archive(void *self, const hd_moment *now)
{
    hd_phases_archive(self, now->archive, hd_trajectory_time(now->trajectory));
}

#define ROW(its_quantities, its_bytes, its_extend, its_create)                                     \
    {                                                                                              \
        .with = HD_OBSERVE_STEPS, .quantities = (its_quantities),                                  \
        .needs = HD_NEEDS_FRAME | HD_NEEDS_VECTORS | HD_NEEDS_CLOSE, .bytes = (its_bytes),         \
        .extend = (its_extend), .create = (its_create), .free = phases_free,                       \
        .clear = phases_clear, .resume = phases_clear, .add = phases_add, .apart = phases_apart,   \
        .sampling = phases_sampling, .archive = phases_archive                                     \
    }
const hd_observable hd_phases_row = ROW(&hd_phase_quantities, lp_bytes, lp_extend, lp_create);
const hd_observable hd_t_phases_row = ROW(NULL, t_bytes, t_extend, t_create);
