/** Measures what a time unit costs against the number of disks (positive half of the spectrum,
 * steps and phases) and, for fixed disks, against the number of vectors (spectrum alone), by parts
 * of the run; and fits powers, which theory predicts.
 * Usage: hdlyap_scaling [--out FOLDER] [--quick]; writes scaling.csv and scaling_fits.csv. */
#include <hdlyap/hdlyap.h>
#include <math.h>
#include <stdio.h>

#include "gemm.h"
#include "options.h"
#include "progress.h"
#include "sample.h"
#include "table.h"
#include "timing.h"

enum {
    EVENTS,
    REPLAY,
    FACTORISATION,
    MODES,
    PARTS,
    POINTS_MAX = 8,
    GEMM_SIZE = 1000,
    FLOOR_FROM = 50
};
enum { BY_DISKS, BY_VECTORS, SWEEPS };

static const char *const PART_NAMES[PARTS] = {"events", "replay", "factorisation", "modes"};
static const char *const SWEEP_NAMES[SWEEPS] = {"disks", "vectors"};
/** Expected powers of N with n = 2 N vectors, and of n at fixed N. */
static const double THEORY[SWEEPS][PARTS] = {{1, 2, 3, 2}, {0, 1, 2, NAN}};
/** Smaller sizes are left out of the fits: they run in one thread, and their matrices are so small
 * that dgemm is slow. */
static const double FIT_FROM[SWEEPS] = {200, 100};
/** A point that is predicted to take more seconds than this is left out. */
static const double PATIENCE = 300.0;
/** Time units of warm-up and, at least, of the measurement; time units, or seconds, of averaging
 * before it, in which intervals are still short and the rotation of the phases is not known yet. */
static const double WARMUP = 6.0, TIME_MIN = 16.0, SETTLING = 150.0, SETTLING_SECONDS = 60.0;

typedef struct point {
    int disks, vectors, threads;
    double interval, time; /**< interval; simulated time that was measured [time units] */
    double part[PARTS];    /**< seconds per time unit */
    double whole,
        floor; /**< sum of parts; see gemm_floor: 0 for few vectors, which dgemm does not bound */
} point;

typedef struct sweep {
    point at[POINTS_MAX];
    int count;
} sweep;

/** The whole benchmark. */
typedef struct study {
    gemm *g;
    double seconds_min; /**< least seconds for which a point is averaged */
    sweep by[SWEEPS];
    progress shown;
} study;

/* ---- measuring ----------------------------------------------------------------------------- */

static void read_costs(const hd_run *run, double part[PARTS])
{
    const hd_cost cost = hd_run_cost(run);
    part[EVENTS] = cost.events;
    part[REPLAY] = cost.replay;
    part[FACTORISATION] = cost.ortho;
    part[MODES] = cost.modes;
}

static void settle(hd_run *run)
{
    const double start = seconds(), begin = hd_run_time(run);
    while (hd_run_time(run) < begin + SETTLING && seconds() < start + SETTLING_SECONDS)
        require(hd_run_advance(run), "settling");
}

/** Advances the run from one orthonormalisation to another, by at least TIME_MIN and seconds_min.
 * Returns the median speed of dgemm meanwhile. */
static double average(hd_run *run, const study *all)
{
    const double start = seconds(), begin = hd_run_time(run);
    double next = start;
    sample speed = {0};
    while (hd_run_time(run) < begin + TIME_MIN || seconds() < start + all->seconds_min) {
        require(hd_run_advance(run), "averaging");
        if (seconds() < next) continue;
        gemm_measure(all->g);
        sample_add(&speed, gemm_last(all->g));
        next = seconds() + 0.3;
    }
    return sample_median(&speed);
}

static void fill(const hd_run *run, double speed, double begin, const double before[PARTS],
                 point *p)
{
    const hd_spectrum *spectrum = hd_run_parts(run).spectrum;
    const int n = hd_run_vectors(run);
    double after[PARTS];
    read_costs(run, after);
    p->vectors = n;
    p->threads = hd_run_threads(run);
    p->interval = hd_run_cost(run).interval;
    p->time = hd_run_time(run) - begin;
    for (int k = 0; k < PARTS; k++) {
        p->part[k] = (after[k] - before[k]) / p->time;
        p->whole += p->part[k];
    }
    const double spread = hd_spectrum_exponent(spectrum, 0) - hd_spectrum_exponent(spectrum, n - 1);
    if (n >= FLOOR_FROM) p->floor = gemm_floor(speed, 4 * p->disks, n, spread);
}

static void measure(study *all, int which, int disks, int exponents, unsigned stages)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.number = disks;
    scene.exponents = exponents;
    scene.observe = stages;
    scene.equilibration = 5.0;
    scene.warmup = WARMUP;
    double before[PARTS];
    point *p = &all->by[which].at[all->by[which].count++];
    *p = (point){.disks = disks};
    hd_run *run = created(&scene);
    while (hd_run_stage(run) != HD_AVERAGING) require(hd_run_advance(run), "warm-up");
    settle(run);
    read_costs(run, before);
    const double begin = hd_run_time(run), speed = average(run, all);
    fill(run, speed, begin, before, p);
    hd_run_free(run);
}

/** Work of a point, for the progress: factorisations, and a constant part. */
static double work(double disks, double vectors) { return 2e8 + disks * vectors * vectors; }

/** Seconds that this many disks will take, predicted from the largest number so far. */
static double predicted(const sweep *s, int disks)
{
    const double warmup = 12.0; /* it costs as much as this later, because intervals are short */
    if (s->count == 0) return 0.0;
    const point *p = &s->at[s->count - 1];
    return p->whole * pow((double)disks / p->disks, 3) * (warmup + TIME_MIN);
}

static void measure_disks(study *all, const int *disks)
{
    for (; *disks; disks++) {
        const double wait = predicted(&all->by[BY_DISKS], *disks);
        if (wait > PATIENCE)
            fprintf(stderr, "%d disks would take %.0f s: left out\n", *disks, wait);
        else
            measure(all, BY_DISKS, *disks, HD_EXPONENTS_POSITIVE,
                    HD_OBSERVE_STEPS | HD_OBSERVE_PHASES);
        progress_add(&all->shown, work(*disks, 2.0 * *disks));
    }
}

static void measure_vectors(study *all, int disks, const int *vectors)
{
    for (; *vectors; vectors++) {
        measure(all, BY_VECTORS, disks, *vectors, 0);
        progress_add(&all->shown, work(disks, *vectors));
    }
}

static void measure_all(study *all, bool quick)
{
    static const int many[] = {100, 200, 400, 780, 1500, 3000, 0}, few[] = {60, 100, 160, 0};
    static const int vectors[] = {1, 10, 100, 400, 1560, 0}, less[] = {1, 10, 100, 200, 0};
    const int disks = quick ? 100 : 780;
    double total = 0.0;
    for (const int *k = quick ? few : many; *k; k++) total += work(*k, 2.0 * *k);
    for (const int *k = quick ? less : vectors; *k; k++) total += work(disks, *k);
    all->shown = progress_begin("scaling", total);
    measure_vectors(all, disks, quick ? less : vectors);
    measure_disks(all, quick ? few : many);
    progress_end();
}

/* ---- telling ------------------------------------------------------------------------------- */

static double size_of(const point *p, int which)
{
    return which == BY_DISKS ? p->disks : p->vectors;
}

/** The slope of ln(seconds) over ln(size); NAN with less than two points. */
static double fitted(const sweep *s, int which, int part)
{
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (const point *p = s->at; p < s->at + s->count; p++) {
        if (size_of(p, which) < FIT_FROM[which] || p->part[part] <= 0) continue;
        const double a = log(size_of(p, which)), b = log(p->part[part]);
        n += 1.0, x += a, y += b, xx += a * a, xy += a * b;
    }
    return n < 2 ? NAN : (n * xy - x * y) / (n * xx - x * x);
}

static void print_sweep(const sweep *s, int which)
{
    printf("\nSeconds per time unit against the number of %s\n%6s %8s %8s %9s", SWEEP_NAMES[which],
           "disks", "vectors", "threads", "interval");
    for (int k = 0; k < PARTS; k++) printf(" %13s", PART_NAMES[k]);
    printf(" %10s %10s %6s\n", "whole", "floor F", "W/F");
    for (const point *p = s->at; p < s->at + s->count; p++) {
        printf("%6d %8d %8d %9.3g", p->disks, p->vectors, p->threads, p->interval);
        for (int k = 0; k < PARTS; k++) printf(" %13.6f", p->part[k]);
        printf(" %10.5f", p->whole);
        if (p->floor > 0) printf(" %10.5f %6.2f", p->floor, p->whole / p->floor);
        printf("\n");
    }
}

static void tell_fits(const sweep s[SWEEPS], table *t)
{
    for (int which = 0; which < SWEEPS; which++) {
        printf("\nFitted power of the number of %s, from %g on (theory):", SWEEP_NAMES[which],
               FIT_FROM[which]);
        for (int k = 0; k < PARTS; k++) {
            const double slope = fitted(&s[which], which, k);
            if (isnan(THEORY[which][k]) || isnan(slope)) continue;
            printf("  %s %.2f (%g)", PART_NAMES[k], slope, THEORY[which][k]);
            table_row(t, "%s,%s,%.4f,%g,%g", SWEEP_NAMES[which], PART_NAMES[k], slope,
                      THEORY[which][k], FIT_FROM[which]);
        }
    }
    printf("\n");
}

static void write_points(const sweep s[SWEEPS], table *t)
{
    for (int which = 0; which < SWEEPS; which++)
        for (const point *p = s[which].at; p < s[which].at + s[which].count; p++)
            table_row(t, "%s,%d,%d,%d,%.4g,%.4g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g", SWEEP_NAMES[which],
                      p->disks, p->vectors, p->threads, p->interval, p->time, p->part[EVENTS],
                      p->part[REPLAY], p->part[FACTORISATION], p->part[MODES], p->whole, p->floor);
}

int main(int argc, char **argv)
{
    const char *out = ".";
    bool quick = false;
    const option list[] = {{"--out", .text = &out}, {"--quick", .flag = &quick}, {0}};
    options_read(argc, argv, list);
    restart_if_slow(argv);
    study all = {.seconds_min = quick ? 0.3 : 2.0, .g = gemm_create(GEMM_SIZE, GEMM_SIZE)};
    measure_all(&all, quick);
    table *points = table_create(
        out, "scaling",
        "sweep,disks,vectors,threads,interval [time units],measured [time units],"
        "events [s/time unit],replay [s/time unit],factorisation [s/time unit],"
        "modes [s/time unit],whole [s/time unit],floor F [s/time unit]");
    table *fits = table_create(out, "scaling_fits", "sweep,part,fitted power,theory,fitted from");
    write_points(all.by, points);
    for (int which = 0; which < SWEEPS; which++) print_sweep(&all.by[which], which);
    tell_fits(all.by, fits);
    table_write(points, argv, gemm_rate(all.g));
    table_write(fits, argv, gemm_rate(all.g));
    gemm_free(all.g);
    return 0;
}
