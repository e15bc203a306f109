/** Orthonormal frame -> widths of all vectors, whoever carries them. */
#include "run/localize.h"

#include "base/check.h"
#include "base/clock.h"
#include "run/factorise.h"

hd_status hd_run_localize_from(hd_run *run)
{
    if (!(run->scene.observe & HD_OBSERVE_LOCALIZATION)) return HD_OK;
    return hd_localization_create(&run->shape, run->scene.disks, run->vectors, run->threads);
}

/** Turned by J a vector lies on the same disks [T19]. */
static void complete(double *measured, int vectors, int carried)
{
    for (int col = carried; col < vectors; col++) measured[col] = measured[vectors - 1 - col];
}

hd_status hd_run_localize(hd_run *run)
{
    const double start = hd_clock_now();
    const size_t n = (size_t)run->vectors;
    const hd_shared shared = {2, n, (size_t)hd_frame_stride(run->frame), (size_t)run->carried, 0};
    const hd_columns here = hd_frame_columns(run->frame);
    if (!hd_run_is_localizing(run)) return HD_OK;
    if (here.count > 0) hd_localization_measure(run->shape, here);
    double *measured = hd_localization_measured(run->shape);
    HD_TRY(hd_communicator_share(run->communicator, measured, shared));
    for (int k = 0; k < 2; k++) complete(measured + (size_t)k * n, run->vectors, run->carried);
    hd_localization_add(run->shape);
    run->cost.modes += hd_clock_now() - start;
    return HD_OK;
}
