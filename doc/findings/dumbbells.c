/** Hard dumbbells: exponents against the bond, how much of each vector is rotation, T and LP steps
 * and how far apart the exponents of one step are, beside disks; LP velocities and pressures; steps
 * of three boxes for each kind of boundary. Rows of a box: its exponents, then its steps.
 * Usage: dumbbells [--quick] >findings_dumbbells.csv */
#include "study.h"

enum { SEEDS = 4, BLOCKS = 64 };
#define P HD_PERIODIC
#define R HD_REFLECTING
#define DISKS 0.0
#define POINTS (-1.0)

typedef struct box {
    double bond, inertia; /**< bond 0: disks */
    double density, height;
    int number, nodes;
    hd_boundary boundary[2];
    double warmup, duration;
    int seeds;
} box;

static const box BOXES[] = {
    /* what the exponents of one step are apart by: 24 x 2.5 at density 0.6, then others */
    {0.25, DISKS, 0.6, 2.5, 36, 2, {P, P}, 200, 8000, 4},
    {0.0, DISKS, 0.6, 2.5, 36, 2, {P, P}, 200, 4000, 4},
    {0.0, DISKS, 0.7895, 2.5, 47, 2, {P, P}, 200, 4000, 4},
    {0.25, POINTS, 0.6, 2.5, 36, 2, {P, P}, 200, 4000, 4},
    {0.1, DISKS, 0.6, 2.5, 36, 2, {P, P}, 200, 4000, 4},
    {0.1, POINTS, 0.6, 2.5, 36, 2, {P, P}, 200, 4000, 4},
    {0.5, DISKS, 0.6, 2.5, 36, 2, {P, P}, 200, 4000, 4},
    {0.5, POINTS, 0.6, 2.5, 36, 2, {P, P}, 200, 4000, 4},
    {0.05, DISKS, 0.6, 2.5, 36, 2, {P, P}, 500, 4000, 4},
    {0.05, POINTS, 0.6, 2.5, 36, 2, {P, P}, 500, 4000, 4},
    {0.02, DISKS, 0.6, 2.5, 36, 2, {P, P}, 2000, 16000, 4},
    {0.01, DISKS, 0.6, 2.5, 36, 2, {P, P}, 4000, 32000, 4},
    {0.25, DISKS, 0.6, 5.0, 72, 2, {P, P}, 200, 4000, 4},
    {0.25, DISKS, 0.6, 2.5, 72, 4, {P, P}, 400, 4000, 4},
    {0.0, DISKS, 0.6, 2.5, 72, 4, {P, P}, 400, 4000, 4},
    {0.25, DISKS, 0.6, 10.0, 144, 2, {P, P}, 200, 2000, 2},
    {0.0, DISKS, 0.6, 10.0, 144, 2, {P, P}, 200, 2000, 2},
    {0.0, DISKS, 0.7895, 10.0, 189, 2, {P, P}, 200, 1500, 2},
    {0.25, DISKS, 0.6, 2.5, 144, 4, {P, P}, 800, 2000, 2},
    /* against the bond: 8 x 8 at density 0.5 */
    {0.0, DISKS, 0.5, 8.0, 32, 1, {P, P}, 200, 2000, 4},
    {0.01, DISKS, 0.5, 8.0, 32, 1, {P, P}, 4000, 40000, 4},
    {0.02, DISKS, 0.5, 8.0, 32, 1, {P, P}, 2000, 16000, 4},
    {0.05, DISKS, 0.5, 8.0, 32, 1, {P, P}, 500, 4000, 4},
    {0.1, DISKS, 0.5, 8.0, 32, 1, {P, P}, 200, 2000, 4},
    {0.25, DISKS, 0.5, 8.0, 32, 1, {P, P}, 200, 2000, 4},
    {0.5, DISKS, 0.5, 8.0, 32, 1, {P, P}, 200, 2000, 4},
    {1.0, DISKS, 0.5, 7.75, 32, 1, {P, P}, 500, 1000, 4},
    {0.01, POINTS, 0.5, 8.0, 32, 1, {P, P}, 200, 1000, 4},
    {0.02, POINTS, 0.5, 8.0, 32, 1, {P, P}, 200, 1000, 4},
    {0.05, POINTS, 0.5, 8.0, 32, 1, {P, P}, 200, 1000, 4},
    {0.1, POINTS, 0.5, 8.0, 32, 1, {P, P}, 200, 1000, 4},
    {0.25, POINTS, 0.5, 8.0, 32, 1, {P, P}, 200, 1000, 4},
    {0.5, POINTS, 0.5, 8.0, 32, 1, {P, P}, 200, 1000, 4},
    {1.0, POINTS, 0.5, 7.75, 32, 1, {P, P}, 500, 1000, 4},
    /* velocities, at one density, packing fraction or pressure */
    {0.25, DISKS, 0.1, 5.0, 100, 1, {P, P}, 2000, 8000, 2},
    {0.25, DISKS, 0.2, 5.0, 100, 1, {P, P}, 1000, 6000, 2},
    {0.25, DISKS, 0.3, 5.0, 100, 1, {P, P}, 800, 5000, 2},
    {0.25, DISKS, 0.4, 5.0, 100, 1, {P, P}, 600, 4000, 2},
    {0.25, DISKS, 0.5, 5.0, 100, 1, {P, P}, 400, 3000, 2},
    {0.25, DISKS, 0.6, 5.0, 100, 1, {P, P}, 400, 3000, 2},
    {0.25, DISKS, 0.7, 5.0, 100, 1, {P, P}, 400, 2000, 2},
    {0.25, POINTS, 0.3, 5.0, 100, 1, {P, P}, 800, 5000, 2},
    {0.25, POINTS, 0.6, 5.0, 100, 1, {P, P}, 400, 3000, 2},
    {0.5, DISKS, 0.1, 5.0, 100, 1, {P, P}, 2000, 8000, 2},
    {0.5, DISKS, 0.3, 5.0, 100, 1, {P, P}, 800, 5000, 2},
    {0.5, DISKS, 0.5, 5.0, 100, 1, {P, P}, 400, 2000, 2},
    {0.0, DISKS, 0.1, 5.0, 100, 1, {P, P}, 2000, 8000, 2},
    {0.0, DISKS, 0.2, 5.0, 100, 1, {P, P}, 1000, 6000, 2},
    {0.0, DISKS, 0.4, 5.0, 100, 1, {P, P}, 600, 4000, 2},
    {0.0, DISKS, 0.6, 5.0, 100, 1, {P, P}, 400, 4000, 2},
    {0.0, DISKS, 0.7, 5.0, 100, 1, {P, P}, 400, 3000, 2},
    {0.0, DISKS, 0.7895, 5.0, 100, 1, {P, P}, 400, 3000, 2},
    {0.0, DISKS, 0.83, 5.0, 100, 1, {P, P}, 400, 3000, 2},
    /* steps of three boxes: 24 x 2.5, 18.5 x 9, 14.1 x 14.1 */
    {0.25, DISKS, 0.6, 2.5, 36, 2, {R, P}, 200, 2000, 2},
    {0.25, DISKS, 0.6, 2.5, 36, 2, {P, R}, 200, 2000, 2},
    {0.25, DISKS, 0.6, 2.5, 36, 2, {R, R}, 200, 2000, 2},
    {0.25, DISKS, 0.6, 9.0, 100, 2, {P, P}, 200, 1500, 2},
    {0.25, DISKS, 0.6, 9.0, 100, 2, {R, P}, 200, 1500, 2},
    {0.25, DISKS, 0.6, 9.0, 100, 2, {P, R}, 200, 1500, 2},
    {0.25, DISKS, 0.6, 9.0, 100, 2, {R, R}, 200, 1500, 2},
    {0.25, DISKS, 0.6, 14.1421, 120, 1, {P, P}, 200, 1500, 2},
    {0.25, DISKS, 0.6, 14.1421, 120, 1, {R, P}, 200, 1500, 2},
    {0.25, DISKS, 0.6, 14.1421, 120, 1, {R, R}, 200, 1500, 2},
};
enum { BOXES_ALL = sizeof BOXES / sizeof *BOXES, QUICK = 2 };

static hd_scene_def scene_of(const box *b, int seed, bool quick)
{
    hd_scene_def scene = hd_scene_def_default();
    if (b->bond > 0) {
        scene.particles = HD_DUMBBELLS;
        scene.own[0].real = b->bond;
        scene.own[1].real = b->inertia;
    }
    scene.number = b->number;
    scene.density = b->density;
    scene.aspect = b->height * b->height * b->density / b->number;
    for (int d = 0; d < 2; d++) scene.boundary[d] = b->boundary[d];
    scene.seed = (uint64_t)seed + 1;
    scene.equilibration = fmax(100.0, b->warmup);
    scene.warmup = b->warmup * (quick ? 0.3 : 1.0);
    scene.duration = b->duration * (quick ? 0.1 : 1.0);
    scene.max_mode_number = b->nodes;
    scene.observe = HD_OBSERVE_STEPS | HD_OBSERVE_GAS | HD_OBSERVE_PHASES;
    scene.threads = 1;
    return scene;
}

/** A run, and what its vectors have grown by: ln R at the ends of its blocks, [BLOCKS + 1][n]. */
typedef struct course {
    hd_run *run;
    double *growth, time[BLOCKS + 1];
    int blocks;
} course;

static void end_block(course *c)
{
    const hd_spectrum *spectrum = hd_run_parts(c->run).spectrum;
    const int n = hd_run_vectors(c->run);
    const double time = hd_spectrum_time(spectrum);
    c->time[c->blocks] = time;
    for (int l = 0; l < n; l++)
        c->growth[c->blocks * n + l] = hd_spectrum_exponent(spectrum, l) * time;
}

static course follow(const box *b, int seed, bool quick)
{
    const hd_scene_def scene = scene_of(b, seed, quick);
    course c = {.run = created(&scene)};
    c.growth = room((size_t)(BLOCKS + 1) * (size_t)hd_run_vectors(c.run), sizeof(double));
    go_on(c.run, HD_AVERAGING);
    while (hd_run_stage(c.run) < HD_FINISHED) {
        require(hd_run_advance(c.run), "run");
        const double time = hd_spectrum_time(hd_run_parts(c.run).spectrum);
        const bool later = time > c.time[c.blocks];
        if (c.blocks == BLOCKS || !later || time < scene.duration * (c.blocks + 1) / BLOCKS)
            continue;
        c.blocks++;
        end_block(&c);
    }
    return c;
}

/** What a seed says, with its standard error. */
typedef struct said {
    double value, error;
} said;

static said turning(const course *c, int first, int count)
{
    const double *share = hd_modes_share_average(hd_run_parts(c->run).modes, HD_SHARE_TURNING);
    said s = {0.0, 0.0};
    for (int l = first; share && l < first + count; l++) s.value += share[l] / count;
    return s;
}

/** Of the vectors of a step, less their mean: what the variance of ln R grows by in a time unit. */
static said trembling(const course *c, const hd_step *step)
{
    const int n = hd_run_vectors(c->run), count = step->count;
    const double free = (count - 1.0) * (c->blocks - 1.0);
    double square = 0.0;
    for (int k = 0; k < c->blocks; k++) {
        const double dt = c->time[k + 1] - c->time[k];
        const double *before = &c->growth[k * n + step->col], *after = before + n;
        const double *whole = &c->growth[c->blocks * n + step->col];
        double sum = 0.0, squares = 0.0;
        for (int l = 0; l < count; l++) {
            const double grown = after[l] - before[l] - whole[l] * dt / c->time[c->blocks];
            sum += grown;
            squares += grown * grown;
        }
        square += (squares - sum * sum / count) / dt;
    }
    return (said){square / free, square / free * sqrt(2.0 / free)};
}

/** Mean distance of its neighbouring exponents, whose ln R trembles by so much. */
static said apart(const course *c, const hd_step *step, double trembles)
{
    const hd_spectrum *spectrum = hd_run_parts(c->run).spectrum;
    const int gaps = step->count - 1;
    const double whole = hd_spectrum_exponent(spectrum, step->col) -
                         hd_spectrum_exponent(spectrum, step->col + gaps);
    return (said){whole / gaps, sqrt(2.0 * trembles / hd_spectrum_time(spectrum)) / gaps};
}

static said rate_of_phases(const course *c, int index)
{
    double omega, error;
    if (hd_steps_step(hd_run_parts(c->run).steps, index)->kind != HD_MODE_LP ||
        !hd_phases_rate(hd_run_parts(c->run).phases, index, &omega, &error))
        return (said){NAN, 0.0};
    return (said){fabs(omega), error};
}

/* ---- table ---------------------------------------------------------------------------------- */

static void tell(const said *s, int seeds)
{
    double value[SEEDS], stated[SEEDS], error;
    for (int k = 0; k < seeds; k++) value[k] = s[k].value, stated[k] = fmax(0.0, s[k].error);
    const double mean = mean_over_seeds(value, stated, seeds, &error);
    printf(",%.6g,%.3g", mean, error);
}

/** What each row begins with. */
static void tell_box(const box *b, const course *c)
{
    said rate[SEEDS], pressure[SEEDS];
    for (int s = 0; s < b->seeds; s++) {
        const hd_gas_means gas = hd_gas_read(hd_run_parts(c[s].run).gas);
        rate[s] = (said){gas.collision_rate, gas.collision_rate_error};
        pressure[s] = (said){gas.pressure_of[0], gas.pressure_of_error[0]};
    }
    const char *inertia = b->bond == 0 ? "none" : b->inertia < 0 ? "points" : "disks";
    printf("%g,%s,%g,%g,%d,%s%s,%.6g", b->bond, inertia, b->density, b->height, b->number,
           b->boundary[0] == P ? "p" : "r", b->boundary[1] == P ? "p" : "r",
           hd_gas_temperature(hd_run_scene(c[0].run)));
    tell(rate, b->seeds);
    tell(pressure, b->seeds);
}

static void tell_exponent(const box *b, const course *c, int col)
{
    said lambda[SEEDS], share[SEEDS];
    for (int s = 0; s < b->seeds; s++) {
        const hd_spectrum *spectrum = hd_run_parts(c[s].run).spectrum;
        lambda[s] = (said){hd_spectrum_exponent(spectrum, col),
                           hd_spectrum_std_error(spectrum, col)};
        share[s] = turning(&c[s], col, 1);
    }
    tell_box(b, c);
    printf(",exponent,0,0,0,0,0,0,%d", col + 1);
    tell(lambda, b->seeds);
    tell(share, b->seeds);
    printf(",nan,nan,nan,nan,nan,nan\n");
}

/** A row of a step that every seed has resolved. */
static void tell_step(const box *b, const course *c, int index)
{
    said lambda[SEEDS], share[SEEDS], distance[SEEDS], trembles[SEEDS], omega[SEEDS];
    double found = 0.0;
    const hd_step *first = hd_steps_step(hd_run_parts(c[0].run).steps, index);
    for (int s = 0; s < b->seeds; s++) {
        const hd_step *step = hd_steps_step(hd_run_parts(c[s].run).steps, index);
        if (!step->resolved) return;
        found += step->multiplicity / b->seeds;
        lambda[s] = (said){step->exponent, step->std_error};
        share[s] = turning(&c[s], step->col, step->count);
        distance[s] = trembles[s] = (said){NAN, 0.0};
        if (step->members == 1 && step->count > 1) {
            trembles[s] = trembling(&c[s], step);
            distance[s] = apart(&c[s], step, trembles[s].value);
        }
        omega[s] = rate_of_phases(&c[s], index);
    }
    tell_box(b, c);
    printf(",%s,%d,%d,%.6g,%d,%.4g,%d,%d", first->kind == HD_MODE_T ? "T" : "LP", first->wave.n[0],
           first->wave.n[1], first->wave.number, first->expected, found, first->members,
           first->col + 1);
    tell(lambda, b->seeds);
    tell(share, b->seeds);
    tell(distance, b->seeds);
    tell(trembles, b->seeds);
    tell(omega, b->seeds);
    printf("\n");
}

static void go(const box *b, bool quick)
{
    course c[SEEDS];
#pragma omp parallel for schedule(dynamic)
    for (int s = 0; s < b->seeds; s++) c[s] = follow(b, s, quick);
    const int positive = hd_scene_counts(hd_run_scene(c[0].run)).positive;
    for (int col = 0; col < positive; col++) tell_exponent(b, c, col);
    const hd_steps *steps = hd_run_parts(c[0].run).steps;
    for (int index = 0; index < hd_steps_count(steps); index++)
        if (hd_steps_step(steps, index)->kind != HD_MODE_ZERO) tell_step(b, c, index);
    fflush(stdout);
    for (int s = 0; s < b->seeds; s++) {
        hd_run_free(c[s].run);
        free(c[s].growth);
    }
}

int main(int argc, char **argv)
{
    const bool quick = study_begin(
        argc, argv,
        "bond,inertia,density,height,number,boundaries,kT,rate,rate error,P_xx,P_xx error,kind,nx,"
        "ny,k [1/sigma],expected,found,members,index,lambda,lambda error,rotation,rotation error,"
        "apart,apart error,trembling,trembling error,omega,omega error");
    for (int b = 0; b < (quick ? QUICK : BOXES_ALL); b++) go(&BOXES[b], quick);
    return 0;
}
