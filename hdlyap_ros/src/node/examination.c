/** Overlap and energy, and what rounding makes of both. */
#include "examination.h"

#include <float.h>
#include <math.h>

/** Times are kept relative to an epoch, which lasts some 32 to 64 collisions of a disk, in a thin
 * gas less. */
static const double epoch_collisions = 64.0, epoch_longest = 32768.0;
/** Of two disks, relative [sigma/time unit]; the mean square of a momentum is 2. */
static const double speed_max = 16.0;
/** Some roundings of eps/2 in positions, times and images on the way to a contact. */
static const double roundings = 16.0;

/** Positions are of the order of the box, and those of a contact as exact as its time. */
static double overlap_of_rounding(const hd_trajectory *trajectory)
{
    double box[2];
    hd_trajectory_box(trajectory, box);
    const double per_disk = 2.0 * hd_trajectory_collision_rate(trajectory) /
                            hd_trajectory_disks(trajectory);
    const double epoch = fmin(epoch_collisions / per_disk, epoch_longest);
    return roundings * DBL_EPSILON * (fmax(box[0], box[1]) + speed_max * epoch);
}

examination examine(const hd_trajectory *trajectory)
{
    const double disks = hd_trajectory_disks(trajectory);
    return (examination){
        .made = true,
        .overlap = hd_trajectory_overlap(trajectory),
        .overlap_max = overlap_of_rounding(trajectory),
        .energy_error = fabs(hd_trajectory_kinetic_energy(trajectory) - disks) / disks,
        .energy_error_max = hd_trajectory_energy_rounding(trajectory),
    };
}
