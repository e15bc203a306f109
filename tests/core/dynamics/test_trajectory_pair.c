/** Trajectory of two disks or spheres over a full grid of impact parameter, direction, image and
 * wall, against the closed form in long double. */
#include "bodies.h"
#include "draw.h"
#include "prepared.h"

/** The core moves coordinates of size L with a few roundings each; ten of them are never exceeded.
 */
static const double POSITION_ROUNDING = 10.0 * DBL_EPSILON;
/** Momenta are of size 1 and pass five operations. */
static const double MOMENTUM_ROUNDING = 16.0 * DBL_EPSILON;

static const double BOX[3] = {9.0, 7.0, 8.0};
static const double DISTANCE = 2.5;                     /* of the centres at the start */
static const double DRIFT[3] = {0.3125, -0.1875, 0.25}; /* of both */
enum { DIRECTIONS = 24, IMPACTS = 41, IMAGES = DIM == 2 ? 9 : 27 };

typedef struct encounter {
    double q[2 * DIM], p[2 * DIM];
    int image[DIM];              /**< box edges to add to disk 1 */
    long double miss;            /**< impact parameter as it came out after rounding */
    long double time, n[DIM], b; /**< of the contact: its time, unit vector and p.n */
} encounter;

static long double dot(const long double *a, const long double *b)
{
    long double sum = 0;
    for (int d = 0; d < DIM; d++) sum += a[d] * b[d];
    return sum;
}

/** Solves |r + p t| = 1 for the doubles that the core is given. */
static void closed_form(encounter *e)
{
    long double r[DIM], p[DIM];
    for (int d = 0; d < DIM; d++) {
        r[d] = (long double)e->q[DIM + d] - e->q[d] + e->image[d] * (long double)BOX[d];
        p[d] = (long double)e->p[DIM + d] - e->p[d];
    }
    const long double rp = dot(r, p), pp = dot(p, p);
    e->miss = sqrtl(fmaxl(0, dot(r, r) - rp * rp / pp));
    if (e->miss >= 1) return;
    e->b = -sqrtl(pp * (1 - e->miss * e->miss));
    e->time = (-rp + e->b) / pp;
    for (int d = 0; d < DIM; d++) e->n[d] = r[d] + p[d] * e->time;
}

/** Disk 1 comes along the direction of that number with impact parameter b; it lies some image away
 * from where disk 0 sees it, so the pair meets across that edge. */
static encounter encounter_at(int direction, double b, int image)
{
    hd_random random = hd_random_seeded(7, (uint64_t)direction);
    encounter e = {.miss = 0};
    double u[DIM], side[DIM];
    draw_direction(&random, u);
    draw_across(&random, side, u);
    for (int d = 0; d < DIM; d++, image /= 3) {
        const double away = DISTANCE * u[d] + b * side[d], edge = BOX[d] * (image % 3 - 1);
        e.p[d] = DRIFT[d];
        e.p[DIM + d] = DRIFT[d] - u[d];
        e.q[DIM + d] = 0.5 * BOX[d] + 0.5 * away - 0.5 * edge;
        e.q[d] = e.q[DIM + d] - away + edge;
        for (int k = d; k < 2 * DIM; k += DIM) e.q[k] -= floor(e.q[k] / BOX[d]) * BOX[d];
        e.image[d] = (int)round((away - (e.q[DIM + d] - e.q[d])) / BOX[d]);
    }
    closed_form(&e);
    return e;
}

static void check_outcome(const encounter *e, const double *after)
{
    long double before_rel[DIM], after_rel[DIM], energy = 0;
    for (int d = 0; d < DIM; d++) {
        before_rel[d] = (long double)e->p[DIM + d] - e->p[d];
        after_rel[d] = (long double)after[DIM + d] - after[d];
        CHECK_CLOSE(after[d] + after[DIM + d], e->p[d] + e->p[DIM + d], MOMENTUM_ROUNDING);
    }
    for (int k = 0; k < 2 * DIM; k++)
        energy += (long double)after[k] * after[k] - e->p[k] * e->p[k];
    CHECK_CLOSE((double)energy, 0.0, 2.0 * MOMENTUM_ROUNDING);
    /* a late contact turns n by the error of the time: the closer to grazing, the more */
    const double n_error = POSITION_ROUNDING * BOX[0] / (double)-e->b;
    CHECK_CLOSE((double)(dot(after_rel, e->n) + dot(before_rel, e->n)), 0.0,
                4.0 * n_error + MOMENTUM_ROUNDING);
    for (int d = 0; d < DIM; d++) {
        CHECK_CLOSE(after[d], (double)(e->p[d] + e->b * e->n[d]),
                    4.0 * n_error + MOMENTUM_ROUNDING);
        CHECK_CLOSE(after[DIM + d], (double)(e->p[DIM + d] - e->b * e->n[d]),
                    4.0 * n_error + MOMENTUM_ROUNDING);
    }
}

static void check_event(const encounter *e, const hd_event *event)
{
    const double n_error = POSITION_ROUNDING * BOX[0] / (double)-e->b;
    CHECK_CLOSE(event->i, 0, 0.0);
    CHECK_CLOSE(event->j, 1, 0.0);
    CHECK_CLOSE(event->t, (double)e->time, n_error);
    for (int d = 0; d < DIM; d++) {
        CHECK_CLOSE(event->n[d], (double)e->n[d], 2.0 * n_error);
        assert_true(event->p[d] == e->p[DIM + d] - e->p[d]);
    }
}

/** Long enough to pass, too short to come round the box. */
static const double PASSAGE = 3.5;

static void check_encounter(const encounter *e)
{
    const hd_scene_def def = box_with(2, BOX[0], BOX[1], BOX[2], 0, 1);
    double after[2 * DIM], box[DIM];
    OWNED(hd_trajectory) *tr = started(&def, e->q, e->p);
    OWNED(hd_record) *log = new_log();
    box_around(tr, box);
    CHECK_CLOSE(box[0], BOX[0], 2.0 * DBL_EPSILON * BOX[0]); /* root of a rounded density */
    CHECK_OK(trajectory_to(tr, log, PASSAGE));
    hd_trajectory_state(tr, NULL, after);
    const int meets = e->miss < 1;
    if ((int)log->count != meets) fail_msg("miss %.17Lg: %zu events", e->miss, log->count);
    if (meets) {
        check_event(e, &events_in(log)[0]);
        check_outcome(e, after);
    }
}

TEST(every_impact_direction_and_image)
{
    int hits = 0, misses = 0;
    for (int a = 0; a < DIRECTIONS; a++)
        for (int k = 0; k < IMPACTS; k++)
            for (int image = 0; image < IMAGES; image++) {
                /* offset so that no line is drawn exactly through a grazing one */
                const double b = -1.2 + 2.4 * (k + 0.01) / (IMPACTS - 1);
                const encounter e = encounter_at(a, b, image);
                check_encounter(&e);
                hits += e.miss < 1;
                misses += e.miss >= 1;
            }
    assert_true(hits > 7000 && misses > 1000);
}

/** 1 - b from 1e-1 down to where rounding decides. */
TEST(grazing)
{
    for (double gap = 0.1; gap > 1e3 * DBL_EPSILON * BOX[0]; gap *= 0.3)
        for (int a = 0; a < DIRECTIONS; a++)
            for (int side = -1; side <= 1; side += 2) {
                const encounter hit = encounter_at(a, side * (1.0 - gap), IMAGES / 2);
                const encounter miss = encounter_at(a, side * (1.0 + gap), IMAGES / 2 + 1);
                assert_true(hit.miss < 1 && miss.miss > 1);
                check_encounter(&hit);
                check_encounter(&miss);
            }
}

/** One disk against each wall from every angle; the other one rests far away. */
static void check_wall(const hd_scene_def *def, int direction, int high, double angle)
{
    const double sign = high ? 1.0 : -1.0;
    double q[2 * DIM], p[2 * DIM] = {0}, after[2 * DIM];
    for (int d = 0; d < DIM; d++) {
        q[d] = 0.5 * BOX[d], q[DIM + d] = 1.0;
        p[d] = sin(angle) / (d + 1);
    }
    q[DIM + direction] = high ? 1.0 : BOX[direction] - 1.0; /* behind */
    p[direction] = sign * cos(angle);
    OWNED(hd_trajectory) *tr = started(def, q, p);
    OWNED(hd_record) *log = new_log();
    const long double reach = 0.5L * BOX[direction] - 0.5L,
                      t = reach / fabsl((long double)p[direction]);
    CHECK_OK(trajectory_to(tr, log, (double)t * 1.01));
    hd_trajectory_state(tr, NULL, after);
    assert_int_equal(log->count, 1);
    const hd_event *event = &events_in(log)[0];
    CHECK_CLOSE(event->t, (double)t, POSITION_ROUNDING * (double)(BOX[0] * t / reach));
    CHECK_CLOSE(event->i, 0, 0.0);
    CHECK_CLOSE(event->j, HD_WALL_X - direction, 0.0);
    for (int d = 0; d < DIM; d++) {
        assert_true(event->n[d] == (d == direction) && event->p[d] == p[d]);
        assert_true(after[d] == (d == direction ? -p[d] : p[d]));
    }
}

TEST(every_wall_and_angle)
{
    enum { WALL_ANGLES = 50 };
    const hd_scene_def def = box_with(2, BOX[0], BOX[1], BOX[2], ALL_WALLS, 1);
    for (int wall = 0; wall < 2 * DIM; wall++)
        for (int a = -WALL_ANGLES; a <= WALL_ANGLES; a++)
            check_wall(&def, wall / 2, wall % 2, 0.6 * a / WALL_ANGLES);
}

/** Between walls a pair never meets through an image: both close to opposite walls, moving
 * outwards. */
TEST(no_image_through_a_wall)
{
    for (int d = 0; d < DIM; d++) {
        const hd_scene_def def = box_with(2, BOX[0], BOX[1], BOX[2], 1 << d, 1);
        double q[2 * DIM], p[2 * DIM] = {0};
        for (int k = 0; k < 2 * DIM; k++) q[k] = 3.0;
        q[d] = 0.75, q[DIM + d] = BOX[d] - 0.75;
        p[d] = -1.0, p[DIM + d] = 1.0;
        OWNED(hd_trajectory) *tr = started(&def, q, p);
        CHECK_OK(hd_trajectory_extend(tr, NULL, 1.0));
        assert_true(hd_trajectory_totals(tr).collisions == 0);
        assert_true(hd_trajectory_totals(tr).wall_events == 2);
    }
}
