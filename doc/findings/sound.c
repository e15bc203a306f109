/** Sound beside LP modes: the period of the correlation of the longest longitudinal momentum wave,
 * that of the longest LP mode, and the velocity of sound that follows from pressures. All from
 * several seeds. Usage: sound [--quick] >findings_sound.csv */
#include <complex.h>

#include "study.h"

enum { SEEDS = 6, MODES = 4, FIRST_LAG = 2, LAGS = 16, SAMPLES = 16000 };
static const double TURN = 0.6 /* [rad], of sound from one sample to the next, about */;
static const double APART = 0.06; /* densities whose pressures are compared, over 1 - density */

typedef struct box {
    double density, height; /**< height 1.000002: hardly more than a disk */
    int disks;
    double collisions; /**< of each disk, with tangent vectors */
} box;

static const box BOXES[] = {
    {0.1, 1.000002, 50, 2000},  {0.1, 1.000002, 100, 2000}, {0.4, 1.000002, 50, 4000},
    {0.4, 1.000002, 100, 4000}, {0.8, 1.000002, 50, 6000},  {0.8, 1.000002, 100, 6000},
    {0.1, 4, 60, 1500},         {0.1, 4, 120, 1000},        {0.4, 4, 60, 2000},
    {0.4, 4, 120, 1500},        {0.8, 5, 140, 3000}};
enum { BOXES_ALL = sizeof BOXES / sizeof *BOXES, QUICK = 4 /* the box of a trial */ };

static double wave_number(const box *b)
{
    return 8.0 * atan(1.0) * b->density * b->height / b->disks;
}

static hd_scene_def scene_of(const box *b, int seed)
{
    hd_scene_def scene = hd_scene_def_default();
    scene.number = b->disks;
    scene.density = b->density;
    scene.aspect = b->height * b->height * b->density / b->disks;
    scene.seed = (uint64_t)seed + 1;
    scene.threads = 1;
    return scene;
}

/** sum p_x exp(i k x) */
static double complex momentum_wave(const double *q, const double *p, int disks, double k)
{
    double complex sum = 0.0;
    for (int j = 0; j < disks; j++) sum += p[2 * j] * cexp(I * k * q[2 * j]);
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

/** Disks that move by themselves, and what they have counted at a time. */
typedef struct gas {
    hd_trajectory *disks;
    double time, virial, pairs;
} gas;

static gas gas_at(hd_trajectory *disks)
{
    const hd_totals told = hd_trajectory_totals(disks);
    const gas now = {disks, hd_trajectory_time(disks), told.virial[0], (double)told.collisions};
    return now;
}

/** Each disk has collided about 200 times a disk's number of neighbours along the box. */
static gas settled(const box *b, int seed)
{
    const hd_scene_def scene = scene_of(b, seed);
    hd_trajectory *disks;
    require(hd_trajectory_create(&disks, &scene), "sound");
    require(
        hd_trajectory_extend(disks, NULL, 200.0 * b->disks / hd_trajectory_totals(disks).expected),
        "sound");
    return gas_at(disks);
}

/** Z = P_xx / rho since then, the kinetic energy of a disk being 1. */
static double compressibility(const gas *since, int disks)
{
    const gas now = gas_at(since->disks);
    return 1.0 + (now.virial - since->virial) / ((now.time - since->time) * disks);
}

/** Velocity of sound from the correlation; Z and collisions of a disk per time unit. */
static double sound(const box *b, int seed, int samples, double *z, double *rate)
{
    const double k = wave_number(b);
    const gas start = settled(b, seed);
    /* sound is at least sqrt(2) times as fast as without collisions */
    const double guess = 1.0 + start.virial / (start.time * b->disks);
    const double sampling = TURN / (sqrt(2.0) * guess * k);
    double *q = room(2 * (size_t)b->disks, sizeof *q), *p = room(2 * (size_t)b->disks, sizeof *p);
    double complex *wave = room((size_t)samples, sizeof *wave);
    for (int s = 0; s < samples; s++) {
        require(hd_trajectory_extend(start.disks, NULL, start.time + (s + 1) * sampling), "sound");
        hd_trajectory_state(start.disks, q, p);
        wave[s] = momentum_wave(q, p, b->disks, k);
    }
    *z = compressibility(&start, b->disks);
    *rate = 2.0 * (gas_at(start.disks).pairs - start.pairs) / (samples * sampling * b->disks);
    const double found = rate_of(wave, samples, sampling) / k;
    free(wave);
    free(q);
    free(p);
    hd_trajectory_free(start.disks);
    return found;
}

/** Z at another density, in a box as high, from so many collisions of a disk. */
static double compressibility_at(const box *b, double density, int seed, double collisions)
{
    box other = *b;
    other.density = density;
    const gas start = settled(&other, seed);
    const double rate = 2.0 * start.pairs / (start.time * b->disks);
    require(hd_trajectory_extend(start.disks, NULL, start.time + collisions / rate), "sound");
    const double z = compressibility(&start, b->disks);
    hd_trajectory_free(start.disks);
    return z;
}

/** c^2 = d(rho Z)/d rho + Z^2 by two neighbouring densities, Z at that of the box. */
static double sound_of_pressure(const box *b, double z, int seed, double collisions)
{
    const double below = b->density - APART * b->density * (1.0 - b->density);
    const double above = b->density + APART * b->density * (1.0 - b->density);
    const double slope = (above * compressibility_at(b, above, seed, collisions) -
                          below * compressibility_at(b, below, seed, collisions)) /
                         (above - below);
    return sqrt(slope + z * z);
}

/** Mean rate of the phases of LP(1,0) over k, and its error; NaN if it was not followed. */
static double mode(const box *b, int seed, double rate, double part, double *error)
{
    hd_scene_def scene = scene_of(b, seed);
    scene.equilibration = 100.0 / rate;
    scene.duration = part * b->collisions / rate;
    scene.warmup = 0.25 * scene.duration;
    scene.report_interval = scene.duration / 40.0;
    scene.max_mode_number = 1;
    scene.observe = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES;
    hd_run *run = created(&scene);
    go_on(run, HD_FINISHED);
    const hd_velocity v = hd_phases_velocity(hd_run_parts(run).phases);
    const double k = hd_wave_component(&scene, 0, 1);
    hd_run_free(run);
    *error = fmax(0.0, v.v_error);
    return v.phases > 0 && fabs(v.k_min - k) < 1e-9 && fabs(v.k_max - k) < 1e-9 ? v.v : NAN;
}

static void tell(const double *value, const double *stated, int count, const char *end)
{
    double error;
    const double mean = mean_over_seeds(value, stated, count, &error);
    printf("%.6g,%.3g%s", mean, error, end);
}

/** Seeds side by side, as many as there are cores. */
static void go(const box *b, bool quick)
{
    const int samples = quick ? SAMPLES / 8 : SAMPLES, modes = quick ? 1 : MODES;
    const double collisions = quick ? 2e3 : 6e4, none[SEEDS] = {0.0};
    double c[SEEDS], expected[SEEDS], pressure[SEEDS], rate[SEEDS], v[MODES], error[MODES];
#pragma omp parallel for schedule(dynamic)
    for (int s = 0; s < SEEDS; s++) {
        double z;
        c[s] = sound(b, s, samples, &z, &rate[s]);
        expected[s] = sound_of_pressure(b, z, s, collisions);
        pressure[s] = z / sqrt(2.0);
    }
#pragma omp parallel for schedule(dynamic)
    for (int s = 0; s < modes; s++) v[s] = mode(b, s, rate[s], quick ? 0.25 : 1.0, &error[s]);
    printf("%g,%g,%d,%.6g,", b->density, b->height, b->disks, wave_number(b));
    tell(c, none, SEEDS, ",");
    tell(expected, none, SEEDS, ",");
    tell(pressure, none, SEEDS, ",");
    tell(v, error, modes, "\n");
    fflush(stdout);
}

int main(int argc, char **argv)
{
    const bool quick = study_begin(
        argc, argv,
        "density,height [sigma],disks,k [1/sigma],sound [sigma/time unit],sound error,"
        "sound of the pressure [sigma/time unit],of the pressure error,"
        "P_xx / (sqrt(2) rho) [sigma/time unit],P_xx error,v [sigma/time unit],v error");
    const int first = quick ? QUICK : 0, boxes = quick ? 1 : BOXES_ALL;
    for (int b = first; b < first + boxes; b++) go(&BOXES[b], quick);
    return 0;
}
