/** Measures what a time step of soft particles costs: moving the particles, making the maps, and
 * carrying tangent vectors, half of all, through the maps. It compares the last with a floor, the
 * time that dgemm takes for as many flops: for each vector and pair in d dimensions d differences,
 * d (2 d - 1) flops for a matrix times them, and 2 d sums; for each vector and particle 2 d, for
 * its flight; so 2 d (d + 1) pairs + 2 d N per vector. It counts processor time of one thread, so
 * that other jobs' time does not count, and prints the least of all rounds. Each round goes through
 * all rows. Usage: hdlyap_steps [--rounds N] */
#include <math.h>
#include <time.h>

#include "base/blas.h"
#include "base/random.h"
#include "dynamics/create_from.h"
#include "dynamics/dynamics.h"
#include "dynamics/trajectory.h"
#include "gemm.h"
#include "options.h"
#include "sample.h"
#include "scene/scene.h"
#include "tangent/frame.h"
#include "timing.h"

enum { STEPS = 200 };
static const double STEP = 0.002, SETTLING = 3.0;

static const struct {
    int particles, number;
    double density;
    int potential; /**< value of the scene's parameter `potential` */
    const char *name;
} rows[] = {{HD_SOFT_DISKS, 400, 0.2, 1, "wca"},
            {HD_SOFT_DISKS, 400, 0.7, 1, "wca"},
            {HD_SOFT_DISKS, 1600, 0.7, 1, "wca"},
            {HD_SOFT_DISKS, 400, 0.7, 2, "lennard_jones"},
            {HD_SOFT_DISKS, 1600, 0.7, 2, "lennard_jones"},
            {HD_SOFT_SPHERES, 343, 0.7, 0, "power"},
            {HD_SOFT_SPHERES, 343, 0.7, 1, "wca"},
            {HD_SOFT_SPHERES, 343, 0.7, 2, "lennard_jones"}};
enum { ROWS = sizeof rows / sizeof *rows };

typedef struct measured {
    hd_scene_def scene;
    hd_trajectory *trajectory;
    hd_record *record;
    hd_frame *frame;
    void *maps;
    sample stepping, making, carrying; /**< time per time step [s] */
} measured;

/** Processor time of this process, which has one thread [s]. */
static double busy_seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }

static hd_scene_def scene_of(int row)
{
    const hd_scene_def core = {.particles = (hd_particles)rows[row].particles};
    hd_scene_def scene = hd_scene_def_of(hd_dynamics_of(&core));
    scene.number = rows[row].number;
    scene.density = rows[row].density;
    scene.aspect = 1.0;
    scene.own[0].whole = rows[row].potential;
    scene.own[2].real = STEP;
    scene.own[3].whole = 0; /* verlet: one kick */
    return scene;
}

static void swap(double *a, double *b, int count)
{
    for (int k = 0; k < count; k++) {
        const double held = a[k];
        a[k] = b[k];
        b[k] = held;
    }
}

/** Numbers the particles at random, as in a long run, in which a fluid mixes and the numbers of
 * neighbours are unrelated. */
static void mix(measured *m)
{
    const int d = hd_scene_dimension(&m->scene), number = m->scene.number;
    double *q = room((size_t)(2 * d * number), sizeof *q), *p = q + d * number;
    hd_random random = hd_random_seeded(1, 0);
    hd_trajectory_state(m->trajectory, q, p);
    for (int i = 1; i < number; i++) {
        const int j = (int)(fabs(hd_random_symmetric(&random)) * (i + 1)) % (i + 1);
        swap(q + d * i, q + d * j, d);
        swap(p + d * i, p + d * j, d);
    }
    hd_trajectory_free(m->trajectory);
    void *state;
    require(hd_soft_create_from(&state, &m->scene, q, p), "trajectory");
    require(hd_trajectory_create_with(&m->trajectory, &m->scene, state), "trajectory");
    free(q);
}

static void begin(measured *m, int row)
{
    const hd_scene_def scene = m->scene = scene_of(row);
    const hd_dynamics *of = hd_dynamics_of(&scene);
    const int half = of->coordinates * scene.number;
    require(hd_trajectory_create(&m->trajectory, &scene), "trajectory");
    require(hd_trajectory_extend(m->trajectory, NULL, SETTLING), "trajectory");
    mix(m);
    require(hd_record_create(&m->record, of->entry), "record");
    require(hd_frame_create(&m->frame, &scene, half, 1, 1), "frame");
    require(hd_maps_create_of(&m->maps, &scene), "maps");
}

/** Pairs in a time step, which has an entry for each, and one that begins it. */
static double pairs_of(const measured *m)
{
    return (double)hd_record_count(m->record) / STEPS - 1.0;
}

static double flops_of(const measured *m)
{
    const double d = hd_frame_coordinates(m->frame);
    return (2.0 * d * (d + 1.0) * pairs_of(m) + 2.0 * d * m->scene.number) *
           hd_frame_vectors(m->frame);
}

static void one_round(measured *m)
{
    const double length = STEPS * STEP, end = hd_trajectory_time(m->trajectory) + length;
    hd_record_clear(m->record);
    const double start = busy_seconds();
    require(hd_trajectory_extend(m->trajectory, m->record, end), "trajectory");
    const double stepped = busy_seconds();
    require(hd_maps_fill_of(hd_dynamics_of(&m->scene), m->maps, m->record, 0.0, length), "maps");
    const double made = busy_seconds();
    require(hd_frame_replay(m->frame, m->record, 0.0, length), "replay");
    sample_add(&m->stepping, (stepped - start) / STEPS);
    sample_add(&m->making, (made - stepped) / STEPS);
    sample_add(&m->carrying, (busy_seconds() - made) / STEPS);
    hd_frame_rewind(m->frame);
}

/** Measures flops per second of dgemm. */
static double dgemm_rate(gemm *g)
{
    const double start = busy_seconds(), taken = gemm_measure(g);
    return gemm_last(g) * taken / (busy_seconds() - start);
}

static void tell(const measured *m, int row, double rate)
{
    printf("%5d %-12s %4.1f  %-14s %6.2f %10.3f %8.3f %8.3f %8.2f\n", m->scene.number,
           hd_dynamics_of(&m->scene)->particles, m->scene.density, rows[row].name,
           pairs_of(m) / m->scene.number, 1e3 * sample_least(&m->stepping),
           1e3 * sample_least(&m->making), 1e3 * sample_least(&m->carrying),
           sample_least(&m->carrying) * rate / flops_of(m));
}

static void end(measured *m)
{
    hd_maps_free_of(hd_dynamics_of(&m->scene), m->maps);
    hd_frame_free(m->frame);
    hd_record_free(m->record);
    hd_trajectory_free(m->trajectory);
}

int main(int argc, char **argv)
{
    static measured all[ROWS];
    int rounds = 3;
    double rate = 0.0; /* the best of all rounds, as of times the least */
    const option list[] = {{"--rounds", .count = &rounds, .least = 1, .most = SAMPLE_MAX}, {0}};
    options_read(argc, argv, list);
    hd_blas_use_threads(1);
    gemm *g = gemm_create(1600, 800);
    for (int k = 0; k < ROWS; k++) begin(&all[k], k);
    for (int round = 0; round < rounds; round++)
        for (int k = 0; k < ROWS; k++) {
            one_round(&all[k]);
            rate = fmax(rate, dgemm_rate(g));
        }
    printf("Least ms of a step on one core, dgemm at %.1f GF/s\n"
           "%39s %6s %10s %8s %8s %8s\n",
           1e-9 * rate, "", "pairs", "particles", "maps", "vectors", "to floor");
    for (int k = 0; k < ROWS; k++) tell(&all[k], k, rate);
    for (int k = 0; k < ROWS; k++) end(&all[k]);
    gemm_free(g);
    return 0;
}
