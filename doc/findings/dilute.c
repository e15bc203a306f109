/** Dilute gases beside kinetic theory: Kolmogorov-Sinai entropy and largest exponent over the
 * collision rate of a disk. Entropy, exponent and rate fluctuate together, so that each error is
 * that of the ratio, by the jackknife over blocks of the run.
 * Usage: dilute [--quick] >findings_dilute.csv */
#include "study.h"

static const double DENSITIES[] = {0.1, 0.03, 0.01, 0.003, 0.001};
/** Collisions of each disk, in averages. */
static const struct {
    int disks;
    double collisions;
} SIZES[] = {{16, 40000}, {36, 8000}, {64, 2500}, {100, 800}};
enum {
    DENSITIES_ALL = sizeof DENSITIES / sizeof *DENSITIES,
    SIZES_ALL = sizeof SIZES / sizeof *SIZES,
    BLOCKS = 50
};

/** Since the averaging began, where each block ends; the first value is 0. */
typedef struct course {
    int blocks;
    double entropy[BLOCKS + 1], largest[BLOCKS + 1]; /**< h_KS and lambda_1, times time */
    double collisions[BLOCKS + 1];                   /**< of a disk */
} course;

/** rate: about, of the collisions of a disk, which all times are to be measured by. */
static hd_scene_def scene_of(double density, int disks, double collisions)
{
    const double rate = 3.545 * density;
    hd_scene_def scene = hd_scene_def_default();
    scene.number = disks;
    scene.density = density;
    scene.equilibration = 100.0 / rate;
    scene.warmup = 200.0 / rate;
    scene.duration = collisions / rate;
    scene.report_interval = scene.duration / BLOCKS;
    scene.threads = 1;
    scene.observe = HD_OBSERVE_GAS;
    return scene;
}

/** Spectrum and gas are averaged up to the same measured state. */
static void course_end(course *c, int block, const hd_run *run)
{
    const hd_spectrum *s = hd_run_parts(run).spectrum;
    const hd_gas_means gas = hd_gas_read(hd_run_parts(run).gas);
    const double time = hd_spectrum_time(s);
    c->blocks = block;
    c->entropy[block] = time * hd_spectrum_sum_up(s).ks_entropy;
    c->largest[block] = time * hd_spectrum_exponent(s, 0);
    c->collisions[block] = gas.time * gas.collision_rate;
}

/** A block ends with each report that tells more than the one before, and with the run. */
static void follow(course *c, hd_run *run)
{
    double time = 0.0;
    while (hd_run_stage(run) < HD_FINISHED) {
        require(hd_run_advance(run), "run");
        const double now = hd_spectrum_time(hd_run_parts(run).spectrum);
        if (!hd_run_report_due(run) || !(now > time) || c->blocks == BLOCKS) continue;
        course_end(c, c->blocks + 1, run);
        time = now;
    }
    course_end(c, c->blocks, run);
}

/** part / over of the whole, and its error by the jackknife: one block after the other is left
 * out. */
static double ratio(const double *part, const double *over, int blocks, double *error)
{
    const double whole = part[blocks] / over[blocks];
    double square = 0.0;
    for (int b = 0; b < blocks; b++)
        square += pow(
            (part[blocks] - part[b + 1] + part[b]) / (over[blocks] - over[b + 1] + over[b]) - whole,
            2.0);
    *error = sqrt(square * (blocks - 1) / blocks);
    return whole;
}

static void go(double density, int disks, double collisions)
{
    const hd_scene_def scene = scene_of(density, disks, collisions);
    hd_run *run = created(&scene);
    course c = {0};
    double entropy_error, largest_error;
    follow(&c, run);
    const double entropy = ratio(c.entropy, c.collisions, c.blocks, &entropy_error);
    const double largest = ratio(c.largest, c.collisions, c.blocks, &largest_error);
    printf("%g,%d,%.6g,%.6g,%.3g,%.6g,%.3g\n", density, disks,
           hd_gas_read(hd_run_parts(run).gas).collision_rate, entropy / disks,
           entropy_error / disks, largest, largest_error);
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
