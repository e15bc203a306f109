/** Run -> errors of its particles' state. */
#include "examination.h"

#include <math.h>

examination examination_of(const hd_run *run)
{
    if (!hd_dynamics_of(hd_run_scene(run))->examine) return (examination){.made = false};
    const hd_trajectory *trajectory = hd_run_parts(run).trajectory;
    const hd_invariants now = hd_trajectory_examined(trajectory);
    return (examination){
        .made = true,
        .overlap = now.overlap,
        .overlap_max = now.overlap_rounding,
        .energy_error = fabs(now.energy_error),
        .energy_error_max = now.energy_rounding,
    };
}
