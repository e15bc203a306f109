/** Two spheres that fly at each other: when they touch, and what they exchange, against the closed
 * form, for all directions and impact parameters; across edges of the box, too. */
#include "prepared.h"

static const double BOX = 16.0, FAR = 3.0, SPEED = 1.7;
/** Of positions of the order of the box. */
static const double ROUNDING = 32.0 * 16.0 * DBL_EPSILON;

static double dot3(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** Two unit vectors that are orthogonal: along a direction of the grid, and turned about it. */
static void directions(double e[3], double u[3], int k, double turn)
{
    const double raw[3] = {k % 3 - 1.0 + 0.01 * (k > 26), k / 3 % 3 - 1.0, k / 9 % 3 - 1.0};
    const double size = sqrt(dot3(raw, raw));
    for (int d = 0; d < 3; d++) e[d] = raw[d] / size;
    const int least = fabs(e[0]) <= fabs(e[1]) ? (fabs(e[0]) <= fabs(e[2]) ? 0 : 2)
                                               : (fabs(e[1]) <= fabs(e[2]) ? 1 : 2);
    double v[3], w[3];
    for (int d = 0; d < 3; d++) v[d] = (d == least) - e[least] * e[d];
    const double length = sqrt(dot3(v, v));
    for (int d = 0; d < 3; d++) v[d] /= length;
    for (int d = 0; d < 3; d++)
        w[d] = e[(d + 1) % 3] * v[(d + 2) % 3] - e[(d + 2) % 3] * v[(d + 1) % 3];
    for (int d = 0; d < 3; d++) u[d] = cos(turn) * v[d] + sin(turn) * w[d];
}

/** The first one stands still at `place`; the other comes along e, off by `off` along u. */
static hd_trajectory *shot(double p[6], const double *e, const double *u, double off, double place)
{
    const hd_scene_def def = spheres_in_box(2, BOX, BOX, BOX, 0, 1);
    double q[6];
    for (int d = 0; d < 3; d++) {
        const double at = place - FAR * e[d] + off * u[d];
        q[d] = place;
        q[3 + d] = at - BOX * floor(at / BOX);
        p[d] = 0.0;
        p[3 + d] = SPEED * e[d];
    }
    return started(&def, q, p);
}

/** The normal, and so what is exchanged, is off by the rounding of positions over the depth of the
 * contact. */
static void check_shot(int k, double turn, double off, double place)
{
    double e[3], u[3], p[6];
    directions(e, u, k, turn);
    const double depth = sqrt(1.0 - off * off), wait = (FAR - depth) / SPEED;
    OWNED(hd_trajectory) *tr = shot(p, e, u, off, place);
    OWNED(hd_event_log) *log = new_log();
    CHECK_OK(trajectory_to(tr, log, FAR / SPEED + 0.5));
    assert_int_equal(log->count, 1);
    const hd_event *event = log->event;
    assert_true(event->i == 0 && event->j == 1);
    CHECK_CLOSE(event->t, wait, ROUNDING / depth);
    hd_trajectory_state(tr, NULL, p);
    for (int d = 0; d < 3; d++) {
        const double n = off * u[d] - depth * e[d]; /* from the first one to the other */
        CHECK_CLOSE(event->n[d], n, ROUNDING / depth);
        CHECK_CLOSE(event->p[d], SPEED * e[d], 4 * DBL_EPSILON * SPEED);
        CHECK_CLOSE(p[d], -SPEED * depth * n, 4 * SPEED * ROUNDING / depth);
        CHECK_CLOSE(p[3 + d], SPEED * (e[d] + depth * n), 4 * SPEED * ROUNDING / depth);
    }
}

static const double OFF[] = {0.0, 0.1, 0.5, 0.9, 0.999, 1.0 - 1e-6, 1.0 - 1e-9};

TEST(contact_and_momenta_are_those_of_the_closed_form)
{
    for (int k = 0; k < 54; k++) {
        if (k == 13) continue; /* no direction */
        for (size_t o = 0; o < sizeof OFF / sizeof *OFF; o++)
            for (double turn = 0.0; turn < 6.0; turn += 0.7) {
                check_shot(k, turn, OFF[o], 8.0);
                check_shot(k, turn, OFF[o], 0.25); /* across the edges of the box */
            }
    }
}

/** Beside each other by more than a diameter: nothing happens. */
TEST(who_passes_does_not_touch)
{
    for (int k = 0; k < 54; k++) {
        double e[3], u[3], p[6];
        if (k == 13) continue;
        directions(e, u, k, 0.3);
        OWNED(hd_trajectory) *tr = shot(p, e, u, 1.0 + 1e-12, 0.25);
        CHECK_OK(hd_trajectory_extend(tr, NULL, 2.0 * FAR / SPEED));
        assert_int_equal(hd_trajectory_collisions(tr), 0);
    }
}
