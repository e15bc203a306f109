/** One run's results as lines "kind number tolerance", for different_blas.py: which linear algebra
 * ran, and what came out of it. Tolerances are what this run states about itself. */
#define _GNU_SOURCE /* dladdr */
#include <dlfcn.h>
#include <math.h>
#include <stdio.h>

#include "hdlyap/hdlyap.h"
#include "modes/modes.h"

/** A channel, in which 64 disks cannot pass each other: clean steps. */
static hd_scene_def channel(unsigned observe, int threads)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.number = 64;
    scene.density = 0.5;
    scene.aspect = 0.0175;
    scene.equilibration = 50.0;
    scene.warmup = 100.0;
    scene.duration = 100.0;
    scene.observe = observe;
    scene.threads = threads;
    return scene;
}

static void print(const char *kind, double value, double tolerance)
{
    printf("%s %.17g %.17g\n", kind, value, tolerance);
}

static void print_library(const char *function)
{
    Dl_info info;
    void *address = dlsym(RTLD_DEFAULT, function);
    printf("library %s %s\n", function,
           address && dladdr(address, &info) ? info.dli_fname : "none");
}

/** Rounding of the vectors: error_bound averages 2 eps condition over the time, 20 times enlarged;
 * vectors of one step, nearly degenerate, keep all of it. What a measured state may lack of
 * orthogonality comes on top. */
static double of_vectors(const hd_run *run)
{
    const double ORTHOGONALITY = 1e-6;
    const hd_cost cost = hd_run_cost(run);
    return cost.error_bound * hd_spectrum_time(hd_run_parts(run).spectrum) + ORTHOGONALITY;
}

static void print_spectrum(const hd_run *run)
{
    const hd_spectrum *spectrum = hd_run_parts(run).spectrum;
    const double bound = hd_run_cost(run).error_bound;
    for (int col = 0; col < hd_run_vectors(run); col++)
        print("exponent", hd_spectrum_exponent(spectrum, col), bound);
    print("entropy", hd_spectrum_sum_up(spectrum).ks_entropy, bound * hd_run_vectors(run));
}

static void print_steps(const hd_run *run)
{
    const hd_steps *steps = hd_run_parts(run).steps;
    const double vectors = of_vectors(run);
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        print("col", step->col, 0.0);
        print("count", step->count, 0.0);
        print("members", step->members, 0.0);
        print("multiplicity", step->multiplicity, 2.0 * vectors * step->count);
        print("step_exponent", step->exponent, hd_run_cost(run).error_bound + vectors);
    }
    const hd_modes *modes = hd_run_parts(run).modes;
    for (int s = 0; s < hd_fields_subspaces(hd_modes_fields(modes)); s++)
        for (int col = 0; col < hd_modes_vectors(modes); col++)
            print("weight", hd_modes_average(modes, s, HD_WEIGHT)[col], 2.0 * vectors);
}

/** More: of looks in single precision, else 0. */
static void print_phases(const hd_run *run, double more)
{
    const hd_phases *phases = hd_run_parts(run).phases;
    const double vectors = of_vectors(run) + more;
    for (int k = 0; k < hd_phases_count(phases); k++) {
        const hd_phase *phase = hd_phases_phase(phases, k);
        print("state", phase->state, 0.0);
        print("a", phase->a, 2.0 * vectors);
        print("b", phase->b, 2.0 * vectors);
        if (phase->state != HD_PHASE_TRACKED) continue;
        const double strength = hypot(phase->a, phase->b); /* a phase is known to 1 / |z| of it */
        print("phase", phase->phase, 2.0 * vectors / strength);
    }
    const hd_velocity v = hd_phases_velocity(phases);
    print("velocity", v.v,
          0.1 * v.v_error); /* where errors are known at all, rounding is far below */
}

static int show(unsigned observe, int threads, double more)
{
    const hd_scene_def scene = channel(observe, threads);
    hd_run *run;
    hd_status status = hd_run_create(&run, &scene, NULL, 0);
    while (status == HD_OK && hd_run_stage(run) != HD_FINISHED) status = hd_run_advance(run);
    if (status != HD_OK) {
        fprintf(stderr, "%s\n", hd_status_text(status));
        return 1;
    }
    print("collisions", (double)hd_trajectory_totals(hd_run_parts(run).trajectory).collisions, 0.0);
    print_spectrum(run);
    print_steps(run);
    print_phases(run, more);
    hd_run_free(run);
    return 0;
}

int main(void)
{
    /** Between orthonormalisations phases come from single precision: test_observe. */
    const double LOOKS = 5e-3;
    const unsigned all = HD_OBSERVE_MODES | HD_OBSERVE_STEPS | HD_OBSERVE_PHASES;
    const hd_blas blas = hd_blas_query();
    printf("blas %s, %s, %s\n", blas.library, blas.kernel, blas.threading);
    print_library("cblas_dgemm");
    print_library("dpotrf_");
    return show(all | HD_OBSERVE_FIELDS, 1, 0.0) || show(all, 2, LOOKS);
}
