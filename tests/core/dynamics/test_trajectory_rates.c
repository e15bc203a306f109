/** Trajectory against kinetic theory, an exact mean and independent codes. Seeds are fixed, so that
 * a tolerance of Z standard errors passes or fails for good. */
#include "testing.h"
#include "interval.h"

static const double Z = 3.0;
static const double EQUILIBRATION = 300.0; /* collisions per disk */

enum { BLOCKS = 64 };

typedef struct estimate {
    double mean, error;
} estimate;

/** Mean of blocks long against the correlation time, and its standard error. */
static estimate estimate_of(const double block[BLOCKS])
{
    double sum = 0, square = 0;
    for (int k = 0; k < BLOCKS; k++) sum += block[k];
    const double mean = sum / BLOCKS;
    for (int k = 0; k < BLOCKS; k++) square += (block[k] - mean) * (block[k] - mean);
    return (estimate){mean, sqrt(square / (BLOCKS - 1) / BLOCKS)};
}

static hd_trajectory *equilibrated(const hd_scene_def *def)
{
    hd_trajectory *tr;
    CHECK_OK(hd_trajectory_create(&tr, def));
    const double per_disk = 2.0 * hd_trajectory_totals(tr).expected / def->number;
    CHECK_OK(hd_trajectory_extend(tr, NULL, EQUILIBRATION / per_disk));
    return tr;
}

/** Collisions that a disk takes part in per time unit: 2 (pair events) / (N t). */
static estimate rate_per_disk(const hd_scene_def *def, double pair_events)
{
    OWNED(hd_trajectory) *tr = equilibrated(def);
    const double piece = pair_events / BLOCKS / hd_trajectory_totals(tr).expected;
    double block[BLOCKS];
    for (int k = 0; k < BLOCKS; k++) {
        const uint64_t before = hd_trajectory_totals(tr).collisions;
        CHECK_OK(hd_trajectory_extend(tr, NULL, hd_trajectory_time(tr) + piece));
        const double events = (double)(hd_trajectory_totals(tr).collisions - before);
        block[k] = 2.0 * events / (def->number * piece);
    }
    return estimate_of(block);
}

/** [T2] is good to a percent below freezing; 400 disks differ from infinitely many by 1/N. The rate
 * that the trajectory itself reports is this estimate, in pair events; so is the free path of
 * [T12]. */
TEST(enskog_with_henderson)
{
    const double density[] = {0.1, 0.3, 0.5, 0.7}, allowed = 0.01;
    for (size_t k = 0; k < 4; k++) {
        hd_scene_def def = scene_of(400, density[k], 0.9, P, P, 21);
        const double eta = PI * density[k] / 4.0;
        const double contact = (1.0 - 7.0 * eta / 16.0) / ((1.0 - eta) * (1.0 - eta));
        const double enskog = 2.0 * sqrt(PI) * density[k] * contact;
        const estimate rate = rate_per_disk(&def, 5e5);
        MADE(hd_trajectory, tr, &def);
        CHECK_CLOSE(hd_trajectory_totals(tr).expected, 200.0 * rate.mean, 0.01 * 200.0 * rate.mean);
        assert_true(Z * rate.error < 0.5 * allowed * enskog); /* else the test says nothing */
        CHECK_CLOSE(rate.mean, enskog, allowed * enskog);
        const double path = sqrt(PI / 2.0) / rate.mean; /* mean speed over collisions */
        CHECK_CLOSE(hd_scene_mean_free_path(&def), path, allowed * path);
    }
}

/** Published with one standard error in the last digit: "collisions per disk and time" count the
 * participations of a disk, two for each pair event (half of them would be off by a factor of
 * two). */
TEST(independent_codes)
{
    const struct {
        int disks;
        double density, rate, error;
    } table[] = {{9, 0.5, 3.958, 0.002}, {16, 0.7, 9.220, 0.003}};
    for (size_t k = 0; k < sizeof table / sizeof *table; k++) {
        const hd_scene_def def = scene_of(table[k].disks, table[k].density, 0.8660, P, P, 22);
        const estimate rate = rate_per_disk(&def, HD_SANITIZED ? 2e5 : 1e6);
        const double error = sqrt(rate.error * rate.error + table[k].error * table[k].error);
        assert_true(error < 3e-3 * table[k].rate); /* a wrong rate would be seen */
        CHECK_CLOSE(rate.mean, table[k].rate, Z * error);
    }
}

/** Mean of |p.n| over collisions where both directions are periodic and the total momentum is zero:
 * momenta are uniform on the sphere of radius R in M dimensions. */
static double exact_mean_impact(int disks)
{
    const double radius = sqrt(2.0 * disks), dimensions = 2.0 * disks - 2.0;
    return sqrt(2.0) * radius * sqrt(PI) / dimensions *
           exp(lgamma(disks - 0.5) - lgamma(disks - 1.0));
}

static estimate mean_impact(const hd_scene_def *def, double pair_events)
{
    OWNED(hd_trajectory) *tr = equilibrated(def);
    const double piece = pair_events / BLOCKS / hd_trajectory_totals(tr).expected;
    double block[BLOCKS];
    OWNED(hd_record) *log = new_log();
    for (int k = 0; k < BLOCKS; k++) {
        CHECK_OK(trajectory_to(tr, log, hd_trajectory_time(tr) + piece));
        double sum = 0;
        for (size_t e = 0; e < log->count; e++)
            sum -= events_in(log)[e].n[0] * events_in(log)[e].p[0] +
                   events_in(log)[e].n[1] * events_in(log)[e].p[1];
        block[k] = sum / (double)log->count;
    }
    return estimate_of(block);
}

TEST(impact_is_exact)
{
    const int disks[] = {16, 100, 16, 4};
    const double density[] = {0.7, 0.5, 0.05, 0.3};
    for (size_t k = 0; k < 4; k++) {
        const hd_scene_def def = scene_of(disks[k], density[k], 1.0, P, P, 23);
        const estimate impact = mean_impact(&def, HD_SANITIZED ? 1e5 : 2.5e5);
        assert_true(impact.error < 5e-3 * impact.mean);
        CHECK_CLOSE(impact.mean, exact_mean_impact(disks[k]), Z * impact.error);
    }
}
