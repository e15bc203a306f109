/** How long a wanted standard error takes: lambda_1, c_T, c_L and v of one run of the paper's
 * scene, with their standard errors, read at growing times. Usage: hdlyap_convergence [--out
 * FOLDER] [--quick] [--duration TIME UNITS]; writes convergence.csv and convergence_targets.csv. */
#include <hdlyap/hdlyap.h>
#include <math.h>
#include <stdio.h>

#include "gemm.h"
#include "options.h"
#include "progress.h"
#include "sample.h"
#include "table.h"
#include "timing.h"

enum { LAMBDA_1, C_T, C_L, V, QUANTITIES, TARGETS = 3, READINGS_MAX = 400 };

static const char *const NAMES[QUANTITIES] = {"lambda_1", "c_T", "c_L", "v"};
static const double TARGET[TARGETS] = {0.01, 0.003, 0.001};

typedef struct reading {
    double time, wall;                           /**< averaged so far: time units, seconds */
    double value[QUANTITIES], error[QUANTITIES]; /**< error negative where it is not yet known */
} reading;

typedef struct course {
    reading at[READINGS_MAX];
    int count;
    gemm *g;
} course;

/* ---- measuring ----------------------------------------------------------------------------- */

static reading read_run(const hd_run *run, double wall)
{
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    const hd_dispersion t = hd_steps_dispersion(hd_run_steps(run), spectrum, HD_MODE_T);
    const hd_dispersion l = hd_steps_dispersion(hd_run_steps(run), spectrum, HD_MODE_LP);
    const hd_velocity v = hd_phases_velocity(hd_run_phases(run));
    return (reading){.time = hd_spectrum_time(spectrum),
                     .wall = wall,
                     .value = {hd_spectrum_lambda_max(spectrum), t.c.value, l.c.value, v.v},
                     .error = {hd_spectrum_std_error(spectrum, 0), t.c_sampling_error,
                               l.c_sampling_error, v.phases > 0 ? v.v_error : -1.0}};
}

/** Readings are 4 % apart in time, once the first error is known. */
static void keep(course *c, const reading *r)
{
    const bool early = c->count > 0 && r->time < 1.04 * c->at[c->count - 1].time;
    if (r->error[LAMBDA_1] < 0 || early || c->count == READINGS_MAX) return;
    c->at[c->count++] = *r;
}

/** Through the run; dgemm, measured in between, does not count. */
static void follow(hd_run *run, course *c)
{
    progress p = progress_begin("convergence", 1.0);
    while (hd_run_stage(run) != HD_AVERAGING) require(hd_run_advance(run), "warm-up");
    double start = seconds(), before = 0.0;
    for (long step = 0; hd_run_stage(run) != HD_FINISHED; step++) {
        require(hd_run_advance(run), "averaging");
        if (step % 8 == 0) start += gemm_measure(c->g);
        if (!hd_run_report_due(run)) continue;
        const reading r = read_run(run, seconds() - start);
        keep(c, &r);
        progress_add(&p, r.time / hd_run_scene(run)->duration - before);
        before = r.time / hd_run_scene(run)->duration;
    }
    progress_end();
}

/* ---- telling ------------------------------------------------------------------------------- */

static double relative_error(const reading *r, int quantity)
{
    return r->error[quantity] > 0 ? r->error[quantity] / fabs(r->value[quantity]) : INFINITY;
}

/** First reading from which on the error is no larger than the target; NULL if the run is too
 * short. */
static const reading *reached(const course *c, int quantity, double target)
{
    const reading *r = c->at + c->count;
    while (r > c->at && relative_error(r - 1, quantity) <= target) r--;
    return r < c->at + c->count ? r : NULL;
}

/** relative error * sqrt(time), median over the second half of the readings: the error falls as it
 * should. */
static double amplitude(const course *c, int quantity)
{
    sample s = {0};
    for (int k = c->count / 2; k < c->count; k++) {
        const double error = relative_error(&c->at[k], quantity);
        if (error < INFINITY) sample_add(&s, error * sqrt(c->at[k].time));
    }
    return s.count > 0 ? sample_median(&s) : NAN;
}

static void tell_target(const course *c, table *t, int quantity, double target)
{
    const reading *last = &c->at[c->count - 1], *r = reached(c, quantity, target);
    const double root = amplitude(c, quantity) / target;
    const double time = r ? r->time : root * root;
    const double wall = r ? r->wall : time * last->wall / last->time;
    if (!(time < INFINITY)) {
        printf(" %22s", "not known");
        return;
    }
    printf(" %s%8.3g (%8.3g)", r ? "  " : " ~", wall, time);
    table_row(t, "%s,%g,%.6g,%.6g,%s", NAMES[quantity], target, time, wall,
              r ? "measured" : "extrapolated");
}

static void tell_targets(const course *c, const char *folder, char **argv)
{
    const reading *last = &c->at[c->count - 1];
    table *t = table_create(folder, "convergence_targets",
                            "quantity,relative standard error,averaged time [time units],"
                            "wall time [s],how");
    printf("Seconds (time units) of averaging to a relative standard error; ~: beyond this run, as "
           "1/sqrt(t)\n%-9s %22s",
           "", "at the end");
    for (int k = 0; k < TARGETS; k++) printf(" %19g %%", 100.0 * TARGET[k]);
    for (int quantity = 0; quantity < QUANTITIES; quantity++) {
        printf("\n%-9s %9.5g +- %8.2g", NAMES[quantity], last->value[quantity],
               last->error[quantity]);
        for (int k = 0; k < TARGETS; k++) tell_target(c, t, quantity, TARGET[k]);
    }
    printf("\n");
    table_write(t, argv, gemm_rate(c->g));
}

static void write_course(const course *c, const char *folder, char **argv)
{
    table *t = table_create(folder, "convergence",
                            "averaged time [time units],wall time [s],lambda_1 [1/time "
                            "unit],lambda_1 error [1/time unit],"
                            "c_T [sigma/time unit],c_T error [sigma/time unit],c_L [sigma/time "
                            "unit],c_L error [sigma/time unit],"
                            "v [sigma/time unit],v error [sigma/time unit]");
    for (const reading *r = c->at; r < c->at + c->count; r++)
        table_row(t, "%.6g,%.6g,%.8g,%.4g,%.8g,%.4g,%.8g,%.4g,%.8g,%.4g", r->time, r->wall,
                  r->value[LAMBDA_1], r->error[LAMBDA_1], r->value[C_T], r->error[C_T],
                  r->value[C_L], r->error[C_L], r->value[V], r->error[V]);
    table_write(t, argv, gemm_rate(c->g));
}

static hd_scene_def scene_of(bool quick, double duration)
{
    hd_scene_def scene = hd_scene_def_default();
    if (quick) {
        scene.disks = 100;
        scene.aspect = 0.2;
    }
    scene.equilibration = 20.0;
    scene.warmup = 10.0;
    scene.duration = duration;
    scene.observe = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES;
    return scene;
}

int main(int argc, char **argv)
{
    const char *out = ".";
    bool quick = false;
    double duration = 480.0;
    const option list[] = {{"--out", .text = &out},
                           {"--quick", .flag = &quick},
                           {"--duration", .number = &duration, .least = 40, .most = 1e6},
                           {0}};
    options_read(argc, argv, list);
    hd_blas_restart_if_slow(argv);
    const hd_scene_def scene = scene_of(quick, duration);
    hd_run *run = created(&scene);
    course *c = room(1, sizeof *c);
    c->g = gemm_create(scene.disks, hd_run_vectors(run));
    follow(run, c);
    printf("%d disks, averaged for %g time units\n", scene.disks, duration);
    if (c->count == 0) require(HD_NOT_FINITE, "standard errors");
    write_course(c, out, argv);
    tell_targets(c, out, argv);
    gemm_free(c->g);
    free(c);
    hd_run_free(run);
    return 0;
}
