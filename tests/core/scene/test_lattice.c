/** Start lattices of disks and of spheres: exactly N of them inside the box, none closer than a
 * diameter, as dense as promised; and the box itself. */
#include "scene/container.h"
#include "scene/plane_lattice.h"
#include "scene/space_lattice.h"
#include "testing.h"

static double densest(const hd_scene_def *def) { return hd_container_of(def)->density_max(def); }

/** The smallest distance that the best lattice promises; fills q. */
static double best_distance(double *q, const hd_scene_def *def, const double *box)
{
    if (DIM == 2) {
        const hd_plane_lattice best = hd_plane_lattice_best(def->number, box, def->boundary);
        if (q) hd_plane_lattice_fill(&best, q, def->number, box, def->boundary);
        return best.distance;
    }
    const hd_space_lattice best = hd_space_lattice_best(def->number, box, def->boundary);
    if (q) hd_space_lattice_fill(&best, q, def->number, box, def->boundary);
    return best.distance;
}

/** A lattice's nearest image is the nearest in each direction. */
static double smallest_distance(const double *q, const hd_scene_def *def, const double *box)
{
    double least = INFINITY;
    for (int i = 0; i < def->number; i++)
        for (int j = i + 1; j < def->number; j++) {
            double square = 0.0;
            for (int d = 0; d < DIM; d++) {
                const double r = q[DIM * j + d] - q[DIM * i + d];
                square += pow(def->boundary[d] == P ? remainder(r, box[d]) : r, 2.0);
            }
            least = fmin(least, square);
        }
    return sqrt(least);
}

/** Returns the promised distance. A site is a product and a sum of numbers up to L. */
static double check_lattice(const hd_scene_def *def)
{
    double box[3] = {0}, longest = 0.0;
    HEAP double *q = calloc(DIM * (size_t)def->number + 1, sizeof *q);
    hd_scene_box(def, box);
    for (int k = 0; k <= DIM * def->number; k++) q[k] = NAN;
    const double promised = best_distance(q, def, box);
    assert_true(isnan(q[DIM * def->number])); /* not one more than asked for */
    for (int k = 0; k < DIM * def->number; k++) {
        const double reach = def->boundary[k % DIM] == R ? 0.5 : 0.0;
        assert_true(q[k] >= reach && q[k] <= box[k % DIM] - reach);
    }
    for (int d = 0; d < DIM; d++) longest = fmax(longest, box[d]);
    const double rounding = (DIM == 2 ? 4 : 8) * DBL_EPSILON * longest;
    CHECK_WITHIN(smallest_distance(q, def, box), promised - rounding, INFINITY);
    return promised;
}

static const double ASPECT[][2] = {{1.0, 1.0}, {0.25, 0.25}, {0.05, 2.0},
                                   {1.7, 0.6}, {13.0, 5.0},  {0.867, 1.0}};
enum { ASPECTS = sizeof ASPECT / sizeof *ASPECT };

TEST(sites_keep_their_distance)
{
    static const double fraction[] = {1e-3, 0.2, 0.8, 1.0};
    int checked = 0;
    for (int n = 2; n < 150; n += 1 + n / 8)
        for (int k = 0; k < WALL_SETS * ASPECTS; k++) {
            hd_scene_def def = box_of(n, 1.0, ASPECT[k / WALL_SETS][0], ASPECT[k / WALL_SETS][1],
                                      k % WALL_SETS, 1);
            const double most = densest(&def);
            if (most <= 0) continue;
            for (int f = 0; f < 4; f++) {
                def.density = fraction[f] * most;
                assert_true(check_lattice(&def) >= HD_START_DISTANCE_MIN);
            }
            checked++;
        }
    assert_true(checked > 400);
}

TEST(any_count)
{
    for (int n = 2; n < (DIM == 2 ? 300 : 130); n++)
        for (int walls = 0; walls < WALL_SETS; walls += ALL_WALLS) {
            const hd_scene_def def = box_of(n, 0.4, 0.6, 0.7, walls, 1);
            check_lattice(&def);
        }
}

/** The maximum is where the best lattice just touches, but for 30 bisections of 1 or sqrt(2). */
TEST(maximum_is_where_they_touch)
{
    const double close = DIM == 2 ? 1e-8 : 3e-9;
    for (int n = 2 * DIM - 2; n < 120; n += 1 + n / 3)
        for (int k = 0; k < 4 * WALL_SETS; k++) {
            hd_scene_def def = box_of(n, 1.0, ASPECT[k / WALL_SETS][0], ASPECT[k / WALL_SETS][1],
                                      k % WALL_SETS, 1);
            double box[3] = {INFINITY, INFINITY, INFINITY};
            const double most = densest(&def);
            if (most <= 0) continue;
            def.density = DIM == 2 ? most * (1.0 + close) : most + close;
            hd_scene_box(&def, box);
            const bool wide = fmin(box[0], fmin(box[1], box[2])) > 1.0;
            assert_true(!wide ||
                        best_distance(NULL, &def, box) < (DIM == 2 ? 1.0 : HD_START_DISTANCE_MIN));
            def.density = most;
            CHECK_CLOSE(check_lattice(&def), 1.0,
                        wide ? close * (DIM == 2 ? 1.0 : 1.0 + 1.0 / most) : INFINITY);
        }
}

/** Directions may be exchanged: x becomes y, y becomes z, the last one x. */
TEST(maximum_knows_no_direction)
{
    for (int n = 2; n < 110; n += 5)
        for (int walls = 0; walls < WALL_SETS; walls++) {
            const int turned = (walls << 1 & ALL_WALLS) | walls >> (DIM - 1);
            const hd_scene_def one = box_of(n, 1.0, 0.8, 1.3, walls, 1);
            const hd_scene_def other = DIM == 2 ? box_of(n, 1.0, 1.0 / 0.8, 1.0, turned, 1)
                                                : box_of(n, 1.0, 1.0 / 1.3, 0.8 / 1.3, turned, 1);
            CHECK_CLOSE(densest(&other), densest(&one), 1e-8);
        }
}

/** Commensurate boxes hold closest packing; 8 x 8 in a square holds the square lattice at least. */
static void check_packings_of_disks(double close)
{
    const hd_scene_def lying = scene_of(64, 0.5, sqrt(0.75), P, P, 1);
    const hd_scene_def upright = scene_of(64, 0.5, 1.0 / sqrt(0.75), P, P, 1);
    const hd_scene_def in_a_square = scene_of(64, 0.5, 1.0, P, P, 1);
    const hd_scene_def two_in_a_box = scene_of(2, 0.5, 0.5, R, R, 1);
    CHECK_CLOSE(densest(&lying), 2.0 / sqrt(3.0), close);
    CHECK_CLOSE(densest(&upright), 2.0 / sqrt(3.0), close);
    CHECK_WITHIN(densest(&in_a_square), 1.0 - close, 2.0 / sqrt(3.0));
    CHECK_CLOSE(densest(&two_in_a_box), 1.0, close);
}

/** N = 4 k^3 in a cube is closest packing, N = 2 k^3 body-centred (3 sqrt(3) / 4), N = k^3 at least
 * the simple cubic one; between walls N = k^3 touches in a cube of k diameters. */
static void check_packings_of_spheres(double close)
{
    for (int k = 1; k < 6; k++) {
        const hd_scene_def faces = box_of(4 * k * k * k, 1.0, 1.0, 1.0, 0, 1);
        const hd_scene_def body = box_of(2 * k * k * k, 1.0, 1.0, 1.0, 0, 1);
        const hd_scene_def simple = box_of(8 * k * k * k, 1.0, 1.0, 1.0, 7, 1);
        CHECK_CLOSE(densest(&faces), sqrt(2.0), close);
        CHECK_WITHIN(densest(&body), 0.75 * sqrt(3.0) - close, sqrt(2.0));
        CHECK_WITHIN(densest(&simple), 1.0 - close, sqrt(2.0));
    }
    const hd_scene_def two = box_of(2, 1.0, 1.0, 1.0, 0, 1);
    CHECK_CLOSE(densest(&two), 0.75 * sqrt(3.0), close);
}

TEST(known_packings)
{
    if (DIM == 2)
        check_packings_of_disks(1e-6);
    else
        check_packings_of_spheres(1e-6);
}

/** The paper's densities must be possible. */
TEST(papers_scenes_fit)
{
    for (int walls = 0; walls < WALL_SETS && DIM == 2; walls++) {
        const hd_scene_def def = box_of(780, 0.8, 0.867, 1.0, walls, 1);
        assert_true(check_lattice(&def) > 1.0);
        assert_true(densest(&def) > 1.0);
    }
}

/** Its root by itself, from 1e-18 to 1e18. */
TEST(boxes_hold_their_density)
{
    for (double density = 1e-6; density < 1.3; density *= 3.7)
        for (int k = 0; k < ASPECTS; k++)
            for (int n = 2; n <= 1000000; n *= 7) {
                const hd_scene_def def = box_of(n, density, ASPECT[k][0], ASPECT[k][1], 0, 1);
                double box[3] = {1.0, 1.0, 1.0};
                const double volume = n / density;
                hd_scene_box(&def, box);
                if (box[0] < 1.0) continue; /* no box of spheres */
                CHECK_CLOSE(box[0] * box[1] * box[2], volume, 12 * DBL_EPSILON * volume);
                for (int d = 1; d < DIM; d++)
                    CHECK_CLOSE(box[d], ASPECT[k][d - 1] * box[0], 2 * DBL_EPSILON * box[d]);
            }
}

/** Without spare sites every site is used; with them the gaps are spread, not left at the end. */
TEST(spare_sites_are_spread)
{
    if (DIM == 3) skip();
    const hd_scene_def def = scene_of(61, 0.4, 1.0, P, P, 1);
    const hd_plane_lattice lattice = {
        .along = 0, .rows = 8, .columns = 8, .column = 1.5, .row = 1.5};
    const double box[2] = {12.0, 12.0};
    double q[2 * 61];
    int in_half = 0;
    hd_plane_lattice_fill(&lattice, q, 61, box, def.boundary);
    for (int i = 0; i < 61; i++) in_half += q[2 * i + 1] < 6.0;
    assert_true(in_half == 30 || in_half == 31);
}
