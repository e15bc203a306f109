/** The table of observables -> what a run has of them, one loop over its rows for each thing to do.
 * What a scene has of them: asked.c. */
#include "observe/observables.h"

#include <math.h>

#include "base/check.h"
#include "base/clock.h"
#include "base/memory.h"
#include "dynamics/trajectory.h"
#include "scene/scene.h"

/** Wall seconds after which no further step of catching up begins in a call. */
static const double CATCH_UP_SECONDS = 0.1;

/** For each row k that the run has and somebody looks at. */
#define EACH_LOOKED_AT(o, k)                                                                       \
    for (int k = 0; k < HD_OBSERVED; k++)                                                          \
        if (hd_observables_has(o, (hd_observed)k))

static hd_status create_state(hd_observables *o)
{
    const hd_scene_def *scene = o->with.scene;
    const size_t size = (size_t)hd_scene_coordinates(scene) * (size_t)scene->disks;
    o->q = hd_memory_alloc(size, sizeof *o->q);
    o->p = hd_memory_alloc(size, sizeof *o->p);
    return o->q && o->p ? HD_OK : HD_NO_MEMORY;
}

static void look(hd_observables *o, unsigned set)
{
    o->looked_at = set;
    o->seen = hd_observables_with(set);
}

hd_status hd_observables_create(hd_observables *o, const hd_observing *with, char *message,
                                size_t size)
{
    HD_TRY(hd_communicator_agree(
        with->communicator,
        hd_observables_check_longest(with->scene, with->longest, message, size)));
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

void *hd_observables_result(const hd_observables *o, hd_observed k)
{
    return o->part[k] && hd_observable_rows[k]->result ? hd_observable_rows[k]->result(o->part[k])
                                                       : o->part[k];
}

unsigned hd_observables_looked_at(const hd_observables *o) { return o->looked_at; }

void hd_observables_look(hd_observables *o, unsigned stages)
{
    const unsigned before = o->seen;
    look(o, stages);
    for (int k = 0; k < HD_OBSERVED; k++)
        if (o->part[k] && o->seen & ~before & hd_observable_bits[k] &&
            hd_observable_rows[k]->resume)
            hd_observable_rows[k]->resume(o->part[k]);
}

bool hd_observables_has(const hd_observables *o, hd_observed k)
{
    return o->part[k] &&
           (o->seen & hd_observable_bits[k] || !(hd_observable_rows[k]->needs & HD_NEEDS_FRAME));
}

bool hd_observables_any(const hd_observables *o) { return hd_observables_need(o, 0); }

bool hd_observables_need(const hd_observables *o, unsigned needs)
{
    EACH_LOOKED_AT(o, k)
    {
        if ((hd_observable_rows[k]->needs & needs) == needs) return true;
    }
    return false;
}

int hd_observables_first(const hd_observables *o)
{
    int first = o->with.vectors;
    EACH_LOOKED_AT(o, k)
    {
        if (!(hd_observable_rows[k]->needs & HD_NEEDS_ALL)) continue;
        const int own = hd_observable_rows[k]->first
                            ? hd_observable_rows[k]->first(o->part[k], &o->with)
                            : 0;
        if (own < first) first = own;
    }
    return first;
}

double hd_observables_sampling(const hd_observables *o)
{
    double longest = INFINITY;
    EACH_LOOKED_AT(o, k)
    {
        if (hd_observable_rows[k]->sampling)
            longest = fmin(longest, hd_observable_rows[k]->sampling(o->part[k], &o->with));
    }
    return longest;
}

/** The state, with positions and momenta where somebody looks at them. */
static hd_view seen(const hd_observables *o, const hd_view *state)
{
    hd_view view = *state;
    if (!hd_observables_need(o, HD_NEEDS_STATE)) return view;
    hd_trajectory_places(state->trajectory, o->q, o->p);
    view.q = o->q;
    view.p = o->p;
    return view;
}

static hd_status measure_here(hd_observables *o, const hd_view *state)
{
    EACH_LOOKED_AT(o, k)
    {
        if (hd_observable_rows[k]->measure)
            HD_TRY(hd_observable_rows[k]->measure(o->part[k], &o->with, state));
    }
    return HD_OK;
}

hd_status hd_observables_measure(hd_observables *o, const hd_view *state)
{
    const hd_view view = seen(o, state);
    HD_TRY(hd_communicator_agree(o->with.communicator, measure_here(o, &view)));
    EACH_LOOKED_AT(o, k)
    {
        if (hd_observable_rows[k]->share)
            HD_TRY(hd_observable_rows[k]->share(o->part[k], &o->with));
    }
    return HD_OK;
}

void hd_observables_add(hd_observables *o, const hd_view *state)
{
    EACH_LOOKED_AT(o, k)
    {
        if (hd_observable_rows[k]->add) hd_observable_rows[k]->add(o->part[k], &o->with, state);
    }
}

void hd_observables_report(hd_observables *o, const hd_view *state)
{
    const hd_view view = seen(o, state);
    EACH_LOOKED_AT(o, k)
    {
        if (hd_observable_rows[k]->report)
            hd_observable_rows[k]->report(o->part[k], &o->with, &view);
    }
}

/* ---- those that follow intervals ----------------------------------------------------------- */

double hd_observables_seconds(const hd_observables *o) { return o->seconds; }

hd_status hd_observables_follow(hd_observables *o, const hd_leg *leg)
{
    EACH_LOOKED_AT(o, k)
    {
        if (!hd_observable_rows[k]->follow) continue;
        const double start = hd_clock_now();
        const hd_status status = hd_observable_rows[k]->follow(o->part[k], leg);
        o->seconds += hd_clock_now() - start;
        HD_TRY(status);
    }
    return HD_OK;
}

bool hd_observables_begin(const hd_observables *o)
{
    EACH_LOOKED_AT(o, k)
    {
        if (hd_observable_rows[k]->begins && hd_observable_rows[k]->begins(o->part[k])) return true;
    }
    return false;
}

double hd_observables_due(const hd_observables *o, double now)
{
    double first = INFINITY;
    EACH_LOOKED_AT(o, k)
    {
        const double due = hd_observable_rows[k]->due ? hd_observable_rows[k]->due(o->part[k], now)
                                                      : INFINITY;
        if (due > now) first = fmin(first, due);
    }
    return first;
}

static bool is_behind(const hd_observables *o, int k)
{
    return hd_observable_rows[k]->is_behind && hd_observable_rows[k]->is_behind(o->part[k]);
}

bool hd_observables_are_behind(const hd_observables *o)
{
    EACH_LOOKED_AT(o, k)
    {
        if (is_behind(o, k)) return true;
    }
    return false;
}

/** True while a call may take another step, by the clock of rank 0. */
static bool has_time(const hd_observables *o, double start)
{
    double left = hd_clock_now() - start < CATCH_UP_SECONDS;
    hd_communicator_broadcast(o->with.communicator, &left, sizeof left);
    return left > 0;
}

static hd_status catch_up(hd_observables *o, bool to_its_end, double start)
{
    EACH_LOOKED_AT(o, k)
    {
        while (is_behind(o, k)) {
            if (!to_its_end && !has_time(o, start)) return HD_OK;
            HD_TRY(hd_observable_rows[k]->catch_up(o->part[k]));
        }
    }
    return HD_OK;
}

hd_status hd_observables_catch_up(hd_observables *o, bool to_its_end)
{
    const double start = hd_clock_now();
    const hd_status status = catch_up(o, to_its_end, start);
    o->seconds += hd_clock_now() - start;
    return status;
}

/* ---- all of them --------------------------------------------------------------------------- */

void hd_observables_clear(hd_observables *o, const hd_view *here)
{
    for (int k = 0; k < HD_OBSERVED; k++)
        if (o->part[k] && hd_observable_rows[k]->clear)
            hd_observable_rows[k]->clear(o->part[k], here);
}

void hd_observables_archive(hd_observables *o, hd_archive *archive, bool of_frame,
                            const hd_trajectory *now)
{
    for (int k = 0; k < HD_OBSERVED; k++)
        if (o->part[k] && hd_observable_rows[k]->archive &&
            !(hd_observable_rows[k]->needs & HD_NEEDS_FRAME) == !of_frame)
            hd_observable_rows[k]->archive(o->part[k], archive, now);
}
