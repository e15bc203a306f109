/** State of a disk at a curved wall -> its state afterwards, and the event [T21]. */
#include "dynamics/hard/round_wall.h"

#include <math.h>

#include "dynamics/hard/contact.h"

/** Least speed away from the wall, over the speed of the disk, after a reflection. A disk that
 * glides along the wall would otherwise meet it again within the rounding of time, forever. The
 * energy changes by 1e-14 of it. */
static const double GLIDE = 1e-7;

bool hd_round_wall_reflect(const hd_wall *wall, hd_disk *disk, hd_event *event)
{
    double n[HD_DIM] = {0.0};
    const double radius = wall->meet(wall, disk->q, n); /* so that rounding never adds up */
    const double speed = sqrt(hd_contact_dot(disk->p, disk->p));
    event->j = HD_WALL_ROUND;
    for (int d = 0; d < HD_DIM; d++) {
        event->n[d] = radius * n[d];
        event->p[d] = disk->p[d];
    }
    const double along = hd_contact_dot(event->n, event->p);
    const double outwards = along / radius, size = outwards > 0 ? outwards : -outwards;
    const double inwards = size > GLIDE * speed ? size : GLIDE * speed;
    for (int d = 0; d < HD_DIM; d++) disk->p[d] -= (outwards + inwards) * n[d];
    return along > 0;
}
