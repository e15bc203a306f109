/** The table of observables -> which of them a scene asks for, and what these need. */
#include "observe/observables.h"

#include <math.h>

#include "base/check.h"
#include "scene/container.h"
#include "scene/scene.h"
#include "scene/scene_check.h"

const hd_observable *const hd_observable_rows[HD_OBSERVED] = {
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) [HD_OBSERVED_##name] = &hd_##name##_row,
#include "hdlyap/observables.inc"
};

const unsigned hd_observable_bits[HD_OBSERVED] = {
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) [HD_OBSERVED_##name] = (bit),
#include "hdlyap/observables.inc"
};

unsigned hd_observables_with(unsigned set)
{
    for (unsigned before = 0; before != set;) {
        before = set;
        for (int k = 0; k < HD_OBSERVED; k++)
            if (set & hd_observable_bits[k]) set |= hd_observable_rows[k]->with;
    }
    return set;
}

bool hd_observable_is_asked(hd_observed k, const hd_scene_def *scene)
{
    return hd_observables_with(scene->observe) & hd_observable_bits[k] &&
           (!(hd_observable_rows[k]->needs & HD_NEEDS_FRAME) || hd_scene_vectors(scene) > 0);
}

/** Loops over the rows that the scene asks for. */
#define EACH_ASKED(scene, row)                                                                     \
    for (int k_ = 0; k_ < HD_OBSERVED; k_++)                                                       \
        for (const hd_observable *row =                                                            \
                 hd_observable_is_asked((hd_observed)k_, scene) ? hd_observable_rows[k_] : NULL;   \
             row; row = NULL)

bool hd_observables_asked(const hd_scene_def *scene, unsigned needs)
{
    EACH_ASKED(scene, row)
    {
        if ((row->needs & needs) == needs) return true;
    }
    return false;
}

double hd_observables_bytes(const hd_scene_def *scene, int ranks)
{
    const double state = 2.0 * hd_scene_coordinates(scene) * scene->number * sizeof(double);
    double bytes = hd_observables_asked(scene, HD_NEEDS_STATE) ? state : 0.0; /* q and p */
    EACH_ASKED(scene, row) bytes += row->bytes(scene, ranks);
    return bytes;
}

hd_result_counts hd_observables_extent(const hd_scene_def *scene, void *const *part)
{
    hd_result_counts extent = {.dimension = hd_scene_dimension(scene),
                               .coordinates = hd_scene_coordinates(scene),
                               .turning = hd_scene_inertia(scene) > 0,
                               .particles = scene->number,
                               .vectors = hd_scene_vectors(scene)};
    for (int k = 0; k < HD_OBSERVED; k++) {
        const hd_observable *row = hd_observable_rows[k];
        if (row->extend && hd_observable_is_asked((hd_observed)k, scene))
            row->extend(&extent, scene, part[k]);
    }
    return extent;
}

/* ---- what may be asked for ----------------------------------------------------------------- */

/** With covariant vectors at least the transient: vectors converge forwards no faster than
 * backwards. */
double hd_scene_warmup(const hd_scene_def *scene)
{
    const double time = hd_scene_parting(scene);
    const bool windows = hd_observable_is_asked(HD_OBSERVED_covariant, scene);
    return scene->warmup == HD_WARMUP_AUTO && windows ? fmax(time, scene->covariant_transient)
                                                      : time;
}

/** All that the observables of a set need. */
static unsigned needs_of(unsigned set)
{
    unsigned needs = 0;
    for (int k = 0; k < HD_OBSERVED; k++)
        if (hd_observables_with(set) & hd_observable_bits[k]) needs |= hd_observable_rows[k]->needs;
    return needs;
}

/** What particles may lack, and why observables that need it are then refused. */
static const struct {
    unsigned need;
    const char *why;
} LACKING[] = {{HD_NEEDS_BOX, "which have no positions in a box"},
               {HD_NEEDS_TOTALS, "whose pressure cannot be measured"},
               {HD_NEEDS_AVERAGES, "whose row of dynamics tells no averages"}};
enum { LACKS = sizeof LACKING / sizeof *LACKING };

/** The needs of which particles of this row lack what they stand for. */
static unsigned lacking(const hd_dynamics *of)
{
    return (of->dimension == 0 ? HD_NEEDS_BOX : 0u) | (of->totals ? 0u : HD_NEEDS_TOTALS) |
           (of->averages > 0 ? 0u : HD_NEEDS_AVERAGES);
}

unsigned hd_observe_of(const hd_dynamics *row)
{
    unsigned set = 0;
    for (int k = 0; k < HD_OBSERVED; k++)
        if (!(needs_of(hd_observable_bits[k]) & lacking(row))) set |= hd_observable_bits[k];
    return set;
}

/** Name of the first observable that the scene asks for and that has this need, or brings one that
 * has; NULL: none. */
static const char *name_of_need(const hd_scene_def *scene, unsigned need)
{
    static const char *const names[HD_OBSERVED] = {
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result) [HD_OBSERVED_##name] = #name,
#include "hdlyap/observables.inc"
    };
    for (int k = 0; k < HD_OBSERVED; k++)
        if (scene->observe & hd_observable_bits[k] && needs_of(hd_observable_bits[k]) & need)
            return names[k];
    return NULL;
}

/** Refuses, by its name, an observable of what these particles lack, or one that needs edges at a
 * curved wall. */
static hd_status check_needs(const hd_scene_def *scene, char *message, size_t size)
{
    const hd_dynamics *of = hd_dynamics_of(scene);
    for (int k = 0; k < LACKS; k++) {
        const char *name = name_of_need(scene, LACKING[k].need & lacking(of));
        if (name)
            return hd_refuse(message, size,
                             "observables = %s: must not be given with particles = %s, %s", name,
                             of->particles, LACKING[k].why);
    }
    const char *of_edges = name_of_need(scene, HD_NEEDS_EDGES);
    if (of_edges && hd_container_of(scene)->wall)
        return hd_refuse(message, size,
                         "observables = %s: must not be given with container = %s: it needs "
                         "the waves of a rectangle",
                         of_edges, hd_container_name(scene));
    return HD_OK;
}

hd_status hd_scene_check(const hd_scene_def *scene, char *message, size_t size)
{
    HD_TRY(hd_scene_check_start(scene, message, size));
    HD_TRY(check_needs(scene, message, size));
    EACH_ASKED(scene, row)
    {
        if (row->check) HD_TRY(row->check(scene, message, size));
    }
    return HD_OK;
}

double hd_observables_apart(const hd_scene_def *scene, unsigned set)
{
    const double report = scene->report_interval, fields = fmax(report, scene->field_interval);
    double apart = INFINITY;
    for (int k = 0; k < HD_OBSERVED; k++) {
        const hd_observable *row = hd_observable_rows[k];
        if (!(set & hd_observable_bits[k])) continue;
        if (row->needs & HD_NEEDS_REPORTS) apart = fmin(apart, report);
        if (row->needs & HD_NEEDS_ALL) apart = fmin(apart, fields);
        if (row->apart) apart = fmin(apart, row->apart(scene));
    }
    return apart;
}
