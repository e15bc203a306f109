/** The table of observables -> those of a run, with one loop over the rows for each task. asked.c
 * has the same for a scene. */
#include "observe/observables.h"

#include <math.h>

#include "base/check.h"
#include "base/memory.h"
#include "dynamics/trajectory.h"
#include "scene/scene.h"

static hd_status create_state(hd_observables *o)
{
    const hd_scene_def *scene = o->with.scene;
    const size_t size = (size_t)hd_scene_coordinates(scene) * (size_t)scene->number;
    o->q = hd_memory_alloc(size, sizeof *o->q);
    o->p = hd_memory_alloc(size, sizeof *o->p);
    return o->q && o->p ? HD_OK : HD_NO_MEMORY;
}

static void look(hd_observables *o, unsigned set)
{
    o->looked_at = set;
    o->seen = hd_observables_with(set);
}

hd_status hd_observables_create(hd_observables *o, const hd_observing *with)
{
    *o = (hd_observables){.with = *with};
    o->with.part = o->part;
    look(o, with->scene->observe);
    if (hd_observables_asked(with->scene, HD_NEEDS_STATE))
        HD_TRY(hd_communicator_agree(with->communicator, create_state(o)));
    for (int k = 0; k < HD_OBSERVED; k++) {
        if (!hd_observable_is_asked((hd_observed)k, with->scene)) continue;
        hd_status status;
        o->part[k] = hd_observable_rows[k]->create(&o->with, &status);
        HD_TRY(hd_communicator_agree(with->communicator, status));
    }
    return HD_OK;
}

void hd_observables_free(hd_observables *o)
{
    for (int k = HD_OBSERVED - 1; k >= 0; k--)
        if (o->part[k]) hd_observable_rows[k]->free(o->part[k]);
    hd_memory_free(o->q);
    hd_memory_free(o->p);
}

void *hd_observables_part(const hd_observables *o, hd_observed row) { return o->part[row]; }

hd_windows *hd_observables_windows(const hd_observables *o)
{
    return o->seen & HD_OBSERVE_COVARIANT ? o->part[HD_OBSERVED_covariant] : NULL;
}

void hd_observables_look(hd_observables *o, unsigned stages)
{
    const unsigned before = o->seen;
    look(o, stages);
    for (int k = 0; k < HD_OBSERVED; k++)
        if (o->part[k] && o->seen & ~before & hd_observable_bits[k] &&
            hd_observable_rows[k]->resume)
            hd_observable_rows[k]->resume(o->part[k], &(hd_moment){.with = &o->with});
}

/* ---- those that somebody looks at ---------------------------------------------------------- */

/** One of the run's observables. */
typedef struct one {
    int k;
    const hd_observable *row;
    void *self;
} one;

/** Moves on to the next observable that somebody listens to; false after the last one. */
static bool next(one *at, const hd_observables *o)
{
    while (++at->k < HD_OBSERVED) {
        at->row = hd_observable_rows[at->k];
        at->self = o->part[at->k];
        const bool seen = o->seen & hd_observable_bits[at->k] || !(at->row->needs & HD_NEEDS_FRAME);
        if (at->self && seen) return true;
    }
    return false;
}

static const one BEFORE = {.k = -1}; /**< the first one */

bool hd_observables_need(const hd_observables *o, unsigned needs)
{
    for (one at = BEFORE; next(&at, o);)
        if ((at.row->needs & needs) == needs) return true;
    return false;
}

int hd_observables_first(const hd_observables *o)
{
    const hd_moment now = {.with = &o->with};
    int first = o->with.vectors;
    for (one at = BEFORE; next(&at, o);) {
        const int own = at.row->first ? at.row->first(at.self, &now) : first;
        if (own < first) first = own;
    }
    return first;
}

double hd_observables_sampling(const hd_observables *o)
{
    const hd_moment now = {.with = &o->with};
    double longest = INFINITY;
    for (one at = BEFORE; next(&at, o);)
        if (at.row->sampling) longest = fmin(longest, at.row->sampling(at.self, &now));
    return longest;
}

/** Adds what observables may use, and positions and momenta if somebody listens to one that needs
 * them. */
static void complete(const hd_observables *o, hd_moment *now)
{
    now->with = &o->with;
    if (!hd_observables_need(o, HD_NEEDS_STATE)) return;
    hd_trajectory_state(now->trajectory, o->q, o->p);
    now->q = o->q;
    now->p = o->p;
}

static hd_status measure_here(hd_observables *o, const hd_moment *now)
{
    for (one at = BEFORE; next(&at, o);)
        if (at.row->measure) HD_TRY(at.row->measure(at.self, now));
    return HD_OK;
}

hd_status hd_observables_measure(hd_observables *o, hd_moment now, bool add)
{
    complete(o, &now);
    HD_TRY(hd_communicator_agree(o->with.communicator, measure_here(o, &now)));
    for (one at = BEFORE; next(&at, o);)
        if (at.row->share) HD_TRY(at.row->share(at.self, &now));
    for (one at = BEFORE; add && next(&at, o);)
        if (at.row->add) at.row->add(at.self, &now);
    return HD_OK;
}

double hd_observables_next(const hd_observables *o)
{
    double time = INFINITY;
    for (one at = BEFORE; next(&at, o);)
        if (at.row->next) time = fmin(time, at.row->next(at.self));
    return time;
}

hd_status hd_observables_glance(hd_observables *o, hd_trajectory *trajectory, double now)
{
    for (one at = BEFORE; next(&at, o);)
        if (at.row->next && at.row->next(at.self) <= now)
            HD_TRY(at.row->glance(at.self, trajectory));
    return HD_OK;
}

void hd_observables_report(hd_observables *o, hd_moment now)
{
    complete(o, &now);
    for (one at = BEFORE; next(&at, o);)
        if (at.row->report) at.row->report(at.self, &now);
}

/* ---- all of them --------------------------------------------------------------------------- */

void hd_observables_clear(hd_observables *o, hd_moment now)
{
    now.with = &o->with;
    for (int k = 0; k < HD_OBSERVED; k++)
        if (o->part[k] && hd_observable_rows[k]->clear)
            hd_observable_rows[k]->clear(o->part[k], &now);
}

void hd_observables_archive(hd_observables *o, hd_archive *archive, bool of_frame,
                            const hd_trajectory *trajectory)
{
    const hd_moment now = {.with = &o->with, .trajectory = trajectory, .archive = archive};
    for (int k = 0; k < HD_OBSERVED; k++)
        if (o->part[k] && hd_observable_rows[k]->archive &&
            !(hd_observable_rows[k]->needs & HD_NEEDS_FRAME) == !of_frame)
            hd_observable_rows[k]->archive(o->part[k], &now);
}
