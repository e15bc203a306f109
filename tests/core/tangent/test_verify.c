/** The verify build's checks: silent about what is right, each of them heard when its invariant is
 * broken. */
#include "bodies.h"
#include "runs.h"
#include "tangent/verify.h"

static jmp_buf caught;

static void catch (const char *condition, const char *file, int line)
{
    (void)condition;
    (void)line;
    longjmp(caught, strstr(file, "verify.c") ? 1 : 2);
}

/** Whether the call broke a contract of verify.c is in `broken`. */
static volatile bool broken;
#define EXPECT_BROKEN(expected, call)                                                              \
    do {                                                                                           \
        broken = true;                                                                             \
        hd_assert_handler_replace(catch);                                                          \
        if (setjmp(caught) == 0) {                                                                 \
            (call);                                                                                \
            broken = false;                                                                        \
        }                                                                                          \
        hd_assert_handler_replace(NULL);                                                           \
        if (broken != (expected)) fail_msg("%s: " #call, broken ? "broken" : "not broken");        \
    } while (0)

static hd_run *run_of(int exponents)
{
    hd_run *run = created(scene(.number = 16, .density = 0.7, .aspect = 1.0, .seed = 3,
                                .exponents = exponents, .equilibration = 2.0, .warmup = 10.0,
                                .duration = 10.0));
    for (int k = 0; k < 20; k++) CHECK_OK(hd_run_advance(run));
    return run;
}

/** Walls that shear keep neither momentum nor symplectic products nor the volume; energy they do.
 */
TEST(what_walls_that_shear_break_is_not_expected)
{
    OWNED(hd_run) *run = created(scene(.number = 16, .density = 0.5, .aspect = 1.0,
                                       .boundary[1] = HD_SHEARING, .shear_b = 0.5,
                                       .exponents = HD_EXPONENTS_ALL, .equilibration = 50.0,
                                       .warmup = 10.0, .duration = 10.0));
    until(run, HD_WARMING_UP);
    for (int k = 0; k < 3; k++) CHECK_OK(hd_run_advance(run));
    const hd_trajectory *tr = run->advance.trajectory;
    hd_disk *disk = hard_in(tr)->motion.disk;
    assert_true(fabs(hd_trajectory_examined(tr).momentum[0]) > 1e-3);
    const hd_symplectic before = {.product = {1.0}, .scale = {1.0}};
    EXPECT_BROKEN(false, hd_verify_trajectory(tr, &run->scene));
    EXPECT_BROKEN(false, hd_verify_record(run->carrier.record, &run->scene));
    EXPECT_BROKEN(false, hd_verify_symplectic(run->carrier.frame, &before, 0.0));
    EXPECT_BROKEN(false, hd_verify_ortho(run->carrier.ortho, run->carrier.frame));
    disk[0].p[0] *= 1.0 + 1e-9;
    EXPECT_BROKEN(true, hd_verify_trajectory(tr, &run->scene));
}

TEST(disks_are_checked)
{
    OWNED(hd_run) *run = run_of(HD_EXPONENTS_POSITIVE);
    const hd_trajectory *tr = run->advance.trajectory;
    hd_disk *disk = hard_in(run->advance.trajectory)->motion.disk;
    const hd_disk right = disk[0];
    EXPECT_BROKEN(false, hd_verify_trajectory(tr, &run->scene));
    disk[0].p[0] *= 1.0 + 1e-9;
    EXPECT_BROKEN(true, hd_verify_trajectory(tr, &run->scene));
    disk[0] = right;
    for (int d = 0; d < 2;
         d++) { /* turned back where it is: the same energy, but not the same momentum */
        disk[0].q[d] += 2.0 * disk[0].p[d] *
                        (hard_in(tr)->now - hard_in(tr)->epoch_start - disk[0].t);
        disk[0].p[d] = -disk[0].p[d];
    }
    EXPECT_BROKEN(true, hd_verify_trajectory(tr, &run->scene));
    disk[0] = right;
    disk[0].q[0] += 0.6; /* density .7: there is no room */
    EXPECT_BROKEN(true, hd_verify_trajectory(tr, &run->scene));
    disk[0] = right;
    disk[0].p[1] = NAN;
    EXPECT_BROKEN(true, hd_verify_trajectory(tr, &run->scene));
    disk[0] = right;
}

TEST(the_log_is_checked)
{
    const hd_scene_def box = scene(.number = 3, .density = 0.5, .boundary[1] = HD_REFLECTING);
    const hd_event right[2] = {{0.5, 0, 1, {1, 0}, {-1, 0}}, {0.7, 2, HD_WALL_Y, {0, 1}, {1, 2}}};
    const struct {
        int event;
        hd_event wrong;
    } cases[] = {
        {1, {0.4, 0, 1, {1, 0}, {-1, 0}}}, /* before the other */
        {1, {1.1, 0, 1, {1, 0}, {-1, 0}}}, /* after the end */
        {0, {NAN, 0, 1, {1, 0}, {-1, 0}}}, /* never */
        {0, {0.5, 1, 0, {1, 0}, {-1, 0}}}, /* not in their order */
        {0, {0.5, 0, 3, {1, 0}, {-1, 0}}}, /* no such disk */
        {0, {0.5, 0, HD_WALL_ROUND, {1, 0}, {1, 0}}},
        {0, {0.5, -1, 1, {1, 0}, {-1, 0}}},
        {0, {0.5, 0, -4, {1, 0}, {-1, 0}}}, /* no such wall */
        {0, {0.5, 0, HD_WALL_X, {1, 0}, {-1, 0}}},
        {0, {0.5, 0, 1, {1, 1e-7}, {-1, 0}}}, /* not a unit vector */
        {0, {0.5, 0, 1, {NAN, 0}, {-1, 0}}},
        {0, {0.5, 0, 1, {1, 0}, {1e-9, 0}}}, /* parting */
        {0, {0.5, 0, 1, {1, 0}, {NAN, 0}}},
    };
    /* one disk in a circle of reach 2 */
    const hd_scene_def round = scene(.container = HD_CIRCLE, .number = 1,
                                     .density = 1.0 / (PI * 2.5 * 2.5));
    const hd_event at_wall[] = {{0.5, 0, HD_WALL_ROUND, {2, 0}, {1, 3}},
                                {0.5, 0, HD_WALL_ROUND, {1, 0}, {1, 3}},  /* of another radius */
                                {0.5, 0, HD_WALL_ROUND, {2, 0}, {-1, 3}}, /* inwards */
                                {0.5, 0, HD_WALL_ROUND, {2, 0}, {NAN, 3}},
                                {0.5, 0, HD_WALL_X, {1, 0}, {1, 3}}}; /* there is none */
    hd_event event[2];
    for (volatile size_t k = 0; k < sizeof at_wall / sizeof *at_wall; k++) {
        const hd_record one = record_of(event, 1, 1.0);
        event[0] = at_wall[k];
        EXPECT_BROKEN(k > 0, hd_verify_record(&one, &round));
    }
    const hd_record log = record_of(event, 2, 1.0);
    memcpy(event, right, sizeof event);
    EXPECT_BROKEN(false, hd_verify_record(&log, &box));
    for (volatile size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        memcpy(event, right, sizeof event);
        event[cases[k].event] = cases[k].wrong;
        EXPECT_BROKEN(true, hd_verify_record(&log, &box));
    }
}

TEST(the_frame_is_checked)
{
    OWNED(hd_run) *run = run_of(HD_EXPONENTS_ALL_INDEPENDENT);
    const hd_symplectic before = hd_verify_sample(run->carrier.frame);
    double *entry = hd_frame_data(run->carrier.frame);
    const double right = entry[0];
    EXPECT_BROKEN(false, hd_verify_symplectic(run->carrier.frame, &before, 0.0));
    EXPECT_BROKEN(false, hd_verify_ortho(run->carrier.ortho, run->carrier.frame));
    entry[0] += 1e-5;
    EXPECT_BROKEN(true, hd_verify_symplectic(run->carrier.frame, &before, 0.0));
    EXPECT_BROKEN(true, hd_verify_ortho(run->carrier.ortho, run->carrier.frame));
    entry[0] = NAN;
    EXPECT_BROKEN(true, hd_verify_symplectic(run->carrier.frame, &before, 0.0));
    EXPECT_BROKEN(true, hd_verify_ortho(run->carrier.ortho, run->carrier.frame));
    entry[0] = right;
    double *stretch = (double *)hd_ortho_log_stretch(run->carrier.ortho);
    stretch[3] += 0.1;
    EXPECT_BROKEN(true, hd_verify_ortho(run->carrier.ortho, run->carrier.frame));
}

/** After a step in the norm of dq the dp halves may be anything. */
TEST(the_frame_is_checked_in_the_norm_of_its_step)
{
    OWNED(hd_run) *run = run_of(HD_EXPONENTS_POSITIVE);
    const hd_ortho_limits limits = {1e7, 1e-6, HD_NORM_DQ};
    CHECK_OK(hd_ortho_step(run->carrier.ortho, run->carrier.frame, limits));
    EXPECT_BROKEN(false, hd_verify_ortho(run->carrier.ortho, run->carrier.frame));
    hd_frame_data(run->carrier.frame)[2 * hd_frame_stride(run->carrier.frame)] += 0.1;
    EXPECT_BROKEN(false, hd_verify_ortho(run->carrier.ortho, run->carrier.frame));
    hd_frame_data(run->carrier.frame)[hd_frame_stride(run->carrier.frame)] += 1e-3;
    EXPECT_BROKEN(true, hd_verify_ortho(run->carrier.ortho, run->carrier.frame));
}

/** The step of a run asks, where the build verifies, and only there. */
TEST(a_step_asks_where_the_build_verifies)
{
    OWNED(hd_run) *run = run_of(HD_EXPONENTS_POSITIVE);
    hd_disk *disk = hard_in(run->advance.trajectory)->motion.disk;
    for (int i = 0; i < 16; i++) disk[i].p[0] *= 1.0 + 1e-9;
    EXPECT_BROKEN(VERIFIES, (void)!hd_run_advance(run));
}
