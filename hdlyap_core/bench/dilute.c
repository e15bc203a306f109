/** Dilute gases beside kinetic theory: Kolmogorov-Sinai entropy and largest exponent over the
 * collision rate of a disk. Usage: hdlyap_dilute [--out FOLDER] [--quick]; writes
 * findings_dilute.csv. */
#include <hdlyap/hdlyap.h>

#include "gemm.h"
#include "options.h"
#include "progress.h"
#include "table.h"
#include "timing.h"

static const double DENSITIES[] = {0.1, 0.03, 0.01, 0.003, 0.001};
/** Collisions of each disk, in averages. */
static const struct {
    int disks;
    double collisions;
} SIZES[] = {{16, 40000}, {36, 8000}, {64, 2500}, {100, 800}};
enum {
    DENSITIES_ALL = sizeof DENSITIES / sizeof *DENSITIES,
    SIZES_ALL = sizeof SIZES / sizeof *SIZES
};

/** rate: about, of the collisions of a disk, which all times are to be measured by. */
static hd_scene_def scene_of(double density, int disks, double collisions)
{
    const double rate = 3.545 * density;
    hd_scene_def scene = hd_scene_def_default();
    scene.disks = disks;
    scene.density = density;
    scene.equilibration = 100.0 / rate;
    scene.warmup = 200.0 / rate;
    scene.duration = collisions / rate;
    scene.report_interval = scene.duration / 50.0;
    scene.threads = 1;
    return scene;
}

static void go(double density, int disks, double collisions, table *t)
{
    const hd_scene_def scene = scene_of(density, disks, collisions);
    char message[512] = "out of memory";
    hd_run *run;
    if (hd_run_create(&run, &scene, message, sizeof message) != HD_OK) {
        fprintf(stderr, "hdlyap_dilute: %s\n", message);
        exit(2);
    }
    while (hd_run_stage(run) < HD_AVERAGING) require(hd_run_advance(run), "warm-up");
    const double start = hd_run_time(run);
    const uint64_t before = hd_trajectory_collisions(hd_run_trajectory(run));
    while (hd_run_stage(run) < HD_FINISHED) require(hd_run_advance(run), "run");
    const uint64_t pairs = hd_trajectory_collisions(hd_run_trajectory(run)) - before;
    const double rate = 2.0 * (double)pairs / disks / (hd_run_time(run) - start);
    const hd_spectrum *s = hd_run_spectrum(run);
    const double entropy = hd_spectrum_ks_entropy(s) / disks / rate;
    const double entropy_error = hd_spectrum_ks_entropy_error(s) / disks / rate;
    const double largest = hd_spectrum_exponent(s, 0) / rate;
    const double largest_error = hd_spectrum_std_error(s, 0) / rate;
    printf("%6g %4d %9.6f  %8.4f %7.4f  %8.4f %7.4f\n", density, disks, rate, entropy,
           entropy_error, largest, largest_error);
    fflush(stdout);
    table_row(t, "%g,%d,%.6g,%.6g,%.3g,%.6g,%.3g", density, disks, rate, entropy, entropy_error,
              largest, largest_error);
    hd_run_free(run);
}

int main(int argc, char **argv)
{
    const char *out = ".";
    bool quick = false;
    const option list[] = {{"--out", .text = &out}, {"--quick", .flag = &quick}, {0}};
    options_read(argc, argv, list);
    hd_blas_restart_if_slow(argv);
    table *t = table_create(out, "findings_dilute",
                            "density,disks,collisions of a disk [1/time unit],h_KS / N over it,"
                            "h_KS error,lambda_1 over it,lambda_1 error");
    printf("%6s %4s %9s  %8s %7s  %8s %7s\n", "rho", "N", "nu", "h/(N nu)", "error", "l_1/nu",
           "error");
    const int sizes = quick ? 1 : SIZES_ALL;
    progress shown = progress_begin("dilute", sizes * DENSITIES_ALL);
    for (int n = 0; n < sizes; n++)
        for (int d = 0; d < DENSITIES_ALL; d++) {
            go(DENSITIES[d], SIZES[n].disks, (quick ? 0.1 : 1.0) * SIZES[n].collisions, t);
            progress_add(&shown, 1.0);
        }
    progress_end();
    gemm *g = gemm_create(1000, 1000); /* the comment says on what machine */
    gemm_measure(g);
    table_write(t, argv, gemm_rate(g));
    gemm_free(g);
    return 0;
}
