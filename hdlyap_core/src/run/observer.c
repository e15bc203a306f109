/** Vectors -> modes of this very time. */
#include "run/observer.h"

#include "base/check.h"
#include "base/memory.h"

enum { SLOW_MAX = 60 };

static hd_status create_slow(hd_observer *observer, const hd_scene_def *scene, int vectors)
{
    const int most = vectors / 4;
    const hd_status status = hd_slow_vectors_create(&observer->slow, scene,
                                                    most < SLOW_MAX ? most : SLOW_MAX);
    return status == HD_REFUSED ? HD_OK : status;
}

/** Kinds of modes need steps; only phases cost more. */
hd_status hd_observer_create(hd_observer *observer, const hd_scene_def *scene, int vectors,
                             int threads, bool looks)
{
    const size_t size = 2 * (size_t)scene->disks;
    observer->q = hd_memory_alloc(size, sizeof(double));
    observer->p = hd_memory_alloc(size, sizeof(double));
    if (!observer->q || !observer->p) return HD_NO_MEMORY;
    HD_TRY(hd_modes_create(&observer->modes, scene, vectors, threads));
    HD_TRY(hd_steps_create(&observer->steps, scene, observer->modes));
    if (!(scene->observe & HD_OBSERVE_PHASES)) return HD_OK;
    HD_TRY(hd_phases_create(&observer->phases, observer->steps));
    return looks ? create_slow(observer, scene, vectors) : HD_OK;
}

void hd_observer_free(hd_observer *observer)
{
    hd_slow_vectors_free(observer->slow);
    hd_phases_free(observer->phases);
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
    if (observer->phases) hd_phases_clear(observer->phases);
}

hd_status hd_observer_measure(hd_observer *observer, hd_columns vectors,
                              const hd_trajectory *trajectory)
{
    observer->known = vectors;
    hd_trajectory_state(trajectory, observer->q, observer->p);
    return hd_modes_measure(observer->modes, observer->known, observer->q, observer->p);
}

bool hd_observer_reaches(const hd_observer *observer, int count)
{
    return observer->slow && count <= hd_slow_vectors_count_max(observer->slow);
}

hd_status hd_observer_look(hd_observer *observer, hd_frame *frame, const hd_trajectory *trajectory,
                           int count)
{
    hd_trajectory_state(trajectory, observer->q, observer->p);
    const hd_status status = hd_slow_vectors_measure(observer->slow, frame, observer->p, count);
    hd_frame_rewind(frame);
    if (status != HD_OK) return status;
    const hd_columns columns = hd_slow_vectors_columns(observer->slow);
    HD_TRY(hd_modes_measure(observer->modes, columns, observer->q, observer->p));
    observer->known = columns;
    return HD_OK;
}
