/** Orthonormalisations of a run -> covariant vectors of its windows. */
#include "run/windows.h"

#include <math.h>

#include "base/check.h"
#include "base/clock.h"
#include "base/memory.h"

static const double GO_SECONDS = 0.1;

hd_status hd_windows_create(hd_windows *windows, const hd_scene_def *scene, hd_ortho *ortho,
                            double longest, int threads, char *message, size_t size)
{
    const size_t vectors = 4 * (size_t)scene->disks * (size_t)hd_scene_vectors(scene);
    HD_TRY(hd_covariant_check_room(scene, longest, message, size));
    HD_TRY(hd_ortho_keep_factor(ortho));
    if (windows->communicator &&
        !(windows->gathered = hd_memory_alloc(vectors, sizeof *windows->gathered)))
        return HD_NO_MEMORY;
    windows->due = true;
    windows->sampling = scene->covariant_sampling;
    return hd_covariant_create(&windows->covariant, scene, threads);
}

void hd_windows_free(hd_windows *windows)
{
    hd_covariant_free(windows->covariant);
    hd_memory_free(windows->gathered);
}

void hd_windows_clear(hd_windows *windows)
{
    hd_covariant_clear(windows->covariant);
    windows->due = true;
}

/** Adds the seconds since then to the cost; what one rank cannot do, none does. */
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
                         const hd_event_log *log, double t_begin, double t_end)
{
    const double start = hd_clock_now();
    const hd_columns none = {NULL, 0, 0, 0};
    const hd_columns vectors = hd_covariant_wants_vectors(windows->covariant)
                                   ? all_of(windows, frame)
                                   : none;
    return timed(windows, start,
                 hd_covariant_add(windows->covariant, ortho, frame, vectors, log, t_begin, t_end));
}

hd_status hd_windows_end(hd_windows *windows, const hd_frame *frame,
                         const hd_trajectory *trajectory)
{
    const double start = hd_clock_now();
    if (!hd_covariant_wants_state(windows->covariant)) return HD_OK;
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

/** By the clock of rank 0. */
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
