/** Many events at one instant: perfect lattices with symmetric momenta, clusters that touch, disks
 * in corners, contacts at the very end of an interval or of an epoch and while a cell's edge is
 * crossed. None is lost, none is repeated for ever, energy and momentum stay, and the log is the
 * same however it is cut. */
#include "bodies.h"
#include "prepared.h"
#include "base/random.h"
#include "twin.h"

/* ---- however it is cut --------------------------------------------------------------------- */

static void check_same_events(const hd_record *got, const hd_record *want)
{
    assert_int_equal(got->count, want->count);
    for (size_t k = 0; k < got->count; k++) {
        const hd_event *a = &events_in(got)[k], *b = &events_in(want)[k];
        assert_true(a->i == b->i && a->j == b->j);
        assert_memory_equal(a->n, b->n, sizeof a->n);
        assert_memory_equal(a->p, b->p, sizeof a->p);
        CHECK_CLOSE(a->t, b->t, 2.0 * DBL_EPSILON * want->duration);
    }
}

/** Just before, at and just after each of the instants in the log. */
static void check_cut_at_events(const hd_scene_def *def, const double *q, const double *p,
                                const hd_record *whole)
{
    OWNED(hd_trajectory) *tr = started(def, q, p);
    OWNED(hd_record) *log = new_log();
    for (size_t k = 0; k < whole->count; k++) {
        const double t = events_in(whole)[k].t;
        if (k > 0 && t == events_in(whole)[k - 1].t) continue;
        const double cut[] = {nextafter(t, 0.0), t, nextafter(t, INFINITY)};
        for (int c = 0; c < 3; c++)
            if (cut[c] >= hd_trajectory_time(tr)) CHECK_OK(hd_trajectory_extend(tr, log, cut[c]));
    }
    CHECK_OK(hd_trajectory_extend(tr, log, whole->duration));
    check_same_events(log, whole);
}

/** Largest number of events of one instant; times of one instant are the same bits. */
static long most_at_once(const hd_record *log)
{
    long most = 0, now = 0;
    for (size_t k = 0; k < log->count; k++) {
        now = k > 0 && events_in(log)[k].t == events_in(log)[k - 1].t ? now + 1 : 1;
        if (now > most) most = now;
    }
    return most;
}

enum { SIDE = 6, DISKS = SIDE * SIDE };

/** Ends, keeps energy and momentum, repeats, and is the twin's; returns most_at_once. A collision's
 * rounding is a few eps of the momenta. */
static long check_all(const hd_scene_def *def, const double *q, const double *p, double t_end)
{
    OWNED(hd_trajectory) *tr = started(def, q, p);
    const double energy = hd_trajectory_examined(tr).kinetic_energy;
    double after[2 * DISKS], sum[2] = {0, 0};
    CHECK_OK(hd_trajectory_extend(tr, NULL, t_end)); /* without a log: for ever would fill memory */
    const double events = (double)(hd_trajectory_totals(tr).collisions +
                                   hd_trajectory_totals(tr).wall_events);
    const double rounding = 8.0 * DBL_EPSILON * energy * events;
    CHECK_CLOSE(hd_trajectory_examined(tr).kinetic_energy, energy, rounding);
    hd_trajectory_state(tr, NULL, after);
    for (int k = 0; k < 2 * def->number; k++) sum[k % 2] += after[k] - p[k];
    for (int d = 0; d < 2; d++)
        if (def->boundary[d] == P) CHECK_CLOSE(sum[d], 0.0, rounding);
    OWNED(hd_record) *log = log_of(def, q, p, t_end), *again = log_of(def, q, p, t_end);
    assert_true(events > 0 && (double)log->count == events && log->count == again->count);
    assert_memory_equal(events_in(log), events_in(again), log->count * sizeof(hd_event));
    check_cut_at_events(def, q, p, log);
    twin_compare(started(def, q, p), def, log->count / 2);
    return most_at_once(log);
}

/* ---- lattices ------------------------------------------------------------------------------ */

/** Momentum of the disk in column x, row y. */
typedef void (*momentum_of)(double p[2], int x, int y);

static void alternate_rows(double p[2], int x, int y)
{
    (void)x;
    p[0] = y % 2 ? -1.0 : 1.0;
    p[1] = y % 2 ? -0.5 : 0.5;
}

static void three_directions(double p[2], int x, int y)
{
    const double angle = 2.0 * PI / 3.0 * ((x + y) % 3);
    p[0] = cos(angle);
    p[1] = sin(angle);
}

static void one_against_all(double p[2], int x, int y)
{
    p[0] = x == 0 && y == 0 ? 4.0 : 0.0;
    p[1] = 0.0;
}

static void head_on_along_x(double p[2], int x, int y)
{
    (void)y;
    p[0] = x % 2 ? -1.0 : 1.0;
    p[1] = 0.0;
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

/** Rows that are `row` apart, every other one shifted by `shift` of the spacing. `margin` is what
 * the box has to spare: without, disks that all touch could never move. */
static void check_lattice(double spacing, double row, double shift, double margin,
                          hd_boundary boundary, momentum_of momentum)
{
    const double lx = boundary == P ? SIDE * spacing : (SIDE - 1 + shift) * spacing + 1.0;
    const double ly = boundary == P ? SIDE * row : (SIDE - 1) * row + 1.0;
    const hd_scene_def def = scene_in_box(DISKS, lx + margin, ly + margin, boundary, boundary, 1);
    double q[2 * DISKS], p[2 * DISKS];
    for (int k = 0; k < DISKS; k++) {
        const int x = k % SIDE, y = k / SIDE;
        q[2 * k] = 0.5 + spacing * (x + shift * (y % 2)) + 0.25 * margin;
        q[2 * k + 1] = 0.5 + row * y + 0.25 * margin;
        momentum(&p[2 * k], x, y);
    }
    check_all(&def, q, p, fmin(2.0, 20.0 * (spacing - 1.0 + margin)));
}

TEST(triangular_lattices)
{
    const struct {
        double spacing, margin;
    } tight[] = {{1.25, 1e-12}, {1.0 + 1e-6, 1e-12}, {1.0 + 1e-10, 1e-12}, {1.0, 1.0}};
    const momentum_of momenta[] = {alternate_rows, three_directions, one_against_all};
    for (int k = 0; k < 4 * 2 * 3; k++) {
        const double spacing = tight[k / 6].spacing;
        check_lattice(spacing, sqrt(0.75) * spacing, 0.5, tight[k / 6].margin, (hd_boundary)(k & 1),
                      momenta[k / 2 % 3]);
    }
}

/** Dyadic spacing 1.5, so that equal times are equal bits. */
TEST(square_lattices)
{
    const momentum_of momenta[] = {head_on_along_x, alternate_rows, checkerboard, into_quadrants};
    for (int k = 0; k < 4 * 2; k++)
        check_lattice(1.5, 1.5, 0.0, k & 1 ? 0.5 : 0.0, (hd_boundary)(k & 1), momenta[k / 2]);
}

/** Touching rows: Newton's cradle along y in every column, closed through the edge; for epochs
 * nothing moves along x. */
TEST(touching_columns)
{
    const hd_scene_def def = scene_in_box(32, 6.0, 10.0, P, P, 1);
    double q[64], p[64] = {0};
    for (int k = 0; k < 32; k++) {
        q[2 * k] = 1.5 * (k / 8) + 0.25;
        q[2 * k + 1] = 0.5 + k % 8;
        p[2 * k + 1] = k % 8 == 0 ? 1.0 : 0.0;
    }
    check_all(&def, q, p, 200.0);
    twin_compare(started(&def, q, p), &def, 4000);
}

/* ---- clusters that touch ------------------------------------------------------------------- */

/** A disk and its six neighbours, all touching, turned; momenta all inwards, or on a coarse grid:
 * many vanish, many are equal. */
static void cluster(double turn, int inwards, hd_random *random, double q[14], double p[14])
{
    q[0] = q[1] = 4.0;
    p[0] = p[1] = 0.0;
    for (int k = 1; k < 7; k++) {
        const double angle = turn + PI / 3.0 * k, u[2] = {cos(angle), sin(angle)};
        for (int d = 0; d < 2; d++) {
            q[2 * k + d] = q[d] + u[d];
            p[2 * k + d] = inwards ? -u[d] : rint(2.0 * hd_random_symmetric(random));
        }
    }
}

TEST(touching_clusters_come_apart)
{
    const int rounds = HD_SANITIZED ? 200 : second_tier() ? 4000 : 1000;
    hd_random random = hd_random_seeded(11, 0);
    long most = 0;
    for (int round = 0; round < rounds; round++) {
        const hd_boundary boundary = round % 2 ? R : P;
        const hd_scene_def def = scene_in_box(7, 8.0, 8.0, boundary, boundary, 1);
        double q[14], p[14];
        cluster(round % 8 ? hd_random_symmetric(&random) : 0.0, round % 4 < 2, &random, q, p);
        const long now = check_all(&def, q, p, 6.0);
        if (now > most) most = now;
    }
    assert_true(most >= 6 && most <= 7 * 7);
}

/** A wedge: a disk that touches two others, which touch two walls and their corner. */
TEST(a_wedge_in_a_corner_comes_apart)
{
    const hd_scene_def def = scene_in_box(4, 8.0, 8.0, R, R, 1);
    const double q[] = {0.5, 0.5, 1.5, 0.5, 0.5, 1.5, 1.5, 1.5};
    const double p[][8] = {{0, 0, 0, 0, 0, 0, -1, -1},      {-1, -1, -1, -1, -1, -1, -1, -1},
                           {-1, 0, -1, 0, -1, 0, -1, 0},    {0, 0, -1, 0, 0, -1, -1, -1},
                           {1, 1, -1, 0, 0, -1, -1, -1},    {-3, 1, -1, 1, 1, -1, -1, -0.5},
                           {0, 0, 0, -1, -1, 0, -1, -1e-9}, {0, 0, 1e-12, -1, -1, 1e-12, -1, -1}};
    for (size_t k = 0; k < sizeof p / sizeof *p; k++) {
        const long most = check_all(&def, q, p[k], 20.0);
        assert_true(most <= 4 * 6);
    }
}

/* ---- ends of epochs and edges of cells ----------------------------------------------------- */

static double epoch_of(const hd_scene_def *def, const double *q, const double *p)
{
    OWNED(hd_trajectory) *tr = started(def, q, p);
    return hard_in(tr)->epoch_length;
}

/** Each in just one of the two intervals, whichever the cut: that which begins there. */
static void check_at(const hd_scene_def *def, const double *q, const double *p, double t,
                     size_t events)
{
    for (int side = -1; side <= 1; side++) {
        const double cut = side < 0 ? nextafter(t, 0.0) : side > 0 ? nextafter(t, INFINITY) : t;
        OWNED(hd_trajectory) *tr = started(def, q, p);
        OWNED(hd_record) *log = new_log();
        CHECK_OK(trajectory_to(tr, log, cut));
        assert_int_equal(log->count, side > 0 ? events : 0);
        CHECK_OK(trajectory_to(tr, log, t + 0.25));
        assert_int_equal(log->count, side > 0 ? 0 : events);
        for (size_t k = 0; k < log->count; k++) assert_true(events_in(log)[k].t == t - cut);
    }
    check_all(def, q, p, 4.0 * t);
}

/** A contact, two walls and a corner, all at the middle of the first epoch, and at the very end of
 * the first, the second and the fourth. */
TEST(events_at_the_end_of_an_epoch)
{
    const hd_scene_def def = scene_in_box(4, 8.0, 8.0, R, R, 1);
    const double q[] = {3.0, 4.0, 5.0, 4.0, 1.0, 1.0, 1.0, 7.0}, rest[8] = {0};
    const double epoch = epoch_of(&def, q, rest);
    for (double t = 0.5 * epoch; t <= 4.0 * epoch; t *= 2.0) {
        const double v = 0.5 / t; /* half a diameter until then; powers of two: exact */
        const double p[] = {v, 0, -v, 0, -v, -v, -v, 0};
        check_at(&def, q, p, t, 4);
    }
}

/** Two disks cross an edge of cells, or the point where four meet, from both sides at the moment at
 * which they touch; ten others wait above and below, two of them on an edge. */
static void start_at(const double at[2], const double way[2], double side, double q[24],
                     double p[24])
{
    const double length = hypot(way[0], way[1]);
    for (int k = 2; k < 12; k++) {
        q[2 * k] = k == 2 ? 6.0 : 1.2 + 2.4 * (k % 5);
        q[2 * k + 1] = k < 7 ? 0.75 : 11.25;
        p[2 * k] = 0.0;
        p[2 * k + 1] = k == 2 ? 1.0 : 0.0;
    }
    for (int d = 0; d < 2; d++) { /* the first one's centre is on the edge at t = 1 */
        q[d] = at[d] - way[d] * side;
        q[2 + d] = at[d] + way[d] * side * (1.0 + 1.0 / length);
        p[d] = way[d] * side;
        p[2 + d] = -way[d] * side;
    }
}

TEST(contacts_on_cell_edges)
{
    const hd_scene_def def = scene_in_box(12, 12.0, 12.0, P, P, 1);
    const double way[][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}, {0.5, 1}};
    hd_cells cells;
    CHECK_OK(hd_cells_create(&cells, &def, 1.0));
    assert_true(cells.size[0] >= 4 && cells.size[1] >= 4);
    const double at[] = {cells.line[0][2].bound[0], cells.line[1][2].bound[0]};
    hd_cells_clear(&cells);
    for (int k = 0; k < 5 * 2; k++) {
        double q[24], p[24];
        start_at(at, way[k / 2], k % 2 ? 1.0 : -1.0, q, p);
        check_all(&def, q, p, 40.0);
    }
}

/* ---- few disks ----------------------------------------------------------------------------- */

/** Two disks hit a resting third from both sides at the same instant, along x and obliquely. */
TEST(three_meet_at_once)
{
    const double start[][2] = {{3.0, 0.0}, {0.0, 2.5}, {2.0, 2.0}, {3.0, 0.5}};
    const hd_boundary both[] = {P, R};
    for (size_t k = 0; k < 4 * 2; k++) {
        const double *from = start[k / 2];
        const hd_scene_def def = scene_in_box(3, 12.0, 8.0, both[k % 2], both[k % 2], 1);
        const double q[] = {6.0 - from[0], 4.0 - from[1], 6.0, 4.0, 6.0 + from[0], 4.0 + from[1]};
        const double p[] = {from[0], from[1], 0.0, 0.0, -from[0], -from[1]};
        check_all(&def, q, p, 30.0);
    }
}

/** A mirror pair behind a third: contacts (0, 2) and (1, 2) at the same instant, (0, 2) is first.
 */
TEST(ties_go_by_index)
{
    const hd_scene_def def = scene_in_box(3, 16.0, 8.0, P, P, 1);
    const double q[] = {4.0, 3.25, 4.0, 4.75, 8.0, 4.0}, p[] = {1, 0, 1, 0, -1, 0};
    OWNED(hd_record) *log = log_of(&def, q, p, 2.0);
    assert_true(log->count >= 2);
    assert_true(events_in(log)[0].t == events_in(log)[1].t);
    CHECK_CLOSE(events_in(log)[0].i, 0, 0.0);
    CHECK_CLOSE(events_in(log)[1].i, 1, 0.0);
    CHECK_CLOSE(events_in(log)[0].j, 2, 0.0);
    CHECK_CLOSE(events_in(log)[1].j, 2, 0.0);
}

/** Into a corner along the diagonal: both walls at once, out again the way it came. */
TEST(disk_in_a_corner)
{
    const double sign[][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    const hd_scene_def def = scene_in_box(2, 8.0, 8.0, R, R, 1);
    for (int k = 0; k < 4; k++) {
        const double q[] = {4.0 + 2.5 * sign[k][0], 4.0 + 2.5 * sign[k][1], 4.0, 4.0};
        const double p[] = {sign[k][0], sign[k][1], 0.0, 0.0};
        double after[4];
        OWNED(hd_trajectory) *tr = started(&def, q, p);
        OWNED(hd_record) *log = new_log();
        CHECK_OK(trajectory_to(tr, log, 1.5));
        hd_trajectory_state(tr, NULL, after);
        assert_int_equal(log->count, 2);
        CHECK_CLOSE(events_in(log)[0].j, HD_WALL_X, 0.0);
        CHECK_CLOSE(events_in(log)[1].j, HD_WALL_Y, 0.0);
        assert_true(events_in(log)[0].t == 1.0 && events_in(log)[1].t == 1.0);
        assert_true(after[0] == -p[0] && after[1] == -p[1]);
        check_all(&def, q, p, 80.0);
    }
}

/** A pair contact and a wall at the same instant: the pair is first. */
TEST(pair_goes_before_wall)
{
    const hd_scene_def def = scene_in_box(3, 8.0, 8.0, R, R, 1);
    const double q[] = {1.5, 2.0, 4.0, 4.0, 7.0, 4.0}, p[] = {-1, 0, 1, 0, -1, 0};
    OWNED(hd_record) *log = log_of(&def, q, p, 1.5);
    assert_int_equal(log->count, 2);
    assert_true(events_in(log)[0].t == 1.0 && events_in(log)[1].t == 1.0);
    CHECK_CLOSE(events_in(log)[0].i, 1, 0.0);
    CHECK_CLOSE(events_in(log)[0].j, 2, 0.0);
    CHECK_CLOSE(events_in(log)[1].j, HD_WALL_X, 0.0);
    check_all(&def, q, p, 40.0);
}
