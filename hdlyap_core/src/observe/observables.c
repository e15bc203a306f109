/** The table of observables -> what a run has of them, one loop over its rows for each thing to do.
 */
#include "observe/observables.h"

#include <math.h>

#include "base/check.h"
#include "base/memory.h"
#include "scene/scene.h"

static const hd_observable *const rows[HD_OBSERVED] = {
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) [HD_OBSERVED_##name] = &hd_##name##_row,
#include "hdlyap/observables.inc"
};
static const unsigned bits[HD_OBSERVED] = {
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) [HD_OBSERVED_##name] = (bit),
#include "hdlyap/observables.inc"
};

/** For each row k that the run has and somebody looks at. */
#define EACH_LOOKED_AT(o, k)                                                                       \
    for (int k = 0; k < HD_OBSERVED; k++)                                                          \
        if (hd_observables_has(o, (hd_observed)k))

unsigned hd_observables_with(unsigned set)
{
    for (unsigned before = 0; before != set;) {
        before = set;
        for (int k = 0; k < HD_OBSERVED; k++)
            if (set & bits[k]) set |= rows[k]->with;
    }
    return set;
}

static bool is_asked(int k, const hd_scene_def *scene)
{
    return hd_observables_with(scene->observe) & bits[k] &&
           (!(rows[k]->needs & HD_NEEDS_FRAME) || hd_scene_vectors(scene) > 0);
}

bool hd_observables_asked(const hd_scene_def *scene, unsigned needs)
{
    for (int k = 0; k < HD_OBSERVED; k++)
        if (is_asked(k, scene) && (rows[k]->needs & needs) == needs) return true;
    return false;
}

/** Of all disks. */
static size_t coordinates(const hd_scene_def *scene)
{
    return (size_t)hd_scene_dimension(scene) * (size_t)scene->disks;
}

double hd_observables_bytes(const hd_scene_def *scene, int ranks)
{
    const bool seen = hd_observables_asked(scene, HD_NEEDS_STATE);
    double bytes = seen ? 2.0 * (double)coordinates(scene) * sizeof(double) : 0.0; /* q and p */
    for (int k = 0; k < HD_OBSERVED; k++)
        if (is_asked(k, scene)) bytes += rows[k]->bytes(scene, ranks);
    return bytes;
}

static hd_status create_state(hd_observables *o)
{
    const size_t size = coordinates(o->with.scene);
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
        if (!is_asked(k, with->scene)) continue;
        hd_status status;
        o->part[k] = rows[k]->create(&o->with, &status);
        HD_TRY(hd_communicator_agree(with->communicator, status));
    }
    o->with.message = NULL; /* the caller's */
    return HD_OK;
}

void hd_observables_free(hd_observables *o)
{
    for (int k = HD_OBSERVED - 1; k >= 0; k--)
        if (o->part[k]) rows[k]->free(o->part[k]);
    hd_memory_free(o->q);
    hd_memory_free(o->p);
}

void *hd_observables_part(const hd_observables *o, hd_observed row) { return o->part[row]; }

void *hd_observables_result(const hd_observables *o, hd_observed k)
{
    return o->part[k] && rows[k]->result ? rows[k]->result(o->part[k]) : o->part[k];
}

unsigned hd_observables_looked_at(const hd_observables *o) { return o->looked_at; }

void hd_observables_look(hd_observables *o, unsigned stages)
{
    const unsigned before = o->seen;
    look(o, stages);
    for (int k = 0; k < HD_OBSERVED; k++)
        if (o->part[k] && o->seen & ~before & bits[k] && rows[k]->resume)
            rows[k]->resume(o->part[k]);
}

bool hd_observables_has(const hd_observables *o, hd_observed k)
{
    return o->part[k] && (o->seen & bits[k] || !(rows[k]->needs & HD_NEEDS_FRAME));
}

bool hd_observables_any(const hd_observables *o) { return hd_observables_need(o, 0); }

bool hd_observables_need(const hd_observables *o, unsigned needs)
{
    EACH_LOOKED_AT(o, k)
    {
        if ((rows[k]->needs & needs) == needs) return true;
    }
    return false;
}

int hd_observables_first(const hd_observables *o)
{
    int first = o->with.vectors;
    EACH_LOOKED_AT(o, k)
    {
        if (!(rows[k]->needs & HD_NEEDS_ALL)) continue;
        const int own = rows[k]->first ? rows[k]->first(o->part[k], &o->with) : 0;
        if (own < first) first = own;
    }
    return first;
}

double hd_observables_sampling(const hd_observables *o)
{
    double longest = INFINITY;
    EACH_LOOKED_AT(o, k)
    {
        if (rows[k]->sampling) longest = fmin(longest, rows[k]->sampling(o->part[k], &o->with));
    }
    return longest;
}

/** The state, with positions and momenta where somebody looks at them. */
static hd_view seen(const hd_observables *o, const hd_view *state)
{
    hd_view view = *state;
    if (!hd_observables_need(o, HD_NEEDS_STATE)) return view;
    hd_trajectory_state(state->trajectory, o->q, o->p);
    view.q = o->q;
    view.p = o->p;
    return view;
}

static hd_status measure_here(hd_observables *o, const hd_view *state)
{
    EACH_LOOKED_AT(o, k)
    {
        if (rows[k]->measure) HD_TRY(rows[k]->measure(o->part[k], &o->with, state));
    }
    return HD_OK;
}

hd_status hd_observables_measure(hd_observables *o, const hd_view *state)
{
    const hd_view view = seen(o, state);
    HD_TRY(hd_communicator_agree(o->with.communicator, measure_here(o, &view)));
    EACH_LOOKED_AT(o, k)
    {
        if (rows[k]->share) HD_TRY(rows[k]->share(o->part[k], &o->with));
    }
    return HD_OK;
}

void hd_observables_add(hd_observables *o, const hd_view *state)
{
    EACH_LOOKED_AT(o, k)
    {
        if (rows[k]->add) rows[k]->add(o->part[k], &o->with, state);
    }
}

void hd_observables_report(hd_observables *o, const hd_view *state)
{
    const hd_view view = seen(o, state);
    EACH_LOOKED_AT(o, k)
    {
        if (rows[k]->report) rows[k]->report(o->part[k], &o->with, &view);
    }
}

void hd_observables_clear(hd_observables *o, const hd_view *here)
{
    for (int k = 0; k < HD_OBSERVED; k++)
        if (o->part[k] && rows[k]->clear) rows[k]->clear(o->part[k], here);
}

void hd_observables_archive(hd_observables *o, hd_archive *archive, bool of_frame,
                            const hd_trajectory *now)
{
    for (int k = 0; k < HD_OBSERVED; k++)
        if (o->part[k] && rows[k]->archive && !(rows[k]->needs & HD_NEEDS_FRAME) == !of_frame)
            rows[k]->archive(o->part[k], archive, now);
}
