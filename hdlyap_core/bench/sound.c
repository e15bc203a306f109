/** Sound beside LP modes: the period of the correlation of the longest longitudinal momentum wave,
 * and that of the longest LP mode. Usage: hdlyap_sound [--out FOLDER] [--quick]; writes
 * findings_sound.csv. */
#include <complex.h>
#include <hdlyap/hdlyap.h>
#include <math.h>

#include "gemm.h"
#include "options.h"
#include "progress.h"
#include "table.h"
#include "timing.h"

enum { SEEDS = 4, FIRST_LAG = 2, LAGS = 16, SAMPLES = 16000 };
static const double TURN = 0.6 /* [rad], of sound from one sample to the next, about */;

typedef struct box {
    double density, height; /**< height 1.000002: hardly more than a disk */
    int disks;
    double collisions; /**< of each disk, with tangent vectors */
} box;

static const box BOXES[] = {{0.1, 1.000002, 50, 2000}, {0.4, 1.000002, 50, 4000},
                            {0.8, 1.000002, 50, 6000}, {0.1, 4, 60, 1500},
                            {0.4, 4, 60, 2000},        {0.8, 5, 140, 3000}};
enum { BOXES_ALL = sizeof BOXES / sizeof *BOXES };

static hd_scene_def scene_of(const box *b, int seed)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.disks = b->disks;
    scene.density = b->density;
    scene.aspect = b->height * b->height * b->density / b->disks;
    scene.seed = (uint64_t)seed + 1;
    scene.threads = 1;
    return scene;
}

/** What events carry along x, and their number. */
typedef struct tally {
    double carried;
    long pairs;
} tally;

static void tally_add(tally *t, const hd_event_log *log)
{
    for (const hd_event *e = log->event; e < log->event + log->count; e++) {
        if (e->j < 0) continue;
        t->carried -= (e->n[0] * e->p[0] + e->n[1] * e->p[1]) * e->n[0] * e->n[0];
        t->pairs++;
    }
}

/** sum p_x exp(i k x), and the mean square of p_x is added. */
static double complex momentum_wave(const double *q, const double *p, int disks, double k,
                                    double *square)
{
    double complex sum = 0.0;
    for (int j = 0; j < disks; j++) {
        sum += p[2 * j] * cexp(I * k * q[2 * j]);
        *square += p[2 * j] * p[2 * j] / disks;
    }
    return sum;
}

/** Correlation c(m) at m times the sampling -> omega: c(m + 1) + f c(m - 1) = g c(m) of a wave that
 * decays, f and g by least squares; without the shortest lags, where single collisions are seen. */
static double rate_of(const double complex *wave, int samples, double sampling)
{
    double c[LAGS + 1], cc = 0.0, bb = 0.0, bc = 0.0, ac = 0.0, ab = 0.0;
    for (int m = 0; m <= LAGS; m++) {
        c[m] = 0.0;
        for (int s = 0; s + m < samples; s++) c[m] += creal(conj(wave[s]) * wave[s + m]);
        c[m] /= samples - m;
    }
    for (int m = FIRST_LAG + 1; m < LAGS; m++) {
        cc += c[m] * c[m], bb += c[m - 1] * c[m - 1], bc += c[m - 1] * c[m];
        ac += c[m + 1] * c[m], ab += c[m + 1] * c[m - 1];
    }
    const double det = cc * bb - bc * bc;
    const double g = (ac * bb - ab * bc) / det, f = (ac * bc - ab * cc) / det;
    return acos(0.5 * g / sqrt(f)) / sampling;
}

/** Velocity of sound from one seed; P_xx / (rho kT), and collisions of a disk per time unit. */
static double sound(const box *b, int seed, int samples, double *pressure, double *rate)
{
    const hd_scene_def scene = scene_of(b, seed);
    const double k = hd_wave_component(&scene, 0, 1);
    hd_trajectory *disks;
    hd_event_log *log;
    require(hd_trajectory_create(&disks, &scene), "sound");
    require(hd_event_log_create(&log), "sound");
    const double settled = 200.0 * b->disks / hd_trajectory_collision_rate(disks);
    require(hd_trajectory_extend(disks, log, settled), "sound");
    tally t = {0};
    tally_add(&t, log);
    const double v = (1.0 + t.carried / (settled * b->disks)) / sqrt(2.0);
    const double sampling = TURN / (2.0 * v * k);
    double square = 0.0, *q = room(2 * (size_t)b->disks, sizeof *q),
           *p = room(2 * (size_t)b->disks, sizeof *p);
    double complex *wave = room((size_t)samples, sizeof *wave);
    t = (tally){0};
    for (int s = 0; s < samples; s++) {
        hd_event_log_clear(log);
        require(hd_trajectory_extend(disks, log, settled + (s + 1) * sampling), "sound");
        tally_add(&t, log);
        hd_trajectory_state(disks, q, p);
        wave[s] = momentum_wave(q, p, b->disks, k, &square);
    }
    *pressure = square / samples + t.carried / (samples * sampling * b->disks);
    *rate = 2.0 * (double)t.pairs / (samples * sampling * b->disks);
    const double found = rate_of(wave, samples, sampling) / k;
    free(wave);
    free(q);
    free(p);
    hd_event_log_free(log);
    hd_trajectory_free(disks);
    return found;
}

/** Mean rate of the phases of LP(1,0) over k, and its error; 0 if it was not followed. */
static double mode(const box *b, double rate, double part, double *error)
{
    hd_scene_def scene = scene_of(b, 0);
    scene.equilibration = 100.0 / rate;
    scene.duration = part * b->collisions / rate;
    scene.warmup = 0.25 * scene.duration;
    scene.report_interval = scene.duration / 40.0;
    scene.max_mode_number = 1;
    scene.observe = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES;
    hd_run *run;
    char message[512] = "out of memory";
    if (hd_run_create(&run, &scene, message, sizeof message) != HD_OK) {
        fprintf(stderr, "hdlyap_sound: %s\n", message);
        exit(2);
    }
    while (hd_run_stage(run) < HD_FINISHED) require(hd_run_advance(run), "mode");
    const hd_velocity v = hd_phases_velocity(hd_run_phases(run));
    const double k = hd_wave_component(&scene, 0, 1);
    hd_run_free(run);
    *error = v.v_error;
    return v.phases > 0 && fabs(v.k_min - k) < 1e-9 && fabs(v.k_max - k) < 1e-9 ? v.v : 0.0;
}

static void go(const box *b, bool quick, table *t)
{
    const int samples = quick ? SAMPLES / 4 : SAMPLES;
    double sum = 0.0, squares = 0.0, pressure, rate, error;
    for (int s = 0; s < SEEDS; s++) {
        const double c = sound(b, s, samples, &pressure, &rate);
        sum += c / SEEDS, squares += c * c / SEEDS;
    }
    const double sound_error = sqrt(fmax(0.0, squares - sum * sum) / (SEEDS - 1));
    const double v = mode(b, rate, quick ? 0.25 : 1.0, &error);
    printf("%4g %8g %4d  %8.4f %7.4f  %8.4f %7.4f  %8.4f  %7.4f\n", b->density, b->height, b->disks,
           sum, sound_error, v, error, pressure / sqrt(2.0), sum * sqrt(2.0) / pressure);
    fflush(stdout);
    table_row(t, "%g,%g,%d,%.6g,%.3g,%.6g,%.3g,%.6g", b->density, b->height, b->disks, sum,
              sound_error, v, error, pressure / sqrt(2.0));
}

int main(int argc, char **argv)
{
    const char *out = ".";
    bool quick = false;
    const option list[] = {{"--out", .text = &out}, {"--quick", .flag = &quick}, {0}};
    options_read(argc, argv, list);
    hd_blas_restart_if_slow(argv);
    table *t = table_create(out, "findings_sound",
                            "density,height [sigma],disks,sound [sigma/time unit],sound error,"
                            "v [sigma/time unit],v error,P_xx / (sqrt(2) rho) [sigma/time unit]");
    printf("%4s %8s %4s  %8s %7s  %8s %7s  %8s  %7s\n", "rho", "height", "N", "sound", "error", "v",
           "error", "from P", "ratio");
    const int boxes = quick ? 1 : BOXES_ALL;
    progress shown = progress_begin("sound", boxes);
    for (int b = 0; b < boxes; b++) {
        go(&BOXES[quick ? 2 : b], quick, t);
        progress_add(&shown, 1.0);
    }
    progress_end();
    gemm *g = gemm_create(1000, 1000); /* the comment says on what machine */
    gemm_measure(g);
    table_write(t, argv, gemm_rate(g));
    gemm_free(g);
    return 0;
}
