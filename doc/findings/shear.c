/** Disks between shearing walls [T27]: spectra, their sum and the Kaplan-Yorke dimension, the flow
 * and the viscosity in square boxes; what becomes of steps and of the weights of vectors in boxes
 * that are long along the flow, or across it; all against b, beside reflecting walls (b: inf).
 * Usage: shear [--quick] >findings_shear.csv */
#include "study.h"

enum { SEEDS = 4 };

static const double BS[] = {0.3, 1, 3, 10, 30, 100, INFINITY};
enum { BS_ALL = sizeof BS / sizeof *BS };

typedef struct box {
    const char *shape;
    int disks;
    double density, aspect, duration;
    double least; /**< b: below it some of the narrow boxes jam */
    unsigned observe;
} box;

static const unsigned MODES = HD_OBSERVE_MODES | HD_OBSERVE_STEPS | HD_OBSERVE_GAS;
static const box BOXES[] = {
    {"square", 36, 0.4, 1.0, 4000, 0.3, HD_OBSERVE_GAS},
    {"square", 144, 0.4, 1.0, 600, 0.3, HD_OBSERVE_GAS},
    {"long", 64, 0.6, 0.25, 1200, 1.0, MODES},
    {"high", 64, 0.6, 4.0, 1200, 1.0, MODES},
};
enum { BOXES_ALL = sizeof BOXES / sizeof *BOXES };

static hd_scene_def scene_of(const box *b, double shear_b, int seed, bool quick)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.number = b->disks;
    scene.density = b->density;
    scene.aspect = b->aspect;
    scene.boundary[1] = isinf(shear_b) ? HD_REFLECTING : HD_SHEARING;
    if (isfinite(shear_b)) scene.shear_b = shear_b;
    scene.exponents = HD_EXPONENTS_ALL_INDEPENDENT;
    scene.seed = (uint64_t)seed + 1;
    scene.equilibration = quick ? 20.0 : 300.0;
    scene.warmup = quick ? 20.0 : 200.0;
    scene.duration = b->duration * (quick ? 0.01 : 1.0);
    scene.max_mode_number = 1;
    scene.observe = b->observe;
    scene.threads = 1;
    return scene;
}

/** A case, whose seeds have run. */
typedef struct seeds {
    const box *box;
    double b;
    hd_run *run[SEEDS];
} seeds;

/** A number of a run, and its error. */
typedef struct number {
    double value, error;
} number;

static number exponent(const hd_run *run, int index)
{
    const hd_spectrum *s = hd_run_parts(run).spectrum;
    return (number){hd_spectrum_exponent(s, index), hd_spectrum_std_error(s, index)};
}

/** The numbers of a run that have no index. */
enum { KS, SUM, DIMENSION, CONTRACTION, STRESS, LOW, HIGH, PRESSURE, NUMBERS };
static const char *const NAMES[] = {"h_KS",         "sum",          "dimension",     "contraction",
                                    "shear stress", "velocity low", "velocity high", "pressure"};

static number number_of(const hd_run *run, int which)
{
    const hd_spectrum_sums sums = hd_spectrum_sum_up(hd_run_parts(run).spectrum);
    const hd_gas_means gas = hd_gas_read(hd_run_parts(run).gas);
    switch (which) {
    case KS: return (number){sums.ks_entropy, sums.ks_entropy_error};
    case SUM: return (number){sums.exponent_sum, sums.exponent_sum_error};
    case DIMENSION: return (number){sums.kaplan_yorke, sums.kaplan_yorke_error};
    case CONTRACTION: return (number){gas.divergence, gas.divergence_error};
    case STRESS: return (number){gas.shear_stress, gas.shear_stress_error};
    case LOW: return (number){gas.wall_velocity[0], gas.wall_velocity_error[0]};
    case HIGH: return (number){gas.wall_velocity[1], gas.wall_velocity_error[1]};
    default: return (number){gas.pressure, gas.pressure_error};
    }
}

static void tell(const seeds *all, const char *name, int index, const number of[SEEDS])
{
    double value[SEEDS], stated[SEEDS], error;
    for (int s = 0; s < SEEDS; s++) {
        value[s] = of[s].value;
        stated[s] = fmax(0.0, of[s].error);
        if (isnan(value[s])) return;
    }
    const double mean = mean_over_seeds(value, stated, SEEDS, &error);
    printf("%s,%d,%g,%g,%s,%d,%.7g,%.3g\n", all->box->shape, all->box->disks, all->box->density,
           all->b, name, index, mean, error);
    fflush(stdout);
}

static void tell_gas(const seeds *all)
{
    for (int which = 0; which < NUMBERS; which++) {
        number of[SEEDS];
        for (int s = 0; s < SEEDS; s++) of[s] = number_of(all->run[s], which);
        tell(all, NAMES[which], 0, of);
    }
    for (int index = 0; index < hd_run_vectors(all->run[0]); index++) {
        number of[SEEDS];
        for (int s = 0; s < SEEDS; s++) of[s] = exponent(all->run[s], index);
        tell(all, "exponent", index + 1, of);
    }
}

static void name_of(const hd_subspace *subspace, char name[16])
{
    snprintf(name, 16, "%s(%d %d)", subspace->kind == HD_MODE_T ? "T" : "LP", subspace->wave.n[0],
             subspace->wave.n[1]);
}

/** Mean weights of all vectors in each kind of field of each wave. */
static void tell_weights(const seeds *all)
{
    const hd_fields *fields = hd_modes_fields(hd_run_parts(all->run[0]).modes);
    for (int k = 0; k < hd_fields_subspaces(fields); k++) {
        char name[16];
        name_of(hd_fields_subspace(fields, k), name);
        if (strstr(name, "1 1")) continue;
        for (int index = 0; index < hd_run_vectors(all->run[0]); index++) {
            number of[SEEDS] = {{0}};
            for (int s = 0; s < SEEDS; s++)
                of[s].value = hd_modes_average(hd_run_parts(all->run[s]).modes, k,
                                               HD_WEIGHT)[index];
            tell(all, name, index + 1, of);
        }
    }
}

static void go(const box *b, double shear_b, bool quick)
{
    seeds all = {.box = b, .b = shear_b};
#pragma omp parallel for schedule(dynamic)
    for (int s = 0; s < SEEDS; s++) {
        const hd_scene_def scene = scene_of(b, shear_b, s, quick);
        all.run[s] = created(&scene);
        go_on(all.run[s], HD_FINISHED);
    }
    tell_gas(&all);
    if (b->observe & HD_OBSERVE_MODES) tell_weights(&all);
    for (int s = 0; s < SEEDS; s++) hd_run_free(all.run[s]);
}

int main(int argc, char **argv)
{
    const bool quick = study_begin(argc, argv, "shape,disks,density,b,quantity,index,value,error");
    for (int k = 0; k < BOXES_ALL; k++)
        for (int b = 0; b < BS_ALL; b++)
            if (BS[b] >= BOXES[k].least) go(&BOXES[k], BS[b], quick);
    return 0;
}
