/** Trajectory against its O(N^2) twin (twin.h): the same events, bit for bit, one by one; of disks
 * and of spheres, behind all walls. */
#include "prepared.h"
#include "scene/container.h"
#include "twin.h"

static void compare_scene(hd_scene_def def, size_t events)
{
    char message[200] = "";
    if (hd_scene_check(&def, message, sizeof message) != HD_OK) fail_msg("%s", message);
    twin_compare(trajectory_of(def), &def, HD_SANITIZED ? events / 4 : events);
}

/** Densities from thin gas to a fraction of the densest lattice. */
static void sweep(int disks, double aspect, size_t events)
{
    const double fraction[] = {0.02, 0.3, 0.7, 0.95, 0.999, 1.0 - 1e-6};
    for (int walls = 0; walls < WALL_SETS; walls++) {
        hd_scene_def def = box_of(disks, 0.1, aspect, 1.1 * aspect, walls, 7);
        const double densest = hd_container_of(&def)->density_max(&def);
        for (size_t k = 0; k < sizeof fraction / sizeof *fraction; k++) {
            def.density = fraction[k] * densest;
            def.seed = 100 * (uint64_t)disks + k;
            compare_scene(def, events / (DIM - 1));
        }
    }
}

TEST(two) { sweep(2, 0.9, 3000); }
TEST(three) { sweep(3, 1.1, 3000); }
TEST(five) { sweep(5, 0.6, 3000); }
TEST(twenty) { sweep(20, 1.0, 3000); }
TEST(sixty) { sweep(60, 0.867, 1500); }

/** More cells than three along an edge. */
TEST(a_hundred)
{
    for (int walls = 0; walls < WALL_SETS; walls++)
        compare_scene(box_of(100, 0.2, 0.6, 0.5, walls, 5), 400);
}

/** Thin gas: many crossings of the box, hence large images, between two collisions. */
TEST(thin_gas)
{
    for (int walls = 0; walls < WALL_SETS; walls++) {
        compare_scene(box_of(2, 0.01, 1.0, 1.1, walls, 3), 2000);
        compare_scene(box_of(20, 0.01, 0.5, 0.6, walls, 4), 2000);
        compare_scene(box_of(3, 1e-4, 0.01, 1.0, walls, 4), 1000);
    }
}

/** Ly from just above a diameter to where only one image can touch; the short edge along y, then x.
 */
TEST(narrow_boxes)
{
    const double width[] = {1.0 + 1e-9, 1.0 + 1e-5,  1.01, 1.3,         1.5,    1.7320508,
                            1.9,        2.0 - 2e-15, 2.0,  2.0 + 2e-15, 2.0001, 2.2};
    const int disks[] = {2, 3, 8};
    for (size_t w = 0; w < sizeof width / sizeof *width; w++)
        for (int k = 0; k < 3; k++)
            for (int walls = 0; walls < WALL_SETS; walls++) {
                const double length = 1.6 * disks[k] + 1.0, other = 1.05 * width[w];
                compare_scene(box_with(disks[k], length, width[w], other, walls, w + 1), 600);
                compare_scene(box_with(disks[k], width[w], length, other, walls, w + 1), 600);
            }
}

/** Edges below two diameters: two disks meet through several images at a time. */
TEST(several_images_of_a_pair)
{
    const double edge[][3] = {{1.9, 1.9, 1.9},  {1.45, 1.45, 1.7}, {1.05, 1.95, 1.6},
                              {1.6, 1.3, 1.4},  {1.42, 1.99, 1.5}, {3.1, 1.1, 1.4},
                              {1.001, 1.6, 5.0}};
    int compared = 0;
    for (size_t k = 0; k < sizeof edge / sizeof *edge; k++)
        for (int walls = 0; walls < WALL_SETS; walls++)
            for (int disks = 2; disks <= 4; disks += 2) {
                const hd_scene_def def = box_with(disks, edge[k][0], edge[k][1], edge[k][2], walls,
                                                  k + 1);
                if (hd_scene_check(&def, NULL, 0) != HD_OK) continue;
                compare_scene(def, 2000 / (DIM - 1));
                compared++;
            }
    assert_true(compared >= 12);
}

TEST(extreme_aspects)
{
    const size_t part = second_tier() ? 1 : 4; /* of pairs with thousands of images */
    for (int walls = 0; walls < WALL_SETS; walls++) {
        compare_scene(box_with(20, 1e4, 1.2, 1.3, walls, 1), 1000 / part);
        compare_scene(box_with(20, 1.7, 1e3, 1.6, walls, 2), 1000 / part);
        compare_scene(box_with(5, 2e5, 1.0 + 1e-7, 1.1, walls, 3), 300 / part);
    }
}

/** Two images at the very same time: the lower one in the last direction first, then in those
 * before it. Edges across are 1.25, images 0.625 away on either side, exactly. */
TEST(lower_images_come_first)
{
    for (int along = 0; along < DIM; along++) {
        double edge[3] = {1.25, 1.25, 1.25}, q[2 * DIM], p[2 * DIM] = {0}, box[DIM];
        for (int k = 0; k < 2 * DIM; k++) q[k] = k < DIM ? 0.25 : 0.875;
        edge[along] = 4.0;
        q[along] = 0.5, q[DIM + along] = 2.5;
        p[along] = 0.5, p[DIM + along] = -0.5;
        const hd_scene_def def = box_with(2, edge[0], edge[1], edge[2], 0, 1);
        hd_scene_box(&def, box);
        for (int d = 0; d < DIM; d++) CHECK_CLOSE(box[d], edge[d], 0.0); /* else they are no ties */
        OWNED(hd_record) *log = log_of(&def, q, p, 1.9);
        assert_true(log->count >= 2);
        const int low = along == 0 ? 1 : 0, high = along == DIM - 1 ? DIM - 2 : DIM - 1;
        for (int d = 0; d < DIM; d++)
            if (d != along) CHECK_CLOSE(events_in(log)[0].n[d], -0.625, 16 * DBL_EPSILON);
        CHECK_CLOSE(events_in(log)[1].n[low], 0.625, 16 * DBL_EPSILON);
        if (high != low) CHECK_CLOSE(events_in(log)[1].n[high], -0.625, 16 * DBL_EPSILON);
    }
}
