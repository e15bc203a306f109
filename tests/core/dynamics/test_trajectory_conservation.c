/** Trajectory over long times: energy, momentum, no overlap, nobody outside the walls. */
#include "create_from.h"
#include "bodies.h"
#include "testing.h"

/** What the project promises over 10^7 collisions. */
static const double ENERGY_DRIFT = 1e-11;
/** Energy and momentum walk at random: this many standard deviations their largest excursion does
 * not reach. */
static const double Z = 5.0;
/** A collision's step in energy: its four momenta are rounded, each to eps p / sqrt(12) rms, and
 * <p^4> = 3, together below 1 eps; what is exchanged is wrong by some eps of b^2, and <b^4> =
 * 32: 3.5 eps. A drift of the 3e-16 that r.r rounded near 1 would give exceeds the bound after some
 * 1e4 collisions. */
static const double ENERGY_STEP = 4.0 * DBL_EPSILON;
/** In one component of the momentum: two momenta are rounded, each to eps p / sqrt(12) rms, <p^2>
 * = 1. */
static const double MOMENTUM_STEP = 0.5 * DBL_EPSILON;
/** Of one disk, when the mean is taken out and all are scaled. */
static const double MOMENTUM_START = 4.0 * DBL_EPSILON;
static const double MEDIUM_RUN = HD_SANITIZED ? 1e5 : 5e5;
enum { SAMPLES = 200 };

/** Two coordinates of size L, each with four roundings (motion, folding) of at most eps L / 2. */
static double overlap_rounding(const double box[2])
{
    return 4.0 * DBL_EPSILON * fmax(box[0], box[1]);
}

static void momentum_of(const hd_trajectory *tr, double *p, double sum[2])
{
    sum[0] = sum[1] = 0;
    hd_trajectory_state(tr, NULL, p);
    for (int k = 0; k < 2 * hd_trajectory_particles(tr); k++) sum[k % 2] += p[k];
}

static void check_inside(const hd_trajectory *tr, const hd_scene_def *def, double *q)
{
    double box[2];
    box_around(tr, box);
    hd_trajectory_state(tr, q, NULL);
    for (int k = 0; k < 2 * def->number; k++) {
        const double reach = def->boundary[k % 2] == R ? 0.5 : 0.0;
        const double slack = DBL_EPSILON *
                             box[k % 2]; /* on its way to a wall, just before the event */
        assert_true(q[k] >= reach - slack && q[k] <= box[k % 2] - reach + slack);
    }
}

static void check_run(const hd_scene_def *def, double collisions)
{
    double *work = calloc(2 * (size_t)def->number, sizeof *work), box[2], sum[2];
    assert_non_null(work);
    MADE(hd_trajectory, tr, def);
    box_around(tr, box);
    const double energy = hd_trajectory_examined(tr).kinetic_energy;
    const double summed = DBL_EPSILON *
                          pow(def->number, 1.5); /* of N partial sums, N / 2 in the mean */
    CHECK_CLOSE(energy, def->number, ENERGY_DRIFT * def->number);
    double t = 0;
    while (t == 0 || (double)hd_trajectory_totals(tr).collisions < collisions) {
        t += collisions / SAMPLES / hd_trajectory_totals(tr).expected;
        CHECK_OK(hd_trajectory_extend(tr, NULL, t));
        const double walked = Z * sqrt((double)hd_trajectory_totals(tr).collisions + def->number);
        CHECK_CLOSE(hd_trajectory_examined(tr).kinetic_energy, energy,
                    summed + ENERGY_STEP * walked);
        CHECK_CLOSE(hd_trajectory_examined(tr).overlap, 0.0, overlap_rounding(box));
        assert_true(overlap_rounding(box) < hd_trajectory_examined(tr).overlap_rounding);
        check_inside(tr, def, work);
        momentum_of(tr, work, sum);
        for (int d = 0; d < 2; d++)
            if (def->boundary[d] == P)
                CHECK_CLOSE(sum[d], 0.0, MOMENTUM_START * def->number + MOMENTUM_STEP * walked);
    }
    free(work);
}

TEST(ten_disks_for_long)
{
    const double collisions = HD_SANITIZED ? 2e5 : second_tier() ? 1e7 : 2e6;
    const hd_scene_def def = scene_of(10, 0.5, 0.8, P, P, 11);
    check_run(&def, collisions);
}

TEST(ten_disks_each_boundary)
{
    for (int b = 1; b < 4; b++) {
        const hd_scene_def def = scene_of(10, 0.5, 0.8, b & 1 ? R : P, b & 2 ? R : P, 11);
        check_run(&def, 0.3 * MEDIUM_RUN);
    }
}

TEST(the_papers_disks)
{
    const hd_scene_def periodic = hd_scene_def_default();
    const hd_scene_def walls = scene_of(780, 0.8, 0.867, R, R, 5);
    check_run(&periodic, MEDIUM_RUN);
    check_run(&walls, MEDIUM_RUN);
}

TEST(dense_and_narrow)
{
    const hd_scene_def dense = scene_of(90, 1.1, 0.8660254, P, P, 5);
    const hd_scene_def narrow = scene_in_box(12, 20.0, 1.1, P, P, 5);
    const hd_scene_def channel = scene_in_box(12, 20.0, 1.1, P, R, 5);
    check_run(&dense, 0.3 * MEDIUM_RUN);
    check_run(&narrow, 0.3 * MEDIUM_RUN);
    check_run(&channel, 0.1 * MEDIUM_RUN);
}

/** A long chain: coordinates a thousand diameters large. */
TEST(large_coordinates)
{
    const hd_scene_def def = scene_in_box(500, 4000.0, 1.5, P, R, 5);
    check_run(&def, 0.1 * MEDIUM_RUN);
}

/** The longest boxes that a scene may have, and the longest of so many disks: positions round by
 * far more there than a short box allows an overlap. Nobody stays behind in a wrong cell either. */
TEST(the_longest_boxes)
{
    enum { LOOKS = 10 };
    static const struct {
        int disks;
        double length, collisions;
    } cases[] = {{100, 1e7, 1e3}, {10000, 1e8, 200}, {1000000, 1e9, 500}};
    for (int k = 0; k < (second_tier() ? 3 : 2); k++) {
        const hd_scene_def def = scene(.number = cases[k].disks, .density = 1e-6, .aspect = 1e-6,
                                       .seed = 2);
        double box[2], deepest = 0.0;
        MADE(hd_trajectory, tr, &def);
        box_around(tr, box);
        CHECK_CLOSE(box[0], cases[k].length, 1e-9 * cases[k].length);
        for (int look = 1; look <= LOOKS; look++) {
            const double collisions = cases[k].collisions * look / LOOKS;
            CHECK_OK(
                hd_trajectory_extend(tr, NULL, collisions / hd_trajectory_totals(tr).expected));
            deepest = fmax(deepest, hd_trajectory_examined(tr).overlap);
        }
        CHECK_CLOSE(deepest, 0.0, overlap_rounding(box));
        CHECK_CLOSE(hd_trajectory_examined(tr).overlap_max,
                    hd_trajectory_examined(tr).overlap_rounding, 0.0);
        CHECK_CLOSE(hd_trajectory_examined(tr).kinetic_energy, def.number,
                    ENERGY_DRIFT * def.number);
    }
}

/** Long before the core gives such disks up, and not as soon as they touch. */
TEST(an_overlap_is_more_than_rounding)
{
    static const double below[] = {32.0 * DBL_EPSILON, 5e-10};
    const hd_scene_def def = scene(.number = 2, .density = 0.3, .aspect = 1.0);
    for (int k = 0; k < 2; k++) {
        const double q[] = {0.1, 1.0, 1.1 - below[k], 1.0}, p[] = {-1.0, 0.0, 0.0, sqrt(3.0)};
        hd_trajectory *tr;
        CHECK_OK(hd_trajectory_create_from(&tr, &def, q, p));
        CHECK_CLOSE(hd_trajectory_examined(tr).overlap, below[k], 1e-15);
        assert_int_equal(
            hd_trajectory_examined(tr).overlap > hd_trajectory_examined(tr).overlap_rounding, k);
        assert_true(hd_trajectory_examined(tr).overlap_rounding < 1e-9);
        CHECK_CLOSE(hd_trajectory_examined(tr).overlap_max, 1e-9, 0.0);
        hd_trajectory_free(tr);
    }
}
