/** How the dp halves of LP modes stand to their dq halves: dp = C dq on the L and P fields, with
 * the angle between the halves, beside the rotation and the pressure. Long boxes of several
 * densities, several waves each; those that turn less than twenty times in a run from several
 * seeds. Usage: halves [--quick] >findings_trailing.csv. As many runs side by side as there are
 * cores, one thread each. */
#include <complex.h>

#include "study.h"

enum { BLOCKS = 20, STEPS = 32, VECTORS = 12, PAIRS = 2, FIELDS = 2 * PAIRS };

typedef struct box {
    double density;
    int disks;
    double height;   /**< [sigma] */
    hd_boundary end; /**< of x */
    double sampling; /**< [time units]; fractions of a turn */
    double duration; /**< [time units] */
    int seeds;       /**< runs of it */
} box;

static const box BOXES[] = {
    {0.1, 80, 6, HD_PERIODIC, 2.0, 2500, 6},   {0.1, 140, 6, HD_PERIODIC, 2.0, 1500, 6},
    {0.2, 100, 4, HD_PERIODIC, 1.5, 1200, 6},  {0.2, 160, 4, HD_PERIODIC, 1.5, 900, 6},
    {0.4, 100, 4, HD_PERIODIC, 1.0, 1000, 1},  {0.4, 240, 4, HD_PERIODIC, 1.0, 500, 4},
    {0.4, 100, 4, HD_REFLECTING, 1.0, 800, 6}, {0.6, 100, 4, HD_PERIODIC, 0.7, 700, 1},
    {0.6, 240, 4, HD_PERIODIC, 0.7, 350, 4},   {0.8, 100, 5, HD_PERIODIC, 0.4, 500, 1},
    {0.8, 200, 5, HD_PERIODIC, 0.4, 400, 1},   {0.8, 300, 3, HD_PERIODIC, 0.4, 300, 4},
    {0.8, 500, 3, HD_PERIODIC, 0.5, 250, 4},   {0.8, 100, 5, HD_REFLECTING, 0.4, 500, 1},
    {0.8, 160, 5, HD_REFLECTING, 0.4, 300, 4}};
enum { BOXES_ALL = sizeof BOXES / sizeof *BOXES, SEEDS = 6 };
static const box QUICK = {0.6, 40, 3, HD_PERIODIC, 0.7, 200, 2};

/** Over vectors, pairs and times, of z = a + i b of the dq half and w of the dp half. */
typedef struct sums {
    double complex zw, z_w, zz, turn; /**< conj(z) w, z w, z z, conj(z) z' of the next time */
    double z2, antisymmetric, whole;  /**< |z|^2; see halves_compare */
} sums;

/** One run of a box. */
typedef struct harvest {
    box box;
    int seed; /**< from 0 */
    hd_run *run;
    double *p;
    sums (*sums)[STEPS]; /**< [BLOCKS] */
    double complex before[STEPS][VECTORS][PAIRS];
    int known[STEPS]; /**< column of the first vector of `before`, -1: none */
    double flown;     /**< sum of p_x^2 over disks and reports */
    int reports;
    double pressure; /**< P_xx / (rho kT) */
} harvest;

static hd_scene_def scene_of(const box *b, int seed)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.number = b->disks;
    scene.density = b->density;
    scene.aspect = b->height * b->height * b->density / b->disks;
    scene.boundary[0] = b->end;
    scene.seed += (uint64_t)seed;
    scene.equilibration = 0.2 * b->duration;
    scene.warmup = 0.4 * b->duration;
    scene.duration = b->duration;
    scene.report_interval = b->sampling;
    scene.threads = 1;
    scene.observe = HD_OBSERVE_GAS | HD_OBSERVE_STEPS;
    scene.observe |= HD_OBSERVE_HYDRO; /* all vectors at each report */
    return scene;
}

/* ---- one step at one time ------------------------------------------------------------------- */

static const hd_fields *fields_of(const harvest *h)
{
    return hd_modes_fields(hd_run_parts(h->run).modes);
}

/** right[d][count] <- gram^-1 right, gram[d][d] of fields that are no combination of each other. */
static void solve(int d, int count, double *gram, double *right)
{
    for (int k = 0; k < d; k++)
        for (int i = 0; i < d; i++) {
            const double factor = i == k ? 0.0 : gram[i * d + k] / gram[k * d + k];
            for (int j = 0; j < d; j++) gram[i * d + j] -= factor * gram[k * d + j];
            for (int v = 0; v < count; v++) right[i * count + v] -= factor * right[k * count + v];
        }
    for (int i = 0; i < d; i++)
        for (int v = 0; v < count; v++) right[i * count + v] /= gram[i * d + i];
}

/** Least-squares coefficients of dq (half 0) or dp halves (1): on L and P of each pair, real and
 * imaginary part. */
static void project(double complex z[VECTORS][PAIRS], const harvest *h, const hd_subspace *s,
                    hd_columns x, int half)
{
    const int d = s->dimension, stride = hd_fields_stride(fields_of(h));
    double gram[FIELDS * FIELDS] = {0}, right[FIELDS * VECTORS] = {0};
    for (int r = 0; r < 2 * h->box.disks; r++) {
        const double *f = hd_fields_data(fields_of(h)) + (size_t)r * (size_t)stride + s->column;
        const double *row = x.data + (size_t)(4 * (r / 2) + 2 * half + r % 2) * (size_t)x.stride;
        for (int i = 0; i < d; i++) {
            for (int j = 0; j < d; j++) gram[i * d + j] += f[i] * f[j];
            for (int v = 0; v < x.count; v++) right[i * x.count + v] += f[i] * row[v];
        }
    }
    solve(d, x.count, gram, right);
    for (int v = 0; v < x.count; v++)
        for (int c = 0; c < d / 2; c++)
            z[v][c] = right[c * x.count + v] + I * right[(c + d / 2) * x.count + v];
}

/** dq_l.dp_m - dp_l.dq_m of two whole vectors: zero of any two that grow. */
static double form(const hd_columns *x, int disks, int l, int m)
{
    double sum = 0.0;
    for (int j = 0; j < disks; j++)
        for (int d = 0; d < 2; d++) {
            const double *dq = x->data + (size_t)(4 * j + d) * (size_t)x->stride;
            const double *dp = dq + 2 * x->stride;
            sum += dq[l] * dp[m] - dp[l] * dq[m];
        }
    return sum;
}

/** The same form, of the parts in the fields (antisymmetric) and of whole vectors, both added up
 * over pairs of vectors with the sine of their phases apart: the first is what makes an angle. */
static void halves_compare(sums *s, double complex z[VECTORS][PAIRS],
                           double complex w[VECTORS][PAIRS], int pairs, const hd_columns *x,
                           int disks)
{
    for (int l = 0; l < x->count; l++)
        for (int m = 0; m < l; m++) {
            double sine = 0.0, part = 0.0;
            for (int c = 0; c < pairs; c++) {
                sine += cimag(conj(z[l][c]) * z[m][c]);
                part += creal(z[l][c] * conj(w[m][c]) - w[l][c] * conj(z[m][c]));
            }
            s->antisymmetric += sine * part;
            s->whole += sine * form(x, disks, l, m);
        }
}

static void step_measure(harvest *h, sums *s, const hd_step *step, int index)
{
    const hd_subspace *space = hd_fields_subspace(fields_of(h), step->subspace);
    hd_columns x = hd_run_vectors_now(h->run);
    double complex z[VECTORS][PAIRS] = {{0.0}}, w[VECTORS][PAIRS];
    const int pairs = space->dimension / 2;
    x.data += step->col - x.first;
    x.first = step->col, x.count = step->count;
    project(z, h, space, x, 0);
    project(w, h, space, x, 1);
    for (int v = 0; v < x.count; v++)
        for (int c = 0; c < pairs; c++) {
            const double complex a = z[v][c], b = w[v][c];
            s->zw += conj(a) * b, s->z_w += a * b, s->zz += a * a, s->z2 += creal(a * conj(a));
            if (h->known[index] == step->col) s->turn += conj(h->before[index][v][c]) * a;
        }
    halves_compare(s, z, w, pairs, &x, h->box.disks);
    memcpy(h->before[index], z, sizeof z);
    h->known[index] = step->col;
}

/** Of an LP step along x; its set may hold T steps: what is summed does not depend on how vectors
 * of the set are mixed. */
static bool is_wanted(const hd_steps *steps, int index)
{
    const hd_step *step = hd_steps_step(steps, index);
    int others = 0;
    if (step->kind != HD_MODE_LP || !step->resolved || step->count > VECTORS) return false;
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *other = hd_steps_step(steps, k);
        others += k != index && other->resolved && other->set == step->set &&
                  other->kind == HD_MODE_LP;
    }
    return others == 0 && step->wave.n[1] == 0;
}

/* ---- one run -------------------------------------------------------------------------------- */

static void report_measure(harvest *h, double since)
{
    const int block = (int)fmin(BLOCKS - 1, BLOCKS * since / h->box.duration);
    const hd_steps *steps = hd_run_parts(h->run).steps;
    hd_trajectory_state(hd_run_parts(h->run).trajectory, NULL, h->p);
    for (int j = 0; j < h->box.disks; j++) h->flown += h->p[2 * j] * h->p[2 * j];
    h->reports++;
    for (int k = 0; k < STEPS && k < hd_steps_count(steps); k++) {
        if (is_wanted(steps, k))
            step_measure(h, &h->sums[block][k], hd_steps_step(steps, k), k);
        else
            h->known[k] = -1;
    }
}

static void follow(harvest *h)
{
    const hd_scene_def scene = scene_of(&h->box, h->seed);
    h->run = created(&scene);
    h->p = room(2 * (size_t)scene.number, sizeof *h->p);
    h->sums = room(BLOCKS, sizeof *h->sums);
    for (int k = 0; k < STEPS; k++) h->known[k] = -1;
    go_on(h->run, HD_AVERAGING);
    const double start = hd_run_time(h->run);
    const double before = hd_trajectory_totals(hd_run_parts(h->run).trajectory).virial[0];
    while (hd_run_stage(h->run) < HD_FINISHED) {
        require(hd_run_advance(h->run), "run");
        if (hd_run_report_due(h->run)) report_measure(h, hd_run_time(h->run) - start);
    }
    const double after = hd_trajectory_totals(hd_run_parts(h->run).trajectory).virial[0];
    h->pressure = h->flown / h->reports + (after - before) / (hd_run_time(h->run) - start);
    h->pressure /= scene.number;
}

static void harvest_free(harvest *h)
{
    hd_run_free(h->run);
    free(h->p);
    free(h->sums);
}

/* ---- sums -> numbers ------------------------------------------------------------------------ */

enum { ANGLE, MEAN, DIFFERENCE, SYMMETRIC, RATE, EXPECTED, OVER, SUM_RULE, NUMBERS };

/** w = c z + d conj(z), by least squares: C = Re c + ((Re d, Im d), (Im d, -Re d)) and a rotation
 * by arg c. ANGLE: phase of w less that of z on average; MEAN: Re c; DIFFERENCE, SYMMETRIC: d over
 * it; RATE: of the phase of z; EXPECTED: sqrt(1 - |d|^2 / x^2) with x, the rate of the pressure;
 * OVER: the rate over x EXPECTED; SUM_RULE: the form of whole vectors over that of the fields. */
static void numbers_of(double out[NUMBERS], const sums *s, double sampling, double x)
{
    const double det = s->z2 * s->z2 - creal(s->zz * conj(s->zz));
    const double complex c = (s->z2 * s->zw - conj(s->zz) * s->z_w) / det;
    const double complex d = (s->z2 * s->z_w - s->zz * s->zw) / det;
    out[ANGLE] = carg(s->zw);
    out[MEAN] = creal(c);
    out[DIFFERENCE] = creal(d) / creal(c);
    out[SYMMETRIC] = cimag(d) / creal(c);
    out[RATE] = carg(s->turn) / sampling;
    out[EXPECTED] = sqrt(1.0 - creal(d * conj(d)) / (x * x));
    out[OVER] = out[RATE] / (x * out[EXPECTED]);
    out[SUM_RULE] = s->whole / s->antisymmetric;
}

static void sums_add(sums *s, const sums *more, double factor)
{
    s->zw += factor * more->zw, s->z_w += factor * more->z_w, s->zz += factor * more->zz;
    s->turn += factor * more->turn, s->z2 += factor * more->z2;
    s->antisymmetric += factor * more->antisymmetric, s->whole += factor * more->whole;
}

static double wave_number(const harvest *h, int step)
{
    return hd_steps_step(hd_run_parts(h->run).steps, step)->wave.number;
}

/** P_xx / (sqrt(2) rho) for kT = 1: the velocity of the pressure alone. */
static double velocity_of_pressure(const harvest *h) { return h->pressure / sqrt(2.0); }

/** Jackknife: one block of time after the other is left out. False if one is empty. */
static bool estimate(double value[NUMBERS], double error[NUMBERS], const harvest *h, int step)
{
    sums total = {0};
    double square[NUMBERS] = {0};
    const double x = velocity_of_pressure(h) * wave_number(h, step);
    for (int b = 0; b < BLOCKS; b++) {
        if (!(h->sums[b][step].z2 > 0.0)) return false;
        sums_add(&total, &h->sums[b][step], 1.0);
    }
    numbers_of(value, &total, h->box.sampling, x);
    for (int b = 0; b < BLOCKS; b++) {
        sums less = total;
        double without[NUMBERS];
        sums_add(&less, &h->sums[b][step], -1.0);
        numbers_of(without, &less, h->box.sampling, x);
        for (int k = 0; k < NUMBERS; k++) square[k] += pow(without[k] - value[k], 2.0);
    }
    for (int k = 0; k < NUMBERS; k++) error[k] = sqrt(square[k] * (BLOCKS - 1) / BLOCKS);
    return true;
}

/* ---- runs -> a row -------------------------------------------------------------------------- */

/** One step of a box. */
typedef struct row {
    int seeds;
    double value[NUMBERS][SEEDS], error[NUMBERS][SEEDS];
    double lambda, apart, pressure; /**< sums: exponent, time between collisions, velocity */
} row;

/** h[seeds]: all runs of the box; those in which the step stands alone. */
static void row_gather(row *r, const harvest *h, int step)
{
    for (int s = 0; s < h->box.seeds; s++) {
        const hd_steps *steps = hd_run_parts(h[s].run).steps;
        double value[NUMBERS], error[NUMBERS];
        if (!is_wanted(steps, step) || !estimate(value, error, &h[s], step)) continue;
        for (int n = 0; n < NUMBERS; n++)
            r->value[n][r->seeds] = value[n], r->error[n][r->seeds] = error[n];
        r->lambda += hd_steps_step(steps, step)->exponent;
        r->apart += 1.0 / hd_gas_read(hd_run_parts(h[s].run).gas).collision_rate;
        r->pressure += velocity_of_pressure(&h[s]);
        r->seeds++;
    }
}

static const char *const HEADER =
    "density,disks,height [sigma],ends of x,nodes,seeds,k [1/sigma],lambda [1/time unit],"
    "time between collisions [time units],P_xx / (sqrt(2) rho) [sigma/time unit],"
    "angle [rad],angle error,mean C [1/time unit],mean C error,difference / mean,difference error,"
    "symmetric / mean,symmetric error,v [sigma/time unit],v error,"
    "sqrt(1 - (h^2 + g^2) / x^2),expected error,v over that of pressure and C,over error,sum rule";

/** The step of this index, if it stood alone in any run. */
static void tell(const harvest *h, int step)
{
    const hd_step *of = hd_steps_step(hd_run_parts(h->run).steps, step);
    const box *b = &h->box;
    row r = {0};
    double error;
    row_gather(&r, h, step);
    if (r.seeds == 0) return;
    printf("%g,%d,%g,%s,%d,%d,%.6g,%.6g,%.6g,%.6g,", b->density, b->disks, b->height,
           b->end == HD_PERIODIC ? "periodic" : "reflecting", of->wave.n[0], r.seeds,
           of->wave.number, r.lambda / r.seeds, r.apart / r.seeds, r.pressure / r.seeds);
    for (int n = 0; n < SUM_RULE; n++) {
        const double unit = n == RATE ? of->wave.number : 1.0,
                     mean = mean_over_seeds(r.value[n], r.error[n], r.seeds, &error);
        printf("%.6g,%.3g,", mean / unit, error / unit);
    }
    printf("%.6g\n", mean_over_seeds(r.value[SUM_RULE], r.error[SUM_RULE], r.seeds, &error));
}

int main(int argc, char **argv)
{
    const bool quick = study_begin(argc, argv, HEADER);
    const int boxes = quick ? 1 : BOXES_ALL;
    harvest *h = room((size_t)boxes * SEEDS, sizeof *h);
    int runs = 0;
    for (int b = 0; b < boxes; b++) {
        const box one = quick ? QUICK : BOXES[b];
        for (int s = 0; s < one.seeds; s++) h[runs].box = one, h[runs++].seed = s;
    }
#pragma omp parallel for schedule(dynamic)
    for (int r = 0; r < runs; r++) follow(&h[r]);
    for (int r = 0; r < runs; r += h[r].box.seeds)
        for (int k = 0; k < STEPS && k < hd_steps_count(hd_run_parts(h[r].run).steps); k++)
            tell(&h[r], k);
    for (int r = 0; r < runs; r++) harvest_free(&h[r]);
    free(h);
    return 0;
}
