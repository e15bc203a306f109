/** Measures what a run costs: its parts, and the whole as a ratio to the floor
 * F = 4 m n^2 flops at dgemm speed per ln(1e8) / (lambda_1 - lambda_n) of simulated time,
 * all in one run on one machine, in rounds.
 * Usage: hdlyap_bench [--spheres | --dumbbells | --soft] [--disks N] [--density RHO] [--threads N]
 *         [--rounds N] [--duration TIME UNITS OF A ROUND] [--settling TIME UNITS BEFORE THE FIRST]
 *         [--whole] [--events] [--out FOLDER] [--name NAME]
 * With --out it writes FOLDER/NAME.csv. --whole and --events do one part alone. */
#include <hdlyap/hdlyap.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "dynamics/dumbbells/dumbbells.h"
#include "dynamics/dynamics.h"
#include "dynamics/trajectory.h"
#include "gemm.h"
#include "options.h"
#include "progress.h"
#include "ratio.h"
#include "timing.h"

typedef struct asked {
    bool spheres, dumbbells, soft, mixed;
    int disks, threads, rounds;
    double density;
    double duration;    /**< length of a round [time units] */
    double settling;    /**< averaging before the first round [time units] */
    bool whole, events; /**< do this part alone */
    const char *out, *name;
} asked;

typedef struct result {
    sample w, f, ratio;  /**< W, F, W / F of each round */
    hd_cost first, last; /**< before and after all rounds */
    double taken;        /**< wall seconds of all rounds without those of dgemm */
} result;

/** Makes a third of the particles 1.4 times as large, at the same packing fraction. */
static void mix(hd_scene_def *scene)
{
    static const double of_second[] = {0.35, 1.4, 1.0};
    const double packing = hd_scene_packing(scene);
    for (int k = 0; k < 3; k++)
        hd_parameter_assign(&hd_dynamics_of(scene)->parameter[k], scene, of_second[k]);
    scene->density *= packing / hd_scene_packing(scene);
}

static hd_scene_def scene_of(const asked *a, int disks, double density)
{
    const hd_scene_def core = {.particles = a->spheres     ? HD_SPHERES
                                            : a->dumbbells ? HD_DUMBBELLS
                                            : a->soft      ? HD_SOFT_DISKS
                                                           : HD_DISKS};
    hd_scene_def scene = hd_scene_def_of(hd_dynamics_of(&core));
    scene.number = disks;
    scene.density = density;
    if (a->mixed) mix(&scene);
    return scene;
}

/** How many numbers a tangent vector has. */
static int rows_of(const hd_scene_def *scene)
{
    return 2 * hd_scene_coordinates(scene) * scene->number;
}

static double spread_of(const hd_run *run)
{
    const hd_spectrum *spectrum = hd_run_parts(run).spectrum;
    return hd_spectrum_exponent(spectrum, 0) -
           hd_spectrum_exponent(spectrum, hd_run_vectors(run) - 1);
}

/** Advances the run by `duration`, and measures dgemm after every second step. */
static void one_round(hd_run *run, gemm *g, double duration, result *r)
{
    const double begin = hd_run_time(run), start = seconds();
    const int m = rows_of(hd_run_scene(run)), n = hd_run_vectors(run);
    double measuring = 0.0;
    sample speed = {0};
    for (int step = 0; hd_run_time(run) < begin + duration - 1e-9; step++) {
        require(hd_run_advance(run), "averaging");
        if (step % 2 != 0) continue;
        measuring += gemm_measure(g);
        sample_add(&speed, gemm_last(g));
    }
    const double taken = seconds() - start - measuring, w = taken / duration;
    const double f = gemm_floor(sample_median(&speed), m, n, spread_of(run));
    r->taken += taken;
    sample_add(&r->w, w);
    sample_add(&r->f, f);
    sample_add(&r->ratio, w / f);
}

/** Measures all rounds, after the first time units of the averaging: there intervals are still
 * short, and the rotation of the phases is not known yet. */
static void measure(hd_run *run, gemm *g, const asked *a, result *r)
{
    const double end = hd_run_scene(run)->equilibration + hd_run_scene(run)->warmup + a->settling;
    progress p = progress_begin("whole run", a->rounds);
    while (hd_run_time(run) < end) require(hd_run_advance(run), "settling");
    r->first = hd_run_cost(run);
    for (int k = 0; k < a->rounds; k++) {
        one_round(run, g, a->duration, r);
        progress_add(&p, 1.0);
    }
    r->last = hd_run_cost(run);
    progress_end();
}

static void print_parts(const result *r, double duration)
{
    const hd_cost *a = &r->first, *b = &r->last;
    const double events = (b->events - a->events) / duration, w = r->taken / duration;
    const double replay = (b->replay - a->replay) / duration;
    const double ortho = (b->ortho - a->ortho) / duration;
    const double modes = (b->modes - a->modes) / duration;
    printf(
        "seconds per time unit: whole run %.4f = events %.4f + replay %.4f + factorisation %.4f\n"
        "    + modes, steps and phases %.4f + rest %.4f\n",
        w, events, replay, ortho, modes, w - events - replay - ortho - modes);
    printf("interval %.3g   condition %.2g   second passes %ld of %ld   repairs %ld\n", b->interval,
           b->condition, b->second_passes - a->second_passes,
           b->orthonormalisations - a->orthonormalisations, b->repairs - a->repairs);
}

static void tell(const hd_run *run, const gemm *g, const asked *a, const result *r, char **argv)
{
    printf("%d %s, %d vectors, %d threads, %s kernels, dgemm %.1f GF/s, %d rounds of %g time "
           "units\n",
           a->disks, hd_dynamics_of(hd_run_scene(run))->particles, hd_run_vectors(run),
           hd_run_threads(run), hd_blas_query().kernel, gemm_rate(g) * 1e-9, a->rounds,
           a->duration);
    table *t = ratio_begin(a->out, a->name);
    ratio_tell(t, "whole run W [s/time unit]", a->disks, &r->w);
    ratio_tell(t, "floor F [s/time unit]", a->disks, &r->f);
    ratio_tell(t, "W/F", a->disks, &r->ratio);
    if (t) table_write(t, argv, gemm_rate(g));
    print_parts(r, a->rounds * a->duration);
}

static void whole_run(const asked *a, char **argv)
{
    hd_scene_def scene = scene_of(a, a->disks, a->density);
    scene.threads = a->threads;
    scene.equilibration = 20.0;
    scene.warmup = 30.0;
    scene.observe = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES;
    hd_run *run = created(&scene);
    result r = {0};
    gemm *g = gemm_create(rows_of(&scene), hd_run_vectors(run));
    measure(run, g, a, &r);
    tell(run, g, a, &r, argv);
    gemm_free(g);
    hd_run_free(run);
}

/** CPU seconds of this process, which do not contain what other jobs take. */
static double busy_seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }

/** Seconds for predicting the events of two dumbbells, as after each collision; the mean over all
 * dumbbells of a state. */
static double predicting(const hd_trajectory *trajectory)
{
    hd_molecules *m = trajectory->state;
    const int32_t count = m->hard.motion.count, rounds = 1 + 200000 / count;
    const double start = busy_seconds();
    for (int32_t k = 0; k < rounds; k++)
        for (int32_t i = 0; i < count; i++) hd_next_renew(m, i);
    return 2.0 * (busy_seconds() - start) / ((double)rounds * count);
}

/** Measures million collisions per second, and prints a line without its end. */
static double events_alone(const asked *a, int disks, double density, double collisions)
{
    hd_scene_def scene = scene_of(a, disks, density);
    scene.aspect = 1.0;
    hd_trajectory *trajectory;
    require(hd_trajectory_create(&trajectory, &scene), "trajectory");
    const double length = collisions / hd_trajectory_totals(trajectory).expected;
    require(hd_trajectory_extend(trajectory, NULL, length),
            "trajectory"); /* leave the lattice first */
    const double first = (double)hd_trajectory_totals(trajectory).collisions, start = seconds(),
                 began = busy_seconds();
    require(hd_trajectory_extend(trajectory, NULL, 2.0 * length), "trajectory");
    const double count = (double)hd_trajectory_totals(trajectory).collisions - first,
                 rate = count / (seconds() - start) * 1e-6, busy = busy_seconds() - began;
    printf("%9d %-9s %9.2f %12.0f %22.2f", disks, hd_dynamics_of(&scene)->particles, scene.density,
           count, rate);
    if (hd_dynamics_of(&scene)->coordinates > hd_scene_dimension(&scene))
        printf(" %4.0f %% of it predicting", 100.0 * count * predicting(trajectory) / busy);
    hd_trajectory_free(trajectory);
    return rate;
}

static void events_of(const asked *a, int disks, double density, double collisions)
{
    (void)events_alone(a, disks, density, collisions);
    printf("\n");
}

/** Measures events of disks, then of dumbbells that cover the same area. */
static void dumbbells_beside_disks(const asked *a, int count, double collisions)
{
    const asked of_disks = {.spheres = false};
    const double rate = events_alone(&of_disks, count, 0.79, 3.0 * collisions);
    printf("\n");
    printf(", %.2f of that\n", events_alone(a, count, 0.6, collisions) / rate);
}

/** Measures events of one kind, then of a mixture that fills as much. */
static void mixture_beside_one_kind(const asked *a, int count, double collisions)
{
    asked mixed = *a;
    mixed.mixed = !a->soft; /* which have no second kind */
    const double rate = events_alone(a, count, 0.7, collisions);
    printf("\n");
    printf(", %.2f of that: a mixture\n", events_alone(&mixed, count, 0.7, collisions) / rate);
}

/** Bytes that one thread reads and writes per second when it copies a block far larger than the
 * caches; the best of a few copies. */
static double memory_rate(void)
{
    const size_t bytes = (size_t)1 << 27;
    char *from = room(bytes, 1), *to = room(bytes, 1);
    double best = 0.0;
    for (int k = 0; k < 5; k++) {
        from[k] = (char)(k + 1); /* each copy is a different one */
        const double start = seconds();
        memcpy(to, from, bytes);
        const double rate = 2.0 * (double)bytes / (seconds() - start);
        if (to[k] == from[k] && rate > best) best = rate;
    }
    free(from);
    free(to);
    return best;
}

/** Measures the replay of one exponent of many particles, and compares it with copying the bytes
 * that each event has to move: the recorded event, a tangent map in and out, and the vector's
 * numbers of two particles in and out. */
static void one_exponent(const asked *a, int disks, double memory)
{
    hd_scene_def scene = scene_of(a, disks, a->dumbbells ? 0.6 : 0.7);
    const double of_event = (double)hd_dynamics_of(&scene)->entry, of_map = a->spheres     ? 104.0
                                                                            : a->dumbbells ? 144.0
                                                                                           : 64.0;
    const double of_vector = 2.0 * 8.0 * rows_of(&scene) / disks; /* bytes of two particles */
    const double bytes_per_event = of_event + 2.0 * of_map + 2.0 * of_vector;
    scene.aspect = 1.0;
    scene.exponents = 1;
    scene.equilibration = 5.0;
    scene.warmup = 5.0;
    scene.duration = (a->dumbbells ? 1e6 : 4e6) / disks;
    hd_run *run = created(&scene);
    while (hd_run_stage(run) != HD_AVERAGING) require(hd_run_advance(run), "warm-up");
    const double before = hd_run_cost(run).replay;
    const double first = (double)hd_trajectory_totals(hd_run_parts(run).trajectory).collisions;
    while (hd_run_stage(run) != HD_FINISHED) require(hd_run_advance(run), "averaging");
    const double count = (double)hd_trajectory_totals(hd_run_parts(run).trajectory).collisions -
                         first;
    const double rate = count / (hd_run_cost(run).replay - before);
    printf("%9d %12.0f %22.1f %12.1f %18.0f\n", disks, count, rate * 1e-6,
           rate * bytes_per_event * 1e-9, 100.0 * rate * bytes_per_event / memory);
    hd_run_free(run);
}

static void print_events(const asked *a)
{
    printf("\nEvents alone, one core:\n%19s %9s %12s %22s\n", "", "density", "collisions",
           "million collisions / s");
    if (a->dumbbells) {
        dumbbells_beside_disks(a, 64, 3e5);
        dumbbells_beside_disks(a, 1000, 3e5);
        dumbbells_beside_disks(a, 10000, 3e5);
    } else {
        mixture_beside_one_kind(a, 780, 1e6);
        events_of(a, 1000, 0.7, 1e6);
        events_of(a, 10000, 0.7, 1e6);
        mixture_beside_one_kind(a, 100000, 1e6);
        events_of(a, 1000000, 0.7, 4e6);
        events_of(a, 780, 0.01, 1e5);
    }
    const double memory = memory_rate();
    printf(
        "\nReplay of one exponent, one core; copying memory: %.1f GB/s\n%9s %12s %22s %12s %18s\n",
        memory * 1e-9, "number", "collisions", "million collisions / s", "GB/s", "% of copying");
    one_exponent(a, 4000, memory);
    one_exponent(a, 100000, memory);
}

int main(int argc, char **argv)
{
    asked a = {.disks = 780,
               .density = 0.8,
               .rounds = 5,
               .duration = 16.0,
               .settling = 100.0,
               .name = "whole"};
    const option list[] = {{"--spheres", .flag = &a.spheres},
                           {"--dumbbells", .flag = &a.dumbbells},
                           {"--soft", .flag = &a.soft},
                           {"--disks", .count = &a.disks, .least = 10, .most = 5000},
                           {"--density", .number = &a.density, .least = 1e-3, .most = 1.4},
                           {"--threads", .count = &a.threads, .least = 0, .most = 256},
                           {"--rounds", .count = &a.rounds, .least = 1, .most = SAMPLE_MAX},
                           {"--duration", .number = &a.duration, .least = 1, .most = 1e6},
                           {"--settling", .number = &a.settling, .least = 0, .most = 1e6},
                           {"--whole", .flag = &a.whole},
                           {"--events", .flag = &a.events},
                           {"--out", .text = &a.out},
                           {"--name", .text = &a.name},
                           {0}};
    options_read(argc, argv, list);
    restart_if_slow(argv);
    if (a.whole || !a.events) whole_run(&a, argv);
    if (a.events || !a.whole) print_events(&a);
    return 0;
}
