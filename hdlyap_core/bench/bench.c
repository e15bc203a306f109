/** What a run costs: its parts, and the whole as a ratio to the floor
 *  F = 4 m n^2 flops at dgemm speed per ln(1e8) / (lambda_1 - lambda_n) of simulated time,
 *  all measured in one run on one machine. Usage: hdlyap_bench [time units averaged, default 20] */
#define _POSIX_C_SOURCE 199309L
#include <cblas.h>
#include <hdlyap/hdlyap.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "timing.h"

/** dgemm on the shape of the Gram matrix, measured in between the run's steps: the machine's speed at
 *  the time, whatever else it is doing. */
typedef struct gemm {
    int m, n;
    double *a, *c;
    double rate[1000]; /**< flops per second, ascending when read */
    int count;
} gemm;

static gemm *gemm_create(int m, int n)
{
    gemm *g = calloc(1, sizeof *g);
    if (g) *g = (gemm){.m = m, .n = n, .a = calloc((size_t)m * (size_t)n, sizeof(double))};
    if (g) g->c = calloc((size_t)n * (size_t)n, sizeof(double));
    if (!g || !g->a || !g->c) require(HD_NO_MEMORY, "dgemm");
    for (size_t k = 0; k < (size_t)m * (size_t)n; k++) g->a[k] = 1.0 / (double)(k % 97 + 1);
    return g;
}

static void gemm_free(gemm *g)
{
    free(g->a);
    free(g->c);
    free(g);
}

/** One more measurement; returns the seconds that it took. */
static double gemm_measure(gemm *g)
{
    const double start = seconds();
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasTrans, g->n, g->n, g->m, 1.0, g->a, g->n, g->a,
                g->n, 0.0, g->c, g->n);
    const double taken = seconds() - start;
    if (g->count < 1000) g->rate[g->count++] = 2.0 * g->m * g->n * (double)g->n / taken;
    return taken;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double gemm_rate(gemm *g)
{
    qsort(g->rate, (size_t)g->count, sizeof *g->rate, ascending);
    return g->rate[g->count / 2];
}

/** Averages for `duration`; the wall seconds of it, dgemm's own left out. */
static double average(hd_run *run, gemm *g)
{
    const double start = seconds();
    double measuring = 0.0;
    for (int step = 0; hd_run_phase(run) != HD_FINISHED; step++) {
        require(hd_run_step(run), "averaging");
        if (step % 2 == 0) measuring += gemm_measure(g);
        fprintf(stderr, "\r%3.0f %%", 100.0 * hd_run_cost(run).progress);
    }
    fprintf(stderr, "\r");
    return seconds() - start - measuring;
}

static void whole_run(double duration)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.equilibration = 20.0;
    scene.warmup = 10.0;
    scene.duration = duration;
    scene.observe = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES;
    hd_run *run;
    require(hd_run_create(&run, &scene, NULL, 0), "780 disks");
    while (hd_run_phase(run) != HD_AVERAGING) require(hd_run_step(run), "warm-up");
    const int m = 4 * scene.disks, n = hd_run_vectors(run);
    gemm *g = gemm_create(m, n);
    const hd_cost before = hd_run_cost(run);
    const double w = average(run, g) / duration, rate = gemm_rate(g);
    const hd_cost after = hd_run_cost(run);
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    const double spread = hd_spectrum_exponent(spectrum, 0) - hd_spectrum_exponent(spectrum, n - 1);
    const double floor = 4.0 * m * n * (double)n / rate * spread / log(1e8);
    const double events = (after.events - before.events) / duration;
    const double replay = (after.replay - before.replay) / duration;
    const double ortho = (after.ortho - before.ortho) / duration;
    const double modes = (after.modes - before.modes) / duration;
    printf("%d disks, %d vectors, %d threads, %s kernels, dgemm %.1f GF/s\n", scene.disks, n,
           hd_run_threads(run), hd_blas_query().kernel, rate * 1e-9);
    printf("seconds per time unit: whole run W %.4f\n", w);
    printf("    = events %.4f + replay %.4f + factorisation %.4f + modes, steps and phases %.4f + "
           "rest "
           "%.4f\n",
           events, replay, ortho, modes, w - events - replay - ortho - modes);
    printf("floor F %.4f   W/F %.2f   interval %.3g   condition %.2g   second passes %ld   repairs "
           "%ld\n",
           floor, w / floor, after.interval, after.condition,
           after.second_passes - before.second_passes, after.repairs - before.repairs);
    gemm_free(g);
    hd_run_free(run);
}

static void events_alone(int disks, double density, double collisions)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.disks = disks;
    scene.density = density;
    scene.aspect = 1.0;
    hd_trajectory *trajectory;
    require(hd_trajectory_create(&trajectory, &scene), "trajectory");
    const double length = collisions / hd_trajectory_collision_rate(trajectory);
    require(hd_trajectory_advance(trajectory, NULL, length),
            "trajectory"); /* away from the lattice */
    const double first = (double)hd_trajectory_collisions(trajectory), start = seconds();
    require(hd_trajectory_advance(trajectory, NULL, 2.0 * length), "trajectory");
    const double count = (double)hd_trajectory_collisions(trajectory) - first;
    printf("%9d %9.2f %12.0f %22.2f\n", disks, density, count, count / (seconds() - start) * 1e-6);
    hd_trajectory_free(trajectory);
}

int main(int argc, char **argv)
{
    hd_blas_restart_if_slow(argv);
    const double duration = argc > 1 ? atof(argv[1]) : 20.0;
    if (!(duration > 0 && duration < 1e6)) {
        fprintf(stderr, "hdlyap_bench: time units = %s: must be above 0, below 1e6\n", argv[1]);
        return 2;
    }
    whole_run(duration);
    printf("\nEvents alone, one core:\n%9s %9s %12s %22s\n", "disks", "density", "collisions",
           "million collisions / s");
    events_alone(780, 0.7, 1e6);
    events_alone(100000, 0.7, 1e6);
    events_alone(780, 0.01, 1e5);
    return 0;
}
