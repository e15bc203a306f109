/** Sound beside LP modes: the period of the correlation of the longest longitudinal momentum wave,
 * and that of the longest LP mode. Usage: sound [--quick] >findings_sound.csv */
#include <complex.h>
#include <math.h>

#include "study.h"

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

/** Virial of collisions along x so far. */
static double virial_of(const hd_trajectory *disks)
{
    double virial[2];
    hd_trajectory_virial(disks, virial);
    return virial[0];
}

/** Velocity of sound from one seed; P_xx / (rho kT), and collisions of a disk per time unit. */
static double sound(const box *b, int seed, int samples, double *pressure, double *rate)
{
    const hd_scene_def scene = scene_of(b, seed);
    const double k = hd_wave_component(&scene, 0, 1);
    hd_trajectory *disks;
    require(hd_trajectory_create(&disks, &scene), "sound");
    const double settled = 200.0 * b->disks / hd_trajectory_collision_rate(disks);
    require(hd_trajectory_extend(disks, NULL, settled), "sound");
    const double virial = virial_of(disks), pairs = (double)hd_trajectory_collisions(disks);
    const double v = (1.0 + virial / (settled * b->disks)) / sqrt(2.0);
    const double sampling = TURN / (2.0 * v * k), all = samples * sampling * b->disks;
    double square = 0.0, *q = room(2 * (size_t)b->disks, sizeof *q),
           *p = room(2 * (size_t)b->disks, sizeof *p);
    double complex *wave = room((size_t)samples, sizeof *wave);
    for (int s = 0; s < samples; s++) {
        require(hd_trajectory_extend(disks, NULL, settled + (s + 1) * sampling), "sound");
        hd_trajectory_state(disks, q, p);
        wave[s] = momentum_wave(q, p, b->disks, k, &square);
    }
    *pressure = square / samples + (virial_of(disks) - virial) / all;
    *rate = 2.0 * ((double)hd_trajectory_collisions(disks) - pairs) / all;
    const double found = rate_of(wave, samples, sampling) / k;
    free(wave);
    free(q);
    free(p);
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
    hd_run *run = created(&scene);
    go_on(run, HD_FINISHED);
    const hd_velocity v = hd_phases_velocity(hd_run_phases(run));
    const double k = hd_wave_component(&scene, 0, 1);
    hd_run_free(run);
    *error = v.v_error;
    return v.phases > 0 && fabs(v.k_min - k) < 1e-9 && fabs(v.k_max - k) < 1e-9 ? v.v : 0.0;
}

static void go(const box *b, bool quick)
{
    const int samples = quick ? SAMPLES / 4 : SAMPLES;
    double sum = 0.0, squares = 0.0, pressure, rate, error;
    for (int s = 0; s < SEEDS; s++) {
        const double c = sound(b, s, samples, &pressure, &rate);
        sum += c / SEEDS, squares += c * c / SEEDS;
    }
    const double sound_error = sqrt(fmax(0.0, squares - sum * sum) / (SEEDS - 1));
    const double v = mode(b, rate, quick ? 0.25 : 1.0, &error);
    printf("%g,%g,%d,%.6g,%.3g,%.6g,%.3g,%.6g\n", b->density, b->height, b->disks, sum, sound_error,
           v, error, pressure / sqrt(2.0));
    fflush(stdout);
}

int main(int argc, char **argv)
{
    const bool quick = study_begin(
        argc, argv,
        "density,height [sigma],disks,sound [sigma/time unit],sound error,"
        "v [sigma/time unit],v error,P_xx / (sqrt(2) rho) [sigma/time unit]");
    const int first = quick ? 2 : 0, boxes = quick ? 1 : BOXES_ALL;
    for (int b = first; b < first + boxes; b++) go(&BOXES[b], quick);
    return 0;
}
