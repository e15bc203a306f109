/** Late times: the same state goes on alike from t = 0 and from t near 1e6, bit for bit. What
 * rounding does in 1e7 collisions is seen by test_trajectory_conservation.c. */
#include "prepared.h"

/** 2^20; a multiple of every scene's epoch. */
static const double LATE = 1048576.0;

enum { SCENES = 4 };
static hd_scene_def scene_number(int k)
{
    const hd_scene_def scene[SCENES] = {
        scene_of(10, 0.1, 1.0, P, P, 5),
        scene_of(100, 0.7, 0.8, P, R, 6),
        scene_of(12, 0.3, 0.5, R, R, 7),
        scene_in_box(8, 14.0, 1.4, P, P, 8),
    };
    return scene[k];
}

enum { PIECES = 24 };

/** Over three epochs; multiples of 1/1024: their sums with LATE are exact, as the epochs' are. */
static double end_of(int piece, double epoch)
{
    const double part = (double)piece / PIECES;
    return ldexp(rint(ldexp(3.3 * epoch * part * part, 10)), -10);
}

/** Both go on from here, at the times that they are at, for some epochs: the same logs and states.
 */
static void check_alike(hd_trajectory *early, hd_trajectory *late)
{
    const double begin[2] = {hd_trajectory_time(early), hd_trajectory_time(late)};
    const size_t size = 4 * (size_t)hd_trajectory_disks(early);
    double *state[2] = {calloc(size, sizeof(double)), calloc(size, sizeof(double))};
    hd_trajectory *tr[2] = {early, late};
    hd_event_log *log[2] = {new_log(), new_log()};
    size_t events = 0;
    for (int piece = 1; piece <= PIECES; piece++) {
        for (int k = 0; k < 2; k++)
            CHECK_OK(trajectory_to(tr[k], log[k], begin[k] + end_of(piece, early->epoch_length)));
        assert_int_equal(log[0]->count, log[1]->count);
        assert_memory_equal(log[0]->event, log[1]->event, log[0]->count * sizeof *log[0]->event);
        events += log[0]->count;
    }
    for (int k = 0; k < 2; k++) hd_trajectory_state(tr[k], state[k], state[k] + size / 2);
    assert_memory_equal(state[0], state[1], size * sizeof(double));
    assert_true(events > 20 * size / 4);
    for (int k = 0; k < 2; k++) {
        hd_event_log_free(log[k]);
        free(state[k]);
    }
}

/** The clock alone is set. */
TEST(a_state_goes_on_alike_at_any_time)
{
    const double shift[] = {LATE, ldexp(1.0, 40)}; /* 1e12, whose last digit is 2^-12 */
    for (int k = 0; k < 2 * SCENES; k++) {
        const hd_scene_def def = scene_number(k / 2);
        MADE(hd_trajectory, early, &def);
        MADE(hd_trajectory, late, &def);
        late->epoch_start = late->now = shift[k % 2];
        check_alike(early, late);
    }
}

/** Really run until then: what is read of the disks at the end of an epoch starts a trajectory that
 * is the same. */
TEST(a_late_state_goes_on_as_at_the_start)
{
    const double end = HD_SANITIZED ? LATE / 64.0 : LATE;
    hd_scene_def def = scene_number(0);
    double q[20], p[20];
    MADE(hd_trajectory, late, &def);
    CHECK_OK(hd_trajectory_extend(late, NULL, end));
    assert_true(fmod(end, late->epoch_length) == 0.0);
    assert_true(HD_SANITIZED || hd_trajectory_collisions(late) > 1000000);
    hd_trajectory_state(late, q, p);
    OWNED(hd_trajectory) *early = started(&def, q, p);
    check_alike(early, late);
}
