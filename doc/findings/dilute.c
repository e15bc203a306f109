/** Dilute gases beside kinetic theory: Kolmogorov-Sinai entropy and largest exponent over the
 * collision rate of a disk. Usage: dilute [--quick] >findings_dilute.csv */
#include "study.h"

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
    scene.observe = HD_OBSERVE_GAS;
    return scene;
}

static void go(double density, int disks, double collisions)
{
    const hd_scene_def scene = scene_of(density, disks, collisions);
    hd_run *run = created(&scene);
    go_on(run, HD_FINISHED);
    const double rate = hd_gas_read(hd_run_gas(run)).collision_rate, all = disks * rate;
    const hd_spectrum *s = hd_run_spectrum(run);
    printf("%g,%d,%.6g,%.6g,%.3g,%.6g,%.3g\n", density, disks, rate,
           hd_spectrum_ks_entropy(s) / all, hd_spectrum_ks_entropy_error(s) / all,
           hd_spectrum_exponent(s, 0) / rate, hd_spectrum_std_error(s, 0) / rate);
    fflush(stdout);
    hd_run_free(run);
}

int main(int argc, char **argv)
{
    const bool quick = study_begin(argc, argv,
                                   "density,disks,collisions of a disk [1/time unit],"
                                   "h_KS / N over it,h_KS error,lambda_1 over it,lambda_1 error");
    for (int n = 0; n < (quick ? 1 : SIZES_ALL); n++)
        for (int d = 0; d < DENSITIES_ALL; d++)
            go(DENSITIES[d], SIZES[n].disks, (quick ? 0.1 : 1.0) * SIZES[n].collisions);
    return 0;
}
