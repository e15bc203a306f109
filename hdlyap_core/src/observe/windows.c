/** Orthonormalisations of a run -> covariant vectors of its windows: an observable that follows
 * each interval, and stops the run to go back through a window. */
#include "observe/windows.h"

#include <math.h>

#include "averages/doubling.h"
#include "averages/spectrum.h"
#include "base/check.h"
#include "base/clock.h"
#include "base/memory.h"
#include "covariant/covariant.h"
#include "covariant/window_room.h"
#include "modes/fields.h"
#include "modes/modes.h"
#include "scene/scene.h"
#include "tangent/localization.h"

/** A call that goes back begins no further step after this many wall seconds. */
static const double BACK_SECONDS = 0.1;

/** Matrices of n^2 numbers more if spaces are counted, and may be as large as all: of the angles of
 * spaces, of those of two starts, and of these starts. */
static const double COUNTED = 7.0;

/** The observable. */
struct hd_windows {
    hd_covariant *covariant;
    hd_communicator *communicator; /**< NULL: a single rank; every rank does the whole way back */
    double *gathered;              /**< [rows * n], vectors of all ranks; NULL for a single one */
    double sampling;               /**< time from the start of a window to its first sample */
    bool due;                      /**< a window begins with the next interval */
};

/** The vectors of all ranks. */
static hd_columns all_of(hd_windows *windows, const hd_frame *frame)
{
    const int n = hd_frame_vectors(frame);
    if (!windows->communicator) return hd_frame_columns(frame);
    hd_frame_gather(frame, 0, n, windows->gathered);
    return (hd_columns){windows->gathered, n, 0, n};
}

/** Begins a window where the record begins. */
static hd_status begin(hd_windows *windows, const hd_interval_event *p)
{
    const double time = hd_trajectory_time(p->trajectory) - hd_record_duration(p->record);
    windows->due = false;
    return hd_covariant_begin(windows->covariant, time, p->expected);
}

static hd_status add(hd_windows *windows, const hd_interval_event *p)
{
    return hd_covariant_add(windows->covariant, p->ortho, p->frame, p->record, p->from, p->to);
}

static hd_status end(hd_windows *windows, const hd_interval_event *p)
{
    return hd_covariant_state(windows->covariant, all_of(windows, p->frame), p->trajectory);
}

/** The status on which all ranks agree: if one fails, all do. */
static hd_status agreed(const hd_windows *windows, hd_status status)
{
    return hd_communicator_agree(windows->communicator, status);
}

/** Adds intervals to a window; not between a window that is lost or complete and the next one. */
hd_status hd_windows_follow(hd_windows *windows, const hd_interval_event *leg)
{
    if (!windows) return HD_OK;
    if (leg->at == HD_INTERVAL_LOST) windows->due = true;
    if (windows->due)
        return leg->at == HD_INTERVAL_BEGINS ? agreed(windows, begin(windows, leg)) : HD_OK;
    if (leg->at == HD_INTERVAL_PIECE) return agreed(windows, add(windows, leg));
    if (leg->at == HD_INTERVAL_ENDS && hd_covariant_wants_state(windows->covariant))
        return agreed(windows, end(windows, leg));
    return HD_OK;
}

bool hd_windows_begin(const hd_windows *windows) { return windows && windows->due; }

double hd_windows_due(const hd_windows *windows, double now)
{
    if (!windows) return INFINITY;
    const double due = windows->due ? now + windows->sampling
                                    : hd_covariant_due(windows->covariant);
    return due > now ? due : INFINITY;
}

/* ---- the way back -------------------------------------------------------------------------- */

bool hd_windows_are_behind(const hd_windows *windows)
{
    return windows && !windows->due && hd_covariant_is_going_back(windows->covariant);
}

/** True while a call may begin another step, by the clock of rank 0. */
static bool has_time(const hd_windows *windows, double start)
{
    double left = hd_clock_now() - start < BACK_SECONDS;
    hd_communicator_broadcast(windows->communicator, &left, sizeof left);
    return left > 0;
}

hd_status hd_windows_go_back(hd_windows *windows, bool to_its_end)
{
    const double start = hd_clock_now();
    while (hd_windows_are_behind(windows) && (to_its_end || has_time(windows, start)))
        HD_TRY(agreed(windows, hd_covariant_step(windows->covariant)));
    return HD_OK;
}

hd_covariant *hd_windows_covariant(hd_windows *windows) { return windows->covariant; }

/* ---- what is asked for --------------------------------------------------------------------- */

hd_status hd_windows_check_ranks(const hd_scene_def *scene, int ranks, char *message, size_t size)
{
    if (ranks == 1 || hd_scene_carried(scene) == hd_scene_vectors(scene)) return HD_OK;
    if (!hd_observable_is_asked(HD_OBSERVED_covariant, scene)) return HD_OK;
    return hd_refuse(message, size,
                     "ranks = %d: must be 1 for covariant vectors with exponents = all; "
                     "all_independent computes them on several ranks",
                     ranks);
}

hd_status hd_windows_check_memory(const hd_scene_def *scene, double longest, char *message,
                                  size_t size)
{
    if (!hd_observable_is_asked(HD_OBSERVED_covariant, scene)) return HD_OK;
    return hd_window_check_memory(scene, longest, message, size);
}

/* ---- as an observable ---------------------------------------------------------------------- */

/** Bytes without the windows, which covariant_memory limits: triangles of two passes, both starts
 * of the way back with their workspace, vectors of a sample, and averages. */
static double covariant_bytes(const hd_scene_def *scene, int ranks)
{
    const double n = hd_scene_vectors(scene), carried = hd_scene_carried(scene),
                 vectors = 2.0 * hd_scene_coordinates(scene) * scene->number * n;
    const double factors = 2.0 * carried * carried, ways = (carried < n ? 8.25 : 5.0) * n * n;
    const double gathered = ranks > 1 ? vectors : 0.0;
    const double counted = hd_scene_symplectic(scene) ? 0.0 : COUNTED * n * n + 4.0 * vectors;
    const double weights = hd_scene_dimension(scene) > 0 ? 3.0 * hd_modes_bytes(scene, n) : 0.0;
    return sizeof(double) * (factors + ways + vectors + gathered + counted) + weights +
           hd_spectrum_bytes(n) + hd_localization_bytes(n) +
           hd_doubling_bytes((hd_doubling_def){.vectors = (int)n});
}

static hd_status covariant_check(const hd_scene_def *scene, char *message, size_t size)
{
    const double window = scene->covariant_window, transient = scene->covariant_transient;
    if (hd_scene_positive_exponents(scene) < 1)
        return hd_refuse(
            message, size,
            "observables = covariant: must not be given with number = %d, which has no "
            "unstable vector",
            scene->number);
    if (scene->covariant_sampling > window)
        return hd_refuse(message, size,
                         "covariant_sampling = %.15g: must be from 1e-6 to covariant_window",
                         scene->covariant_sampling);
    if (!(hd_scene_warmup(scene) >= transient))
        return hd_refuse(message, size,
                         "warmup = %.15g: must be at least covariant_transient = %.15g: vectors "
                         "converge forwards no faster than backwards",
                         scene->warmup, transient);
    if (scene->duration > 0 && !(scene->duration >= window + transient))
        return hd_refuse(message, size,
                         "duration = %.15g: must be 0 or at least covariant_window + "
                         "covariant_transient = %.15g",
                         scene->duration, window + transient);
    return HD_OK;
}

static void covariant_extend(hd_result_counts *extent, const hd_scene_def *scene, const void *self)
{
    const int known = hd_scene_symplectic(scene)
                          ? hd_scene_positive_exponents(scene) + hd_scene_zero_exponents(scene)
                          : 0;
    (void)self;
    extent->subspaces = (int)hd_fields_count_of(scene).subspaces;
    if (extent->vectors > known) extent->angles = HD_PAIRS_OF_SPACES;
    extent->orders = 1 + (int)log2(scene->covariant_window / scene->covariant_sampling);
}

static hd_status prepare(hd_windows *windows, const hd_observing *with)
{
    const size_t vectors = 2 * (size_t)hd_scene_coordinates(with->scene) *
                           (size_t)with->scene->number * (size_t)with->vectors;
    HD_TRY(hd_ortho_keep_factor(with->ortho));
    if (with->communicator &&
        !(windows->gathered = hd_memory_alloc(vectors, sizeof *windows->gathered)))
        return HD_NO_MEMORY;
    windows->communicator = with->communicator;
    windows->due = true;
    windows->sampling = with->scene->covariant_sampling;
    return hd_covariant_create(&windows->covariant, with->scene, with->spectrum, with->threads);
}

static void covariant_free(void *self)
{
    hd_windows *windows = self;
    hd_covariant_free(windows->covariant);
    hd_memory_free(windows->gathered);
    hd_memory_free(windows);
}

/** Creates it; if one part cannot be created, the caller frees all. */
static void *covariant_create(const hd_observing *with, hd_status *status)
{
    hd_windows *windows = hd_memory_alloc(1, sizeof *windows);
    *status = windows ? prepare(windows, with) : HD_NO_MEMORY;
    return windows;
}

static void covariant_resume(void *self, const hd_moment *now)
{
    (void)now;
    ((hd_windows *)self)->due = true;
}

static void covariant_clear(void *self, const hd_moment *now)
{
    hd_covariant_clear(((hd_windows *)self)->covariant, hd_trajectory_time(now->trajectory));
    covariant_resume(self, now);
}

static void covariant_archive(void *self, const hd_moment *now)
{
    hd_covariant_archive(((hd_windows *)self)->covariant, now->archive);
}

const hd_observable hd_covariant_row = {.needs = HD_NEEDS_FRAME | HD_NEEDS_WHOLE,
                                        .bytes = covariant_bytes,
                                        .extend = covariant_extend,
                                        .check = covariant_check,
                                        .create = covariant_create,
                                        .free = covariant_free,
                                        .clear = covariant_clear,
                                        .resume = covariant_resume,
                                        .archive = covariant_archive};
