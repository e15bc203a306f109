/** What spheres are refused: by name, value, and what is allowed. */
#include "scene/container.h"
#include "create_from.h"
#include "testing.h"

static void check_line(hd_scene_def def, const char *want)
{
    char line[512] = "";
    assert_int_equal(hd_scene_check(&def, line, sizeof line), HD_REFUSED);
    assert_string_equal(line, want);
}

static hd_scene_def usual(void) { return box_of(32, 0.5, 1.0, 1.0, 0, 1); }

TEST(what_is_of_disks_alone)
{
    check_line(scene_from(usual(), .container = HD_CIRCLE),
               "container = circle: must be rectangle, a box, with particles = spheres");
}

TEST(values_out_of_range)
{
    check_line(scene_from(usual(), .density = 1.4143),
               "density = 1.4143: must be from 1e-6 to 1.4142 with particles = spheres");
    check_line(scene_from(usual(), .density = NAN),
               "density = nan: must be from 1e-6 to 2/sqrt(3) = 1.1547, in space to sqrt(2) = "
               "1.4142, with small particles of a second kind to 28.8675 and 176.7767");
    check_line(scene_from(usual(), .aspect_z = 0.0), "aspect_z = 0: must be from 1e-6 to 1e6");
    check_line(scene_from(usual(), .aspect_z = 2e6),
               "aspect_z = 2000000: must be from 1e-6 to 1e6");
    check_line(scene_from(usual(), .boundary[2] = HD_CURVED),
               "boundary_z = 3: must be periodic or reflecting or shearing");
    check_line(
        scene_from(usual(), .exponents = 193),
        "exponents = 193: must be positive, all, all_independent, none or from 1 to 6 N = 192");
    assert_int_equal(hd_scene_vectors(&(hd_scene_def){.number = 32, .exponents = 192}), 192);
}

/** Each direction by its own name, behind walls and without. */
TEST(edges_below_a_diameter)
{
    check_line(box_of(2, 2.0 / 3.375, 1.0, 0.5, 0, 1), /* Lx^3 = 6.75 */
               "density = 0.592592592592593 with number = 2, aspect = 1, aspect_z = 0.5: the box "
               "edge Lz = 0.944940787421155 must be above the disk diameter 1");
    check_line(box_of(2, 1.0 / 8.0, 0.25, 1.0, 2, 1), /* 4 x 1 x 4 */
               "density = 0.125 with number = 2, aspect = 0.25, aspect_z = 1: the box edge Ly = 1 "
               "must be above the disk diameter 1 by 1e-9");
}

TEST(a_box_in_words)
{
    const hd_scene_def def = box_with(8, 4.0, 6.0, 2.0, 4, 1);
    char text[64];
    hd_scene_describe(&def, text, sizeof text);
    assert_string_equal(text, "4 x 6 x 2");
    assert_string_equal(hd_scene_boundary_word(&def, 0), "periodic");
    assert_string_equal(hd_scene_boundary_word(&def, 2), "reflecting");
}

/** The number in the line is the density up to which there is a lattice. */
TEST(denser_than_the_densest_lattice)
{
    for (int walls = 0; walls < 8; walls++)
        for (int n = 5; n < 60; n += 11) {
            hd_scene_def def = box_of(n, 1.414, 1.1, 0.9, walls, 1);
            char line[512] = "", *number;
            assert_int_equal(hd_scene_check(&def, line, sizeof line), HD_REFUSED);
            if (strstr(line, "the box edge")) continue;
            assert_non_null(number = strstr(line, "must be at most "));
            const double most = atof(number + strlen("must be at most "));
            assert_non_null(strstr(line, "density = 1.414"));
            assert_non_null(strstr(line, "aspect = 1.1, aspect_z = 0.9 and these boundaries"));
            def.density = most * (1.0 - 1e-5); /* it has six digits */
            CHECK_OK(hd_scene_check(&def, line, sizeof line));
            def.density = most * (1.0 + 1e-5);
            assert_int_equal(hd_scene_check(&def, line, sizeof line), HD_REFUSED);
        }
}

/** Closest packing is a lattice of 4 k^3 spheres in a cube. */
TEST(closest_packing_is_allowed)
{
    for (int k = 1; k < 5; k++) {
        const hd_scene_def closest = box_of(4 * k * k * k, 1.41421, 1.0, 1.0, 0, 1);
        CHECK_OK(hd_scene_check(&closest, NULL, 0));
    }
}

TEST(waves_shorter_than_two_distances)
{
    check_line(
        scene_from(box_of(64, 0.5, 0.5, 1.0, 0, 1), .max_mode_number = 4),
        "max_mode_number = 4: must be at most 2 with number = 64, density = 0.5, aspect = 0.5, "
        "aspect_z = 1 and these boundaries: waves shorter than two mean distances of particles, 2 "
        "/ "
        "cbrt(density), are not looked for");
}

/** A prepared state that overlaps through an image across an edge or a corner, or is outside. */
TEST(states_that_cannot_be)
{
    const hd_scene_def def = box_with(2, 5.0, 6.0, 7.0, 0, 1);
    const double p[6] = {0.1, 0.2, 0.3, -0.1, -0.2, -0.3};
    double q[6] = {0.2, 0.3, 0.1, 4.8, 5.8, 6.7};
    hd_trajectory *tr = NULL;
    assert_int_equal(hd_trajectory_create_from(&tr, &def, q, p), HD_OVERLAP);
    q[5] = 6.0;
    CHECK_OK(hd_trajectory_create_from(&tr, &def, q, p));
    hd_trajectory_free(tr);
    q[5] = 7.1;
    assert_int_equal(hd_trajectory_create_from(&tr, &def, q, p), HD_REFUSED);
}
