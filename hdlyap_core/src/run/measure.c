/** Orthonormal frame -> what is observed of it, whoever carries its vectors. */
#include "run/measure.h"

#include "base/check.h"
#include "base/clock.h"
#include "run/ranks.h"

/** The modes of the vectors that this rank has, and of their partners. */
static hd_status measure_here(hd_run *run)
{
    const hd_columns own = hd_frame_columns(run->frame);
    const hd_trajectory *disks = run->advance.trajectory;
    if (!run->communicator)
        return hd_observer_measure(&run->observer, run->observe, hd_run_frame_columns(run), disks);
    HD_TRY(hd_observer_measure(&run->observer, run->observe, own, disks));
    if (!run->conjugate) return HD_OK;
    return hd_observer_measure(&run->observer, run->observe,
                               hd_conjugate_partners(run->conjugate, own), disks);
}

hd_status hd_run_measure(hd_run *run)
{
    const double start = hd_clock_now();
    HD_TRY(hd_run_agree(run, measure_here(run)));
    HD_TRY(hd_observer_share(&run->observer, run->observe, run->communicator,
                             hd_frame_stride(run->frame), run->carried));
    if (run->communicator) run->observer.known.count = run->vectors; /* alike, whoever has them */
    run->cost.modes += hd_clock_now() - start;
    return HD_OK;
}

void hd_run_follow_phases(hd_run *run)
{
    hd_observer_follow(&run->observer, run->observe, hd_run_time(run));
    run->followed = hd_run_time(run);
}

hd_status hd_run_measure_and_add(hd_run *run)
{
    HD_TRY(hd_run_measure(run));
    const double start = hd_clock_now();
    hd_observer_add(&run->observer, run->observe);
    hd_steps_find(run->observer.steps, run->spectrum);
    if (run->observe & HD_OBSERVE_OF_PHASES) hd_run_follow_phases(run);
    HD_TRY(hd_run_gather(run));
    run->cost.modes += hd_clock_now() - start;
    return HD_OK;
}
