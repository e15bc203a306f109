/** Trajectory when many events fall on the same instant: perfect lattices with symmetric momenta,
 * three disks that meet at once, disks in corners. Ends, conserves, and gives the same log each
 * time. */
#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "scenes.h"
#include "testing.h"
#include "twin.h"
#include "interval.h"

enum { SIDE = 6, DISKS = SIDE * SIDE, EVENTS = 4000 };

/** Rounding of one collision is a few eps of the momenta; EVENTS of them at most add up. */
static const double CONSERVED = 4.0 * EVENTS * DBL_EPSILON;

static double energy_of(const double *p, int n)
{
    double twice = 0;
    for (int k = 0; k < 2 * n; k++) twice += p[k] * p[k];
    return 0.5 * twice;
}

static hd_trajectory *started(const hd_scene_def *def, const double *q, const double *p)
{
    hd_trajectory *tr = NULL;
    CHECK_OK(hd_trajectory_create_from(&tr, def, q, p));
    return tr;
}

static void check_conserved(const hd_scene_def *def, const double *q, const double *p, double t_end)
{
    double after[2 * DISKS], sum[2] = {0, 0};
    hd_trajectory *tr = started(def, q, p);
    CHECK_OK(hd_trajectory_extend(tr, NULL, t_end));
    hd_trajectory_state(tr, NULL, after);
    const double energy = energy_of(p, def->disks);
    CHECK_CLOSE(energy_of(after, def->disks), energy, CONSERVED * energy);
    for (int k = 0; k < 2 * def->disks; k++) sum[k % 2] += after[k] - p[k];
    for (int d = 0; d < 2; d++)
        if (def->boundary[d] == HD_PERIODIC) CHECK_CLOSE(sum[d], 0.0, CONSERVED * energy);
    assert_true(hd_trajectory_collisions(tr) > 0);
    hd_trajectory_free(tr);
}

static void check_repeats(const hd_scene_def *def, const double *q, const double *p, double t_end)
{
    hd_event_log *log[2];
    for (int k = 0; k < 2; k++) {
        hd_trajectory *tr = started(def, q, p);
        CHECK_OK(hd_event_log_create(&log[k]));
        CHECK_OK(trajectory_to(tr, log[k], t_end));
        hd_trajectory_free(tr);
    }
    assert_int_equal(log[0]->count, log[1]->count);
    assert_memory_equal(log[0]->event, log[1]->event, log[0]->count * sizeof *log[0]->event);
    hd_event_log_free(log[0]);
    hd_event_log_free(log[1]);
}

static void check_all(const hd_scene_def *def, const double *q, const double *p, double t_end)
{
    check_conserved(def, q, p, t_end);
    check_repeats(def, q, p, t_end);
    twin_compare(started(def, q, p), def, EVENTS);
}

/* ---- perfect lattices ---------------------------------------------------------------------- */

/** Momentum of the disk in column x, row y. */
typedef void (*momentum_of)(double p[2], int x, int y);

static void head_on_along_x(double p[2], int x, int y)
{
    (void)y;
    p[0] = x % 2 ? -1.0 : 1.0;
    p[1] = 0.0;
}

static void rows_against_each_other(double p[2], int x, int y)
{
    (void)x;
    p[0] = y % 2 ? -1.0 : 1.0;
    p[1] = y % 2 ? -0.5 : 0.5;
}

static void checkerboard(double p[2], int x, int y)
{
    p[0] = (x + y) % 2 ? -1.0 : 1.0;
    p[1] = (x + y) % 2 ? 0.25 : -0.25;
}

static void into_quadrants(double p[2], int x, int y)
{
    p[0] = x < SIDE / 2 ? 1.0 : -1.0;
    p[1] = y < SIDE / 2 ? 1.0 : -1.0;
}

/** Dyadic spacing 1.5, so that equal times are equal bits. */
static void square_lattice(hd_boundary boundary, momentum_of momentum)
{
    const double spacing = 1.5;
    const hd_scene_def def = scene_in_box(DISKS, spacing * SIDE, spacing * SIDE, boundary, boundary,
                                          1);
    double q[2 * DISKS], p[2 * DISKS];
    for (int k = 0; k < DISKS; k++) {
        q[2 * k] = spacing * (0.5 + k % SIDE);
        q[2 * k + 1] = spacing * (0.5 + k / SIDE);
        momentum(&p[2 * k], k % SIDE, k / SIDE);
    }
    check_all(&def, q, p, 5.0);
}

TEST(square_lattices)
{
    const momentum_of momenta[] = {head_on_along_x, rows_against_each_other, checkerboard,
                                   into_quadrants};
    for (size_t k = 0; k < sizeof momenta / sizeof *momenta; k++) {
        square_lattice(HD_PERIODIC, momenta[k]);
        square_lattice(HD_REFLECTING, momenta[k]);
    }
}

/** Touching rows: Newton's cradle along y in every column, closed through the edge. */
TEST(touching_columns)
{
    enum { COLUMNS = 4, ROWS = 8, N = COLUMNS * ROWS };
    const hd_scene_def def = scene_in_box(N, 6.0, 10.0, HD_PERIODIC, HD_PERIODIC, 1);
    double q[2 * N], p[2 * N];
    for (int k = 0; k < N; k++) {
        q[2 * k] = 1.5 * (k / ROWS) + 0.25;
        q[2 * k + 1] = 0.5 + k % ROWS;
        p[2 * k] = 0.0;
        p[2 * k + 1] = k % ROWS == 0 ? 1.0 : 0.0;
    }
    check_all(&def, q, p, 200.0);
}

/* ---- few disks ----------------------------------------------------------------------------- */

/** Two disks hit a resting third from both sides at the same instant, along x and obliquely. */
TEST(three_meet_at_once)
{
    const double start[][2] = {{3.0, 0.0}, {0.0, 2.5}, {2.0, 2.0}, {3.0, 0.5}};
    const hd_boundary both[] = {HD_PERIODIC, HD_REFLECTING};
    for (size_t k = 0; k < 4 * 2; k++) {
        const double *from = start[k / 2];
        const hd_scene_def def = scene_in_box(3, 12.0, 8.0, both[k % 2], both[k % 2], 1);
        const double q[] = {6.0 - from[0], 4.0 - from[1], 6.0, 4.0, 6.0 + from[0], 4.0 + from[1]};
        const double p[] = {from[0], from[1], 0.0, 0.0, -from[0], -from[1]};
        check_conserved(&def, q, p, 30.0);
        check_repeats(&def, q, p, 30.0);
        twin_compare(started(&def, q, p), &def, 20);
    }
}

/** A mirror pair behind a third: contacts (0, 2) and (1, 2) at the same instant, (0, 2) is first.
 */
TEST(ties_go_by_index)
{
    const hd_scene_def def = scene_in_box(3, 16.0, 8.0, HD_PERIODIC, HD_PERIODIC, 1);
    const double q[] = {4.0, 3.25, 4.0, 4.75, 8.0, 4.0}, p[] = {1, 0, 1, 0, -1, 0};
    hd_trajectory *tr = started(&def, q, p);
    hd_event_log *log;
    CHECK_OK(hd_event_log_create(&log));
    CHECK_OK(trajectory_to(tr, log, 2.0));
    assert_true(log->count >= 2);
    assert_true(log->event[0].t == log->event[1].t);
    assert_int_equal(log->event[0].i, 0);
    assert_int_equal(log->event[1].i, 1);
    assert_int_equal(log->event[0].j, 2);
    assert_int_equal(log->event[1].j, 2);
    hd_event_log_free(log);
    hd_trajectory_free(tr);
}

/** Into a corner along the diagonal: both walls at once, out again the way it came. */
TEST(disk_in_a_corner)
{
    const double sign[][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    const hd_scene_def def = scene_in_box(2, 8.0, 8.0, HD_REFLECTING, HD_REFLECTING, 1);
    for (int k = 0; k < 4; k++) {
        const double q[] = {4.0 + 2.5 * sign[k][0], 4.0 + 2.5 * sign[k][1], 4.0, 4.0};
        const double p[] = {sign[k][0], sign[k][1], 0.0, 0.0};
        double after[4];
        hd_event_log *log;
        hd_trajectory *tr = started(&def, q, p);
        CHECK_OK(hd_event_log_create(&log));
        CHECK_OK(trajectory_to(tr, log, 1.5));
        hd_trajectory_state(tr, NULL, after);
        assert_int_equal(log->count, 2);
        assert_int_equal(log->event[0].j, HD_WALL_X);
        assert_int_equal(log->event[1].j, HD_WALL_Y);
        assert_true(log->event[0].t == 1.0 && log->event[1].t == 1.0);
        assert_true(after[0] == -p[0] && after[1] == -p[1]);
        hd_event_log_free(log);
        hd_trajectory_free(tr);
        check_conserved(&def, q, p, 40.0);
        twin_compare(started(&def, q, p), &def, 100);
    }
}

/** A pair contact and a wall at the same instant: the pair is first. */
TEST(pair_goes_before_wall)
{
    const hd_scene_def def = scene_in_box(3, 8.0, 8.0, HD_REFLECTING, HD_REFLECTING, 1);
    const double q[] = {1.5, 2.0, 4.0, 4.0, 7.0, 4.0}, p[] = {-1, 0, 1, 0, -1, 0};
    hd_event_log *log;
    hd_trajectory *tr = started(&def, q, p);
    CHECK_OK(hd_event_log_create(&log));
    CHECK_OK(trajectory_to(tr, log, 1.5));
    assert_int_equal(log->count, 2);
    assert_true(log->event[0].t == 1.0 && log->event[1].t == 1.0);
    assert_int_equal(log->event[0].i, 1);
    assert_int_equal(log->event[0].j, 2);
    assert_int_equal(log->event[1].j, HD_WALL_X);
    hd_event_log_free(log);
    hd_trajectory_free(tr);
    twin_compare(started(&def, q, p), &def, 30);
}

/** Half a narrow box apart: contact through two images at the same instant. */
TEST(two_images_at_once)
{
    const hd_scene_def def = scene_in_box(2, 6.0, 1.5, HD_PERIODIC, HD_PERIODIC, 1);
    const double q[] = {1.0, 0.25, 4.0, 1.0}, p[] = {1, 0, -1, 0};
    check_conserved(&def, q, p, 50.0);
    check_repeats(&def, q, p, 50.0);
    twin_compare(started(&def, q, p), &def, 4);
}

/** The edge of a cell in x and a wall in y at the same instant: cells leave no trace in the order.
 */
TEST(wall_at_a_cell_edge)
{
    const hd_scene_def def = scene_in_box(3, 8.0, 8.0, HD_REFLECTING, HD_REFLECTING, 1);
    const double q[] = {3.0, 6.5, 6.0, 6.5, 2.0, 2.0}, p[] = {1, 1, 0, 1, 0, 0};
    twin_compare(started(&def, q, p), &def, 2);
}

/** What only a broken state can show: it is named. */
TEST(a_broken_state_is_refused)
{
    hd_scene_def def = scene_in_box(2, 8.0, 8.0, HD_PERIODIC, HD_PERIODIC, 1);
    const double q[] = {2.0, 2.0, 2.5, 2.0}, p[] = {1, 0, -1, 0}, fast[] = {1e7, 0, 0, 0};
    const double apart[] = {2.0, 2.0, 5.0, 2.0};
    hd_trajectory *tr;
    assert_int_equal(hd_trajectory_create_from(&tr, &def, q, p), HD_OVERLAP);
    assert_int_equal(hd_trajectory_create_from(&tr, &def, apart, fast), HD_REFUSED);
    def.density = 0.0;
    assert_int_equal(hd_trajectory_create_from(&tr, &def, apart, p), HD_REFUSED);
}
