/** Orthonormalisations of a run -> covariant vectors of its windows. */
#include "observe/windows.h"

#include <math.h>

#include "averages/archived.h"
#include "base/check.h"
#include "base/clock.h"
#include "base/memory.h"
#include "covariant/archived.h"
#include "covariant/covariant.h"
#include "modes/archived.h"
#include "observe/observable.h"
#include "scene/scene.h"
#include "tangent/archived.h"

/** Wall seconds after which no further step of the way back begins in a call. */
static const double GO_SECONDS = 0.1;

struct hd_windows {
    hd_covariant *covariant;
    hd_communicator *communicator; /**< NULL: a single rank; all of them go the same way back */
    double *gathered;              /**< [rows * n], vectors of all ranks; NULL of a single one */
    double sampling;               /**< from the beginning of a window to its first look */
    bool due;                      /**< a window begins with the next interval */
    double seconds;                /**< wall seconds spent here */
};

double *hd_windows_seconds(hd_windows *windows) { return &windows->seconds; }
void hd_windows_lose(hd_windows *windows) { windows->due = true; }
bool hd_windows_begins(const hd_windows *windows) { return windows->due; }

/** Adds the seconds since `start` to the cost; what one rank cannot do, none does. */
static hd_status timed(hd_windows *windows, double start, hd_status status)
{
    status = hd_communicator_agree(windows->communicator, status);
    windows->seconds += hd_clock_now() - start;
    return status;
}

/** Vectors of all ranks. */
static hd_columns all_of(hd_windows *windows, const hd_frame *frame)
{
    const int n = hd_frame_vectors(frame);
    if (!windows->communicator) return hd_frame_columns(frame);
    hd_frame_gather(frame, 0, n, windows->gathered);
    return (hd_columns){windows->gathered, n, 0, n};
}

hd_status hd_windows_start(hd_windows *windows, const hd_frame *frame, double begin,
                           double expected)
{
    const double start = hd_clock_now();
    if (!windows->due) return HD_OK;
    windows->due = false;
    return timed(windows, start,
                 hd_covariant_begin(windows->covariant, all_of(windows, frame), begin, expected));
}

hd_status hd_windows_add(hd_windows *windows, const hd_ortho *ortho, const hd_frame *frame,
                         const hd_record *record, double t_begin, double t_end)
{
    const double start = hd_clock_now();
    const hd_columns none = {NULL, 0, 0, 0};
    if (windows->due) return HD_OK;
    const hd_columns vectors = hd_covariant_wants_vectors(windows->covariant)
                                   ? all_of(windows, frame)
                                   : none;
    return timed(
        windows, start,
        hd_covariant_add(windows->covariant, ortho, frame, vectors, record, t_begin, t_end));
}

hd_status hd_windows_end(hd_windows *windows, const hd_frame *frame,
                         const hd_trajectory *trajectory)
{
    const double start = hd_clock_now();
    if (windows->due || !hd_covariant_wants_state(windows->covariant)) return HD_OK;
    return timed(windows, start,
                 hd_covariant_state(windows->covariant, all_of(windows, frame), trajectory));
}

double hd_windows_due(const hd_windows *windows, double now)
{
    return windows->due ? now + windows->sampling : hd_covariant_due(windows->covariant);
}

bool hd_windows_is_going(const hd_windows *windows)
{
    return !windows->due && hd_covariant_is_going_back(windows->covariant);
}

/** True while a call may take another step, by the clock of rank 0. */
static bool has_time(const hd_windows *windows, double start)
{
    double left = hd_clock_now() - start < GO_SECONDS;
    hd_communicator_broadcast(windows->communicator, &left, sizeof left);
    return left > 0;
}

hd_status hd_windows_go(hd_windows *windows, bool to_its_end)
{
    const double start = hd_clock_now();
    hd_status status = HD_OK;
    while (status == HD_OK && hd_windows_is_going(windows) &&
           (to_its_end || has_time(windows, start)))
        status = hd_communicator_agree(windows->communicator,
                                       hd_covariant_step(windows->covariant));
    return timed(windows, start, status);
}

/* ---- as an observable ---------------------------------------------------------------------- */

/** Beside the windows themselves, which have a limit of their own (covariant_memory): triangles of
 * two passes, both ways back with their work, vectors of a look, and what is averaged. */
static double covariant_bytes(const hd_scene_def *scene, int ranks)
{
    const double n = hd_scene_vectors(scene), carried = hd_scene_carried(scene),
                 vectors = 2.0 * hd_scene_coordinates(scene) * scene->disks * n;
    const double factors = 2.0 * carried * carried, ways = (carried < n ? 8.25 : 5.0) * n * n;
    const double gathered = ranks > 1 ? vectors : 0.0;
    return sizeof(double) * (factors + ways + vectors + gathered) + 3.0 * hd_modes_bytes(scene, n) +
           hd_spectrum_bytes(n) + hd_localization_bytes(n);
}

static hd_status prepare(hd_windows *windows, const hd_observing *with)
{
    const size_t vectors = 2 * (size_t)hd_scene_coordinates(with->scene) *
                           (size_t)with->scene->disks * (size_t)with->vectors;
    HD_TRY(hd_covariant_check_room(with->scene, with->longest, with->message, with->size));
    HD_TRY(hd_ortho_keep_factor(with->ortho));
    if (with->communicator &&
        !(windows->gathered = hd_memory_alloc(vectors, sizeof *windows->gathered)))
        return HD_NO_MEMORY;
    windows->communicator = with->communicator;
    windows->due = true;
    windows->sampling = with->scene->covariant_sampling;
    return hd_covariant_create(&windows->covariant, with->scene, with->threads);
}

static void covariant_free(void *self)
{
    hd_windows *windows = self;
    hd_covariant_free(windows->covariant);
    hd_memory_free(windows->gathered);
    hd_memory_free(windows);
}

/** Its parts are freed with it if they cannot all be made. */
static void *covariant_create(const hd_observing *with, hd_status *status)
{
    hd_windows *windows = hd_memory_alloc(1, sizeof *windows);
    *status = windows ? prepare(windows, with) : HD_NO_MEMORY;
    return windows;
}

static void covariant_resume(void *self) { ((hd_windows *)self)->due = true; }

static void covariant_clear(void *self, const hd_view *here)
{
    (void)here;
    hd_covariant_clear(((hd_windows *)self)->covariant);
    covariant_resume(self);
}

static void covariant_archive(void *self, hd_archive *archive, const hd_trajectory *now)
{
    (void)now;
    hd_covariant_archive(((hd_windows *)self)->covariant, archive);
}

static void *covariant_result(void *self) { return ((hd_windows *)self)->covariant; }

const hd_observable hd_covariant_row = {.needs = HD_NEEDS_FRAME,
                                        .bytes = covariant_bytes,
                                        .create = covariant_create,
                                        .free = covariant_free,
                                        .clear = covariant_clear,
                                        .resume = covariant_resume,
                                        .archive = covariant_archive,
                                        .result = covariant_result};
