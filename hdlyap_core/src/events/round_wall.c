/** A disk's state -> its next meeting with a round wall [T21]. One thread. */
#include "events/round_wall.h"

#include <math.h>

#include "scene/circle.h"

/** A disk that glides along the wall leaves it at least so fast, as a part of its speed: or it
 * would meet the wall again within rounding of the time, for ever. It changes its energy by 1e-14.
 */
static const double GLIDE = 1e-7;

hd_round_wall hd_round_wall_of(const hd_scene_def *def)
{
    const double radius = hd_circle_radius(def);
    const bool is_round = hd_scene_boundary(def, 0) == HD_CURVED;
    return is_round ? (hd_round_wall){radius, radius - 0.5} : (hd_round_wall){0.0, 0.0};
}

double hd_round_wall_excess(const hd_round_wall *wall, const double q[HD_DIM])
{
    const double x = q[0] - wall->centre, y = q[1] - wall->centre;
    return sqrt(x * x + y * y) - wall->reach;
}

/** |r + p s| = reach: the later root s, by the sum that does not cancel. p^2 reach^2 - (r x p)^2 is
 * the square of r.p at the wall; a disk there within rounding has it by r.p itself. */
double hd_round_wall_time(const hd_round_wall *wall, const hd_disk *disk)
{
    const double x = disk->q[0] - wall->centre, y = disk->q[1] - wall->centre;
    const double px = disk->p[0], py = disk->p[1];
    const double rp = x * px + y * py, p2 = px * px + py * py, r = sqrt(x * x + y * y);
    const double room = (wall->reach - r) * (wall->reach + r);
    const double square = rp * rp + p2 * room, root = sqrt(square > 0 ? square : 0.0);
    const double wait = rp > 0 ? room / (rp + root) : (root - rp) / p2;
    return p2 > 0 ? disk->t + (wait > 0 ? wait : 0.0) : INFINITY;
}

bool hd_round_wall_reflect(const hd_round_wall *wall, hd_disk *disk, hd_event *event)
{
    const double r[HD_DIM] = {disk->q[0] - wall->centre, disk->q[1] - wall->centre};
    const double distance = sqrt(r[0] * r[0] + r[1] * r[1]);
    const double speed = sqrt(disk->p[0] * disk->p[0] + disk->p[1] * disk->p[1]);
    event->j = HD_WALL_ROUND;
    for (int d = 0; d < HD_DIM; d++) {
        event->n[d] = wall->reach * (r[d] / distance);
        event->p[d] = disk->p[d];
        disk->q[d] = wall->centre + event->n[d]; /* there within rounding: no drift */
    }
    const double along = event->n[0] * event->p[0] + event->n[1] * event->p[1];
    const double outwards = along / wall->reach, size = outwards > 0 ? outwards : -outwards;
    const double inwards = size > GLIDE * speed ? size : GLIDE * speed;
    for (int d = 0; d < HD_DIM; d++) disk->p[d] -= (outwards + inwards) * (r[d] / distance);
    return along > 0;
}
