/** Forward for a while, all momenta reversed, and back: disks return as far as rounding, which
 * grows by exp(lambda_1 t), allows; and do not where it must have grown beyond the box. */
#include "prepared.h"

enum { DISKS = 12, STARTS = 24 };

typedef struct state {
    double q[2 * DISKS], p[2 * DISKS];
} state;

static hd_scene_def scene_with(hd_boundary x, hd_boundary y)
{
    return scene_of(DISKS, 0.5, 0.9, x, y, 9);
}

/** After `time`. */
static state carried(const hd_scene_def *def, const state *from, double time)
{
    state to;
    OWNED(hd_trajectory) *tr = started(def, from->q, from->p);
    CHECK_OK(hd_trajectory_extend(tr, NULL, time));
    hd_trajectory_state(tr, to.q, to.p);
    return to;
}

static state reversed(const state *s)
{
    state r = *s;
    for (int k = 0; k < 2 * DISKS; k++) r.p[k] = -r.p[k];
    return r;
}

/** Distance in phase space, with the shortest way round the box. */
static double distance(const hd_scene_def *def, const state *a, const state *b)
{
    double box[2], sum = 0;
    hd_scene_box(def, box);
    for (int k = 0; k < 2 * DISKS; k++) {
        const double dq = def->boundary[k % 2] == P ? remainder(a->q[k] - b->q[k], box[k % 2])
                                                    : a->q[k] - b->q[k];
        sum += dq * dq + (a->p[k] - b->p[k]) * (a->p[k] - b->p[k]);
    }
    return sqrt(sum);
}

/** How far from the start it comes back. */
static double miss(const hd_scene_def *def, const state *start, double time)
{
    const state there = carried(def, start, time), turned = reversed(&there);
    const state back = carried(def, &turned, time), again = reversed(&back);
    return distance(def, &again, start);
}

/** ln of what a random vector is stretched by on the way: exp(lambda_1 t) of this very stretch. */
static double stretched(const hd_scene_def *def, const state *start, double time)
{
    OWNED(hd_event_log) *events = log_of(def, start->q, start->p, time);
    MADE(hd_frame, frame, DISKS, 1, 4, 1);
    double square[2] = {0, 0};
    for (int pass = 0; pass < 2; pass++) {
        if (pass) CHECK_OK(hd_frame_replay(frame, events, 0.0, time));
        for (int row = 0; row < hd_frame_rows(frame); row++)
            square[pass] += pow(hd_frame_read(frame)[row * hd_frame_stride(frame)], 2.0);
    }
    return 0.5 * log(square[1] / square[0]);
}

static state next_start(const hd_scene_def *def, const state *s) { return carried(def, s, 20.0); }

static state first_start(const hd_scene_def *def)
{
    state s;
    MADE(hd_trajectory, tr, def);
    CHECK_OK(hd_trajectory_extend(tr, NULL, 20.0));
    hd_trajectory_state(tr, s.q, s.p);
    return s;
}

/** Rounding starts as some eps of 4 N coordinates of size up to 6, is made anew at every collision,
 * and each part of it is stretched by the rest of the way there and back, where it lies along the
 * fastest direction: ln(miss / eps) exceeds ln(stretch) by 0 to 4 in the mean. A single start
 * differs by what one grazing collision does. */
static const double OFF_MIN = 0.0, OFF_MAX = 4.0, SINGLE = 13.0;

typedef struct returns {
    double off;     /**< mean of ln(miss / eps) - ln(stretch) */
    double stretch; /**< mean of its logarithm */
    double largest; /**< of ln(miss / eps) - ln(stretch) */
    double nearest; /**< least miss */
} returns;

static returns returns_after(const hd_scene_def *def, double time)
{
    returns r = {.nearest = INFINITY, .largest = -INFINITY};
    state s = first_start(def);
    for (int k = 0; k < STARTS; k++) {
        s = next_start(def, &s);
        const double missed = miss(def, &s, time), stretch = stretched(def, &s, time);
        const double off = log(missed / DBL_EPSILON) - stretch;
        assert_true(isfinite(off));
        r.off += off / STARTS;
        r.stretch += stretch / STARTS;
        r.largest = fmax(r.largest, off);
        r.nearest = fmin(r.nearest, missed);
    }
    return r;
}

static const hd_boundary BOUNDARY[][2] = {{P, P}, {R, R}, {P, R}};

TEST(returns_as_far_as_rounding_grows)
{
    for (int b = 0; b < 3; b++) {
        const hd_scene_def def = scene_with(BOUNDARY[b][0], BOUNDARY[b][1]);
        for (double time = 1.0; time < 6.5; time += 1.0) {
            const returns r = returns_after(&def, time);
            assert_true(r.off >= OFF_MIN && r.off <= OFF_MAX && r.largest <= SINGLE);
        }
    }
}

/** eps exp(lambda_1 t) is then above 1e6: nothing of the start is left, and a program that returned
 * all the same would not have moved. */
TEST(cannot_return_from_too_far)
{
    for (int b = 0; b < 3; b++) {
        const hd_scene_def def = scene_with(BOUNDARY[b][0], BOUNDARY[b][1]);
        const returns r = returns_after(&def, 16.0);
        assert_true(r.stretch > 36.0 + log(1e6));
        assert_true(r.nearest > 1.0);
    }
}

/** The way back meets the same pairs and walls in the opposite order. */
TEST(events_come_in_the_opposite_order)
{
    const double time = 3.0; /* rounding has grown to some 1e-11: far from another order */
    for (int b = 0; b < 3; b++) {
        const hd_scene_def def = scene_with(BOUNDARY[b][0], BOUNDARY[b][1]);
        const state start = first_start(&def), there = carried(&def, &start, time);
        const state turned = reversed(&there);
        OWNED(hd_event_log) *forth = log_of(&def, start.q, start.p, time);
        OWNED(hd_event_log) *back = log_of(&def, turned.q, turned.p, time);
        assert_true(forth->count > 2 * DISKS && back->count == forth->count);
        for (size_t k = 0; k < forth->count; k++) {
            const hd_event *a = &forth->event[k], *c = &back->event[back->count - 1 - k];
            assert_true(a->i == c->i && a->j == c->j);
            CHECK_CLOSE(a->t + c->t, time, 1e-9);
        }
    }
}
