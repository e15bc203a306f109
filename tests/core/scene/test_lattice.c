/** Lattice: exactly N disks inside the box, none closer than a diameter, as dense as promised. */
#include "scene/container.h"
#include "scene/plane_lattice.h"
#include "testing.h"

/** A site is a product and a sum of numbers up to L. */
static double position_rounding(const double box[2])
{
    return 4.0 * DBL_EPSILON * fmax(box[0], box[1]);
}

static double square(double x) { return x * x; }

/** Least distance of two sites in one direction; periodic boxes by all images that count. */
static double least_gap(double r, double box, hd_boundary boundary)
{
    return boundary == P ? r - box * round(r / box) : r;
}

/** Smallest distance of any pair; a lattice's nearest image is the nearest in each direction. */
static double smallest_distance(const double *q, int n, const double box[2],
                                const hd_boundary boundary[2])
{
    double least = INFINITY;
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++) {
            const double x = least_gap(q[2 * j] - q[2 * i], box[0], boundary[0]);
            const double y = least_gap(q[2 * j + 1] - q[2 * i + 1], box[1], boundary[1]);
            least = fmin(least, square(x) + square(y));
        }
    return sqrt(least);
}

static void check_sites(const double *q, const hd_scene_def *def, const double box[2])
{
    for (int k = 0; k < 2 * def->disks; k++) {
        const double reach = def->boundary[k % 2] == R ? 0.5 : 0.0;
        assert_true(q[k] >= reach && q[k] <= box[k % 2] - reach);
    }
    assert_true(isnan(q[2 * def->disks])); /* not one more than asked for */
}

/** Distance and number of the best lattice at the scene's density; returns its distance. */
static double check_lattice(const hd_scene_def *def)
{
    double box[2];
    hd_scene_box(def, box);
    const hd_plane_lattice best = hd_plane_lattice_best(def->disks, box, def->boundary);
    HEAP double *q = calloc(2 * (size_t)def->disks + 1, sizeof *q);
    assert_non_null(q);
    for (int k = 0; k <= 2 * def->disks; k++) q[k] = NAN;
    hd_plane_lattice_fill(&best, q, def->disks, box, def->boundary);
    check_sites(q, def, box);
    const double distance = smallest_distance(q, def->disks, box, def->boundary);
    if (!(distance >= best.distance - position_rounding(box)))
        fail_msg("N %d boundary %d %d density %.17g: distance %.17g promised %.17g", def->disks,
                 (int)def->boundary[0], (int)def->boundary[1], def->density, distance,
                 best.distance);
    return best.distance;
}

TEST(sites_keep_their_distance)
{
    const double aspect[] = {0.05, 0.3, 0.867, 1.0, 1.7, 13.0}, fraction[] = {1e-3, 0.2, 0.8, 1.0};
    for (int n = 2; n < 150; n += 1 + n / 12)
        for (int k = 0; k < 6 * 4 * 4; k++) {
            hd_scene_def def = scene_of(n, 0.1, aspect[k / 16], (hd_boundary)(k & 1),
                                        (hd_boundary)(k >> 1 & 1), 1);
            def.density = fraction[k / 4 % 4] * hd_container_of(&def)->density_max(&def);
            if (def.density > 0) assert_true(check_lattice(&def) >= 1.0);
        }
}

TEST(any_count_up_to_a_few_hundred)
{
    for (int n = 2; n < 300; n++)
        for (int b = 0; b < 4; b++) {
            const hd_scene_def def = scene_of(n, 0.5, 0.6, (hd_boundary)(b & 1),
                                              (hd_boundary)(b >> 1), 1);
            check_lattice(&def);
        }
}

/** The maximum is where the best lattice just touches. */
TEST(maximum_is_where_disks_touch)
{
    const double aspect[] = {0.1, 0.867, 1.0, 3.0}, close = 1e-8; /* 30 bisections of about 1 */
    for (int n = 2; n < 200; n += 1 + n / 8)
        for (int k = 0; k < 16; k++) {
            hd_scene_def def = scene_of(n, 0.1, aspect[k / 4], (hd_boundary)(k & 1),
                                        (hd_boundary)(k >> 1 & 1), 1);
            double box[2];
            const double densest = hd_container_of(&def)->density_max(&def);
            def.density = densest * (1.0 + close);
            hd_scene_box(&def, box);
            const int wide = box[0] > 1.0 && box[1] > 1.0;
            assert_true(!wide || hd_plane_lattice_best(n, box, def.boundary).distance < 1.0);
            def.density = densest;
            CHECK_CLOSE(check_lattice(&def), 1.0, wide ? close : INFINITY);
        }
}

/** Rows go along either direction: x and y may be exchanged. */
TEST(maximum_is_the_same_lying_and_standing)
{
    const double aspect[] = {0.1, 0.5, 0.867, 3.0}, close = 1e-8;
    for (int n = 2; n < 60; n++)
        for (int k = 0; k < 16; k++) {
            const hd_boundary x = (hd_boundary)(k & 1), y = (hd_boundary)(k >> 1 & 1);
            const hd_scene_def lying = scene_of(n, 0.1, aspect[k / 4], x, y, 1);
            const hd_scene_def standing = scene_of(n, 0.1, 1.0 / aspect[k / 4], y, x, 1);
            CHECK_CLOSE(hd_container_of(&standing)->density_max(&standing),
                        hd_container_of(&lying)->density_max(&lying), close);
        }
}

/** Commensurate boxes hold closest packing; 8 x 8 in a square holds the square lattice at least. */
TEST(known_packings)
{
    const double closest = 2.0 / sqrt(3.0), close = 1e-6;
    const hd_scene_def hexagonal = scene_of(64, 0.5, sqrt(0.75), P, P, 1);
    const hd_scene_def upright = scene_of(64, 0.5, 1.0 / sqrt(0.75), P, P, 1);
    const hd_scene_def in_a_square = scene_of(64, 0.5, 1.0, P, P, 1);
    const hd_scene_def two_in_a_box = scene_of(2, 0.5, 0.5, R, R, 1);
    CHECK_CLOSE(hd_container_of(&hexagonal)->density_max(&hexagonal), closest, close);
    CHECK_CLOSE(hd_container_of(&upright)->density_max(&upright), closest, close);
    assert_true(hd_container_of(&in_a_square)->density_max(&in_a_square) > 1.0 - close);
    CHECK_CLOSE(hd_container_of(&two_in_a_box)->density_max(&two_in_a_box), 1.0, close);
}

/** The paper's densities must be possible. */
TEST(papers_scenes_fit)
{
    for (int b = 0; b < 4; b++) {
        const hd_scene_def def = scene_of(780, 0.8, 0.867, (hd_boundary)(b & 1),
                                          (hd_boundary)(b >> 1), 1);
        assert_true(check_lattice(&def) > 1.0);
        assert_true(hd_container_of(&def)->density_max(&def) > 1.0);
    }
}

/** Without spare sites every site is used; with them the gaps are spread, not left at the end. */
TEST(spare_sites_are_spread)
{
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
