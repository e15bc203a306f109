/** Soft disks and spheres beside hard ones: exponents, weights of T(1,0) and LP(1,0) in
 * Gram-Schmidt and in covariant vectors, cos Theta, the pressure, and how much of the flow lies in
 * the span of the unstable vectors. A row for each positive exponent; all boxes with one seed, then
 * with the next. Usage: soft [--quick] >findings_soft.csv */
#include "study.h"

enum { POTENTIAL = 0, ENERGY = 1, TIME_STEP = 2, INTEGRATOR = 3, VERLET = 0, PEFRL = 1 };
enum { HARD = -1, POWER, WCA, LENNARD_JONES };
enum { SEEDS = 2, LOOKS = 100 };
static const char *const NAME[] = {"hard", "power", "wca", "lennard_jones"};

typedef struct box {
    int potential, dimension;
    double energy, density, height;
    int number;
    bool covariant;
} box;

static const box BOXES[] = {
    /* density 0.2, where steps are seen */
    {POWER, 2, 1, 0.2, 5.2, 64, true},
    {WCA, 2, 1, 0.2, 5.2, 64, true},
    {LENNARD_JONES, 2, 1, 0.2, 5.2, 64, true},
    {HARD, 2, 1, 0.2, 5.2, 64, true},
    /* dense */
    {POWER, 2, 1, 0.7, 5.2, 64, true},
    {WCA, 2, 1, 0.7, 5.2, 64, true},
    {LENNARD_JONES, 2, 1, 0.7, 5.2, 64, true},
    {HARD, 2, 1, 0.7, 5.2, 64, true},
    /* how hard a meeting is */
    {POWER, 2, 0.1, 0.7, 5.2, 64, false},
    {POWER, 2, 0.01, 0.7, 5.2, 64, false},
    {POWER, 2, 0.001, 0.7, 5.2, 64, false},
    {POWER, 2, 0.0001, 0.7, 5.2, 64, false},
    {WCA, 2, 10, 0.7, 5.2, 64, false},
    {WCA, 2, 100, 0.7, 5.2, 64, false},
    {POWER, 2, 10, 0.2, 5.2, 64, false},
    /* other densities */
    {POWER, 2, 1, 0.4, 5.2, 64, true},
    {WCA, 2, 1, 0.4, 5.2, 64, true},
    {HARD, 2, 1, 0.4, 5.2, 64, true},
    {POWER, 2, 1, 0.1, 5.2, 64, false},
    {WCA, 2, 1, 0.1, 5.2, 64, false},
    {HARD, 2, 1, 0.1, 5.2, 64, false},
    {POWER, 2, 1, 0.9, 5.2, 64, false},
    {WCA, 2, 1, 0.9, 5.2, 64, false},
    {HARD, 2, 1, 0.9, 5.2, 64, false},
    /* space */
    {HARD, 3, 1, 0.4, 2.6, 48, false},
    {POWER, 3, 1, 0.4, 2.6, 48, false},
    {WCA, 3, 1, 0.4, 2.6, 48, false},
    /* sizes */
    {POWER, 2, 1, 0.2, 5.2, 32, false},
    {POWER, 2, 1, 0.7, 5.2, 32, false},
    {POWER, 2, 1, 0.2, 10, 100, false},
    {POWER, 2, 1, 0.7, 5.2, 100, false},
    {HARD, 2, 1, 0.2, 5.2, 32, false},
    {POWER, 2, 1, 0.7, 5.2, 200, false},
    {POWER, 2, 1, 0.7, 5.2, 400, false},
    /* a pull */
    {LENNARD_JONES, 2, 1, 0.4, 5.2, 48, false},
    {LENNARD_JONES, 2, 1, 0.1, 5.2, 48, false},
    {LENNARD_JONES, 2, 1, 0.9, 5.2, 48, false},
};
enum { BOXES_ALL = sizeof BOXES / sizeof *BOXES };

static void soften(hd_scene_def *scene, const box *b)
{
    const bool verlet = b->potential == WCA; /* whose bend does not fall with the energy */
    const double finer = verlet ? fmin(1.0, 1.0 / sqrt(b->energy)) : pow(b->energy, -0.25);
    scene->particles = b->dimension == 2 ? HD_SOFT_DISKS : HD_SOFT_SPHERES;
    scene->own[POTENTIAL].whole = b->potential;
    scene->own[ENERGY].real = b->energy;
    scene->own[TIME_STEP].real = finer * (verlet ? 0.00125 : 0.005);
    scene->own[INTEGRATOR].whole = verlet ? VERLET : PEFRL;
}

static hd_scene_def scene_of(const box *b, int seed, bool quick)
{
    const double unit = (quick ? 0.1 : 1.0) / sqrt(b->energy);
    hd_scene_def scene = hd_scene_def_default();
    scene.particles = b->dimension == 2 ? HD_DISKS : HD_SPHERES;
    if (b->potential != HARD) soften(&scene, b);
    scene.seed = (uint64_t)seed + 1;
    scene.number = b->number;
    scene.density = b->density;
    const double across = b->dimension == 2 ? b->height : b->height * b->height;
    scene.aspect = b->height / (b->number / (b->density * across));
    if (b->dimension == 3) scene.aspect_z = scene.aspect;
    scene.equilibration = 100.0 * unit;
    scene.warmup = 150.0 * unit;
    scene.duration = scene.report_interval = 400.0 * unit;
    scene.report_interval /= LOOKS;
    scene.max_mode_number = 1;
    scene.exponents = HD_EXPONENTS_ALL;
    scene.observe = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES;
    if (b->potential == HARD) scene.observe |= HD_OBSERVE_GAS;
    if (b->covariant) scene.observe |= HD_OBSERVE_COVARIANT;
    scene.covariant_transient = 80.0 * unit;
    scene.covariant_window = 80.0 * unit;
    scene.covariant_sampling = 4.0 * unit;
    scene.threads = 1;
    return scene;
}

/** Sums over looks at the frame. */
typedef struct looked {
    double looks, kinetic, pressure; /**< P_xx of soft ones */
    double climb;          /**< largest part of the gradient of the energy in an unstable vector */
    double *flow, *cosine; /**< [positive]: squared part of the flow in a vector; |cos Theta| */
    double *null, *q, *p, *cos_theta, *ratio;
} looked;

static looked looked_create(const hd_run *run, const box *b)
{
    const size_t rows = 2 * (size_t)(b->dimension * b->number);
    return (looked){.flow = room(rows, sizeof(double)),
                    .cosine = room(rows, sizeof(double)),
                    .null = room(rows * (2 * (size_t)b->dimension + 2), sizeof(double)),
                    .q = room(rows, sizeof(double)),
                    .p = room(rows, sizeof(double)),
                    .cos_theta = room((size_t)hd_run_vectors(run), sizeof(double)),
                    .ratio = room((size_t)hd_run_vectors(run), sizeof(double))};
}

static void looked_clear(looked *l)
{
    double *all[] = {l->flow, l->cosine, l->null, l->q, l->p, l->cos_theta, l->ratio};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) free(all[k]);
}

/** The flow (p, F), the last null vector that soft particles know; the gradient of the energy is
 * (-F, p). Of hard ones (p, 0) and (0, p). */
static void project(looked *l, const box *b, hd_columns v, int positive)
{
    const int d = b->dimension, rows = 2 * d * b->number;
    const double *flow = l->null + (size_t)(2 * d * rows);
    double square = 0.0;
    for (int row = 0; row < rows; row++) square += flow[row] * flow[row];
    for (int col = 0; col < positive; col++) {
        double along = 0.0, climb = 0.0;
        for (int row = 0; row < rows; row++) {
            const double entry = v.data[(size_t)row * (size_t)v.stride + (size_t)col];
            const bool place = row % (2 * d) < d;
            along += entry * flow[row];
            climb += place ? -entry * flow[row + d] : entry * flow[row - d];
        }
        l->flow[col] += along * along / square;
        if (b->potential != HARD) l->climb = fmax(l->climb, fabs(climb) / sqrt(square));
    }
}

/** Force over distance, outwards; of what pulls it is left out. */
static double push(int potential, double square)
{
    const double x = 1.0 - square, w = pow(square, -3.0);
    if (potential == POWER) return square < 1.0 ? 800.0 * x * x * x : 0.0;
    return w > 0.5 ? 24.0 * w * (2.0 * w - 1.0) / square : 0.0;
}

static double nearest(double r, double edge) { return r - edge * round(r / edge); }

/** P_xx by the virial. */
static double pressure(const box *b, const double *edge, const double *q, const double *p)
{
    const int d = b->dimension;
    double sum = 0.0;
    for (int i = 0; i < b->number; i++) {
        sum += p[d * i] * p[d * i];
        for (int j = 0; j < i; j++) {
            double square = 0.0;
            for (int k = 0; k < d; k++)
                square += pow(nearest(q[d * i + k] - q[d * j + k], edge[k]), 2.0);
            const double x = nearest(q[d * i] - q[d * j], edge[0]);
            sum += push(b->potential, square) * x * x;
        }
    }
    return sum * b->density / b->number;
}

static void look(looked *l, hd_run *run, const box *b)
{
    const hd_scene_def *scene = hd_run_scene(run);
    const hd_trajectory *trajectory = hd_run_parts(run).trajectory;
    const int positive = hd_scene_counts(scene).positive;
    const hd_columns v = hd_run_vectors_now(run);
    hd_trajectory_state(trajectory, l->q, l->p);
    (void)hd_dynamics_of(scene)->null_vectors(scene, l->q, l->p, l->null);
    project(l, b, v, positive);
    double edge[HD_DIMENSION_MAX];
    hd_scene_box(scene, edge);
    l->pressure += pressure(b, edge, l->q, l->p);
    hd_run_dq_dp(run, l->cos_theta, l->ratio);
    for (int col = 0; col < positive; col++) l->cosine[col] += fabs(l->cos_theta[col]);
    l->kinetic += hd_trajectory_examined(trajectory).kinetic_energy / b->number;
    l->looks += 1.0;
}

static hd_run *follow(const box *b, int seed, looked *l, bool quick)
{
    const hd_scene_def scene = scene_of(b, seed, quick);
    hd_run *run = created(&scene);
    *l = looked_create(run, b);
    go_on(run, HD_AVERAGING);
    while (hd_run_stage(run) < HD_FINISHED) {
        require(hd_run_advance(run), "run");
        if (!hd_run_report_due(run) || hd_run_stage(run) == HD_FINISHED) continue;
        hd_run_watch(run, scene.report_interval / 10.0);
        require(hd_run_advance(run), "run");
        require(hd_run_measure(run, 0), "run");
        look(l, run, b);
        hd_run_watch(run, INFINITY);
    }
    return run;
}

/* ---- table ---------------------------------------------------------------------------------- */

/** T(1,0) or LP(1,0); -1. */
static int subspace_of(const hd_modes *modes, hd_mode_kind kind)
{
    const hd_fields *fields = hd_modes_fields(modes);
    for (int s = 0; s < hd_fields_subspaces(fields); s++) {
        const hd_subspace *of = hd_fields_subspace(fields, s);
        if (of->kind == kind && of->wave.n[0] == 1 && !of->wave.n[1] && !of->wave.n[2]) return s;
    }
    return -1;
}

static void tell_weights(const hd_modes *modes, int col)
{
    const int t = modes ? subspace_of(modes, HD_MODE_T) : -1;
    const int lp = modes ? subspace_of(modes, HD_MODE_LP) : -1;
    printf(",%.4g,%.4g,%.4g", t < 0 ? NAN : hd_modes_average(modes, t, HD_WEIGHT)[col],
           lp < 0 ? NAN : hd_modes_average(modes, lp, HD_WEIGHT_L)[col],
           lp < 0 ? NAN : hd_modes_average(modes, lp, HD_WEIGHT_P)[col]);
}

/** What each row of a box begins with. */
static void tell_box(const box *b, const looked *l, const hd_run *run)
{
    double edge[HD_DIMENSION_MAX], omega = NAN, omega_error = NAN;
    const hd_parts parts = hd_run_parts(run);
    const hd_steps *steps = parts.steps;
    hd_scene_box(hd_run_scene(run), edge);
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (step->kind == HD_MODE_LP && step->wave.n[0] == 1 && !step->conjugate &&
            step->resolved && !hd_phases_rate(parts.phases, k, &omega, &omega_error))
            omega = omega_error = NAN;
    }
    const double null = b->covariant ? hd_covariant_read(parts.covariant).null_most : NAN;
    const double pressed = b->potential == HARD            ? hd_gas_read(parts.gas).pressure_of[0]
                           : b->potential == LENNARD_JONES ? NAN
                                                           : l->pressure / l->looks;
    printf("%s,%d,%g,%g,%g,%d,%d,%.6g,%.5g,%.5g,%.3g,%.3g,%.4g,%.3g", NAME[b->potential + 1],
           b->dimension, b->energy, b->density, b->height, b->number, (int)hd_run_scene(run)->seed,
           6.283185307179586 / edge[0], l->kinetic / l->looks, pressed, l->climb, null, omega,
           omega_error);
}

static void go(const box *b, int seed, bool quick)
{
    looked l;
    hd_run *run = follow(b, seed, &l, quick);
    const hd_parts parts = hd_run_parts(run);
    const int positive = hd_scene_counts(hd_run_scene(run)).positive;
    hd_covariant_results c = {0};
    if (b->covariant) c = hd_covariant_read(parts.covariant);
    for (int col = 0; col < positive; col++) {
        tell_box(b, &l, run);
        printf(",%d,%.5g,%.3g", col + 1, hd_spectrum_exponent(parts.spectrum, col),
               hd_spectrum_std_error(parts.spectrum, col));
        tell_weights(parts.modes, col);
        printf(",%.4g,%.4g", l.cosine[col] / l.looks, l.flow[col] / l.looks);
        tell_weights(c.half[0], col);
        printf(",%.4g\n", c.cosines ? c.cosines[col] : NAN);
    }
    fflush(stdout);
    looked_clear(&l);
    hd_run_free(run);
}

int main(int argc, char **argv)
{
    const bool quick = study_begin(
        argc, argv,
        "particles,dimension,energy,density,height,number,seed,k [1/sigma],kinetic,P_xx,climb,null "
        "angle,"
        "omega,omega error,index,lambda,lambda error,T,L,P,cos Theta,flow,covariant T,covariant L,"
        "covariant P,covariant cos Theta");
    for (int seed = 0; seed < (quick ? 1 : SEEDS); seed++)
        for (int b = 0; b < (quick ? 1 : BOXES_ALL); b++) go(&BOXES[b], seed, quick);
    return 0;
}
