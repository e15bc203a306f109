/** What rounding does to a long trajectory: energy, momentum and overlap after ever more collisions
 * of disks in a periodic box. Usage: hdlyap_endurance [--collisions N] [--disks N] [--density RHO]
 * [--out FOLDER] [--quick]; 1e9 collisions, 1e6 if quick; writes endurance.csv. */
#include <hdlyap/hdlyap.h>
#include <math.h>
#include <stdio.h>

#include "gemm.h"
#include "options.h"
#include "events/trajectory_state.h"
#include "progress.h"
#include "table.h"
#include "timing.h"

static const double ROW_FIRST = 1e4, COLLISIONS_QUICK = 1e6, COLLISIONS_MAX = 1e12;
static const double COLLISIONS_PER_LOOK = 1000.0;

typedef struct asked {
    int disks;
    double density, collisions;
    const char *out;
} asked;

/** The largest seen so far. */
typedef struct course {
    hd_trajectory *trajectory;
    double energy_at_start;
    double energy;   /**< |K / K_start - 1| */
    double momentum; /**< component of the total momentum, per disk */
    double
        overlap; /**< of any two disks, and of the two about to collide, at their contact [sigma] */
} course;

/* ---- measuring ----------------------------------------------------------------------------- */

/** NaN stays. */
static void raise(double *worst, double seen)
{
    if (!(seen <= *worst) && !isnan(*worst)) *worst = seen;
}

/** How deep the next two disks to collide are in each other when they do; 0 if the next event is no
 * contact. */
static double overlap_at_contact(hd_trajectory *tr)
{
    const int32_t i = hd_queue_next(&tr->motion.queue);
    if (i < 0 || hd_queue_kind(tr->motion.queue.entry[i].key.order) != PAIR) return 0.0;
    const prediction *next = &tr->motion.predicted[i];
    const hd_disk *a = &tr->motion.disk[i], *b = &tr->motion.disk[next->partner];
    if (next->partner_collisions != b->collisions) return 0.0;
    const double shift[HD_DIM] = {next->image[0] * tr->motion.cells.box[0],
                                  next->image[1] * tr->motion.cells.box[1]};
    double r[HD_DIM];
    hd_contact_separation(r, a, b, shift, tr->motion.queue.entry[i].key.t);
    return 1.0 - sqrt(hd_contact_dot(r, r));
}

static void look(course *c)
{
    const int n = hd_trajectory_disks(c->trajectory);
    double sum[2];
    hd_trajectory_momentum(c->trajectory, sum);
    for (int d = 0; d < 2; d++) raise(&c->momentum, fabs(sum[d]) / n);
    raise(&c->energy, fabs(hd_trajectory_kinetic_energy(c->trajectory) / c->energy_at_start - 1.0));
    raise(&c->overlap, hd_trajectory_overlap(c->trajectory));
    raise(&c->overlap, overlap_at_contact(c->trajectory));
}

/* ---- telling ------------------------------------------------------------------------------- */

static double collisions_of(const course *c)
{
    return (double)hd_trajectory_collisions(c->trajectory);
}

static void tell(const course *c, table *t)
{
    const double time = hd_trajectory_time(c->trajectory);
    printf("%14.0f %12.6g %12.2e %14.2e %12.2e\n", collisions_of(c), time, c->energy, c->momentum,
           c->overlap);
    fflush(stdout);
    table_row(t, "%.0f,%.10g,%.6g,%.6g,%.6g", collisions_of(c), time, c->energy, c->momentum,
              c->overlap);
}

/** 1, 2, 5, 10 .. times the first. */
static double row_after(double collisions)
{
    const double mantissa = collisions / pow(10.0, floor(log10(collisions * 1.01)));
    return mantissa < 1.5 ? 2.0 * collisions : mantissa < 3.0 ? 2.5 * collisions : 2.0 * collisions;
}

static void follow(course *c, const asked *a, table *t)
{
    const double piece = COLLISIONS_PER_LOOK / hd_trajectory_collision_rate(c->trajectory);
    double next = fmin(ROW_FIRST, a->collisions);
    progress shown = progress_begin("endurance", a->collisions);
    while (collisions_of(c) < a->collisions) {
        require(
            hd_trajectory_extend(c->trajectory, NULL, hd_trajectory_time(c->trajectory) + piece),
            "trajectory");
        look(c);
        progress_add(&shown, collisions_of(c) - shown.done);
        if (collisions_of(c) < next) continue;
        tell(c, t);
        next = next < a->collisions ? fmin(row_after(next), a->collisions) : INFINITY;
    }
    progress_end();
}

static void endure(const asked *a, char **argv)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.disks = a->disks;
    scene.density = a->density;
    scene.aspect = 1.0;
    scene.exponents = HD_EXPONENTS_NONE;
    char message[256] = "out of memory";
    if (hd_scene_check(&scene, message, sizeof message) != HD_OK) {
        fprintf(stderr, "hdlyap_endurance: %s\n", message);
        exit(2);
    }
    course c = {0};
    require(hd_trajectory_create(&c.trajectory, &scene), "trajectory");
    c.energy_at_start = hd_trajectory_kinetic_energy(c.trajectory);
    table *t = table_create(a->out, "endurance",
                            "collisions,simulated time [time units],relative energy deviation,"
                            "momentum [per disk],overlap [sigma]");
    printf("%d disks, density %g, periodic; the largest so far\n%14s %12s %12s %14s %12s\n",
           a->disks, a->density, "collisions", "time", "energy", "momentum/disk", "overlap");
    follow(&c, a, t);
    table_write(t, argv, gemm_once());
    hd_trajectory_free(c.trajectory);
}

int main(int argc, char **argv)
{
    asked a = {.disks = 100, .density = 0.7, .collisions = 1e9, .out = "."};
    bool quick = false;
    const option list[] = {
        {"--collisions", .number = &a.collisions, .least = 1, .most = COLLISIONS_MAX},
        {"--disks", .count = &a.disks, .least = 2, .most = 1e6},
        {"--density", .number = &a.density, .least = 1e-6, .most = 1.1547},
        {"--out", .text = &a.out},
        {"--quick", .flag = &quick},
        {0}};
    options_read(argc, argv, list);
    if (quick) a.collisions = fmin(a.collisions, COLLISIONS_QUICK);
    endure(&a, argv);
    return 0;
}
