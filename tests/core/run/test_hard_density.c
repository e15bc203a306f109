/** From thin gas to just under closest packing, and channels from a disk's width up: events as the
 * twin has them, energy, overlap, collision rate, and a whole spectrum that is finite, sums to zero
 * and pairs. */
#include "runs.h"
#include "scene/plane_lattice.h"
#include "prepared.h"
#include "base/random.h"
#include "twin.h"

static const double DENSITY[] = {
    0.001, 0.01, 0.1,
    0.4,   0.7,  0.9,
    1.0,   1.1,  (1.0 - 1e-8) * 1.1547005383792515}; /* 2 / sqrt(3): closest packing */
enum { DENSITIES = sizeof DENSITY / sizeof *DENSITY };

/** A box that holds four rows of `columns` disks in closest packing. */
static hd_scene_def packed(int columns, double density)
{
    return scene_of(4 * columns, density, 4.0 * sqrt(0.75) / columns, P, P, 7);
}

/** Time in which a disk collides about `count` times, as tried out. */
static double time_of(const hd_scene_def *def, double count)
{
    MADE(hd_trajectory, tr, def);
    const double wanted = 0.5 * count * def->disks;
    double t = 1e-9 / hd_trajectory_collision_rate(tr), seen = 0;
    while (seen < wanted) {
        CHECK_OK(hd_trajectory_extend(tr, NULL, t *= 1.5));
        seen = (double)hd_trajectory_collisions(tr);
    }
    return t * wanted / seen;
}

/** Where they are, and as two of them touch: as in test_trajectory_conservation.c, and what the
 * rounding of the time of the contact adds at a speed of 4. */
static void check_overlap(hd_trajectory *tr, const double box[2])
{
    const double time = fmax(hd_trajectory_time(tr), next_event_time(tr));
    CHECK_OK(hd_trajectory_extend(tr, NULL, time));
    CHECK_CLOSE(hd_trajectory_overlap(tr), 0.0, 4.0 * DBL_EPSILON * (fmax(box[0], box[1]) + time));
}

/** Rounding of a collision is some eps of the momenta. */
static void check_conserved(const hd_scene_def *def, double events)
{
    enum { LOOKS = 500 };
    double box[2];
    hd_scene_box(def, box);
    const double t_end = time_of(def, 2.0 * events / def->disks);
    MADE(hd_trajectory, tr, def);
    const double energy = hd_trajectory_kinetic_energy(tr);
    for (int k = 1; k <= LOOKS; k++) {
        const double t = t_end * k / LOOKS;
        CHECK_OK(hd_trajectory_extend(tr, NULL, fmax(t, hd_trajectory_time(tr))));
        CHECK_CLOSE(hd_trajectory_kinetic_energy(tr), energy, 20.0 * DBL_EPSILON * sqrt(events));
        check_overlap(tr, box);
    }
    assert_true((double)hd_trajectory_collisions(tr) > 0.5 * events);
}

TEST(gas_to_solid_is_the_twins)
{
    for (int k = 0; k < DENSITIES; k++) {
        const hd_scene_def def = packed(5, DENSITY[k]);
        twin_compare(trajectory_of(def), &def, 2000);
        check_conserved(&def, HD_SANITIZED || !second_tier() ? 2e4 : 2e5);
    }
}

/** A triangular patch of 16 disks that touch, to rounding or as deep as is allowed, with room
 * around. */
TEST(contact_within_rounding_at_the_start)
{
    const double spacing[] = {1.0, 1.0 + DBL_EPSILON, 1.0 - DBL_EPSILON, 1.0 - 1e-12, 1.0 - 0.9e-9};
    hd_random random = hd_random_seeded(3, 0);
    for (int k = 0; k < 5 * 8; k++) {
        const hd_boundary boundary = k % 2 ? R : P;
        const hd_scene_def def = scene_in_box(16, 6.0, 5.5, boundary, boundary, 1);
        double q[32], p[32];
        for (int i = 0; i < 16; i++) {
            q[2 * i] = 0.5 + spacing[k / 8] * (i % 4 + 0.5 * (i / 4 % 2)) + 0.25;
            q[2 * i + 1] = 0.5 + spacing[k / 8] * sqrt(0.75) * (i / 4) + 0.5;
            for (int d = 0; d < 2; d++) p[2 * i + d] = 1.7 * hd_random_symmetric(&random);
        }
        OWNED(hd_trajectory) *tr = started(&def, q, p);
        assert_true(hd_trajectory_overlap(tr) <= 1e-9);
        CHECK_OK(hd_trajectory_extend(tr, NULL, 10.0));
        CHECK_CLOSE(hd_trajectory_overlap(tr), 0.0, 4.0 * DBL_EPSILON * 6.0);
        assert_true(hd_trajectory_collisions(tr) > 100);
        twin_compare(started(&def, q, p), &def, 300);
    }
}

/** All exponents, over `time`: times are those of the dense, accuracy is per time unit. */
static hd_run *finished_after(hd_scene_def scene, double time)
{
    hd_run *run;
    char message[256] = "";
    scene.exponents = HD_EXPONENTS_ALL_INDEPENDENT;
    scene.equilibration = scene.warmup = 0.1 * time;
    scene.duration = time;
    scene.report_interval = fmax(1e-6, time / 20.0);
    scene.accuracy = fmin(1e-2, 1e-8 / time * 1e3);
    scene.threads = 1;
    if (hd_run_create(&run, &scene, message, sizeof message) != HD_OK) fail_msg("%s", message);
    finish(run);
    return run;
}

/** Logarithms of the stretches: all together vanish, as det S = 1, each known to the stated bound;
 * two of a pair differ by what the angles between vectors allow, some units: nothing that grows. */
static void check_spectrum(const hd_run *run)
{
    const double allowed = 12.0, time = hd_run_scene(run)->duration;
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    const int n = hd_run_vectors(run), half = hd_run_scene(run)->disks * 2;
    const int zeros = hd_scene_zero_exponents(hd_run_scene(run));
    double sum = 0, zero = 0;
    for (int col = 0; col < n; col++) {
        assert_true(isfinite(hd_spectrum_exponent(spectrum, col)));
        sum += hd_spectrum_exponent(spectrum, col) * time;
    }
    CHECK_CLOSE(sum, 0.0, n * (hd_run_cost(run).error_bound * time + 1e-12));
    CHECK_CLOSE(hd_spectrum_pairing_error(spectrum) * time, 0.0, allowed);
    for (int col = half - zeros / 2; col < half + zeros / 2; col++)
        zero = fmax(zero, fabs(hd_spectrum_exponent(spectrum, col)));
    CHECK_CLOSE(zero * time, 0.0, allowed);
    assert_true(hd_spectrum_exponent(spectrum, half - zeros / 2 - 1) > 2.0 * zero);
}

TEST(exponents_pair_at_every_density)
{
    for (int k = 0; k < DENSITIES; k++) {
        const hd_scene_def scene = packed(3, DENSITY[k]);
        const double per_disk = HD_SANITIZED ? 300.0 : second_tier() ? 2000.0 : 700.0;
        OWNED(hd_run) *run = finished_after(scene, time_of(&scene, per_disk));
        check_spectrum(run);
    }
}

/** Each of these has an interval whose eighth stretches by more than 1e13. */
TEST(several_grazes_in_an_interval_are_divided)
{
    const uint64_t seeds[] = {159, 284};
    for (int k = 0; k < 2; k++) {
        hd_scene_def scene = scene_of(3, 0.001, 1.0, P, P, seeds[k]);
        const double time = 300.0 / (3.5 * scene.density);
        scene.exponents = HD_EXPONENTS_ALL_INDEPENDENT;
        scene.equilibration = scene.warmup = 0.0;
        scene.duration = scene.report_interval = time;
        OWNED(hd_run) *run = finished(scene);
        CHECK_CLOSE(hd_spectrum_pairing_error(hd_run_spectrum(run)) * time, 0.0, 12.0);
    }
}

typedef struct channel {
    double width; /**< Ly - 1 */
    double gap;   /**< along the channel, per disk */
    double count; /**< collisions of a disk */
} channel;

static void check_channel(const channel *c, hd_boundary x, hd_boundary y)
{
    enum { CHAIN = 4 };
    const double length = x == R ? 1.0 + (CHAIN - 1) * (1.0 + c->gap) : CHAIN * (1.0 + c->gap);
    const hd_scene_def scene = scene_in_box(CHAIN, length, 1.0 + c->width, x, y, 2);
    twin_compare(trajectory_of(scene), &scene, 1000);
    OWNED(hd_run) *run = finished_after(scene,
                                        time_of(&scene, HD_SANITIZED ? 0.2 * c->count : c->count));
    check_spectrum(run);
}

/** Single file: a disk's wall events outnumber its collisions by gap / width. */
TEST(single_file)
{
    const channel c[] = {
        {1e-9, 1e-6, 300}, {1e-6, 1e-4, 1500}, {1e-3, 1e-2, 1500}, {0.05, 0.1, 1500}};
    for (int k = 0; k < 4; k++) {
        check_channel(&c[k], P, R);
        check_channel(&c[k], R, R);
    }
}

/** Two disks can be on either side of each other at once: both images count. Across 2 sigma the
 * cells change. */
TEST(several_images)
{
    const channel c[] = {{0.05, 0.3, 3000},        {0.5, 0.3, 1500},         {0.9, 0.3, 1500},
                         {1.0 - 1e-9, 0.3, 1500},  {1.0 - 2e-15, 0.3, 1500}, {1.0, 0.3, 1500},
                         {1.0 + 2e-15, 0.3, 1500}, {1.0 + 1e-9, 0.3, 1500}};
    for (int k = 0; k < 8; k++) {
        check_channel(&c[k], P, P);
        check_channel(&c[k], P, R);
    }
}
