/** Trajectory of two disks over a full grid of impact parameter, angle, image and wall, against the
 * closed form in long double. */
#include "testing.h"
#include "interval.h"

/** The core moves coordinates of size L with a few roundings each; ten of them are never exceeded.
 */
static const double POSITION_ROUNDING = 10.0 * DBL_EPSILON;
/** Momenta are of size 1 and pass five operations. */
static const double MOMENTUM_ROUNDING = 16.0 * DBL_EPSILON;

static const double LX = 9.0, LY = 7.0;
static const double DISTANCE = 2.5;               /* of the centres at the start */
static const double DRIFT[2] = {0.3125, -0.1875}; /* of both disks */
enum { ANGLES = 24, IMPACTS = 41 };

typedef struct encounter {
    double q[4], p[4];
    int image[2];              /**< box edges to add to disk 1 */
    long double miss;          /**< impact parameter as it came out after rounding */
    long double time, n[2], b; /**< of the contact: its time, unit vector and p.n */
} encounter;

static long double dot(const long double a[2], const long double b[2])
{
    return a[0] * b[0] + a[1] * b[1];
}

/** Solves |r + p t| = 1 for the doubles that the core is given. */
static void closed_form(encounter *e)
{
    const long double box[2] = {LX, LY};
    long double r[2], p[2];
    for (int d = 0; d < 2; d++) {
        r[d] = (long double)e->q[2 + d] - e->q[d] + e->image[d] * box[d];
        p[d] = (long double)e->p[2 + d] - e->p[d];
    }
    const long double rp = dot(r, p), pp = dot(p, p);
    e->miss = fabsl(r[0] * p[1] - r[1] * p[0]) / sqrtl(pp);
    if (e->miss >= 1) return;
    e->b = -sqrtl(pp * (1 - e->miss * e->miss));
    e->time = (-rp + e->b) / pp;
    for (int d = 0; d < 2; d++) e->n[d] = r[d] + p[d] * e->time;
}

/** Disk 1 comes from `angle` with impact parameter b; it lies `image` boxes away from where disk 0
 * sees it, so the pair meets across that edge. */
static encounter encounter_at(double angle, double b, int mx, int my)
{
    const double u[2] = {cos(angle), sin(angle)}, box[2] = {LX, LY};
    const int image[2] = {mx, my};
    encounter e = {.image = {mx, my}};
    for (int d = 0; d < 2; d++) {
        const double side = d ? u[0] : -u[1]; /* u turned by 90 degrees */
        const double away = DISTANCE * u[d] + b * side;
        e.p[d] = DRIFT[d];
        e.p[2 + d] = DRIFT[d] - u[d];
        e.q[2 + d] = 0.5 * box[d] + 0.5 * away - 0.5 * image[d] * box[d];
        e.q[d] = e.q[2 + d] - away + image[d] * box[d];
        for (int k = d; k < 4; k += 2) e.q[k] -= floor(e.q[k] / box[d]) * box[d];
        e.image[d] = (int)round((away - (e.q[2 + d] - e.q[d])) / box[d]);
    }
    closed_form(&e);
    return e;
}

static void check_outcome(const encounter *e, const double after[4])
{
    const long double n[2] = {e->n[0], e->n[1]};
    long double before_rel[2], after_rel[2], energy = 0;
    for (int d = 0; d < 2; d++) {
        before_rel[d] = (long double)e->p[2 + d] - e->p[d];
        after_rel[d] = (long double)after[2 + d] - after[d];
        CHECK_CLOSE(after[d] + after[2 + d], e->p[d] + e->p[2 + d], MOMENTUM_ROUNDING);
    }
    for (int k = 0; k < 4; k++) energy += (long double)after[k] * after[k] - e->p[k] * e->p[k];
    CHECK_CLOSE((double)energy, 0.0, 2.0 * MOMENTUM_ROUNDING);
    /* a late contact turns n by the error of the time: the closer to grazing, the more */
    const double n_error = POSITION_ROUNDING * LX / (double)-e->b;
    CHECK_CLOSE((double)(dot(after_rel, n) + dot(before_rel, n)), 0.0,
                4.0 * n_error + MOMENTUM_ROUNDING);
    for (int d = 0; d < 2; d++) {
        CHECK_CLOSE(after[d], (double)(e->p[d] + e->b * n[d]), 4.0 * n_error + MOMENTUM_ROUNDING);
        CHECK_CLOSE(after[2 + d], (double)(e->p[2 + d] - e->b * n[d]),
                    4.0 * n_error + MOMENTUM_ROUNDING);
    }
}

static void check_event(const encounter *e, const hd_event *event)
{
    const double n_error = POSITION_ROUNDING * LX / (double)-e->b;
    assert_int_equal(event->i, 0);
    assert_int_equal(event->j, 1);
    CHECK_CLOSE(event->t, (double)e->time, n_error);
    for (int d = 0; d < 2; d++) {
        CHECK_CLOSE(event->n[d], (double)e->n[d], 2.0 * n_error);
        assert_true(event->p[d] == e->p[2 + d] - e->p[d]);
    }
}

/** Long enough to pass, too short to come round the box. */
static const double PASSAGE = 3.5;

static void check_encounter(const encounter *e)
{
    const hd_scene_def def = scene_in_box(2, LX, LY, P, P, 1);
    OWNED(hd_trajectory) *tr = NULL;
    double after[4], box[2];
    OWNED(hd_event_log) *log = new_log();
    CHECK_OK(hd_trajectory_create_from(&tr, &def, e->q, e->p));
    hd_trajectory_box(tr, box);
    CHECK_CLOSE(box[0], LX, 2.0 * DBL_EPSILON * LX); /* sqrt of a rounded density */
    CHECK_OK(trajectory_to(tr, log, PASSAGE));
    hd_trajectory_state(tr, NULL, after);
    const int meets = e->miss < 1;
    if ((int)log->count != meets)
        fail_msg("miss %.17Lg image %d %d: %zu events", e->miss, e->image[0], e->image[1],
                 log->count);
    if (meets) {
        check_event(e, &log->event[0]);
        check_outcome(e, after);
    }
}

TEST(every_impact_angle_and_image)
{
    int hits = 0, misses = 0;
    for (int a = 0; a < ANGLES; a++)
        for (int k = 0; k < IMPACTS; k++)
            for (int m = 0; m < 9; m++) {
                /* offset so that no line is drawn exactly through a grazing one */
                const double b = -1.2 + 2.4 * (k + 0.01) / (IMPACTS - 1);
                const encounter e = encounter_at(2.0 * PI * (a + 0.1) / ANGLES, b, m % 3 - 1,
                                                 m / 3 - 1);
                check_encounter(&e);
                hits += e.miss < 1;
                misses += e.miss >= 1;
            }
    assert_true(hits > 7000 && misses > 1000);
}

/** 1 - b from 1e-1 down to where rounding decides. */
TEST(grazing)
{
    for (double gap = 0.1; gap > 1e3 * DBL_EPSILON * LX; gap *= 0.3)
        for (int a = 0; a < ANGLES; a++)
            for (int side = -1; side <= 1; side += 2) {
                const double angle = 2.0 * PI * (a + 0.1) / ANGLES;
                const encounter hit = encounter_at(angle, side * (1.0 - gap), 0, 0);
                const encounter miss = encounter_at(angle, side * (1.0 + gap), 1, 0);
                assert_true(hit.miss < 1 && miss.miss > 1);
                check_encounter(&hit);
                check_encounter(&miss);
            }
}

/** One disk against each wall from every angle; the other one rests far away. */
static void check_wall(const hd_scene_def *def, int direction, int high, double angle)
{
    const double box[2] = {LX, LY}, sign = high ? 1.0 : -1.0;
    const int across = 1 - direction;
    double q[4] = {0.5 * LX, 0.5 * LY, 0, 0}, p[4] = {0, 0, 0, 0}, after[4];
    OWNED(hd_trajectory) *tr = NULL;
    q[2 + direction] = high ? 1.0 : box[direction] - 1.0; /* behind */
    q[2 + across] = 1.0;
    p[direction] = sign * cos(angle);
    p[across] = sin(angle);
    const long double reach = 0.5L * box[direction] - 0.5L,
                      t = reach / fabsl((long double)p[direction]);
    OWNED(hd_event_log) *log = new_log();
    CHECK_OK(hd_trajectory_create_from(&tr, def, q, p));
    CHECK_OK(trajectory_to(tr, log, (double)t * 1.01));
    hd_trajectory_state(tr, NULL, after);
    assert_int_equal(log->count, 1);
    const hd_event *event = &log->event[0];
    CHECK_CLOSE(event->t, (double)t, POSITION_ROUNDING * (double)(LX * t / reach));
    assert_int_equal(event->i, 0);
    assert_int_equal(event->j, direction ? HD_WALL_Y : HD_WALL_X);
    assert_true(event->n[direction] == 1.0 && event->n[across] == 0.0);
    assert_true(event->p[0] == p[0] && event->p[1] == p[1]);
    assert_true(after[direction] == -p[direction] && after[across] == p[across]);
}

TEST(every_wall_and_angle)
{
    enum { WALL_ANGLES = 50 };
    const hd_scene_def def = scene_in_box(2, LX, LY, R, R, 1);
    for (int wall = 0; wall < 4; wall++)
        for (int a = -WALL_ANGLES; a <= WALL_ANGLES; a++)
            check_wall(&def, wall / 2, wall % 2, 0.6 * a / WALL_ANGLES);
}

/** Between walls a pair never meets through an image: both close to opposite walls, moving
 * outwards. */
TEST(no_image_through_a_wall)
{
    const hd_scene_def def = scene_in_box(2, LX, LY, R, P, 1);
    const double q[] = {0.75, 3.0, LX - 0.75, 3.0}, p[] = {-1, 0, 1, 0};
    OWNED(hd_trajectory) *tr = NULL;
    CHECK_OK(hd_trajectory_create_from(&tr, &def, q, p));
    CHECK_OK(hd_trajectory_extend(tr, NULL, 1.0));
    assert_true(hd_trajectory_collisions(tr) == 0);
    assert_true(hd_trajectory_wall_events(tr) == 2);
}
