/** Disks in a circle, and in a periodic box of the same pressure: the steps; of the circle also the
 * radial profiles of the vectors of T(m,1) and LP(m,1), m = 1 and 2, without a Bessel function.
 * Usage: circle [--quick] >findings_circle.csv */
#include "study.h"

#include <complex.h>

static const struct {
    int disks;
    double density;
} CASES[] = {{240, 0.7}, {480, 0.7}, {960, 0.7}, {480, 0.4}, {780, 0.8}};
enum { CASES_ALL = sizeof CASES / sizeof *CASES, SHELLS = 24, PROFILES = 4 };

/** Of one step: components of dq in shells of equal area, of the angle m, by the phase of its own
 * coefficients; A of its P fields. */
typedef struct profile {
    int step;
    double radial[SHELLS], angular[SHELLS], momentum[SHELLS], norm;
} profile;

typedef struct profiles {
    int count;
    profile of[PROFILES];
    double *q, *p, disks_in[SHELLS];
} profiles;

static hd_scene_def scene_of(int disks, double density, bool quick)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.number = disks;
    scene.density = density;
    scene.duration = quick ? 20.0 : 400.0;
    scene.report_interval = 1.0;
    scene.observe = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES | HD_OBSERVE_FIELDS | HD_OBSERVE_GAS;
    return scene;
}

/* ---- profiles ------------------------------------------------------------------------------- */

static void choose(profiles *all, const hd_run *run)
{
    const hd_steps *steps = hd_run_parts(run).steps;
    for (int k = 0; k < hd_steps_count(steps) && all->count < PROFILES; k++) {
        const hd_step *step = hd_steps_step(steps, k);
        const int *n = step->wave.n;
        if (step->kind != HD_MODE_ZERO && n[1] == 1 && (n[0] == 1 || n[0] == 2))
            all->of[all->count++].step = k;
    }
}

/** Coefficients on the fields of the cosine and the sine; the P fields are the second half. */
static double complex coefficient(const hd_run *run, const hd_step *step, int col, int half)
{
    const hd_modes *modes = hd_run_parts(run).modes;
    const int column = hd_fields_subspace(hd_modes_fields(modes), step->subspace)->column +
                       2 * half;
    return hd_modes_coefficients(modes, column)[col] -
           I * hd_modes_coefficients(modes, column + 1)[col];
}

/** A vector of the form (a cos + b sin of m theta) f(r) has the component (a - i b) f / 2. */
static void add_vector(profiles *all, profile *of, const hd_run *run, hd_columns v, int col)
{
    const hd_step *step = hd_steps_step(hd_run_parts(run).steps, of->step);
    const double complex z = coefficient(run, step, col, 0);
    const double complex w = step->kind == HD_MODE_LP ? coefficient(run, step, col, 1) : 0.0;
    double box[HD_DIMENSION_MAX];
    hd_scene_box(hd_run_scene(run), box);
    const double centre = 0.5 * box[0], reach = centre - 0.5;
    of->norm += creal(z * conj(z));
    for (int j = 0; j < hd_run_scene(run)->number; j++) {
        const double x = all->q[2 * j] - centre, y = all->q[2 * j + 1] - centre, r = hypot(x, y);
        const double *row = v.data + (size_t)(4 * j) * (size_t)v.stride + (col - v.first);
        const double dx = row[0], dy = row[v.stride];
        const double complex turn = cexp(-I * (step->wave.n[0] * atan2(y, x))) / r;
        int s = (int)(r * r / (reach * reach) * SHELLS);
        if (s >= SHELLS) s = SHELLS - 1;
        const double complex radial = turn * (dx * x + dy * y), angular = turn * (dy * x - dx * y);
        const bool t = step->kind == HD_MODE_T;
        of->radial[s] += t ? cimag(radial * conj(z)) : creal(radial * conj(z));
        of->angular[s] += t ? creal(angular * conj(z)) : cimag(angular * conj(z));
        of->momentum[s] += creal(turn * r * conj(w)) *
                           (dx * all->p[2 * j] + dy * all->p[2 * j + 1]);
    }
}

static void add_state(profiles *all, const hd_run *run)
{
    const hd_columns v = hd_run_vectors_now(run);
    hd_trajectory_state(hd_run_parts(run).trajectory, all->q, all->p);
    double box[HD_DIMENSION_MAX];
    hd_scene_box(hd_run_scene(run), box);
    const double reach = 0.5 * box[0] - 0.5;
    for (int j = 0; j < hd_run_scene(run)->number; j++) {
        const double r = hypot(all->q[2 * j] - 0.5 * box[0], all->q[2 * j + 1] - 0.5 * box[0]);
        const int s = (int)(r * r / (reach * reach) * SHELLS);
        all->disks_in[s < SHELLS ? s : SHELLS - 1]++;
    }
    for (int k = 0; k < all->count; k++) {
        const hd_step *step = hd_steps_step(hd_run_parts(run).steps, all->of[k].step);
        for (int c = 0; step->resolved && step->members == 1 && c < step->count; c++)
            add_vector(all, &all->of[k], run, v, step->col + c);
    }
}

/* ---- tables --------------------------------------------------------------------------------- */

static void begin_row(const hd_run *run, const hd_step *step)
{
    const hd_scene_def *scene = hd_run_scene(run);
    printf("%d,%.6g,%d,%d,%d,%d,", scene->container == HD_CIRCLE, scene->density, scene->number,
           step->kind == HD_MODE_T, step->wave.n[0], step->wave.n[1]);
}

static void print_steps(const hd_run *run)
{
    const double pressure = hd_gas_read(hd_run_parts(run).gas).pressure;
    for (int k = 0; k < hd_steps_count(hd_run_parts(run).steps); k++) {
        const hd_step *step = hd_steps_step(hd_run_parts(run).steps, k);
        double omega = NAN, error = NAN;
        if (!step->resolved || step->kind == HD_MODE_ZERO) continue;
        if (!hd_phases_rate(hd_run_parts(run).phases, k, &omega, &error)) omega = error = NAN;
        begin_row(run, step);
        printf("-1,0,0,0,%.6f,%.3f,%.5f,%.5f,%.5f,%.5f,%.5f\n", step->wave.number,
               step->multiplicity, step->exponent, step->std_error, fabs(omega), error, pressure);
    }
}

/** A shell's place is its mean radius squared; components are those of a disk. */
static void print_profiles(const profiles *all, const hd_run *run)
{
    for (int k = 0; k < all->count; k++) {
        const profile *of = &all->of[k];
        for (int s = 0; s < SHELLS && of->norm > 0; s++) {
            const double each = 1.0 / (of->norm * all->disks_in[s]);
            begin_row(run, hd_steps_step(hd_run_parts(run).steps, of->step));
            printf("%.5f,%.6f,%.6f,%.6f,0,0,0,0,0,0,0\n", sqrt((s + 0.5) / SHELLS),
                   of->radial[s] * each, of->angular[s] * each, of->momentum[s] * each);
        }
    }
}

/** Density of Henderson's pressure in a box, kT = 1. */
static double density_of(double pressure)
{
    double low = 0.0, high = 0.9;
    for (int k = 0; k < 60; k++) {
        const double rho = 0.5 * (low + high), eta = 0.25 * 3.14159265358979 * rho;
        const double here = rho * (1.0 + eta * eta / 8.0) / ((1.0 - eta) * (1.0 - eta));
        *(here < pressure ? &low : &high) = rho;
    }
    return low;
}

static double of_circle(int disks, double density, bool quick)
{
    hd_scene_def scene = scene_of(disks, density, quick);
    scene.container = HD_CIRCLE;
    hd_run *run = created(&scene);
    profiles all = {.q = room(2 * (size_t)disks, sizeof(double)),
                    .p = room(2 * (size_t)disks, sizeof(double))};
    choose(&all, run);
    go_on(run, HD_AVERAGING);
    while (hd_run_stage(run) < HD_FINISHED) {
        require(hd_run_advance(run), "run");
        if (!hd_run_report_due(run)) continue;
        require(hd_run_measure(run, 0), "run");
        add_state(&all, run);
    }
    const double pressure = hd_gas_read(hd_run_parts(run).gas).pressure;
    print_steps(run);
    print_profiles(&all, run);
    free(all.q);
    free(all.p);
    hd_run_free(run);
    return pressure;
}

static void of_box(int disks, double density, bool quick)
{
    const hd_scene_def scene = scene_of(disks, density, quick);
    hd_run *run = created(&scene);
    go_on(run, HD_FINISHED);
    print_steps(run);
    hd_run_free(run);
}

int main(int argc, char **argv)
{
    const bool quick = study_begin(argc, argv,
                                   "circle,density,disks,T,m,n,r / a,u_r,u_theta,A,k,multiplicity,"
                                   "exponent,error,omega,omega error,pressure");
    for (int k = 0; k < (quick ? 1 : CASES_ALL); k++) {
        const double pressure = of_circle(CASES[k].disks, CASES[k].density, quick);
        of_box(CASES[k].disks, density_of(pressure), quick);
        fflush(stdout);
    }
    return 0;
}
