/** A disk's state -> its next meeting with a round wall [T21]. One thread. */
#include "dynamics/hard/round_wall.h"

#include <math.h>

#include "dynamics/hard/contact.h"
#include "scene/scene.h"

/** A disk that glides along the wall leaves it at least so fast, as a part of its speed: or it
 * would meet the wall again within rounding of the time, for ever. It changes its energy by 1e-14.
 */
static const double GLIDE = 1e-7;

hd_round_wall hd_round_wall_of(const hd_scene_def *def)
{
    double box[HD_DIM];
    hd_scene_box(def, box);
    const bool is_round = hd_scene_boundary(def, 0) == HD_CURVED;
    return is_round ? (hd_round_wall){0.5 * box[0], 0.5 * box[0] - 0.5} : (hd_round_wall){0.0, 0.0};
}

/** From the centre to q; returns its length. */
static double from_centre(double r[HD_DIM], const hd_round_wall *wall, const double q[HD_DIM])
{
    for (int d = 0; d < HD_DIM; d++) r[d] = q[d] - wall->centre;
    return sqrt(hd_contact_dot(r, r));
}

double hd_round_wall_excess(const hd_round_wall *wall, const double q[HD_DIM])
{
    double r[HD_DIM];
    return from_centre(r, wall, q) - wall->reach;
}

/** |r + p s| = reach: the later root s, by the sum that does not cancel. p^2 reach^2 - (r x p)^2 is
 * the square of r.p at the wall; a disk there within rounding has it by r.p itself. */
double hd_round_wall_time(const hd_round_wall *wall, const hd_disk *disk)
{
    double at[HD_DIM];
    const double r = from_centre(at, wall, disk->q), rp = hd_contact_dot(at, disk->p);
    const double p2 = hd_contact_dot(disk->p, disk->p);
    const double room = (wall->reach - r) * (wall->reach + r);
    const double square = rp * rp + p2 * room, root = sqrt(square > 0 ? square : 0.0);
    const double wait = rp > 0 ? room / (rp + root) : (root - rp) / p2;
    return p2 > 0 ? disk->t + (wait > 0 ? wait : 0.0) : INFINITY;
}

bool hd_round_wall_reflect(const hd_round_wall *wall, hd_disk *disk, hd_event *event)
{
    double r[HD_DIM];
    const double distance = from_centre(r, wall, disk->q);
    const double speed = sqrt(hd_contact_dot(disk->p, disk->p));
    event->j = HD_WALL_ROUND;
    for (int d = 0; d < HD_DIM; d++) {
        event->n[d] = wall->reach * (r[d] / distance);
        event->p[d] = disk->p[d];
        disk->q[d] = wall->centre + event->n[d]; /* there within rounding: no drift */
    }
    const double along = hd_contact_dot(event->n, event->p);
    const double outwards = along / wall->reach, size = outwards > 0 ? outwards : -outwards;
    const double inwards = size > GLIDE * speed ? size : GLIDE * speed;
    for (int d = 0; d < HD_DIM; d++) disk->p[d] -= (outwards + inwards) * (r[d] / distance);
    return along > 0;
}
