/** Vectors -> modes of this very time. */
#include "run/observer.h"

#include <math.h>

#include "base/check.h"
#include "base/memory.h"

const unsigned hd_observer_stage[HD_FOLLOWED] = {HD_OBSERVE_PHASES, HD_OBSERVE_T_PHASES};
static const hd_mode_kind followed[HD_FOLLOWED] = {HD_MODE_LP, HD_MODE_T};

/** Kinds of modes need steps; only phases cost more. */
hd_status hd_observer_create(hd_observer *observer, const hd_scene_def *scene, int vectors,
                             int threads)
{
    const size_t size = 2 * (size_t)scene->disks;
    observer->q = hd_memory_alloc(size, sizeof(double));
    observer->p = hd_memory_alloc(size, sizeof(double));
    if (!observer->q || !observer->p) return HD_NO_MEMORY;
    HD_TRY(hd_modes_create(&observer->modes, scene, vectors, threads));
    HD_TRY(hd_steps_create(&observer->steps, scene, observer->modes));
    if (scene->observe & HD_OBSERVE_STRUCTURE)
        HD_TRY(hd_structure_create(&observer->structure, scene, vectors, threads));
    if (!(scene->observe & HD_OBSERVE_OF_PHASES)) return HD_OK;
    for (int k = 0; k < HD_FOLLOWED; k++)
        if (scene->observe & hd_observer_stage[k])
            HD_TRY(hd_phases_create(&observer->phases[k], observer->steps, followed[k]));
    return HD_OK;
}

void hd_observer_free(hd_observer *observer)
{
    for (int k = 0; k < HD_FOLLOWED; k++) hd_phases_free(observer->phases[k]);
    hd_structure_free(observer->structure);
    hd_steps_free(observer->steps);
    hd_modes_free(observer->modes);
    hd_memory_free(observer->q);
    hd_memory_free(observer->p);
}

void hd_observer_clear(hd_observer *observer)
{
    if (!observer->modes) return;
    hd_modes_clear(observer->modes);
    hd_steps_clear(observer->steps);
    if (observer->structure) hd_structure_clear(observer->structure);
    hd_observer_forget_phases(observer, ~0u);
}

/** NULL unless they are in the set. */
static hd_phases *phases_of(const hd_observer *observer, unsigned stages, int k)
{
    return stages & hd_observer_stage[k] ? observer->phases[k] : NULL;
}

void hd_observer_follow(hd_observer *observer, unsigned stages, double time)
{
    for (int k = 0; k < HD_FOLLOWED; k++)
        if (phases_of(observer, stages, k))
            hd_phases_add(observer->phases[k], observer->steps, time);
}

void hd_observer_forget_phases(hd_observer *observer, unsigned stages)
{
    for (int k = 0; k < HD_FOLLOWED; k++)
        if (phases_of(observer, stages, k)) hd_phases_clear(observer->phases[k]);
}

double hd_observer_sampling(const hd_observer *observer, unsigned stages)
{
    double sampling = INFINITY;
    for (int k = 0; k < HD_FOLLOWED; k++)
        if (phases_of(observer, stages, k))
            sampling = fmin(sampling, hd_phases_sampling(observer->phases[k], observer->steps));
    return sampling;
}

static hd_structure *structure_of(const hd_observer *observer, unsigned stages)
{
    return stages & HD_OBSERVE_STRUCTURE ? observer->structure : NULL;
}

hd_status hd_observer_measure(hd_observer *observer, unsigned stages, hd_columns vectors,
                              const hd_trajectory *trajectory)
{
    observer->known = vectors;
    hd_trajectory_state(trajectory, observer->q, observer->p);
    HD_TRY(hd_modes_measure(observer->modes, observer->known, observer->q, observer->p));
    if (!structure_of(observer, stages)) return HD_OK;
    return hd_structure_measure(observer->structure, observer->known, observer->q,
                                hd_modes_dq_norms(observer->modes));
}

hd_status hd_observer_share(hd_observer *observer, unsigned stages, hd_communicator *communicator,
                            int width, int carried)
{
    HD_TRY(hd_modes_share(observer->modes, communicator, width, carried));
    if (!structure_of(observer, stages)) return HD_OK;
    return hd_structure_share(observer->structure, communicator, width, carried);
}

void hd_observer_add(hd_observer *observer, unsigned stages)
{
    hd_modes_add(observer->modes);
    if (structure_of(observer, stages)) hd_structure_add(observer->structure);
}
