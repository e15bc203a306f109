/** What covariant vectors cost beside the forward pass, and what a longer transient buys: how far
 * two starts still are apart where a window ends, and how far the covariant centre is from the
 * exact null space. All 4N vectors. Usage: hdlyap_covariant [--disks N] [--positive] [--windows N]
 * [--out FOLDER] [--quick]; 198 disks, 24 if quick; writes covariant.csv. --positive: the positive
 * half alone. */
#include <hdlyap/hdlyap.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "gemm.h"
#include "options.h"
#include "progress.h"
#include "table.h"
#include "timing.h"

static const double WINDOW = 50.0, SAMPLING = 5.0, ROOM = 16.0 /* GB */;

typedef struct asked {
    int disks, windows;
    bool positive, quick;
    const char *out;
} asked;

typedef struct row {
    hd_storage storage;
    double transient;
} row;

static const row rows[] = {{HD_STORAGE_MEMORY, 5},
                           {HD_STORAGE_MEMORY, 20},
                           {HD_STORAGE_MEMORY, 50},
                           {HD_STORAGE_MEMORY, 100},
                           {HD_STORAGE_RECOMPUTE, 100}};
enum { ROWS = sizeof rows / sizeof *rows };

static const char *const storages[] = {"memory", "recompute"};

static hd_scene_def scene_of(const asked *a, row r)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.disks = a->disks;
    scene.density = 0.7;
    scene.exponents = a->positive ? HD_EXPONENTS_POSITIVE : HD_EXPONENTS_ALL;
    scene.equilibration = 50.0;
    scene.warmup = 100.0;
    scene.duration = a->windows * WINDOW + r.transient + SAMPLING;
    scene.observe = HD_OBSERVE_COVARIANT;
    scene.covariant_window = WINDOW;
    scene.covariant_transient = r.transient;
    scene.covariant_sampling = SAMPLING;
    scene.covariant_memory = ROOM;
    scene.covariant_storage = r.storage;
    return scene;
}

/* ---- one run ------------------------------------------------------------------------------- */

static int ascending(const void *x, const void *y)
{
    const double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}

/** Of the vectors' sines; a copy, as it sorts. */
static double median_apart(const hd_covariant *c)
{
    const size_t n = (size_t)hd_covariant_vectors(c);
    double *sines = room(n, sizeof *sines);
    for (size_t k = 0; k < n; k++) sines[k] = hd_covariant_start_mismatch_each(c)[k];
    qsort(sines, n, sizeof *sines, ascending);
    const double median = 0.5 * (sines[(n - 1) / 2] + sines[n / 2]);
    free(sines);
    return median;
}

static double forward_seconds(const hd_cost *cost)
{
    return cost->events + cost->replay + cost->ortho;
}

static void tell(const hd_run *run, row r, table *t, double began)
{
    const hd_covariant *c = hd_run_covariant(run);
    const hd_covariant_mismatch apart = hd_covariant_start_mismatch(c);
    const hd_cost cost = hd_run_cost(run);
    const double length = hd_spectrum_time(hd_run_spectrum(run));
    const double forward = (forward_seconds(&cost) - began) / length;
    const double back = cost.covariant / hd_spectrum_time(hd_covariant_spectrum(c));
    const double median = median_apart(c);
    printf("%-10s %9g %8.2f %11.4f %11.4f %8.2f %10.1e %10.1e %10.1e\n", storages[r.storage],
           r.transient, 1e-9 * hd_covariant_bytes(c), forward, back, back / forward, median,
           apart.stable, hd_covariant_null_most(c));
    fflush(stdout);
    table_row(t, "%s,%g,%.4g,%.6g,%.6g,%.6g,%.4g,%.4g,%.4g,%d,%d,%ld", storages[r.storage],
              r.transient, 1e-9 * hd_covariant_bytes(c), forward, back, back / forward, median,
              apart.stable, hd_covariant_null_most(c), hd_run_scene(run)->disks,
              hd_covariant_vectors(c), hd_covariant_windows(c));
}

static void go(const asked *a, row r, table *t)
{
    const hd_scene_def scene = scene_of(a, r);
    hd_run *run = created(&scene);
    while (hd_run_stage(run) < HD_AVERAGING) require(hd_run_advance(run), "warm-up");
    const hd_cost before = hd_run_cost(run);
    while (hd_run_stage(run) < HD_FINISHED) require(hd_run_advance(run), "run");
    tell(run, r, t, forward_seconds(&before));
    hd_run_free(run);
}

int main(int argc, char **argv)
{
    asked a = {.disks = 198, .windows = 2, .out = "."};
    const option list[] = {{"--disks", .count = &a.disks, .least = 4, .most = 10000},
                           {"--windows", .count = &a.windows, .least = 1, .most = 1000},
                           {"--positive", .flag = &a.positive},
                           {"--out", .text = &a.out},
                           {"--quick", .flag = &a.quick},
                           {0}};
    options_read(argc, argv, list);
    if (a.quick) a.disks = 24;
    table *t = table_create(
        a.out, "covariant",
        "storage,transient [time units],room [GB],forward [s/time unit],covariant [s/time unit],"
        "covariant over forward,median sine apart,stable spaces apart [rad],null angle [rad],disks,"
        "vectors,windows");
    printf("%d disks, density 0.7, %s, windows of %g; seconds per time unit\n%-10s %9s %8s %11s "
           "%11s %8s %10s %10s %10s\n",
           a.disks, a.positive ? "positive half" : "all 4N vectors", WINDOW, "storage", "transient",
           "room, GB", "forward", "covariant", "ratio", "apart", "stable", "null");
    progress shown = progress_begin("covariant", ROWS);
    for (int k = 0; k < ROWS; k++) {
        go(&a, rows[k], t);
        progress_add(&shown, 1.0);
    }
    progress_end();
    table_write(t, argv, gemm_once());
    return 0;
}
