/** What the time step of soft disks costs: the error of the energy, the largest exponent, the third
 * pair of zeros, which pairing cannot see, and seconds; of each potential and integrator.
 * Usage: time_steps [--quick] >time_steps.csv */
#include "study.h"

enum { POTENTIALS = 3, INTEGRATORS = 2, STEPS = 5, POTENTIAL = 0, TIME_STEP = 2, INTEGRATOR = 3 };
static const char *const POTENTIAL_NAME[POTENTIALS] = {"power", "wca", "lennard_jones"};
static const char *const INTEGRATOR_NAME[INTEGRATORS] = {"verlet", "pefrl"};
static const double LONGEST[INTEGRATORS] = {0.016, 0.032};

/** 20 in a square at density 0.7, energy 1 per particle. */
static hd_scene_def scene_of(int potential, int integrator, double step, bool quick)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.particles = HD_SOFT_DISKS;
    scene.number = 20;
    scene.density = 0.7;
    scene.aspect = 1.0;
    scene.own[POTENTIAL].whole = potential;
    scene.own[1].real = 1.0;
    scene.own[TIME_STEP].real = step;
    scene.own[INTEGRATOR].whole = integrator;
    scene.exponents = 2 * scene.number;
    scene.equilibration = scene.warmup = 50.0;
    scene.duration = quick ? 100.0 : 1000.0;
    scene.observe = 0;
    scene.threads = 1;
    return scene;
}

/** Root mean square of its error in the time of the averages; NaN if the energy is lost. */
static double energy_error(hd_run *run)
{
    double square = 0.0, looks = 0.0;
    while (hd_run_stage(run) < HD_FINISHED) {
        if (hd_run_advance(run) != HD_OK) return NAN;
        if (hd_run_stage(run) < HD_AVERAGING) continue;
        square += pow(hd_trajectory_examined(hd_run_parts(run).trajectory).energy_error, 2.0);
        looks += 1.0;
    }
    return sqrt(square / looks);
}

/** ",exponent,error"; NaN is what is not known. */
static void tell_exponent(const hd_run *run, int col, bool lost)
{
    const hd_spectrum *spectrum = hd_run_parts(run).spectrum;
    const double error = lost ? -1.0 : hd_spectrum_std_error(spectrum, col);
    printf(",%.6g,%.3g", lost ? NAN : hd_spectrum_exponent(spectrum, col), error < 0 ? NAN : error);
}

static void go(int potential, int integrator, double step, bool quick)
{
    const hd_scene_def scene = scene_of(potential, integrator, step, quick);
    hd_run *run = created(&scene);
    const double error = energy_error(run);
    const bool lost = isnan(error);
    const hd_cost cost = hd_run_cost(run);
    printf("%s,%s,%g,%.3g", POTENTIAL_NAME[potential], INTEGRATOR_NAME[integrator], step, error);
    tell_exponent(run, 0, lost);
    tell_exponent(run, hd_scene_counts(&scene).positive, lost);
    printf(",%.4g\n", lost ? NAN : (cost.events + cost.replay + cost.ortho) / hd_run_time(run));
    fflush(stdout);
    hd_run_free(run);
}

int main(int argc, char **argv)
{
    const bool quick = study_begin(argc, argv,
                                   "potential,integrator,step [time units],energy error,lambda_1,"
                                   "lambda_1 error,third zero,third zero error,"
                                   "seconds [s/time unit]");
    for (int potential = 0; potential < POTENTIALS; potential++)
        for (int integrator = 0; integrator < (quick ? 1 : INTEGRATORS); integrator++)
            for (int k = quick; k < (quick ? 3 : STEPS); k++)
                go(potential, integrator, LONGEST[integrator] / (1 << k), quick);
    return 0;
}
