/** Mixtures of disks of two sizes and masses beside disks of one kind: largest exponent, h_KS,
 * where the first vector lives, T and LP steps, compressibility. Usage: mixtures [--quick]
 * >findings_mixtures.csv */
#include "study.h"

static const double PI = 3.14159265358979323846;
/** Four rows of 24 fit as a crystal. */
static const double CRYSTAL = 0.14433756729740643;
enum { SEEDS = 4 };

typedef struct box {
    const char *part; /**< of the study */
    double fraction, diameter, mass, packing, aspect;
    int disks, nodes;
    double duration;
} box;

#define GLASS(packing) {"glass", 0.35, 1.4, 1, packing, CRYSTAL, 96, 3, 600},
#define PURE(packing) {"pure", 0, 1, 1, packing, CRYSTAL, 96, 3, 600},
#define MASS(mass) {"mass", 0.5, 1, mass, 0.5, 0.866, 64, 1, 600},
#define MODES(fraction, diameter, mass, packing)                                                   \
    {"modes", fraction, diameter, mass, packing, 0.05, 120, 4, 1200},
static const box BOXES[] = {
    /* against packing: a glass former, and what becomes a crystal */
    GLASS(0.4) GLASS(0.5) GLASS(0.6) GLASS(0.7) GLASS(0.75) GLASS(0.8) PURE(0.4) PURE(0.5) PURE(0.6)
        PURE(0.7) PURE(0.75) PURE(0.8)
    /* against the mass of half of the disks */
    MASS(1) MASS(2) MASS(5) MASS(10) MASS(20) MASS(50) MASS(100)
    /* branches: one kind at several packing fractions, then mixtures */
    MODES(0, 1, 1, 0.3) MODES(0, 1, 1, 0.35) MODES(0, 1, 1, 0.4) MODES(0, 1, 1, 0.45)
        MODES(0, 1, 1, 0.5) MODES(0, 1, 1, 0.55) MODES(0.35, 1.4, 1, 0.4) MODES(0.5, 0.5, 1, 0.4)
            MODES(0.1, 2.5, 1, 0.4) MODES(0.5, 1, 10, 0.4) MODES(0.35, 1.4, 1.96, 0.4)
                MODES(0.35, 1.4, 1, 0.5) MODES(0.5, 0.5, 1, 0.5)};
enum { BOXES_ALL = sizeof BOXES / sizeof *BOXES };

/** Sets a parameter that only disks have. */
static void set_own(hd_scene_def *scene, const char *name, double value)
{
    const hd_dynamics *of = hd_dynamics_of(scene);
    for (int k = 0; k < of->parameters; k++)
        if (strcmp(of->parameter[k].name, name) == 0)
            hd_parameter_assign(&of->parameter[k], scene, value);
}

static hd_scene_def scene_of(const box *b, int seed, bool quick)
{
    const double square = 1.0 + floor(b->fraction * b->disks + 0.5) / b->disks *
                                    (b->diameter * b->diameter - 1.0);
    hd_scene_def scene = hd_scene_def_default();
    scene.number = b->disks;
    scene.density = b->packing * 4.0 / PI / square;
    scene.aspect = b->aspect;
    set_own(&scene, "second_fraction", b->fraction);
    set_own(&scene, "second_diameter", b->diameter);
    set_own(&scene, "second_mass", b->mass);
    scene.seed = (uint64_t)seed + 1;
    scene.equilibration = 100.0 * sqrt(b->mass);
    scene.warmup = quick ? 20.0 : 150.0;
    scene.duration = b->duration * (quick ? 0.03 : 1.0);
    scene.max_mode_number = b->nodes;
    scene.observe = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES | HD_OBSERVE_GAS;
    scene.threads = 1;
    return scene;
}

/** A number as each seed says it; `stated` is 0 where a run states no error. */
typedef struct numbers {
    double value[SEEDS], stated[SEEDS];
} numbers;

static void tell(const numbers *of, int count)
{
    double error;
    const double mean = mean_over_seeds(of->value, of->stated, count, &error);
    printf(",%.6g,%.3g", mean, error);
}

/** Of all seeds: lambda_1, h_KS / N, share of the first vector on the second kind, Z, rate. */
static void tell_runs(const box *b, hd_run *const run[], int count)
{
    enum { WHAT = 5 };
    numbers all[WHAT];
    for (int s = 0; s < count; s++) {
        const hd_parts of = hd_run_parts(run[s]);
        const hd_spectrum_sums sums = hd_spectrum_sum_up(of.spectrum);
        const hd_gas_means gas = hd_gas_read(of.gas);
        const double *second = hd_modes_share_average(of.modes, HD_SHARE_SECOND);
        const double value[WHAT] = {hd_spectrum_exponent(of.spectrum, 0),
                                    sums.ks_entropy / b->disks, second ? second[0] : NAN,
                                    gas.compressibility, gas.collision_rate};
        const double stated[WHAT] = {hd_spectrum_std_error(of.spectrum, 0),
                                     sums.ks_entropy_error / b->disks, 0.0,
                                     gas.compressibility_error, gas.collision_rate_error};
        for (int k = 0; k < WHAT; k++) {
            all[k].value[s] = value[k];
            all[k].stated[s] = fmax(0.0, stated[k]);
        }
    }
    printf("%s,%g,%g,%g,%g,%g,%d", b->part, b->fraction, b->diameter, b->mass, b->packing,
           hd_run_scene(run[0])->density, b->disks);
    for (int k = 0; k < WHAT; k++) tell(&all[k], count);
}

/** Of a step: k, found, lambda / k, omega / k, share on the second kind; false unless every seed
 * has resolved it. */
static bool tell_step(hd_run *const run[], int count, int index)
{
    numbers lambda, rate, share;
    double found = 0.0;
    const hd_step *step = NULL;
    for (int s = 0; s < count; s++) {
        const hd_parts of = hd_run_parts(run[s]);
        const double *second = hd_modes_share_average(of.modes, HD_SHARE_SECOND);
        double omega = NAN, error = 0.0;
        step = hd_steps_step(of.steps, index);
        if (!step->resolved || step->kind == HD_MODE_ZERO) return false;
        if (step->kind != HD_MODE_LP || !hd_phases_rate(of.phases, index, &omega, &error))
            omega = NAN;
        found += step->multiplicity / count;
        lambda.value[s] = step->exponent / step->wave.number;
        lambda.stated[s] = fmax(0.0, step->std_error) / step->wave.number;
        rate.value[s] = fabs(omega) / step->wave.number;
        rate.stated[s] = fmax(0.0, error) / step->wave.number;
        share.value[s] = share.stated[s] = 0.0;
        for (int v = 0; second && v < step->count; v++)
            share.value[s] += second[step->col + v] / step->count;
    }
    printf(",%s,%d,%d,%.6g,%.3g,%d", step->kind == HD_MODE_T ? "T" : "LP", step->wave.n[0],
           step->wave.n[1], step->wave.number, found, step->expected);
    tell(&lambda, count);
    tell(&rate, count);
    tell(&share, count);
    printf("\n");
    return true;
}

static void go(const box *b, bool quick)
{
    const int count = quick ? 1 : SEEDS;
    hd_run *run[SEEDS];
#pragma omp parallel for schedule(dynamic)
    for (int s = 0; s < count; s++) {
        const hd_scene_def scene = scene_of(b, s, quick);
        run[s] = created(&scene);
        go_on(run[s], HD_FINISHED);
    }
    tell_runs(b, run, count);
    printf(",none,0,0,0,0,0,0,0,0,0,0,0\n");
    for (int k = 0; k < hd_steps_count(hd_run_parts(run[0]).steps); k++) {
        bool all = true;
        for (int s = 0; s < count; s++) {
            const hd_step *step = hd_steps_step(hd_run_parts(run[s]).steps, k);
            all &= step->resolved && step->kind != HD_MODE_ZERO && !step->conjugate;
        }
        if (!all) continue;
        tell_runs(b, run, count);
        (void)tell_step(run, count, k);
    }
    fflush(stdout);
    for (int s = 0; s < count; s++) hd_run_free(run[s]);
}

int main(int argc, char **argv)
{
    const bool quick = study_begin(
        argc, argv,
        "part,fraction,diameter,mass,packing,density,disks,lambda_1 [1/time unit],lambda_1 error,"
        "h_KS / N [1/time unit],h_KS error,second kind of vector 1,second kind error,Z,Z error,"
        "rate [1/time unit],rate error,kind,nx,ny,k [1/sigma],found,expected,"
        "lambda / k [sigma/time unit],lambda / k error,omega / k [sigma/time unit],"
        "omega / k error,second kind of step,second kind of step error");
    for (int b = 0; b < BOXES_ALL; b += quick ? 5 : 1) go(&BOXES[b], quick);
    return 0;
}
