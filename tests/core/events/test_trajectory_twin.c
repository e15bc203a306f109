/** Trajectory against its O(N^2) twin (twin.h): the same events, bit for bit, one by one. */
#include "scene/container.h"
#include "twin.h"

enum { BOUNDARIES = 4 };
static const hd_boundary BOUNDARY[BOUNDARIES][2] = {{P, P}, {R, R}, {P, R}, {R, P}};

static void compare_scene(const hd_scene_def *def, size_t events)
{
    hd_trajectory *fast;
    char message[200] = "";
    if (hd_scene_check(def, message, sizeof message) != HD_OK) fail_msg("%s", message);
    CHECK_OK(hd_trajectory_create(&fast, def));
    twin_compare(fast, def, HD_SANITIZED ? events / 4 : events);
}

/** Densities from thin gas to a fraction of the densest lattice. */
static void sweep(int disks, double aspect, size_t events)
{
    const double fraction[] = {0.02, 0.3, 0.7, 0.95, 0.999, 1.0 - 1e-6};
    for (int b = 0; b < BOUNDARIES; b++) {
        hd_scene_def def = scene_of(disks, 0.1, aspect, BOUNDARY[b][0], BOUNDARY[b][1], 7);
        const double densest = hd_container_of(&def)->density_max(&def);
        for (size_t k = 0; k < sizeof fraction / sizeof *fraction; k++) {
            def.density = fraction[k] * densest;
            def.seed = 100 * (uint64_t)disks + k;
            compare_scene(&def, events);
        }
    }
}

TEST(two_disks) { sweep(2, 0.9, 3000); }
TEST(three_disks) { sweep(3, 1.1, 3000); }
TEST(five_disks) { sweep(5, 0.6, 3000); }
TEST(twenty_disks) { sweep(20, 1.0, 3000); }
TEST(sixty_disks) { sweep(60, 0.867, 1500); }

/** Thin gas: many crossings of the box, hence large images, between two collisions. */
TEST(thin_gas)
{
    for (int b = 0; b < BOUNDARIES; b++) {
        const hd_scene_def two = scene_of(2, 0.01, 1.0, BOUNDARY[b][0], BOUNDARY[b][1], 3);
        const hd_scene_def many = scene_of(20, 0.01, 0.5, BOUNDARY[b][0], BOUNDARY[b][1], 4);
        const hd_scene_def flat = scene_of(3, 1e-4, 0.01, BOUNDARY[b][0], BOUNDARY[b][1], 4);
        compare_scene(&two, 2000);
        compare_scene(&many, 2000);
        compare_scene(&flat, 1000);
    }
}

/** Ly from just above a diameter to where only one image can touch; the short edge along y, then x.
 */
TEST(narrow_boxes)
{
    const double width[] = {1.0 + 1e-9, 1.0 + 1e-5, 1.01, 1.3,    1.5,
                            1.7320508,  1.9,        2.0,  2.0001, 2.2};
    const int disks[] = {2, 3, 8};
    for (size_t w = 0; w < sizeof width / sizeof *width; w++)
        for (int k = 0; k < 3; k++)
            for (int b = 0; b < BOUNDARIES; b++) {
                const double length = 1.6 * disks[k] + 1.0;
                const hd_boundary x = BOUNDARY[b][0], y = BOUNDARY[b][1];
                const hd_scene_def flat = scene_in_box(disks[k], length, width[w], x, y, w + 1);
                const hd_scene_def tall = scene_in_box(disks[k], width[w], length, x, y, w + 1);
                compare_scene(&flat, 600);
                compare_scene(&tall, 600);
            }
}

/** Both edges below two diameters: two disks meet through as many as four images at a time. */
TEST(several_images_of_a_pair)
{
    const double edge[][2] = {{1.9, 1.9}, {1.45, 1.45}, {1.05, 1.95}, {1.6, 1.3}, {1.42, 1.99}};
    for (size_t k = 0; k < sizeof edge / sizeof *edge; k++)
        for (int b = 0; b < BOUNDARIES; b++) {
            const hd_scene_def def = scene_in_box(2, edge[k][0], edge[k][1], BOUNDARY[b][0],
                                                  BOUNDARY[b][1], k + 1);
            if (hd_scene_check(&def, NULL, 0) == HD_OK) compare_scene(&def, 2000);
        }
}

TEST(extreme_aspects)
{
    for (int b = 0; b < BOUNDARIES; b++) {
        const hd_boundary x = BOUNDARY[b][0], y = BOUNDARY[b][1];
        const hd_scene_def chain = scene_in_box(20, 1e4, 1.2, x, y, 1);
        const hd_scene_def pole = scene_in_box(20, 1.7, 1e3, x, y, 2);
        const hd_scene_def thin = scene_in_box(5, 2e5, 1.0 + 1e-7, x, y, 3);
        const size_t part = second_tier() ? 1 : 4; /* of pairs with thousands of images */
        compare_scene(&chain, 1000 / part);
        compare_scene(&pole, 1000 / part);
        compare_scene(&thin, 300 / part);
    }
}
