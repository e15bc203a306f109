/** Measures what a time unit costs on several ranks, and what they send each other. Is started by
 * mpirun, or without it for comparison; rank 0 prints.
 * Usage: [mpirun -n RANKS] hdlyap_ranks [--disks N] [--threads OF EACH RANK] [--rounds R]
 *         [--duration TIME UNITS OF A ROUND] [--settling TIME UNITS BEFORE THE FIRST] [--steps] */
#include <hdlyap/hdlyap.h>
#include <hdlyap/mpi.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>

#include "base/communicator.h"
#include "options.h"
#include "sample.h"
#include "timing.h"

typedef struct asked {
    int disks, threads, rounds;
    double duration, settling;
    bool steps;
} asked;

/** Cost and traffic up to a moment. */
typedef struct counts {
    hd_cost cost;
    hd_traffic of[HD_CALLS];
} counts;

static counts counts_now(const hd_run *run, const hd_communicator *ranks)
{
    counts now = {.cost = hd_run_cost(run)};
    if (ranks) memcpy(now.of, ranks->traffic, sizeof now.of);
    return now;
}

/** Prints the latency that ranks_model.py needs: a sum of one number takes a message there and one
 * back in each of log2(ranks) steps. */
static void tell_latency(hd_communicator *ranks)
{
    enum { TIMES = 200 };
    const int all = hd_communicator_ranks(ranks);
    const double start = seconds();
    double x = 0.0;
    if (all == 1) return;
    for (int k = 0; k < TIMES; k++) hd_communicator_sum(ranks, &x, 1);
    if (ranks->rank == 0)
        printf("latency %.3g s\n", (seconds() - start) / TIMES / (2.0 * ceil(log2(all))));
}

/** Advances the run. Simulated time decides when to end, so all ranks end together. */
static void go_on(hd_run *run, double duration)
{
    const double end = hd_run_time(run) + duration;
    while (hd_run_time(run) < end) require(hd_run_advance(run), "averaging");
}

static double peak_gigabytes(void)
{
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    return 1024e-9 * (double)used.ru_maxrss;
}

static void tell_traffic(const counts *a, const counts *b)
{
    static const char *const names[HD_CALLS] = {"sums", "gathers", "exchanges", "broadcasts"};
    const double steps = (double)(b->cost.orthonormalisations - a->cost.orthonormalisations);
    for (int k = 0; k < HD_CALLS; k++)
        printf("  %-10s %9.1f calls %12.4g MB %9.4f s for each orthonormalisation\n", names[k],
               (b->of[k].calls - a->of[k].calls) / steps,
               1e-6 * (b->of[k].bytes - a->of[k].bytes) / steps,
               (b->of[k].seconds - a->of[k].seconds) / steps);
}

static void tell_steps(const hd_run *run)
{
    const hd_steps *steps = hd_run_parts(run).steps;
    printf("lambda_1 %.5f +- %.5f\n", hd_spectrum_exponent(hd_run_parts(run).spectrum, 0),
           hd_spectrum_std_error(hd_run_parts(run).spectrum, 0));
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *s = hd_steps_step(steps, k);
        if (s->resolved && !s->conjugate && s->kind != HD_MODE_ZERO)
            printf("%s(%d,%d) k %.4f lambda %.5f +- %.5f\n", s->kind == HD_MODE_T ? "T" : "LP",
                   s->wave.n[0], s->wave.n[1], s->wave.number, s->exponent, s->std_error);
    }
}

static void tell(const asked *a, const hd_run *run, const sample *w, const counts *first,
                 const counts *last)
{
    const double time = a->rounds * a->duration;
    const hd_cost *x = &first->cost, *y = &last->cost;
    printf("%d disks, %d vectors, %d ranks of %d threads, %d rounds of %g time units\n", a->disks,
           hd_run_vectors(run), hd_run_ranks(run), hd_run_threads(run), a->rounds, a->duration);
    printf("W [s/time unit]: least %.5f median %.5f most %.5f; interval %.3g\n", sample_least(w),
           sample_median(w), sample_most(w),
           time / (double)(y->orthonormalisations - x->orthonormalisations));
    printf(
        "of it events %.5f, replay %.5f, factorisation %.5f, modes %.5f; in communication %.5f\n",
        (y->events - x->events) / time, (y->replay - x->replay) / time,
        (y->ortho - x->ortho) / time, (y->modes - x->modes) / time,
        (y->communication - x->communication) / time);
    printf("peak of rank 0 %.3f GB\n", peak_gigabytes());
    if (hd_run_ranks(run) > 1) tell_traffic(first, last);
    if (a->steps) tell_steps(run);
}

static hd_scene_def scene_of(const asked *a)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.number = a->disks;
    scene.threads = a->threads;
    scene.equilibration = 5.0;
    scene.warmup = 12.0;
    scene.observe = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES;
    return scene;
}

int main(int argc, char **argv)
{
    asked a = {.disks = 780, .rounds = 5, .duration = 10.0, .settling = 20.0};
    const option list[] = {{"--disks", .count = &a.disks, .least = 10, .most = 1e6},
                           {"--threads", .count = &a.threads, .least = 0, .most = 256},
                           {"--rounds", .count = &a.rounds, .least = 1, .most = SAMPLE_MAX},
                           {"--duration", .number = &a.duration, .least = 0.1, .most = 1e6},
                           {"--settling", .number = &a.settling, .least = 0, .most = 1e6},
                           {"--steps", .flag = &a.steps},
                           {0}};
    hd_communicator *ranks;
    hd_run *run;
    char message[300] = "";
    sample w = {0};
    require(hd_mpi_begin(&ranks, &argc, &argv, message, sizeof message), "MPI");
    options_read(argc, argv, list);
    const hd_scene_def scene = scene_of(&a);
    if (hd_run_create_shared(&run, &scene, ranks, message, sizeof message) != HD_OK) {
        fprintf(stderr, "%s\n", message);
        return 2;
    }
    while (hd_run_stage(run) != HD_AVERAGING) require(hd_run_advance(run), "warm-up");
    go_on(run, a.settling);
    tell_latency(ranks);
    const counts first = counts_now(run, ranks);
    for (int k = 0; k < a.rounds; k++) {
        const double start = seconds(), begin = hd_run_time(run);
        go_on(run, a.duration);
        sample_add(&w, (seconds() - start) / (hd_run_time(run) - begin));
    }
    const counts last = counts_now(run, ranks);
    if (hd_communicator_rank(ranks) == 0) tell(&a, run, &w, &first, &last);
    hd_run_free(run);
    hd_mpi_end(ranks);
    return 0;
}
