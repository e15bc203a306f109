/** Trajectory -> event log, a step at a time: short enough for its log and for whoever waits. */
#include "advance.h"

#include <float.h>
#include <math.h>

#include "check.h"
#include "clock.h"
#include "verify.h"

static const double EVENTS_PER_STEP = 200000.0; /* bounds memory, and the wait for an answer */
/** No step is planned shorter: simulated time must move. */
static const double STEP_MIN = 1e-12;

/** Pair and wall events of one disk per time unit, roughly: momenta across a box are about 1. */
static double events_per_disk(const hd_run *run, double collisions_per_disk)
{
    double box[2], rate = collisions_per_disk;
    hd_scene_box(&run->scene, box);
    for (int d = 0; d < 2; d++)
        if (run->scene.boundary[d] == HD_REFLECTING) rate += 1.0 / (box[d] - 1.0);
    return rate;
}

double hd_run_step_bound(const hd_run *run)
{
    const double rate = hd_trajectory_collision_rate(run->trajectory), disks = run->scene.disks;
    return 8.0 * EVENTS_PER_STEP / (disks * events_per_disk(run, 2.0 * rate / disks));
}

void hd_advance_first(hd_run *run, double collisions_per_disk)
{
    run->step_max = 1e-3 / events_per_disk(run, collisions_per_disk);
}

static uint64_t events_so_far(const hd_run *run)
{
    return hd_trajectory_collisions(run->trajectory) + hd_trajectory_wall_events(run->trajectory);
}

double hd_advance_shortest(const hd_run *run) { return STEP_MIN + 4.0 * DBL_EPSILON * run->now; }

double hd_advance_longest(const hd_run *run)
{
    return fmax(run->step_max, hd_advance_shortest(run));
}

void hd_advance_plan(hd_run *run, double stop)
{
    const double left = stop - run->now, most = hd_advance_longest(run);
    const double end = left <= most ? stop : run->now + left / ceil(left / most);
    run->plan = (hd_step_plan){.begin = run->now, .end = end, .events = events_so_far(run)};
}

/** How long a step may be: a channel of hardly more than a disk's width can have 1e9 wall events in
 * a time unit. */
static void learn_step(hd_run *run)
{
    const double length = run->plan.end - run->plan.begin;
    const double events = fmax(1.0, (double)(events_so_far(run) - run->plan.events));
    if (length > 0)
        run->step_max = fmin(4.0 * fmax(length, run->step_max / 4.0),
                             length * EVENTS_PER_STEP / events);
}

hd_status hd_advance(hd_run *run, hd_event_log *log)
{
    const double start = hd_clock_now(), left = run->plan.end - run->now;
    const double most = fmax(run->watch.interval, hd_advance_shortest(run));
    const double end = left <= most ? run->plan.end : run->now + left / ceil(left / most);
    HD_TRY(hd_trajectory_extend(run->trajectory, log, end));
    run->now = end;
    if (end >= run->plan.end) learn_step(run);
    run->cost.events += hd_clock_now() - start;
    if (HD_VERIFIES) hd_verify_disks(run->trajectory, &run->scene);
    if (HD_VERIFIES && log) hd_verify_log(log, run->scene.disks);
    return HD_OK;
}
