/** Hard spheres: exponents over k of the T and LP steps and velocity of the LP phases at five
 * densities beside the pressure; steps found in three boxes for each kind of boundary. Usage:
 * spheres [--quick] >findings_spheres.csv */
#include "study.h"

enum { SEEDS = 4 };
#define P HD_PERIODIC
#define R HD_REFLECTING

typedef struct box {
    double density, aspect; /**< of y and z */
    int disks, nodes;
    hd_boundary boundary[3];
    double duration; /**< at density 0.5, else longer or shorter as exponents are */
    int seeds;
} box;

static const box BOXES[] = {
    /* long ones, whose waves lie along x */
    {0.1, 0.125, 300, 5, {P, P, P}, 350, SEEDS},
    {0.3, 0.125, 300, 5, {P, P, P}, 350, SEEDS},
    {0.5, 0.125, 300, 5, {P, P, P}, 350, SEEDS},
    {0.7, 0.125, 300, 5, {P, P, P}, 350, SEEDS},
    {0.9, 0.125, 300, 5, {P, P, P}, 350, SEEDS},
    /* multiplicities */
    {0.5, 0.25, 256, 2, {P, P, P}, 200, 2},
    {0.5, 0.25, 256, 2, {R, P, P}, 200, 2},
    {0.5, 0.25, 256, 2, {P, R, P}, 200, 2},
    {0.5, 0.25, 256, 2, {R, R, R}, 200, 2},
    {0.5, 0.5, 256, 2, {P, P, P}, 200, 2},
    {0.5, 0.5, 256, 2, {R, P, P}, 200, 2},
    {0.5, 0.5, 256, 2, {P, R, P}, 200, 2},
    {0.5, 0.5, 256, 2, {R, R, R}, 200, 2},
    {0.5, 1.0, 500, 1, {P, P, P}, 150, 2},
    {0.5, 1.0, 500, 1, {R, P, P}, 150, 2},
    {0.5, 1.0, 500, 1, {P, R, R}, 150, 2},
    {0.5, 1.0, 500, 1, {R, R, R}, 150, 2},
};
enum { BOXES_ALL = sizeof BOXES / sizeof *BOXES, QUICK = 5 };

/** Exponents are about as large as the density, below 0.5 somewhat smaller. */
static double slowness(double density) { return fmax(1.0, pow(0.5 / density, 1.2)); }

static hd_scene_def scene_of(const box *b, int seed, bool quick)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.particles = HD_SPHERES;
    scene.number = b->disks;
    scene.density = b->density;
    scene.aspect = scene.aspect_z = b->aspect;
    for (int d = 0; d < 3; d++) scene.boundary[d] = b->boundary[d];
    scene.seed = (uint64_t)seed + 1;
    scene.duration = b->duration * slowness(b->density) * (quick ? 0.1 : 1.0);
    scene.warmup = (quick ? 10.0 : 100.0) * slowness(b->density);
    scene.max_mode_number = b->nodes;
    scene.observe = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES | HD_OBSERVE_GAS;
    scene.threads = 1;
    return scene;
}

/** What each seed says of one step. */
typedef struct seen {
    double found, lambda, lambda_error, rate, rate_error;
    bool resolved;
    int members;
} seen;

static seen look(const hd_run *run, int index)
{
    const hd_step *step = hd_steps_step(hd_run_parts(run).steps, index);
    seen s = {.found = step->multiplicity,
              .lambda = step->exponent,
              .lambda_error = step->std_error,
              .rate = NAN,
              .rate_error = 0.0,
              .resolved = step->resolved,
              .members = step->members};
    double omega, error;
    if (step->kind == HD_MODE_LP &&
        hd_phases_rate(hd_run_parts(run).phases, index, &omega, &error)) {
        s.rate = fabs(omega);
        s.rate_error = fmax(error, 0.0);
    }
    return s;
}

static void tell(const double *value, const double *stated, int count, double unit)
{
    double error;
    const double mean = mean_over_seeds(value, stated, count, &error);
    printf(",%.6g,%.3g", mean / unit, error / unit);
}

/** A row of a step that every seed has resolved. */
static void tell_step(const box *b, hd_run *const run[], int index, double pressure,
                      double pressure_error)
{
    const hd_step *step = hd_steps_step(hd_run_parts(run[0]).steps, index);
    double found = 0.0, lambda[SEEDS], lambda_error[SEEDS], rate[SEEDS], rate_error[SEEDS];
    for (int s = 0; s < b->seeds; s++) {
        const seen one = look(run[s], index);
        if (!one.resolved) return;
        found += one.found / b->seeds;
        lambda[s] = one.lambda, lambda_error[s] = fmax(0.0, one.lambda_error);
        rate[s] = one.rate, rate_error[s] = one.rate_error;
    }
    printf("%g,%g,%d,%s%s%s,%s,%d,%d,%d,%.6g,%d,%.4g,%d", b->density, b->aspect, b->disks,
           b->boundary[0] == P ? "p" : "r", b->boundary[1] == P ? "p" : "r",
           b->boundary[2] == P ? "p" : "r", step->kind == HD_MODE_T ? "T" : "LP", step->wave.n[0],
           step->wave.n[1], step->wave.n[2], step->wave.number, step->expected, found,
           step->members);
    tell(lambda, lambda_error, b->seeds, step->wave.number);
    tell(rate, rate_error, b->seeds, step->wave.number);
    printf(",%.6g,%.3g\n", pressure, pressure_error);
    fflush(stdout);
}

/** P_xx / (rho sqrt(3 kT)) of all seeds: of the direction of the long waves. */
static double velocity_of_pressure(const box *b, hd_run *const run[], double *error)
{
    const hd_scene_def *scene = hd_run_scene(run[0]);
    const double unit = b->density * sqrt(3.0 * hd_gas_temperature(scene));
    double value[SEEDS], stated[SEEDS];
    for (int s = 0; s < b->seeds; s++) {
        const hd_gas_means gas = hd_gas_read(hd_run_parts(run[s]).gas);
        value[s] = gas.pressure_of[0] / unit;
        stated[s] = fmax(0.0, gas.pressure_of_error[0]) / unit;
    }
    return mean_over_seeds(value, stated, b->seeds, error);
}

static void go(const box *b, bool quick)
{
    hd_run *run[SEEDS];
#pragma omp parallel for schedule(dynamic)
    for (int s = 0; s < b->seeds; s++) {
        const hd_scene_def scene = scene_of(b, s, quick);
        run[s] = created(&scene);
        go_on(run[s], HD_FINISHED);
    }
    double error;
    const double pressure = velocity_of_pressure(b, run, &error);
    for (int index = 0; index < hd_steps_count(hd_run_parts(run[0]).steps); index++)
        if (hd_steps_step(hd_run_parts(run[0]).steps, index)->kind != HD_MODE_ZERO)
            tell_step(b, run, index, pressure, error);
    for (int s = 0; s < b->seeds; s++) hd_run_free(run[s]);
}

int main(int argc, char **argv)
{
    const bool quick = study_begin(
        argc, argv,
        "density,aspect,disks,boundaries,kind,nx,ny,nz,k [1/sigma],expected,found,members,"
        "lambda / k [sigma/time unit],lambda / k error,omega / k [sigma/time unit],omega / k error,"
        "P_xx / (sqrt(3 kT) rho) [sigma/time unit],P_xx error");
    const int first = quick ? QUICK : 0, boxes = quick ? 1 : BOXES_ALL;
    for (int b = first; b < first + boxes; b++) go(&BOXES[b], quick);
    return 0;
}
