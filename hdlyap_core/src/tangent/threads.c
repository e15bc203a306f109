/** Frame -> number of threads. More threads must never make it slower: a pass over a small frame is
 * shorter than the time a thread takes to wake up, and on a busy machine so is one over larger
 * frames. */
#include "tangent/threads.h"

#include <math.h>

#include "base/blas.h"
#include "base/check.h"
#include "base/clock.h"

/** Below the first number of entries a frame uses one thread, above the second all, without a
 * trial. */
static const double ENTRIES_FEW = 1e5, ENTRIES_MANY = 2e6;
/** All threads are used if they are faster than one by this factor. */
static const double WORTH = 1.05;
enum { TRIALS = 3 };

int hd_threads_most(int wanted, int rows, int vectors)
{
    if (wanted > 0) return wanted;
    return (double)rows * vectors < ENTRIES_FEW ? 1 : hd_blas_query().cores;
}

static void use(hd_frame *frame, int threads)
{
    hd_blas_use_threads(threads);
    hd_frame_use_threads(frame, threads);
}

/** Seconds of the shortest of some orthonormalisations. */
static hd_status seconds_of(double *seconds, hd_ortho *ortho, hd_frame *frame, int threads)
{
    const hd_ortho_limits limits = {1e7, 1.0, HD_NORM_FULL};
    *seconds = INFINITY;
    use(frame, threads);
    for (int trial = 0; trial < TRIALS; trial++) {
        const double start = hd_clock_now();
        HD_TRY(hd_ortho_step(ortho, frame, limits));
        *seconds = fmin(*seconds, hd_clock_now() - start);
    }
    return HD_OK;
}

/** Seconds with `most` threads and with one, of an orthonormal frame made for the trial. */
static hd_status try_both(double *all, double *one, hd_ortho *ortho, hd_frame *frame, int most)
{
    HD_TRY(hd_ortho_step(ortho, frame, (hd_ortho_limits){1e7, 1.0, HD_NORM_FULL}));
    HD_TRY(seconds_of(all, ortho, frame, most));
    return seconds_of(one, ortho, frame, 1);
}

hd_status hd_threads_choose(int *threads, hd_ortho *ortho, const hd_scene_def *scene, int vectors,
                            int most)
{
    double all = 0.0, one = 0.0;
    hd_frame *frame;
    *threads = most;
    if (most == 1 ||
        2.0 * hd_dynamics_of(scene)->coordinates * scene->number * vectors > ENTRIES_MANY)
        return HD_OK;
    HD_TRY(hd_frame_create(&frame, scene, vectors, 1, most));
    const hd_status status = try_both(&all, &one, ortho, frame, most);
    hd_frame_free(frame);
    if (status == HD_ILL_CONDITIONED) return HD_OK; /* random vectors are hardly ever dependent */
    if (status == HD_OK && one < WORTH * all) *threads = 1;
    return status;
}
