/** The tangent maps of spheres: against shadow trajectories, exact invariants, and the way back. */
#include "draw.h"
#include "prepared.h"
#include "tangent.h"

enum { DISKS = 10, Q = 3 * DISKS, ROWS = 6 * DISKS };

static hd_scene_def small(int walls) { return spheres_of(DISKS, 0.4, 0.9, 1.2, walls, 3); }

typedef struct state {
    double q[Q], p[Q];
} state;

static state fluid(const hd_scene_def *def, double time)
{
    state s;
    MADE(hd_trajectory, tr, def);
    CHECK_OK(hd_trajectory_extend(tr, NULL, time));
    hd_trajectory_state(tr, s.q, s.p);
    return s;
}

static state carried(const hd_scene_def *def, const state *from, double time)
{
    state to;
    OWNED(hd_trajectory) *tr = started(def, from->q, from->p);
    CHECK_OK(hd_trajectory_extend(tr, NULL, time));
    hd_trajectory_state(tr, to.q, to.p);
    return to;
}

/** Displacement of a component in the rows of a frame; its momentum is three rows below. */
static int row_of(int k) { return 6 * (k / 3) + k % 3; }

/* ---- shadows -------------------------------------------------------------------------------- */

static state displaced(const state *s, const double *v, double epsilon)
{
    state out = *s;
    for (int k = 0; k < Q; k++) {
        out.q[k] += epsilon * v[row_of(k)];
        out.p[k] += epsilon * v[row_of(k) + 3];
    }
    return out;
}

/** Relative deviation of the central difference from the carried vector. */
static double shadow_error(const hd_scene_def *def, const state *s, const double *v,
                           const double *later, double time, double epsilon)
{
    double box[3], off = 0.0;
    const state ahead = displaced(s, v, epsilon), behind = displaced(s, v, -epsilon);
    const state a = carried(def, &ahead, time), b = carried(def, &behind, time);
    hd_scene_box(def, box);
    for (int k = 0; k < Q; k++) {
        const double dq = remainder(a.q[k] - b.q[k], box[k % 3]) / (2.0 * epsilon);
        const double dp = (a.p[k] - b.p[k]) / (2.0 * epsilon);
        off = hypot(off, hypot(dq - later[row_of(k)], dp - later[row_of(k) + 3]));
    }
    return off / sqrt(dot(later, later, ROWS));
}

/** Over a sweep of offsets the deviation falls as epsilon^2, down to rounding / epsilon; some three
 * collisions of a sphere, fewer where there is more room. */
TEST(maps_are_the_derivative_of_the_flow)
{
    for (int walls = 0; walls < 8; walls++) {
        const hd_scene_def def = small(walls);
        const state s = fluid(&def, 20.0);
        double v[ROWS], later[ROWS], error[4];
        MADE(hd_frame, frame, DISKS, 1, 1, 1);
        for (int row = 0; row < ROWS; row++)
            *frame_entry(frame, row, 0) = v[row] = cos(1 + 7 * row);
        MADE(hd_trajectory, tr, &def);
        const double time = 1.5 * DISKS / hd_trajectory_collision_rate(tr);
        OWNED(hd_event_log) *log = log_of(&def, s.q, s.p, time);
        assert_true(log->count >= DISKS / 2);
        CHECK_OK(hd_frame_replay(frame, log, 0.0, time));
        frame_column(frame, 0, later);
        for (int k = 0; k < 4; k++)
            error[k] = shadow_error(&def, &s, v, later, time, pow(10.0, -5.5 - 0.5 * k));
        assert_true(error[3] < 1e-5);
        for (int k = 0; k < 3; k++)
            CHECK_CLOSE(error[k + 1], error[k] / 10.0, 0.5 * error[k] / 10.0 + 1e-8);
    }
}

/* ---- invariants ----------------------------------------------------------------------------- */

static void draw_unit(hd_random *random, double out[3])
{
    double square = 2.0;
    while (square > 1.0 || square < 0.1) {
        for (int d = 0; d < 3; d++) out[d] = hd_random_symmetric(random);
        square = dot(out, out, 3);
    }
    for (int d = 0; d < 3; d++) out[d] /= sqrt(square);
}

/** From head-on to grazing, in any direction. */
TEST(one_collision_is_symplectic)
{
    hd_random random = hd_random_seeded(4, 0);
    double before = 0.0;
    for (double slope = 1e-12; slope < 1e8; slope *= 10.0) /* |p_t / p.n| */
        for (int k = 0; k < 20; k++) {
            hd_event event = {.t = 0.4, .i = 0, .j = 1};
            double across[3];
            draw_unit(&random, event.n);
            draw_unit(&random, across);
            const double along = dot(across, event.n, 3);
            for (int d = 0; d < 3; d++)
                event.p[d] = -2.0 * event.n[d] / hypot(1.0, slope) +
                             2.0 * slope / hypot(1.0, slope) * (across[d] - along * event.n[d]);
            const hd_event_log log = {&event, 1, 1, 1.0};
            const double size = check_symplectic_map(&log, 2);
            assert_true(slope < 1e3 || size > 0.1 * slope); /* it stretches as it grazes */
            before = fmax(before, size);
        }
    assert_true(before > 1e7);
}

TEST(one_wall_is_symplectic)
{
    for (int d = 0; d < 3; d++) {
        hd_event event = {
            .t = 0.4, .i = 1, .j = -1 - d, .n = {d == 0, d == 1, d == 2}, .p = {0.3, -0.7, 0.9}};
        const hd_event_log log = {&event, 1, 1, 1.0};
        check_symplectic_map(&log, 2);
    }
}

/** Products of all pairs of vectors stay, to rounding of their sizes. */
TEST(many_events_are_symplectic)
{
    for (int walls = 0; walls < 8; walls += 7) {
        const hd_scene_def def = small(walls);
        const state s = fluid(&def, 20.0);
        OWNED(hd_event_log) *log = log_of(&def, s.q, s.p, 1.0);
        double before[ROWS][ROWS], a[ROWS], b[ROWS];
        MADE(hd_frame, frame, DISKS, ROWS, 3, 1);
        for (int k = 0; k < ROWS; k++)
            for (int l = 0; l < ROWS; l++)
                before[k][l] = symplectic(frame_column(frame, k, a), frame_column(frame, l, b),
                                          ROWS);
        CHECK_OK(hd_frame_replay(frame, log, 0.0, 1.0));
        for (int k = 0; k < ROWS; k++)
            for (int l = 0; l < ROWS; l++) {
                frame_column(frame, k, a);
                frame_column(frame, l, b);
                const double size = sqrt(dot(a, a, ROWS) * dot(b, b, ROWS));
                CHECK_CLOSE(symplectic(a, b, ROWS), before[k][l],
                            8 * DBL_EPSILON * sqrt((double)log->count) * size);
            }
    }
}

/** dq and dp along a periodic direction, dq = p and dp = p: each is carried into what is known in
 * closed form, behind whatever walls. */
TEST(the_null_space_is_mapped_into_itself)
{
    const double time = 1.0, tolerance = 1e-10; /* eps exp(lambda_1 t) at lambda_1 t < 9 */
    for (int walls = 0; walls < 8; walls++) {
        const hd_scene_def def = small(walls);
        const state s = fluid(&def, 20.0), end = carried(&def, &s, time);
        OWNED(hd_event_log) *log = log_of(&def, s.q, s.p, time);
        MADE(hd_frame, frame, DISKS, 8, 3, 1);
        memset(hd_frame_data(frame), 0, (size_t)(ROWS * hd_frame_stride(frame)) * sizeof(double));
        for (int k = 0; k < Q; k++) {
            *frame_entry(frame, row_of(k), 2 * (k % 3)) = 1.0;
            *frame_entry(frame, row_of(k) + 3, 2 * (k % 3) + 1) = 1.0;
            *frame_entry(frame, row_of(k), 6) = *frame_entry(frame, row_of(k) + 3, 7) = s.p[k];
        }
        CHECK_OK(hd_frame_replay(frame, log, 0.0, time));
        for (int k = 0; k < Q; k++)
            for (int col = 0; col < 8; col++) {
                const bool of_p = col >= 6, in_dp = col % 2;
                if (!of_p && walls >> col / 2 & 1) continue;
                const double size = of_p ? end.p[k] : k % 3 == col / 2;
                CHECK_CLOSE(*frame_entry(frame, row_of(k), col), in_dp ? time * size : size,
                            tolerance);
                CHECK_CLOSE(*frame_entry(frame, row_of(k) + 3, col), in_dp ? size : 0.0, tolerance);
            }
    }
}

/* ---- the way back --------------------------------------------------------------------------- */

static state reversed(const state *s)
{
    state r = *s;
    for (int k = 0; k < Q; k++) r.p[k] = -r.p[k];
    return r;
}

/** Events come in the opposite order, and spheres return as far as rounding, some eps of positions
 * at every event, has grown by less than exp(20). */
TEST(time_reversal)
{
    const double time = 3.0;
    for (int walls = 0; walls < 8; walls++) {
        const hd_scene_def def = small(walls);
        const state s = fluid(&def, 20.0), there = carried(&def, &s, time);
        const state turned = reversed(&there), back = carried(&def, &turned, time);
        OWNED(hd_event_log) *forth = log_of(&def, s.q, s.p, time);
        OWNED(hd_event_log) *again = log_of(&def, turned.q, turned.p, time);
        double box[3];
        hd_scene_box(&def, box);
        assert_true(forth->count > 3 * DISKS && again->count == forth->count);
        for (size_t k = 0; k < forth->count; k++) {
            const hd_event *a = &forth->event[k], *b = &again->event[again->count - 1 - k];
            assert_true(a->i == b->i && a->j == b->j);
            CHECK_CLOSE(a->t + b->t, time, 1e-7);
        }
        for (int k = 0; k < Q; k++) {
            CHECK_CLOSE(back.p[k], -s.p[k], 1e-6);
            CHECK_CLOSE(remainder(back.q[k] - s.q[k], box[k % 3]), 0.0, 1e-6);
        }
    }
}
