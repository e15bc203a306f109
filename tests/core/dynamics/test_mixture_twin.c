/** Mixtures against the O(N^2) twin (twin.h): the same events, bit for bit; of disks and of
 * spheres, in boxes and behind all walls. */
#include "draw.h"
#include "prepared.h"
#include "twin.h"

static void compare_scene(hd_scene_def def, size_t events)
{
    char message[200] = "";
    if (hd_scene_check(&def, message, sizeof message) != HD_OK) fail_msg("%s", message);
    twin_compare(trajectory_of(def), &def, HD_SANITIZED ? events / 4 : events);
}

static const double MASSES[] = {0.001, 0.1, 1.0, 3.0, 1000.0};

/** Of any sizes and masses; what has no start is refused, most have one. */
TEST(random_mixtures)
{
    enum { SCENES = 120 };
    hd_random random = hd_random_seeded(11, 0);
    int compared = 0;
    for (int k = 0; k < SCENES / (DIM - 1); k++) {
        const int walls = one_of(&random, WALL_SETS), number = 2 + one_of(&random, 8);
        const double packing = 0.02 + 0.6 / (DIM - 1) * uniform(&random);
        hd_scene_def def = box_of(number, 0.01, log_uniform(&random, 0.5, 2.0),
                                  log_uniform(&random, 0.5, 2.0), walls, (uint64_t)k);
        def = packed(with_second(def, uniform(&random), log_uniform(&random, 0.2, 5.0),
                                 MASSES[one_of(&random, 5)]),
                     packing);
        if (hd_scene_check(&def, NULL, 0) != HD_OK) continue;
        compare_scene(def, 1000);
        compared++;
    }
    CHECK_WITHIN(compared, SCENES / 2 / (DIM - 1), SCENES);
}

/** More cells than three along an edge, and a fluid as dense as starts are. */
TEST(many)
{
    const double densest = DIM == 2 ? 0.8 : 0.6;
    for (int walls = 0; walls < WALL_SETS; walls++) {
        const hd_scene_def box = box_of(100, 0.1, 0.9, 1.1, walls, 5);
        compare_scene(packed(with_second(box, 0.35, 1.4, 1.0), 0.3), 500);
        compare_scene(packed(with_second(box, 0.1, 3.0, 20.0), 0.5 * densest), 500);
    }
    const hd_scene_def box = box_of(100, 0.1, 0.9, 1.1, 0, 6);
    compare_scene(packed(with_second(box, 0.35, 1.4, 1.0), densest), 500);
}

/** A second kind that is as the first: the events of one kind from the same state, bit for bit. */
TEST(a_second_kind_as_the_first)
{
    for (int walls = 0; walls < WALL_SETS; walls++) {
        const hd_scene_def alike = box_of(40, 0.5, 0.9, 1.1, walls, 5),
                           two = with_second(alike, 0.5, 1.0, 1.0);
        double q[40 * DIM], p[40 * DIM];
        OWNED(hd_trajectory) *of_two = trajectory_of(two);
        hd_trajectory_state(of_two, q, p);
        OWNED(hd_record) *want = log_of(&alike, q, p, 30.0), *got = new_log();
        CHECK_OK(trajectory_to(of_two, got, 30.0));
        assert_int_equal(got->count, want->count);
        assert_memory_equal(got->entry, want->entry, want->count * want->size);
        assert_true(want->count > 500);
    }
}
