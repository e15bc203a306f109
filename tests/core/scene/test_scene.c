/** Scene: what is refused and in which words; numbers derived from a definition. */
#include "scene/container.h"
#include "testing.h"

static void check_accepted(const hd_scene_def *def)
{
    char message[256] = "untouched";
    if (hd_scene_check(def, message, sizeof message) != HD_OK) fail_msg("refused: %s", message);
    assert_string_equal(message, "untouched");
}

/** The message names the parameter, shows its value and says what is allowed, on one line. */
static void check_refused(const hd_scene_def *def, const char *name, const char *value,
                          const char *allowed)
{
    char message[256] = "";
    const hd_status status = hd_scene_check(def, message, sizeof message);
    if (status != HD_REFUSED) fail_msg("%s = %s was accepted", name, value);
    if (strncmp(message, name, strlen(name)) != 0 || !strstr(message, value) ||
        !strstr(message, allowed) || strchr(message, '\n'))
        fail_msg("%s = %s: \"%s\" lacks \"%s\"", name, value, message, allowed);
    assert_int_equal(hd_scene_check(def, NULL, 0), HD_REFUSED);
}

TEST(default_is_the_papers)
{
    const hd_scene_def def = hd_scene_def_default();
    double box[2];
    check_accepted(&def);
    hd_scene_box(&def, box);
    CHECK_CLOSE(box[0], 33.535, 5e-4); /* as printed in the paper */
    CHECK_CLOSE(box[1], 29.074, 7e-4);
    assert_int_equal(hd_scene_vectors(&def), 1557);
}

/** Of a circle by its area; two disks of a dumbbell share a lens, and none from a bond of 1 on. */
TEST(packing_is_what_particles_cover)
{
    const double pi = 3.14159265358979323846;
    hd_scene_def def = scene(.number = 50, .density = 0.6);
    CHECK_CLOSE(hd_scene_packing(&def), 0.6 * pi / 4.0, 1e-15);
    def.container = HD_CIRCLE;
    CHECK_CLOSE(hd_scene_packing(&def), 0.6 * pi / 4.0, 1e-15);
    def.container = HD_RECTANGLE;
    def.particles = HD_SPHERES;
    CHECK_CLOSE(hd_scene_packing(&def), 0.6 * pi / 6.0, 1e-15);
    assert_true(hd_scene_inertia(&def) == 0.0);
    def.particles = HD_DUMBBELLS;
    def.own[0].real = 0.5; /* the lens: pi / 6 - sqrt(3) / 8 */
    CHECK_CLOSE(hd_scene_packing(&def), 0.6 * (pi / 2.0 - pi / 6.0 + sqrt(3.0) / 8.0), 1e-15);
    CHECK_CLOSE(hd_scene_inertia(&def), 0.0625 + 0.125, 1e-15);
    def.own[0].real = 1.5;
    CHECK_CLOSE(hd_scene_packing(&def), 0.6 * pi / 2.0, 1e-15);
    hd_dynamics other = *hd_dynamics_of(&def);
    other.size = NULL;
    def.dynamics = &other;
    assert_true(isnan(hd_scene_packing(&def)));
}

/** 3 / (0.05 c_T k): 100 time units in the paper's scene, more in larger boxes. */
TEST(the_warm_up_follows_from_the_smallest_step)
{
    hd_scene_def def = hd_scene_def_default();
    const double box = 33.535, slope = 3.28, first = 60.0 * box / (2.0 * 3.14159265 * slope);
    CHECK_CLOSE(hd_scene_warmup(&def), first, 0.01 * first);
    def.number *= 4; /* twice as long */
    CHECK_CLOSE(hd_scene_warmup(&def), 2.0 * first, 0.02 * first);
    def.exponents = 3;
    CHECK_CLOSE(hd_scene_warmup(&def), 50.0, 0.0);
    def.exponents = HD_EXPONENTS_NONE;
    CHECK_CLOSE(hd_scene_warmup(&def), 0.0, 0.0);
    def.exponents = HD_EXPONENTS_ALL;
    def.number = 2; /* too few for any step */
    def.density = 0.2;
    CHECK_CLOSE(hd_scene_warmup(&def), 20.0, 0.0);
    def.observe = HD_OBSERVE_COVARIANT;
    CHECK_CLOSE(hd_scene_warmup(&def), def.covariant_transient, 0.0);
    def.warmup = 7.0;
    CHECK_CLOSE(hd_scene_warmup(&def), 7.0, 0.0);
}

/** What has a range of its own. */
static bool has_range(const hd_parameter *row)
{
    return row->kind == HD_PARAMETER_REAL || row->kind == HD_PARAMETER_INTERVAL;
}

/** Of a scene that is otherwise right, whatever the value: times are as long as they get. */
static hd_scene_def with(const hd_parameter *row, double value)
{
    hd_scene_def def = hd_scene_def_default();
    if (row->needs == HD_OBSERVE_COVARIANT) {
        def.observe = HD_OBSERVE_COVARIANT;
        def.warmup = 1e12;
        def.covariant_window = row->offset == offsetof(hd_scene_def, covariant_sampling) ? 1e12
                                                                                         : 1.0;
        def.covariant_transient = 1.0;
        def.covariant_sampling = 1e-6;
    }
    hd_parameter_assign(row, &def, value);
    return def;
}

TEST(real_parameters_out_of_range)
{
    int count, checked = 0;
    const hd_parameter *rows = hd_scene_parameters(&count);
    for (int k = 0; k < count; k++) {
        const hd_parameter *row = &rows[k];
        const double refused[] = {row->min - 1e-3 * fabs(row->min) - DBL_MIN,
                                  row->max * 1.001,
                                  NAN,
                                  -NAN,
                                  INFINITY,
                                  -INFINITY,
                                  -2.0,
                                  -DBL_MAX,
                                  DBL_MAX};
        if (!has_range(row)) continue;
        for (size_t v = 0; v < sizeof refused / sizeof *refused; v++) {
            char value[64];
            const hd_scene_def def = with(row, refused[v]);
            snprintf(value, sizeof value, "= %.15g", refused[v]);
            check_refused(&def, row->name, value, row->range);
        }
        checked++;
    }
    assert_true(checked > 10);
}

/** Those that no other parameter limits further. */
TEST(real_parameters_at_the_ends_of_their_range)
{
    int count, checked = 0;
    const hd_parameter *rows = hd_scene_parameters(&count);
    for (int k = 0; k < count; k++) {
        const bool limited = strcmp(rows[k].name, "density") == 0 ||
                             strcmp(rows[k].name, "aspect") == 0 ||
                             strcmp(rows[k].name, "max_wave_number") == 0;
        if (!has_range(&rows[k]) || limited || is_of_spheres(&rows[k])) continue;
        const hd_scene_def least = with(&rows[k], rows[k].min), most = with(&rows[k], rows[k].max);
        check_accepted(&least);
        check_accepted(&most);
        checked++;
    }
    assert_true(checked > 8);
}

TEST(whole_fields_out_of_range)
{
    const int disks[] = {1, 0, -1, -780, 1000001, INT32_MAX, INT32_MIN}, threads[] = {-1, 1025};
    for (size_t k = 0; k < sizeof disks / sizeof *disks; k++) {
        char value[32];
        hd_scene_def def = scene(.number = disks[k]);
        snprintf(value, sizeof value, "= %d", disks[k]);
        check_refused(&def, "number", value,
                      disks[k] == 1 ? "from 2 to 1000000 in a rectangle"
                                    : "an integer from 1 to 1000000");
    }
    for (size_t k = 0; k < 2; k++) {
        char value[32];
        hd_scene_def def = scene(.threads = threads[k]);
        snprintf(value, sizeof value, "= %d", threads[k]);
        check_refused(&def, "threads", value, "from 0 (all cores) to 1024");
    }
    for (int d = 0; d < 2; d++) {
        hd_scene_def def = hd_scene_def_default();
        def.boundary[d] = HD_CURVED;
        check_refused(&def, d ? "boundary_y" : "boundary_x", "= 3", "periodic or reflecting");
    }
}

/** What is of spheres alone is refused, not left aside. */
TEST(a_third_direction)
{
    const hd_scene_def high = scene(.aspect_z = 0.5), other = scene(.particles = HD_PARTICLES_END);
    char value[32];
    const hd_scene_def walls = scene(.boundary[2] = R);
    snprintf(value, sizeof value, "= %d", HD_PARTICLES_END);
    check_refused(&other, "particles", value, "disks or spheres or dumbbells or soft_disks or ");
    const hd_scene_def dense = scene(.density = 1.1548);
    check_refused(&dense, "density", "= 1.1548", "from 1e-6 to 1.1547 with particles = disks");
    check_refused(&high, "aspect_z", "= 0.5", "must not be given with particles = disks");
    check_refused(&walls, "boundary_z", "= reflecting", "must not be given with particles = disks");
}

TEST(exponents_out_of_range)
{
    const int refused[] = {-4, 3121, INT32_MAX, INT32_MIN}, accepted[] = {-3, -2, -1, 0, 1, 3120};
    for (size_t k = 0; k < sizeof refused / sizeof *refused; k++) {
        char value[32];
        hd_scene_def def = scene(.exponents = refused[k]);
        snprintf(value, sizeof value, "= %d", refused[k]);
        check_refused(&def, "exponents", value, "4 N = 3120");
    }
    for (size_t k = 0; k < sizeof accepted / sizeof *accepted; k++) {
        hd_scene_def def = scene(.exponents = accepted[k]);
        check_accepted(&def);
    }
}

TEST(narrower_than_a_disk)
{
    const hd_scene_def flat = scene_in_box(5, 20.0, 0.999, P, P, 1);
    const hd_scene_def tall = scene_in_box(5, 0.999, 20.0, R, P, 1);
    const hd_scene_def square = scene_in_box(2, 1.5, 1.5, P, P, 1);
    check_refused(&flat, "density", "Ly = 0.999", "above the disk diameter 1");
    check_refused(&tall, "density", "Lx = 0.999", "above the disk diameter 1");
    check_accepted(&square);
    for (int b = 0; b < 4; b++) { /* a last bit above a diameter is enough for a chain */
        hd_scene_def chain = scene_in_box(5, 20.0, 1.0 + 1e-9, (hd_boundary)(b & 1),
                                          (hd_boundary)(b >> 1), 1);
        check_accepted(&chain);
    }
}

/** Just below the reported maximum a scene is accepted, just above it is refused and told so. */
TEST(too_dense_for_the_lattice)
{
    const int disks[] = {2, 3, 5, 12, 49, 64, 780};
    for (size_t k = 0; k < sizeof disks / sizeof *disks; k++)
        for (int b = 0; b < 4; b++) {
            hd_scene_def def = scene_of(disks[k], 0.5, 0.9, (hd_boundary)(b & 1),
                                        (hd_boundary)(b >> 1), 1);
            char most[32];
            const double densest = hd_container_of(&def)->density_max(&def);
            def.density = densest;
            check_accepted(&def);
            def.density = densest * (1.0 + 1e-8);
            snprintf(most, sizeof most, "at most %.6g", densest);
            if (def.density <= 2.0 / sqrt(3.0)) check_refused(&def, "density", "= ", most);
        }
}

TEST(message_may_be_short)
{
    char message[] = "..........";
    hd_scene_def def = scene(.density = -1.0);
    assert_int_equal(hd_scene_check(&def, message, 5), HD_REFUSED);
    assert_memory_equal(message, "dens\0.....", sizeof message);
    assert_int_equal(hd_scene_check(&def, message, 0), HD_REFUSED);
    assert_memory_equal(message, "dens\0.....", sizeof message);
}

TEST(box_has_area_and_aspect)
{
    const double density[] = {1e-6, 0.3, 1.1}, aspect[] = {1e-3, 0.867, 1.0, 77.0};
    for (int k = 0; k < 12; k++) {
        const hd_scene_def def = scene_of(50 * (k + 1), density[k % 3], aspect[k % 4], P, P, 1);
        const double area = def.number / def.density, rounding = 4.0 * DBL_EPSILON;
        double box[2];
        hd_scene_box(&def, box);
        CHECK_CLOSE(box[0] * box[1], area, rounding * area);
        CHECK_CLOSE(box[1] / box[0], def.aspect, rounding * def.aspect);
    }
}

TEST(what_a_box_says_of_itself)
{
    const hd_scene_def def = scene(.number = 100, .density = 0.25, .aspect = 0.25,
                                   .boundary[1] = HD_REFLECTING);
    double x[HD_OUTLINE], y[HD_OUTLINE];
    char text[64];
    hd_scene_describe(&def, text, sizeof text);
    assert_string_equal(text, "40 x 10");
    assert_string_equal(hd_scene_boundary_word(&def, 0), "periodic");
    assert_string_equal(hd_scene_boundary_word(&def, 1), "reflecting");
    assert_string_equal(hd_scene_boundary_word(&def, 2), "");
    assert_int_equal(hd_scene_outline(&def, x, y), 0);
}

TEST(numbers_of_vectors)
{
    const int zeros[] = {6, 4, 4, 2};
    for (int b = 0; b < 4; b++)
        for (int n = 2; n <= 1000000; n = n * 3 + 1) {
            hd_scene_def def = scene_of(n, 0.5, 1.0, (hd_boundary)(b & 1), (hd_boundary)(b >> 1),
                                        1);
            assert_int_equal(hd_scene_zero_exponents(&def), zeros[b]);
            def.exponents = HD_EXPONENTS_ALL;
            assert_int_equal(hd_scene_vectors(&def), 4 * n);
            def.exponents = HD_EXPONENTS_POSITIVE;
            assert_int_equal(hd_scene_vectors(&def), 2 * n - zeros[b] / 2);
            def.exponents = HD_EXPONENTS_NONE;
            assert_int_equal(hd_scene_vectors(&def), 0);
            def.exponents = 7;
            assert_int_equal(hd_scene_vectors(&def), 7);
        }
}

/** Of a gas sqrt(2); of a fluid from the slope of the pressure p(rho) = rho Z at constant entropy:
 * d p / d rho + p^2 / rho^2, as kT changes by p / rho for each part of rho. */
TEST(sound_is_that_of_the_equation_of_state)
{
    hd_scene_def def = hd_scene_def_default();
    double box[2], p[3];
    def.aspect = 4.0;
    def.density = 1e-6;
    hd_scene_box(&def, box);
    CHECK_CLOSE(box[1] / hd_scene_sound_crossing(&def), sqrt(2.0), 1e-5);
    const double step = 1e-4, rho = 0.8;
    for (int k = 0; k < 3; k++) {
        const double x = rho + (k - 1) * step, eta = atan(1.0) * x;
        p[k] = x * (1.0 + eta * eta / 8.0) / pow(1.0 - eta, 2.0);
    }
    def.density = rho;
    hd_scene_box(&def, box);
    const double want = sqrt((p[2] - p[0]) / (2.0 * step) + pow(p[1] / rho, 2.0));
    CHECK_CLOSE(box[1] / hd_scene_sound_crossing(&def), want, 1e-5 * want);
}
