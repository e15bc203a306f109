/** Start lattices of spheres: exactly N of them inside the box, none closer than a diameter, as
 * dense as promised; and the box itself. */
#include "scene/container.h"
#include "scene/space_lattice.h"
#include "testing.h"

enum { MAX = 500 };

static double densest(const hd_scene_def *def) { return hd_container_of(def)->density_max(def); }

/** A lattice's nearest image is the nearest in each direction. */
static double smallest_distance(const double *q, const hd_scene_def *def, const double box[3])
{
    double least = INFINITY;
    for (int i = 0; i < def->disks; i++)
        for (int j = i + 1; j < def->disks; j++) {
            double square = 0.0;
            for (int d = 0; d < 3; d++) {
                const double r = q[3 * j + d] - q[3 * i + d];
                square += pow(def->boundary[d] == P ? remainder(r, box[d]) : r, 2.0);
            }
            least = fmin(least, square);
        }
    return sqrt(least);
}

/** Returns the promised distance. */
static double check_lattice(const hd_scene_def *def)
{
    double box[3], q[3 * MAX + 1];
    hd_scene_box(def, box);
    const hd_space_lattice best = hd_space_lattice_best(def->disks, box, def->boundary);
    for (int k = 0; k <= 3 * def->disks; k++) q[k] = NAN;
    hd_space_lattice_fill(&best, q, def->disks, box, def->boundary);
    assert_true(isnan(q[3 * def->disks])); /* not one more than asked for */
    for (int k = 0; k < 3 * def->disks; k++) {
        const double reach = def->boundary[k % 3] == R ? 0.5 : 0.0;
        assert_true(q[k] >= reach && q[k] <= box[k % 3] - reach);
    }
    const double longest = fmax(box[0], fmax(box[1], box[2]));
    CHECK_WITHIN(smallest_distance(q, def, box), best.distance - 8 * DBL_EPSILON * longest,
                 INFINITY);
    return best.distance;
}

static const double ASPECT[][2] = {{1.0, 1.0}, {0.25, 0.25}, {0.05, 2.0}, {1.7, 0.6}, {13.0, 5.0}};
enum { ASPECTS = sizeof ASPECT / sizeof *ASPECT };

TEST(sites_keep_their_distance)
{
    static const double fraction[] = {1e-3, 0.6, 1.0};
    int checked = 0;
    for (int n = 2; n < 120; n += 1 + n / 6)
        for (int k = 0; k < 8 * ASPECTS; k++) {
            hd_scene_def def = box_of(n, 1.0, ASPECT[k / 8][0], ASPECT[k / 8][1], k % 8, 1);
            const double most = densest(&def);
            if (most <= 0) continue;
            for (int f = 0; f < 3; f++) {
                def.density = fraction[f] * most;
                assert_true(check_lattice(&def) >= HD_START_DISTANCE_MIN);
            }
            checked++;
        }
    assert_true(checked > 400);
}

TEST(any_count)
{
    for (int n = 2; n < 130; n++)
        for (int walls = 0; walls < 8; walls += 7) {
            const hd_scene_def def = box_of(n, 0.3, 0.8, 0.7, walls, 1);
            check_lattice(&def);
        }
}

/** The maximum is where the best lattice just touches, but for 30 bisections of sqrt(2). */
TEST(maximum_is_where_spheres_touch)
{
    const double close = 3e-9;
    for (int n = 4; n < 120; n += 1 + n / 3)
        for (int k = 0; k < 4 * 8; k++) {
            hd_scene_def def = box_of(n, 1.0, ASPECT[k / 8][0], ASPECT[k / 8][1], k % 8, 1);
            double box[3];
            const double most = densest(&def);
            def.density = most + close;
            hd_scene_box(&def, box);
            const bool wide = fmin(box[0], fmin(box[1], box[2])) > 1.0;
            assert_true(!wide || hd_space_lattice_best(n, box, def.boundary).distance <
                                     HD_START_DISTANCE_MIN);
            def.density = most;
            CHECK_CLOSE(check_lattice(&def), 1.0, wide ? close * (1.0 + 1.0 / most) : INFINITY);
        }
}

/** Directions may be exchanged. */
TEST(maximum_knows_no_direction)
{
    for (int n = 4; n < 110; n += 7)
        for (int walls = 0; walls < 8; walls++) {
            const int turned = (walls << 1 & 7) | walls >> 2; /* x -> y -> z -> x */
            const hd_scene_def one = box_of(n, 1.0, 0.8, 1.3, walls, 1);
            const hd_scene_def other = box_of(n, 1.0, 1.0 / 1.3, 0.8 / 1.3, turned, 1);
            CHECK_CLOSE(densest(&other), densest(&one), 1e-8);
        }
}

/** N = 4 k^3 in a cube is closest packing, N = 2 k^3 body-centred (3 sqrt(3) / 4), N = k^3 at least
 * the simple cubic one; between walls N = k^3 touches in a cube of k diameters. */
TEST(known_packings)
{
    const double close = 1e-6;
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

/** The cube root by itself, from 1e-18 to 1e18. */
TEST(boxes_hold_their_density)
{
    for (double density = 1e-6; density < 1.3; density *= 3.7)
        for (int k = 0; k < ASPECTS; k++)
            for (int n = 2; n <= 1000000; n *= 7) {
                const hd_scene_def def = box_of(n, density, ASPECT[k][0], ASPECT[k][1], 0, 1);
                double box[3];
                hd_scene_box(&def, box);
                const double volume = n / density;
                if (box[0] < 1.0) continue; /* no box of spheres */
                CHECK_CLOSE(box[0] * box[1] * box[2], volume, 12 * DBL_EPSILON * volume);
                CHECK_CLOSE(box[1], ASPECT[k][0] * box[0], 2 * DBL_EPSILON * box[1]);
                CHECK_CLOSE(box[2], ASPECT[k][1] * box[0], 2 * DBL_EPSILON * box[2]);
            }
}
