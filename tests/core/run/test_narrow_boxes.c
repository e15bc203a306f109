/** c_T, c_L and v of narrow boxes and of boxes with walls against those of long boxes of the same
 * density: stated errors hold what edges and walls change [T12]. */
#include "dumbbell.h"
#include "runs.h"

/** Means over boxes that are 8 high, or of boxes without walls: c_T, c_L, v and their errors. */
typedef struct in_long_boxes {
    double density, bond, value[3], error[3];
} in_long_boxes;

static const in_long_boxes QUARTER = {0.6, 0.25, {2.666, 3.406, 3.334}, {0.007, 0.03, 0.014}},
                           HALF = {0.6, 0.5, {4.997, 7.223, 8.782}, {0.012, 0.07, 0.035}},
                           THIN = {0.3, 0.5, {1.394, 1.451, 1.279}, {0.006, 0.012, 0.008}},
                           DISKS = {0.5, 0.0, {1.6586, 1.8113, 1.9491}, {0.002, 0.005, 0.004}};

/** height: Ly. walls: 1 of x, 2 of y. */
static const struct {
    const in_long_boxes *of;
    int number;
    double height;
    int walls;
} boxes[] = {
    {&QUARTER, 40, 1.8, 0},   {&QUARTER, 40, 2.0, 0}, {&QUARTER, 40, 2.5, 0},
    {&QUARTER, 40, 3.0, 0},   {&QUARTER, 40, 3.5, 0}, {&HALF, 40, 1.8, 0},
    {&HALF, 40, 3.0, 0},      {&THIN, 40, 2.25, 0},   {&DISKS, 40, 1.8, 0},
    {&DISKS, 100, 14.142, 3}, {&DISKS, 60, 8.485, 3}, {&DISKS, 60, 4.2426, 2},
};
enum { BOXES = sizeof boxes / sizeof boxes[0] };

static hd_scene_def scene_of_box(int box)
{
    const in_long_boxes *of = boxes[box].of;
    const double length = boxes[box].number / (of->density * boxes[box].height);
    const int walls = boxes[box].walls;
    hd_scene_def def = of->bond > 0
                           ? dumbbells_in_box(boxes[box].number, length, boxes[box].height,
                                              of->bond, 0.0, walls, 1)
                           : scene_in_box(boxes[box].number, length, boxes[box].height,
                                          (hd_boundary)(walls & 1), (hd_boundary)(walls >> 1), 1);
    return scene_from(def, .equilibration = 50.0, .warmup = 50.0, .duration = 200.0,
                      .observe = HD_OBSERVE_STEPS | HD_OBSERVE_PHASES, .threads = 1);
}

/** c_T, c_L and v; errors are negative where there is none. */
static void results(const hd_run *run, double value[3], double error[3])
{
    const hd_parts parts = hd_run_parts(run);
    const hd_velocity v = hd_phases_velocity(parts.phases);
    for (int k = 0; k < 2; k++) {
        const hd_dispersion d = hd_steps_dispersion(parts.steps, parts.spectrum,
                                                    k == 0 ? HD_MODE_T : HD_MODE_LP);
        value[k] = d.c.value;
        error[k] = d.c.error;
    }
    value[2] = v.v;
    error[2] = v.v_error;
}

TEST(no_box_is_farther_off_than_two_of_its_errors)
{
    static const char *const names[3] = {"c_T", "c_L", "v"};
    int count = 0, beyond = 0;
    double squares = 0.0;
    for (int box = 0; box < BOXES; box++) {
        const in_long_boxes *of = boxes[box].of;
        OWNED(hd_run) *run = finished(scene_of_box(box));
        double value[3], error[3];
        results(run, value, error);
        print_message("%d, density %g, bond %g, height %g, walls %d\n", boxes[box].number,
                      of->density, of->bond, boxes[box].height, boxes[box].walls);
        for (int k = 0; k < 3; k++) {
            if (error[k] < 0) continue;
            const double z = (value[k] - of->value[k]) / hypot(error[k], of->error[k]);
            print_message("  %s %.4f(%.4f), long boxes %.4f: %+.2f errors\n", names[k], value[k],
                          error[k], of->value[k], z);
            squares += z * z;
            count++;
            beyond += fabs(z) > 2.0;
        }
    }
    print_message("%d values, %d beyond two errors, rms %.2f\n", count, beyond,
                  sqrt(squares / count));
    assert_true(count >= 28);
    assert_int_equal(beyond, 0);
    CHECK_WITHIN(sqrt(squares / count), 0.4, 1.25); /* of 30 normal deviations 1 +- 0.13 */
}

/** Whatever the kind of particles: those of the same area have the same edges and rows. */
TEST(dumbbells_fill_a_box_as_disks_of_their_area)
{
    const double pi = 3.14159265358979323846, bond = 0.5, height = 3.0, density = 0.6;
    for (int walls = 0; walls < 4; walls++) {
        const hd_scene_def def = dumbbells_in_box(40, 40 / (density * height), height, bond, 0.0,
                                                  walls, 1);
        const double packing = hd_scene_packing(&def), s = sqrt(packing / density / (pi / 4.0));
        assert_true(s > 1.2 && s < 1.3);
        const hd_scene_def disks = scene_in_box(40, 40 / (density * height) / s, height / s,
                                                (hd_boundary)(walls & 1), (hd_boundary)(walls >> 1),
                                                1);
        for (int kind = HD_MODE_T; kind <= HD_MODE_LP; kind++) {
            const double got = hd_relation_of(&def, (hd_mode_kind)kind).box_error;
            const double want = hd_relation_of(&disks, (hd_mode_kind)kind).box_error;
            CHECK_CLOSE(got, want, 1e-12 * want);
        }
    }
}
