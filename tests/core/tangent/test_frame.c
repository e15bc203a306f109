/** The tangent maps of disks and of spheres: against shadow trajectories, exact invariants, the way
 * back, and each other. */
#include "draw.h"
#include "prepared.h"
#include "tangent.h"

enum { DISKS_MAX = 32, ROWS_MAX = ROWS_OF_ONE * DISKS_MAX };

typedef struct state {
    double q[DIM * DISKS_MAX], p[DIM * DISKS_MAX];
} state;

/** Of component k of all displacements; its momentum is DIM rows below. */
static int row_of(int k) { return ROWS_OF_ONE * (k / DIM) + k % DIM; }

static hd_scene_def small(int walls) { return box_of(10, 0.4, 0.9, 1.2, walls, 3); }

static state fluid(const hd_scene_def *def)
{
    state s;
    MADE(hd_trajectory, tr, def);
    CHECK_OK(hd_trajectory_extend(tr, NULL, 20.0));
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

/* ---- shadows ------------------------------------------------------------------------------- */

/** The state displaced by epsilon v, after `time`. */
static state shadow_of(const hd_scene_def *def, const state *s, const double *v, double epsilon,
                       double time)
{
    state moved = *s;
    for (int k = 0; k < DIM * def->number; k++) {
        moved.q[k] += epsilon * v[row_of(k)];
        moved.p[k] += epsilon * v[row_of(k) + DIM];
    }
    return carried(def, &moved, time);
}

/** Relative deviation of the central difference from the carried vector. */
static double shadow_error(const hd_scene_def *def, const state *s, const double *v,
                           const double *later, double time, double epsilon)
{
    double box[DIM], off = 0.0;
    const state a = shadow_of(def, s, v, epsilon, time), b = shadow_of(def, s, v, -epsilon, time);
    hd_scene_box(def, box);
    for (int k = 0; k < DIM * def->number; k++) {
        const double dq = remainder(a.q[k] - b.q[k], box[k % DIM]) / (2.0 * epsilon);
        const double dp = (a.p[k] - b.p[k]) / (2.0 * epsilon);
        off = hypot(off, hypot(dq - later[row_of(k)], dp - later[row_of(k) + DIM]));
    }
    return off / sqrt(dot(later, later, ROWS_OF_ONE * def->number));
}

/** Over a sweep of offsets the deviation falls as epsilon^2, down to rounding / epsilon; some three
 * collisions of a disk, fewer where there is more room. */
static void check_shadow(hd_scene_def def)
{
    const state s = fluid(&def);
    double v[ROWS_MAX], later[ROWS_MAX], error[4];
    MADE(hd_frame, frame, PARTICLES(def.number), 1, 1, 1);
    for (int row = 0; row < ROWS_OF_ONE * def.number; row++)
        *frame_entry(frame, row, 0) = v[row] = cos(1 + 7 * row);
    MADE(hd_trajectory, tr, &def);
    const double time = 1.6 * def.number / hd_trajectory_totals(tr).expected;
    OWNED(hd_record) *log = log_of(&def, s.q, s.p, time);
    assert_true(log->count >= (size_t)def.number / 2);
    CHECK_OK(hd_frame_replay(frame, log, 0.0, time));
    frame_column(frame, 0, later);
    for (int k = 0; k < 4; k++)
        error[k] = shadow_error(&def, &s, v, later, time, pow(10.0, -5.5 - 0.5 * k));
    /* a wall that shears rounds in each of its dozen steps */
    const double rounding = hd_scene_symplectic(&def) ? 1e-8 : 4e-8;
    assert_true(error[3] < 1e-5);
    for (int k = 0; k < 3; k++) /* a factor 10 each, less what rounding adds */
        CHECK_CLOSE(error[k + 1], error[k] / 10.0, 0.5 * error[k] / 10.0 + rounding);
}

TEST(maps_are_the_derivative_of_the_flow)
{
    for (int walls = 0; walls < WALL_SETS; walls++) check_shadow(small(walls));
    check_shadow(box_of(30, 0.7, 0.8, 0.9, 0, 1));
    if (DIM == 3) return;
    for (int d = 0; d < 2; d++)
        for (double b = 0.1; b < 200.0; b *= 10.0) {
            hd_scene_def def = small(0);
            def.boundary[d] = HD_SHEARING;
            def.shear_b = b;
            def.exponents = HD_EXPONENTS_ALL;
            check_shadow(def);
        }
    check_shadow(scene(.container = HD_CIRCLE, .number = 12, .density = 0.3));
    check_shadow(scene(.container = HD_CIRCLE, .number = 30, .density = 0.7));
}

/* ---- invariants ---------------------------------------------------------------------------- */

/** From head-on to |p.n| = 1e-14 |p|, in any direction, at three speeds. Where it grazes the
 * largest entries of S are p_t^2 / b, to and from both disks: |S| = 2 p_t^2 / |b|, and flights of a
 * half stretch it further by less than (1 + 1/2)^2. */
TEST(one_collision_is_symplectic)
{
    const double speed[] = {1e-3, 1.0, 30.0};
    hd_random random = hd_random_seeded(4, 0);
    for (double slope = 1e-12; slope < 2e14; slope *= 10.0) /* |p_t / p.n| */
        for (int k = 0; k < 60; k++) {
            hd_event event = {.t = 0.25, .i = 0, .j = 1};
            double across[DIM];
            draw_direction(&random, event.n);
            draw_across(&random, across, event.n);
            for (int d = 0; d < DIM; d++)
                event.p[d] = speed[k % 3] * (slope * across[d] - event.n[d]) / hypot(1.0, slope);
            const hd_record log = record_of(&event, 1, 0.5);
            const double grown = check_symplectic_map(&log, 2), want = 2.0 * speed[k % 3] * slope;
            if (slope > 1e6) CHECK_WITHIN(grown, 0.9 * want, 2.3 * want);
        }
}

TEST(one_wall_is_symplectic)
{
    for (int d = 0; d < DIM; d++) {
        hd_event event = {.t = 0.4, .i = 1, .j = -1 - d, .p = {0.3, -0.7}};
        event.n[d] = 1.0;
        const hd_record log = record_of(&event, 1, 1.0);
        check_symplectic_map(&log, 2);
    }
}

/** S^T J S = J: products of all pairs of vectors stay, to rounding of their sizes. */
TEST(many_events_are_symplectic)
{
    for (int walls = 0; walls < WALL_SETS; walls += ALL_WALLS) {
        enum { ROWS = ROWS_OF_ONE * 10 };
        const hd_scene_def def = small(walls);
        const state s = fluid(&def);
        OWNED(hd_record) *log = log_of(&def, s.q, s.p, 1.0);
        double before[ROWS][ROWS], a[ROWS], b[ROWS];
        MADE(hd_frame, frame, PARTICLES(10), ROWS, 3, 1);
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
TEST(zero_modes_stay_zero_modes)
{
    enum { OF_P = 2 * DIM, COLUMNS = OF_P + 2 };
    const double time = 1.0, tolerance = 1e-10; /* eps exp(lambda_1 t) at lambda_1 t < 9 */
    for (int walls = 0; walls < WALL_SETS; walls++) {
        const hd_scene_def def = small(walls);
        const state s = fluid(&def), end = carried(&def, &s, time);
        OWNED(hd_record) *log = log_of(&def, s.q, s.p, time);
        MADE(hd_frame, frame, PARTICLES(def.number), COLUMNS, 3, 1);
        for (int row = 0; row < ROWS_OF_ONE * def.number; row++)
            for (int col = 0; col < COLUMNS; col++) *frame_entry(frame, row, col) = 0.0;
        for (int k = 0; k < DIM * def.number; k++) {
            *frame_entry(frame, row_of(k), 2 * (k % DIM)) = 1.0;
            *frame_entry(frame, row_of(k) + DIM, 2 * (k % DIM) + 1) = 1.0;
            *frame_entry(frame, row_of(k), OF_P) = s.p[k];
            *frame_entry(frame, row_of(k) + DIM, OF_P + 1) = s.p[k];
        }
        CHECK_OK(hd_frame_replay(frame, log, 0.0, time));
        for (int k = 0; k < DIM * def.number; k++)
            for (int col = 0; col < COLUMNS; col++) {
                const bool of_p = col >= OF_P, in_dp = col % 2;
                if (!of_p && walls >> col / 2 & 1) continue;
                const double size = of_p ? end.p[k] : k % DIM == col / 2;
                CHECK_CLOSE(*frame_entry(frame, row_of(k), col), in_dp ? time * size : size,
                            tolerance);
                CHECK_CLOSE(*frame_entry(frame, row_of(k) + DIM, col), in_dp ? size : 0.0,
                            tolerance);
            }
    }
}

/* ---- the way back -------------------------------------------------------------------------- */

static state reversed(state s)
{
    for (int k = 0; k < DIM * DISKS_MAX; k++) s.p[k] = -s.p[k];
    return s;
}

/** There and back again, the same events in the opposite order: how far from the start, with the
 * shortest way round the box. */
static double miss(const hd_scene_def *def, const state *s, double time)
{
    const state there = carried(def, s, time), turned = reversed(there);
    const state back = reversed(carried(def, &turned, time));
    double box[DIM], sum = 0.0;
    hd_scene_box(def, box);
    for (int k = 0; k < DIM * def->number; k++)
        sum += pow(remainder(back.q[k] - s->q[k], box[k % DIM]), 2.0) +
               pow(back.p[k] - s->p[k], 2.0);
    return sqrt(sum);
}

static void check_order(const hd_scene_def *def, const state *s, double time)
{
    const state there = carried(def, s, time), turned = reversed(there);
    OWNED(hd_record) *forth = log_of(def, s->q, s->p, time);
    OWNED(hd_record) *back = log_of(def, turned.q, turned.p, time);
    assert_true(forth->count > 2 * (size_t)def->number && back->count == forth->count);
    for (size_t k = 0; k < forth->count; k++) {
        const hd_event *a = &events_in(forth)[k], *b = &events_in(back)[back->count - 1 - k];
        assert_true(a->i == b->i && a->j == b->j);
        CHECK_CLOSE(a->t + b->t, time, DIM == 2 ? 1e-9 : 1e-7);
    }
}

/** ln of what a random vector is stretched by on the way: exp(lambda_1 t) of this very stretch. */
static double stretched(const hd_scene_def *def, const state *s, double time)
{
    double v[ROWS_MAX];
    const int rows = ROWS_OF_ONE * def->number;
    OWNED(hd_record) *events = log_of(def, s->q, s->p, time);
    MADE(hd_frame, frame, PARTICLES(def->number), 1, 4, 1);
    frame_column(frame, 0, v);
    const double before = dot(v, v, rows);
    CHECK_OK(hd_frame_replay(frame, events, 0.0, time));
    frame_column(frame, 0, v);
    return 0.5 * log(dot(v, v, rows) / before);
}

/** Rounding starts as some eps of 2 DIM N coordinates, is made anew at every collision, and each
 * part of it is stretched by the rest of the way there and back, where it lies along the fastest
 * direction: ln(miss / eps) exceeds ln(stretch) by 0 to 4 in the mean, 5 of spheres. A single start
 * differs by what one grazing collision does. */
TEST(the_way_back_misses_by_what_rounding_grows)
{
    enum { STARTS = 24 };
    for (int walls = 0; walls < WALL_SETS; walls++)
        for (double time = 2.0; time < 6.5; time += 2.0) {
            const hd_scene_def def = box_of(12, 0.5, 0.9, 1.1, walls, 9);
            state s = fluid(&def);
            double mean = 0.0;
            check_order(&def, &s, 3.0);
            for (int k = 0; k < STARTS; k++) {
                s = carried(&def, &s, 20.0);
                const double off = log(miss(&def, &s, time) / DBL_EPSILON) -
                                   stretched(&def, &s, time);
                assert_true(off <= 13.0);
                mean += off / STARTS;
            }
            CHECK_WITHIN(mean, 0.0, 2.0 + DIM);
        }
}

/* ---- many vectors -------------------------------------------------------------------------- */

typedef struct scene_log {
    hd_scene_def scene;
    hd_record *log;
} scene_log;

static scene_log logged(int disks, int walls, double time)
{
    scene_log s = {box_of(disks, 0.6, 0.8, 0.9, walls, 1), new_log()};
    MADE(hd_trajectory, tr, &s.scene);
    CHECK_OK(hd_trajectory_extend(tr, NULL, 10.0));
    CHECK_OK(trajectory_to(tr, s.log, 10.0 + time));
    return s;
}

/** Replays the log with `vectors` columns and `threads`, in pieces ending at cuts[]; column col. */
static void replayed(const scene_log *s, int vectors, int threads, const double *cuts, int col,
                     double *out)
{
    MADE(hd_frame, frame, PARTICLES(s->scene.number), vectors, 1, threads);
    for (int row = 0; row < hd_frame_rows(frame); row++)
        for (int k = 0; k < vectors; k++) *frame_entry(frame, row, k) = cos(row * 1.7 + k * 0.3);
    double begin = 0.0;
    for (; *cuts > 0.0; begin = *cuts++) CHECK_OK(hd_frame_replay(frame, s->log, begin, *cuts));
    frame_column(frame, col, out);
}

static void check_same(const double *a, const double *b, int rows, double relative)
{
    const double size = sqrt(dot(a, a, rows));
    for (int row = 0; row < rows; row++) CHECK_CLOSE(b[row], a[row], relative * size);
}

/** Every width of block, any number of threads: the same column; width changes rounding only. */
TEST(columns_do_not_know_of_each_other)
{
    enum { DISKS = 40, ROWS = ROWS_OF_ONE * DISKS };
    static const int counts[] = {1, 2, 3, 4, 5, 7, 8, 9, 16, 17, 31, 33, 63, 64, 65, 100, 129, 160};
    const double whole[] = {1.0, 0.0}, rounding = 1e3 * DBL_EPSILON; /* e^(lambda_1 t), no more */
    scene_log s = logged(DISKS, ALL_WALLS, 1.0);
    double one[ROWS], other[ROWS];
    for (size_t k = 0; k < sizeof counts / sizeof *counts; k++) {
        const int last = counts[k] - 1;
        double *v = one;
        replayed(&s, 160, 1, whole, last, v);
        replayed(&s, counts[k], 1, whole, last, other);
        check_same(one, other, ROWS, rounding);
        replayed(&s, counts[k], 3, whole, last, one);
        assert_memory_equal(one, other, sizeof one); /* threads: the same bits */
    }
    hd_record_free(s.log);
}

TEST(pieces_make_the_whole)
{
    enum { DISKS = 40, ROWS = ROWS_OF_ONE * DISKS };
    scene_log s = logged(DISKS, 0, 1.0);
    const double at_event = events_in(s.log)[s.log->count / 2].t;
    const double whole[] = {1.0, 0.0}, two[] = {0.3, 1.0, 0.0}, event[] = {at_event, 1.0, 0.0};
    double one[ROWS], other[ROWS];
    replayed(&s, 8, 1, whole, 7, one);
    replayed(&s, 8, 1, two, 7, other);
    check_same(one, other, ROWS, 1e3 * DBL_EPSILON);
    replayed(&s, 8, 1, event, 7, other);
    check_same(one, other, ROWS, 1e3 * DBL_EPSILON);
    hd_record_free(s.log);
}

TEST(rewind_brings_the_vectors_back)
{
    enum { DISKS = 20, VECTORS = 70 };
    scene_log s = logged(DISKS, 0, 0.5);
    MADE(hd_frame, frame, PARTICLES(DISKS), VECTORS, 5, 2);
    const size_t size = (size_t)(hd_frame_rows(frame) * hd_frame_stride(frame)) * sizeof(double);
    HEAP double *before = malloc(size);
    memcpy(before, hd_frame_data(frame), size);
    CHECK_OK(hd_frame_replay(frame, s.log, 0.0, 0.5));
    assert_memory_not_equal(before, hd_frame_data(frame), size);
    hd_frame_rewind(frame);
    assert_memory_equal(before, hd_frame_data(frame), size);
    hd_record_free(s.log);
}

/** Neither an angle to nothing, nor a ratio to it. */
TEST(a_half_that_vanishes_has_no_angle)
{
    enum { DISKS = 2, VECTORS = 2 };
    double cosine[VECTORS], ratio[VECTORS];
    MADE(hd_frame, frame, PARTICLES(DISKS), VECTORS, 9, 1);
    for (int row = 0; row < ROWS_OF_ONE * DISKS; row++)
        for (int col = 0; col < VECTORS; col++) /* column 0: dp = 0, column 1: dq = 0 */
            hd_frame_data(frame)[row * hd_frame_stride(frame) + col] = (row % ROWS_OF_ONE < DIM) ==
                                                                       (col == 0);
    hd_frame_dq_dp(frame, cosine, ratio);
    assert_true(isnan(cosine[0]) && isnan(cosine[1]) && isnan(ratio[1]));
    CHECK_CLOSE(ratio[0], 0.0, 0.0);
}

/** Of dp halves whose squares are no normal numbers nothing is known, or what is known is right. */
TEST(a_tiny_half_has_its_angle_or_none)
{
    enum { DISKS = 5 };
    double cosine, ratio, want;
    for (int digits = 0; digits <= 320; digits += 2) {
        MADE(hd_frame, frame, PARTICLES(DISKS), 1, 9, 1);
        hd_frame_dq_dp(frame, &want, &ratio);
        for (int row = 0; row < ROWS_OF_ONE * DISKS; row++)
            if (row % ROWS_OF_ONE >= DIM) *frame_entry(frame, row, 0) *= pow(10.0, -digits);
        hd_frame_dq_dp(frame, &cosine, &ratio);
        assert_true(digits > 140 || !isnan(cosine));
        if (!isnan(cosine)) CHECK_CLOSE(cosine, want, 32 * DBL_EPSILON);
    }
}

TEST(halves_are_measured_per_column)
{
    enum { DISKS = 5, VECTORS = 20 };
    double cosine[VECTORS], ratio[VECTORS], v[ROWS_OF_ONE * DISKS];
    MADE(hd_frame, frame, PARTICLES(DISKS), VECTORS, 9, 1);
    for (int row = 0; row < ROWS_OF_ONE * DISKS; row++) /* column 3: dp = -2 dq */
        hd_frame_data(frame)[row * hd_frame_stride(frame) + 3] = row % ROWS_OF_ONE < DIM ? 1.5
                                                                                         : -3.0;
    hd_frame_dq_dp(frame, cosine, ratio);
    CHECK_CLOSE(cosine[3], -1.0, 4 * DBL_EPSILON);
    CHECK_CLOSE(ratio[3], 2.0, 4 * DBL_EPSILON);
    for (int col = 0; col < VECTORS; col++) {
        double qq = 0, pp = 0, qp = 0;
        frame_column(frame, col, v);
        for (int row = 0; row < ROWS_OF_ONE * DISKS; row++) {
            qq += row % ROWS_OF_ONE < DIM ? v[row] * v[row] : 0;
            pp += row % ROWS_OF_ONE >= DIM ? v[row] * v[row] : 0;
            qp += row % ROWS_OF_ONE < DIM ? v[row] * v[row + DIM] : 0;
        }
        CHECK_CLOSE(cosine[col], qp / sqrt(qq * pp), 8 * DBL_EPSILON);
        CHECK_CLOSE(ratio[col], sqrt(pp / qq), 8 * DBL_EPSILON * ratio[col]);
    }
}
