/** Measures what accuracy costs. For eight methods and many intervals it compares exponents with an
 * accurate reference on the same stretch of trajectory, and takes the seconds of replay and
 * factorisation; likewise for the intervals that hd_run chooses at four accuracies. An interval
 * that is too long gives wrong exponents without an error; the tables and the picture show where.
 * Usage: hdlyap_precision [--out FOLDER] [--quick]; writes precision.csv. */
#include <hdlyap/hdlyap.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gemm.h"
#include "options.h"
#include "progress.h"
#include "sample.h"
#include "table.h"
#include "timing.h"
#include "window.h"

enum { LENGTHS = 10, AUTOS = 4, SLOW = 40, REFERENCE_PIECES = 48, SHORT = 4, WINDOWS = 40 };

/** Numbers of intervals in a window of 12 time units. */
static const int PIECES[LENGTHS] = {48, 24, 12, 8, 6, 5, 4, 3, 2, 1};
static const double ACCURACY[AUTOS] = {1e-4, 1e-6, 1e-8, 1e-10};

/** A window by one method, with one interval. */
typedef struct point {
    double interval, accuracy; /**< [time units]; of the scene, 0 if the interval is fixed */
    bool measured;             /**< false: left out */
    bool failed;               /**< the method noticed that it failed; all below is 0 */
    double largest, slow, all; /**< deviation of the first, of the last SLOW, of any exponent */
    double replay, factor;     /**< seconds per time unit */
    double gemms;              /**< replay + factor over the time of a dgemm, timed in between */
} point;

typedef struct study {
    window w;
    double *reference, *exponents; /**< [vectors] */
    gemm *g;
    point fixed[FACTOR_METHODS][LENGTHS], chosen[AUTOS];
    progress shown;
} study;

/* ---- measuring ----------------------------------------------------------------------------- */

/** About the seconds of one factorisation, in those of a pass of Cholesky. */
static double weight(factor_method method)
{
    static const double passes[FACTOR_METHODS] = {1.2, 0.9, 1.2, 2.2, 1.0, 0.8, 3.0, 14.0};
    return passes[method];
}

static bool is_left_out(factor_method method, int pieces)
{
    if (method == FACTOR_CHOLESKY_TWICE) return pieces == REFERENCE_PIECES;
    if (method == FACTOR_HOUSEHOLDER) return pieces > 24;
    return method == FACTOR_GRAM_SCHMIDT && pieces != 12 && pieces != 4 && pieces != 2;
}

/** How often a window is repeated. One with few factorisations is, so that a disturbance by other
 * jobs counts less. */
static int repetitions(factor_method method, int pieces)
{
    return pieces < SHORT && method != FACTOR_GRAM_SCHMIDT ? 3 : 1;
}

/** The work of a window of hd_run, which comes after a warm-up. */
static double work_of_chosen(const study *s)
{
    return (s->w.scene.warmup + s->w.length) * weight(FACTOR_OURS);
}

static double work_of_fixed(factor_method method, int pieces)
{
    return weight(method) * pieces * repetitions(method, pieces);
}

static double work_in_all(const study *s)
{
    double sum = AUTOS * work_of_chosen(s) +
                 (AUTOS + 1) * REFERENCE_PIECES * weight(FACTOR_CHOLESKY_TWICE);
    for (factor_method method = 0; method < FACTOR_METHODS; method++)
        for (int k = 0; k < LENGTHS; k++)
            if (!is_left_out(method, PIECES[k])) sum += work_of_fixed(method, PIECES[k]);
    return sum;
}

/** Fills the deviations of s->exponents from the reference. */
static void measure_deviation(const study *s, point *p)
{
    const int n = s->w.vectors, slow = n > 2 * SLOW ? SLOW : n / 2;
    p->largest = fabs(s->exponents[0] - s->reference[0]);
    p->slow = p->all = 0.0;
    for (int l = 0; l < n; l++) {
        const double off = fabs(s->exponents[l] - s->reference[l]);
        if (!(off <= p->all)) p->all = off; /* NaN stays */
        if (l >= n - slow && !(off <= p->slow)) p->slow = off;
    }
    if (!(p->all < INFINITY)) p->failed = true;
    if (p->failed) p->largest = p->slow = p->all = 0.0;
}

static double gemm_flops(const study *s)
{
    return 2.0 * s->w.rows * s->w.vectors * (double)s->w.vectors;
}

static void fill_cost(const study *s, point *p, double replay, double factorisation, double speed)
{
    p->replay = replay / s->w.length;
    p->factor = factorisation / s->w.length;
    p->gemms = (p->replay + p->factor) * speed / gemm_flops(s);
}

static void measure_fixed(study *s, factor_method method, int pieces, point *p)
{
    const double end = s->shown.done + work_of_fixed(method, pieces);
    const watch beside = {s->g, &s->shown, weight(method)};
    sample replay = {0}, factorisation = {0}, speed = {0};
    effort spent;
    *p = (point){.measured = true, .interval = s->w.length / pieces};
    factor *f = factor_create(method, s->w.rows, s->w.vectors);
    for (int k = 0; k < repetitions(method, pieces) && !p->failed; k++) {
        p->failed = window_exponents(&s->w, f, pieces, &beside, s->exponents, &spent) != HD_OK;
        sample_add(&replay, spent.replay);
        sample_add(&factorisation, spent.factor);
        sample_add(&speed, sample_median(&spent.speed));
    }
    factor_free(f);
    measure_deviation(s, p);
    if (!p->failed)
        fill_cost(s, p, sample_median(&replay), sample_median(&factorisation),
                  sample_median(&speed));
    progress_add(&s->shown, end - s->shown.done); /* a method that fails ends early */
}

/** Advances the run to the first measured state after the window, and measures dgemm in between. */
static void average(hd_run *run, gemm *g, double length, sample *speed)
{
    while (hd_run_stage(run) < HD_AVERAGING ||
           hd_spectrum_time(hd_run_parts(run).spectrum) < length) {
        require(hd_run_advance(run), "averaging");
        gemm_measure(g);
        sample_add(speed, gemm_last(g));
    }
}

static void measure_reference(study *s)
{
    const watch beside = {s->g, &s->shown, weight(FACTOR_CHOLESKY_TWICE)};
    effort spent;
    factor *f = factor_create(FACTOR_CHOLESKY_TWICE, s->w.rows, s->w.vectors);
    require(window_exponents(&s->w, f, REFERENCE_PIECES, &beside, s->reference, &spent),
            "reference");
    factor_free(f);
}

/** Measures the beginning of a run of usual length. It ends at a measured state and not with the
 * window, so it is compared with a separate reference. */
static void measure_chosen(study *s, double accuracy, point *p)
{
    const double length = s->w.length;
    hd_scene_def scene = s->w.scene;
    sample speed = {0};
    scene.accuracy = accuracy;
    scene.duration = WINDOWS * length;
    hd_run *run = created(&scene);
    while (hd_run_stage(run) != HD_AVERAGING) require(hd_run_advance(run), "warm-up");
    const hd_cost before = hd_run_cost(run);
    average(run, s->g, length, &speed);
    const hd_cost after = hd_run_cost(run);
    const long steps = after.orthonormalisations - before.orthonormalisations;
    s->w.length = hd_spectrum_time(hd_run_parts(run).spectrum);
    *p = (point){.measured = true, .accuracy = accuracy, .interval = s->w.length / (double)steps};
    for (int l = 0; l < s->w.vectors; l++)
        s->exponents[l] = hd_spectrum_exponent(hd_run_parts(run).spectrum, l);
    fill_cost(s, p, after.replay - before.replay, after.ortho - before.ortho,
              sample_median(&speed));
    hd_run_free(run);
    progress_add(&s->shown, work_of_chosen(s));
    measure_reference(s);
    measure_deviation(s, p);
    s->w.length = length;
}

static void measure_all(study *s)
{
    for (int k = 0; k < AUTOS; k++) measure_chosen(s, ACCURACY[k], &s->chosen[k]);
    measure_reference(s);
    for (factor_method method = 0; method < FACTOR_METHODS; method++)
        for (int k = 0; k < LENGTHS; k++)
            if (!is_left_out(method, PIECES[k]))
                measure_fixed(s, method, PIECES[k], &s->fixed[method][k]);
    progress_end();
}

/* ---- telling ------------------------------------------------------------------------------- */

/** Seconds per time unit at the median speed of dgemm in the whole program, so that other jobs do
 * not count. */
static double seconds_of(const study *s, const point *p)
{
    return p->gemms * gemm_flops(s) / gemm_rate(s->g);
}

/** Seconds of the cheapest fixed interval, by any method, that deviates by no more; 0 if there is
 * none. */
static double cheapest(const study *s, double deviation)
{
    double best = 0.0;
    for (const point *p = s->fixed[0]; p < s->fixed[0] + FACTOR_METHODS * LENGTHS; p++)
        if (p->measured && !p->failed && p->all <= deviation &&
            (best == 0.0 || seconds_of(s, p) < best))
            best = seconds_of(s, p);
    return best;
}

static void print_matrix(const study *s, const char *title, bool deviations)
{
    printf("\n%s\n%8s", title, "interval");
    for (factor_method method = 0; method < FACTOR_METHODS; method++)
        printf(" %14s", factor_name(method));
    for (int k = 0; k < LENGTHS; k++) {
        printf("\n%8g", s->w.length / PIECES[k]);
        for (factor_method method = 0; method < FACTOR_METHODS; method++) {
            const point *p = &s->fixed[method][k];
            if (!p->measured || p->failed)
                printf(" %14s", p->failed ? "fails" : "-");
            else
                printf(deviations ? " %14.1e" : " %14.4f", deviations ? p->all : seconds_of(s, p));
        }
    }
    printf("\n");
}

static void print_chosen(const study *s)
{
    printf("\nChosen by hd_run (interval: auto), and how much cheaper the cheapest of the above is "
           "that deviates no\n"
           "more, or no more than was asked for:\n%9s %9s %10s %14s %14s %10s\n",
           "accuracy", "interval", "deviation", "s / time unit", "ratio, as seen", "as asked");
    for (int k = 0; k < AUTOS; k++) {
        const point *p = &s->chosen[k];
        const double seen = cheapest(s, p->all), asked = cheapest(s, p->accuracy);
        printf("%9.0e %9.3g %10.1e %14.4f", p->accuracy, p->interval, p->all, seconds_of(s, p));
        printf(" %14.2f %10.2f\n", seen > 0 ? seconds_of(s, p) / seen : 0.0,
               seconds_of(s, p) / asked);
    }
}

static void write_point(table *t, const study *s, const char *method, const point *p)
{
    if (!p->measured) return;
    table_row(t, "%s,%g,%g,%s,%.4e,%.4e,%.4e,%.6f,%.6f,%.4f,%.6f", method, p->interval, p->accuracy,
              p->failed ? "fails" : "ok", p->largest, p->slow, p->all, p->replay, p->factor,
              p->gemms, seconds_of(s, p));
}

static void tell(const study *s, const char *folder, char **argv)
{
    print_matrix(s, "Largest deviation of any exponent [1/time unit]", true);
    print_matrix(
        s, "Replay and factorisation [seconds per time unit, at the median speed of dgemm]", false);
    print_chosen(s);
    table *t = table_create(
        folder, "precision",
        "method,interval [time units],accuracy asked [1/time unit],status,"
        "deviation of the largest [1/time unit],deviation of the slow [1/time unit],"
        "deviation of any [1/time unit],replay [s/time unit],factorisation [s/time unit],"
        "both [dgemms of the Gram matrix/time unit],"
        "both at the median speed of dgemm [s/time unit]");
    for (factor_method method = 0; method < FACTOR_METHODS; method++)
        for (int k = 0; k < LENGTHS; k++)
            write_point(t, s, factor_name(method), &s->fixed[method][k]);
    for (int k = 0; k < AUTOS; k++) write_point(t, s, "auto", &s->chosen[k]);
    table_write(t, argv, gemm_rate(s->g));
}

static hd_scene_def scene_of(bool quick)
{
    hd_scene_def scene = hd_scene_def_default();
    if (quick) scene.number = 64;
    scene.equilibration = 20.0;
    scene.warmup = 12.0;
    scene.duration = scene.report_interval = 12.0;
    return scene;
}

int main(int argc, char **argv)
{
    const char *out = ".";
    bool quick = false;
    const option list[] = {{"--out", .text = &out}, {"--quick", .flag = &quick}, {0}};
    options_read(argc, argv, list);
    restart_if_slow(argv);
    const hd_scene_def scene = scene_of(quick);
    study *s = room(1, sizeof *s);
    s->w = window_create(&scene);
    s->reference = room((size_t)s->w.vectors, sizeof(double));
    s->exponents = room((size_t)s->w.vectors, sizeof(double));
    s->g = gemm_create(s->w.rows / 4, s->w.vectors);
    s->shown = progress_begin("precision", work_in_all(s));
    measure_all(s);
    printf("%d disks, %d vectors, a window of %g time units\n", scene.number, s->w.vectors,
           s->w.length);
    tell(s, out, argv);
    gemm_free(s->g);
    window_free(&s->w);
    free(s->reference);
    free(s->exponents);
    free(s);
    return 0;
}
