/** The circle as a container: start, what is refused, wave numbers [T21]. */
#include "testing.h"

static hd_scene_def circle(int disks, double density)
{
    return scene(.container = HD_CIRCLE, .number = disks, .density = density);
}

static double radius_of(const hd_scene_def *def)
{
    double box[2];
    hd_scene_box(def, box);
    CHECK_CLOSE(box[0], box[1], 0.0);
    return 0.5 * box[0];
}

static void check_refused(hd_scene_def def, const char *text)
{
    char message[256] = "";
    assert_int_equal(hd_scene_check(&def, message, sizeof message), HD_REFUSED);
    if (!strstr(message, text)) fail_msg("\"%s\" does not say \"%s\"", message, text);
}

TEST(density_is_by_the_area_of_the_circle)
{
    for (int n = 1; n < 1000; n = 2 * n + 1) {
        const hd_scene_def def = circle(n, 0.3);
        const double r = radius_of(&def);
        CHECK_CLOSE(n / (PI * r * r), 0.3, 4.0 * DBL_EPSILON);
    }
}

TEST(what_it_says_of_itself)
{
    const hd_scene_def def = circle(100, 0.3);
    double x[HD_OUTLINE], y[HD_OUTLINE];
    char text[64];
    hd_scene_describe(&def, text, sizeof text);
    assert_string_equal(text, "a circle of radius 10.3006"); /* sqrt(100 / (0.3 pi)) */
    assert_string_equal(hd_scene_boundary_word(&def, 0), "curved");
    assert_string_equal(hd_scene_boundary_word(&def, 1), "curved");
    assert_string_equal(hd_scene_boundary_word(&def, 2), "");
    assert_int_equal(hd_scene_outline(&def, x, y), HD_OUTLINE);
    for (int k = 0; k < HD_OUTLINE; k++) {
        const double angle = 2.0 * PI * k / HD_OUTLINE, r = radius_of(&def);
        CHECK_CLOSE(x[k], r + r * cos(angle), 1e-13);
        CHECK_CLOSE(y[k], r + r * sin(angle), 1e-13);
    }
}

/** 2 N / kT of 2 N momenta: one less, as the angular momentum is 0. */
TEST(its_temperature_knows_what_is_conserved)
{
    for (int n = 2; n < 50; n += 3) {
        const hd_scene_def def = circle(n, 0.1);
        CHECK_CLOSE(hd_gas_temperature(&def), 2.0 * n / (2.0 * n - 1.0), 4.0 * DBL_EPSILON);
    }
}

TEST(what_a_circle_has_not_is_refused_by_name)
{
    hd_scene_def def = circle(100, 0.7);
    CHECK_OK(hd_scene_check(&def, NULL, 0));
    check_refused(scene_from(def, .aspect = 1.0), "aspect = 1: must not be given");
    check_refused(scene_from(def, .boundary[0] = R), "boundary_x = reflecting: must not be given");
    check_refused(scene_from(def, .boundary[1] = R), "boundary_y = reflecting: must not be given");
    check_refused(scene_from(def, .observe = HD_OBSERVE_HYDRO), "hydro");
    check_refused(scene_from(def, .observe = HD_OBSERVE_STRUCTURE), "structure");
    check_refused(scene(.number = 1), "number = 1: must be");
    check_refused(circle(1, 0.5), "exponents = positive: must be all");
    check_refused(
        scene_from(circle(1, 0.5), .exponents = HD_EXPONENTS_ALL, .observe = HD_OBSERVE_COVARIANT),
        "observables = covariant: must not be given with number = 1");
    check_refused(scene_from(def, .max_mode_number = 40),
                  "density = 0.7, container = circle: waves");
}

/** Below the density that is named disks start apart, inside, with energy N and at rest together;
 * above it they are refused. */
static void check_start(int disks)
{
    char message[256] = "";
    hd_scene_def def = circle(disks, 1.1547);
    double densest = 1.1547;
    if (hd_scene_check(&def, message, sizeof message) != HD_OK) {
        const char *most = strstr(message, "must be at most ");
        assert_non_null(most);
        densest = strtod(most + strlen("must be at most "), NULL);
    }
    def.density = densest * (1.0 - 1e-5);
    MADE(hd_trajectory, tr, &def);
    HEAP double *q = calloc(2 * (size_t)disks, sizeof *q);
    const double r = radius_of(&def);
    hd_trajectory_state(tr, q, NULL);
    double least = INFINITY, farthest = 0.0;
    for (int i = 0; i < disks; i++) {
        farthest = fmax(farthest, hypot(q[2 * i] - r, q[2 * i + 1] - r));
        for (int j = 0; j < i; j++)
            least = fmin(least, hypot(q[2 * i] - q[2 * j], q[2 * i + 1] - q[2 * j + 1]));
    }
    assert_true(farthest <= r - 0.5);
    assert_true(least >= 1.0);
    CHECK_CLOSE(hd_trajectory_examined(tr).kinetic_energy, disks, 1e-13 * disks);
    CHECK_CLOSE(hd_trajectory_examined(tr).angular_momentum, 0.0, 1e-13 * disks * r);
    def.density = densest * (1.0 + 2e-5);
    if (def.density < 1.1547) check_refused(def, "density = ");
}

TEST(disks_start_apart_and_inside)
{
    for (int n = 2; n < 60; n++) check_start(n);
    for (int n = 60; n < 1500; n += 1 + n / 4) check_start(n);
}

/** Closest packings of 2, 3 and 7 disks are hexagons; of many it is nearly that of the plane. */
TEST(known_packings)
{
    const struct {
        int disks;
        double radius;
    } packed[] = {{2, 1.0}, {3, 0.5 + 1.0 / sqrt(3.0)}, {7, 1.5}, {19, 2.5}};
    for (size_t k = 0; k < sizeof packed / sizeof *packed; k++) {
        const double densest = packed[k].disks / (PI * packed[k].radius * packed[k].radius);
        const hd_scene_def below = circle(packed[k].disks, densest * (1.0 - 1e-8));
        if (packed[k].disks < 19) CHECK_OK(hd_scene_check(&below, NULL, 0));
        check_refused(circle(packed[k].disks, densest * (1.0 + 1e-8)), "density = ");
    }
    const hd_scene_def many = circle(780, 1.0);
    CHECK_OK(hd_scene_check(&many, NULL, 0));
}

/** Roots of J_m' (LP) and of m J_m - J_(m+2) (T), which for m = 0 are those of J_2 and for m = 1
 * those of J_2': Abramowitz and Stegun, tables 9.5; those of m = 2 solve their equation. */
TEST(wave_numbers_are_published_roots)
{
    static const struct {
        int m, n, pairs, transverse;
        double root;
    } known[] = {
        {1, 1, 2, 0, 1.84118}, {1, 1, 0, 2, 3.05424}, {2, 1, 2, 0, 3.05424}, {0, 1, 1, 0, 3.83171},
        {2, 1, 0, 2, 4.61256}, {0, 1, 0, 1, 5.13562}, {1, 2, 2, 0, 5.33144}, {1, 2, 0, 2, 6.70613},
        {2, 2, 2, 0, 6.70613}, {0, 2, 1, 0, 7.01559}, {2, 2, 0, 2, 8.15781}, {0, 2, 0, 1, 8.41724},
    };
    enum { KNOWN = sizeof known / sizeof *known };
    const hd_scene_def def = scene_from(circle(400, 0.5), .max_mode_number = 2);
    const double reach = radius_of(&def) - 0.5;
    hd_wave wave[2 * KNOWN];
    assert_int_equal(hd_waves(&def, wave, 2 * KNOWN), KNOWN);
    for (int k = 0; k < KNOWN; k++) {
        int at = 0;
        while (at < KNOWN && !(wave[at].n[0] == known[k].m && wave[at].n[1] == known[k].n &&
                               wave[at].pairs.count == known[k].pairs &&
                               wave[at].transverse.count == known[k].transverse))
            at++;
        assert_true(at < KNOWN);
        CHECK_CLOSE(wave[at].number * reach, known[k].root, 6e-6);
        if (k > 0) assert_true(wave[k].number >= wave[k - 1].number);
    }
}

/** The largest number of nodes that is allowed is that of a wave that is there. */
TEST(no_more_nodes_than_waves_have)
{
    for (int disks = 5; disks < 500; disks += 1 + disks / 3) {
        hd_scene_def def = circle(disks, 0.5);
        hd_wave wave[2000];
        def.max_mode_number = hd_wave_limits_of(&def).node;
        CHECK_OK(hd_scene_check(&def, NULL, 0));
        int largest = 0;
        const int count = hd_waves(&def, wave, 2000);
        for (int k = 0; k < count; k++) largest = wave[k].n[0] > largest ? wave[k].n[0] : largest;
        assert_int_equal(largest, def.max_mode_number);
        def.max_mode_number++;
        check_refused(def, "max_mode_number = ");
    }
}

TEST(every_wave_up_to_a_wave_number)
{
    hd_scene_def def = circle(400, 0.5);
    hd_wave wave[1000];
    double most = hd_wave_limits_of(&def).largest;
    def.max_wave_number = most;
    const int count = hd_waves(&def, wave, 1000);
    const double reach = radius_of(&def) - 0.5;
    /* Weyl: LP and T each about (k a)^2 / 4 +- k a / 2, less the sines */
    int dimension = 0;
    for (int k = 0; k < count; k++) dimension += wave[k].pairs.count + wave[k].transverse.count;
    CHECK_CLOSE(dimension, 0.5 * most * most * reach * reach, 0.05 * dimension + most * reach);
    most = hd_wave_limits_of(&def).smallest;
    CHECK_CLOSE(most * reach, 1.84118, 1e-5);
    def.max_wave_number = 1.0001 * most;
    assert_int_equal(hd_waves(&def, wave, 1000), 1);
}
