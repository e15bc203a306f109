/** The tangent maps: against shadow trajectories, exact invariants, and each other. */
#include "tangent.h"
#include "interval.h"

/** A state in the fluid, a displacement of it, and the time that both are followed. */
typedef struct shadow {
    hd_scene_def scene;
    double q[64], p[64]; /**< of at most 32 disks */
    double d[128];       /**< rows as in hd_frame */
    double time;
} shadow;

static shadow shadow_of(hd_scene_def scene)
{
    const int disks = scene.disks;
    shadow s = {.scene = scene};
    MADE(hd_trajectory, tr, &s.scene);
    CHECK_OK(hd_trajectory_extend(tr, NULL, 20.0));
    s.time = 1.6 * disks / hd_trajectory_collision_rate(tr); /* about three collisions a disk */
    hd_trajectory_state(tr, s.q, s.p);
    for (int row = 0; row < 4 * disks; row++) s.d[row] = cos(1.0 + 7.0 * row); /* any direction */
    return s;
}

/** Final state of the shadow displaced by epsilon d, and the base's log (NULL: not wanted). */
static void follow(const shadow *s, double epsilon, double *q, double *p, hd_event_log *log)
{
    double q0[64], p0[64];
    for (int i = 0; i < s->scene.disks; i++)
        for (int c = 0; c < 2; c++) {
            q0[2 * i + c] = s->q[2 * i + c] + epsilon * s->d[4 * i + c];
            p0[2 * i + c] = s->p[2 * i + c] + epsilon * s->d[4 * i + 2 + c];
        }
    OWNED(hd_trajectory) *tr = NULL;
    CHECK_OK(hd_trajectory_create_from(&tr, &s->scene, q0, p0));
    CHECK_OK(trajectory_to(tr, log, s->time));
    hd_trajectory_state(tr, q, p);
}

/** d carried by the frame. */
static void carry(const shadow *s, const hd_event_log *log, double *out)
{
    MADE(hd_frame, frame, s->scene.disks, 1, 1, 1);
    memcpy(hd_frame_data(frame), s->d, (size_t)(4 * s->scene.disks) * sizeof(double));
    CHECK_OK(hd_frame_replay(frame, log, 0.0, log->duration));
    memcpy(out, hd_frame_data(frame), (size_t)(4 * s->scene.disks) * sizeof(double));
}

/** Relative deviation of the central difference from the carried vector. */
static double shadow_error(const shadow *s, const double *carried, double epsilon)
{
    double q[2][64], p[2][64], off = 0.0, size = 0.0, box[2];
    hd_scene_box(&s->scene, box);
    follow(s, epsilon, q[0], p[0], NULL);
    follow(s, -epsilon, q[1], p[1], NULL);
    for (int k = 0; k < 2 * s->scene.disks; k++) {
        const double dq = remainder(q[0][k] - q[1][k], box[k % 2]) / (2.0 * epsilon);
        const double dp = (p[0][k] - p[1][k]) / (2.0 * epsilon);
        const double *v = carried + 4 * (k / 2) + k % 2;
        off += pow(dq - v[0], 2.0) + pow(dp - v[2], 2.0);
        size += v[0] * v[0] + v[2] * v[2];
    }
    return sqrt(off / size);
}

/** Over a sweep of offsets the deviation falls as epsilon^2, down to rounding / epsilon. */
static void check_shadow(hd_scene_def scene)
{
    const shadow s = shadow_of(scene);
    const int disks = scene.disks;
    double q[64], p[64], carried[128], error[4];
    OWNED(hd_event_log) *log = new_log();
    follow(&s, 0.0, q, p, log);
    assert_true(log->count > (size_t)disks);
    carry(&s, log, carried);
    for (int k = 0; k < 4; k++) error[k] = shadow_error(&s, carried, pow(10.0, -5.0 - 0.5 * k));
    assert_true(error[3] < 1e-5);
    for (int k = 0; k < 3;
         k++) /* a factor 10 each, less what rounding of order 1e-15 / epsilon adds */
        CHECK_CLOSE(error[k + 1], error[k] / 10.0, 0.5 * error[k] / 10.0 + 1e-8);
}

TEST(maps_are_the_derivative_of_the_flow)
{
    check_shadow(scene_of(10, 0.5, 0.8, P, P, 1));
    check_shadow(scene_of(12, 0.3, 0.8, R, R, 1));
    check_shadow(scene_of(12, 0.6, 0.8, P, R, 1));
    check_shadow(scene_of(12, 0.6, 0.8, R, P, 1));
    check_shadow(scene_of(30, 0.7, 0.8, P, P, 1));
    check_shadow(scene(.container = HD_CIRCLE, .disks = 12, .density = 0.3));
    check_shadow(scene(.container = HD_CIRCLE, .disks = 30, .density = 0.7));
}

/* ---- many vectors -------------------------------------------------------------------------- */

typedef struct scene_log {
    hd_scene_def scene;
    hd_event_log *log;
    double q[2][128], p[2][128]; /**< of at most 64 disks, before and after */
} scene_log;

static scene_log logged(int disks, hd_boundary boundary, double time)
{
    scene_log s = {.scene = hd_scene_def_default()};
    s.scene.disks = disks;
    s.scene.boundary[0] = s.scene.boundary[1] = boundary;
    CHECK_OK(hd_event_log_create(&s.log));
    MADE(hd_trajectory, tr, &s.scene);
    CHECK_OK(hd_trajectory_extend(tr, NULL, 10.0));
    hd_trajectory_state(tr, s.q[0], s.p[0]);
    CHECK_OK(trajectory_to(tr, s.log, 10.0 + time));
    hd_trajectory_state(tr, s.q[1], s.p[1]);
    return s;
}

/** S^T J S = J: the symplectic product of any two vectors stays, to rounding of their sizes. */
static void check_symplectic(hd_boundary boundary)
{
    enum { DISKS = 9, ROWS = 4 * DISKS };
    scene_log s = logged(DISKS, boundary, 1.0);
    double before[ROWS][ROWS], a[ROWS], b[ROWS];
    MADE(hd_frame, frame, DISKS, ROWS, 3, 1);
    for (int k = 0; k < ROWS; k++)
        for (int l = 0; l < ROWS; l++)
            before[k][l] = symplectic(frame_column(frame, k, a), frame_column(frame, l, b), ROWS);
    CHECK_OK(hd_frame_replay(frame, s.log, 0.0, s.log->duration));
    for (int k = 0; k < ROWS; k++)
        for (int l = 0; l < ROWS; l++) {
            frame_column(frame, k, a);
            frame_column(frame, l, b);
            const double size = sqrt(dot(a, a, ROWS) * dot(b, b, ROWS));
            const double events = (double)s.log->count;
            CHECK_CLOSE(symplectic(a, b, ROWS), before[k][l],
                        sqrt(events) * 8 * DBL_EPSILON * size);
        }
    hd_event_log_free(s.log);
}

TEST(maps_are_symplectic)
{
    check_symplectic(P);
    check_symplectic(R);
}

/** Uniform dq, uniform dp, dq = p and dp = p are carried into vectors known in closed form. */
TEST(zero_modes_stay_zero_modes)
{
    enum { DISKS = 30, ROWS = 4 * DISKS };
    const double time = 1.0,
                 tolerance = 1e-10; /* eps * e^(lambda_1 t) at lambda_1 t = 7, |p| = 8 */
    scene_log s = logged(DISKS, P, time);
    MADE(hd_frame, frame, DISKS, 6, 1, 1);
    double *v = hd_frame_data(frame);
    const int stride = hd_frame_stride(frame);
    for (int i = 0; i < DISKS; i++)
        for (int c = 0; c < 2; c++) {
            double *dq = v + (4 * i + c) * stride, *dp = dq + 2 * stride;
            memset(dq, 0, (size_t)stride * sizeof *dq);
            memset(dp, 0, (size_t)stride * sizeof *dp);
            dq[c] = dp[2 + c] = 1.0;
            dq[4] = dp[5] = s.p[0][2 * i + c];
        }
    CHECK_OK(hd_frame_replay(frame, s.log, 0.0, time));
    v = hd_frame_data(frame);
    for (int i = 0; i < DISKS; i++)
        for (int c = 0; c < 2; c++) {
            const double *dq = v + (4 * i + c) * stride, *dp = dq + 2 * stride;
            const double p = s.p[1][2 * i + c];
            const double want_q[6] = {c == 0, c == 1,  c == 0 ? time : 0, c == 1 ? time : 0,
                                      p,      time * p};
            const double want_p[6] = {0, 0, c == 0, c == 1, 0, p};
            for (int k = 0; k < 6; k++) {
                CHECK_CLOSE(dq[k], want_q[k], tolerance);
                CHECK_CLOSE(dp[k], want_p[k], tolerance);
            }
        }
    hd_event_log_free(s.log);
}

/** Replays the log with `vectors` columns and `threads`, in pieces ending at cuts[]; column col. */
static void replayed(const scene_log *s, int vectors, int threads, const double *cuts, int col,
                     double *out)
{
    MADE(hd_frame, frame, s->scene.disks, vectors, 1, threads);
    double *v = hd_frame_data(frame);
    for (int row = 0; row < hd_frame_rows(frame); row++)
        for (int k = 0; k < vectors; k++)
            v[(size_t)row * (size_t)hd_frame_stride(frame) + (size_t)k] = cos(row * 1.7 + k * 0.3);
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
    enum { DISKS = 40, ROWS = 4 * DISKS };
    static const int counts[] = {1, 2, 3, 4, 5, 7, 8, 9, 16, 17, 31, 33, 63, 64, 65, 100, 129, 160};
    const double whole[] = {1.0, 0.0}, rounding = 1e3 * DBL_EPSILON; /* e^(lambda_1 t), no more */
    scene_log s = logged(DISKS, R, 1.0);
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
    hd_event_log_free(s.log);
}

TEST(pieces_make_the_whole)
{
    enum { DISKS = 40, ROWS = 4 * DISKS };
    scene_log s = logged(DISKS, P, 1.0);
    const double at_event = s.log->event[s.log->count / 2].t;
    const double whole[] = {1.0, 0.0}, two[] = {0.3, 1.0, 0.0}, event[] = {at_event, 1.0, 0.0};
    double one[ROWS], other[ROWS];
    replayed(&s, 8, 1, whole, 7, one);
    replayed(&s, 8, 1, two, 7, other);
    check_same(one, other, ROWS, 1e3 * DBL_EPSILON);
    replayed(&s, 8, 1, event, 7, other);
    check_same(one, other, ROWS, 1e3 * DBL_EPSILON);
    hd_event_log_free(s.log);
}

TEST(rewind_brings_the_vectors_back)
{
    enum { DISKS = 20, VECTORS = 70 };
    scene_log s = logged(DISKS, P, 0.5);
    MADE(hd_frame, frame, DISKS, VECTORS, 5, 2);
    const size_t size = (size_t)(hd_frame_rows(frame) * hd_frame_stride(frame)) * sizeof(double);
    HEAP double *before = malloc(size);
    memcpy(before, hd_frame_data(frame), size);
    CHECK_OK(hd_frame_replay(frame, s.log, 0.0, 0.5));
    assert_memory_not_equal(before, hd_frame_data(frame), size);
    hd_frame_rewind(frame);
    assert_memory_equal(before, hd_frame_data(frame), size);
    hd_event_log_free(s.log);
}

/** Neither an angle to nothing, nor a ratio to it. */
TEST(a_half_that_vanishes_has_no_angle)
{
    enum { DISKS = 2, VECTORS = 2 };
    double cosine[VECTORS], ratio[VECTORS];
    MADE(hd_frame, frame, DISKS, VECTORS, 9, 1);
    for (int row = 0; row < 4 * DISKS; row++)
        for (int col = 0; col < VECTORS; col++) /* column 0: dp = 0, column 1: dq = 0 */
            hd_frame_data(frame)[row * hd_frame_stride(frame) + col] = (row % 4 < 2) == (col == 0);
    hd_frame_halves(frame, cosine, ratio);
    assert_true(isnan(cosine[0]) && isnan(cosine[1]) && isnan(ratio[1]));
    CHECK_CLOSE(ratio[0], 0.0, 0.0);
}

TEST(halves_are_measured_per_column)
{
    enum { DISKS = 5, VECTORS = 20 };
    double cosine[VECTORS], ratio[VECTORS], v[4 * DISKS];
    MADE(hd_frame, frame, DISKS, VECTORS, 9, 1);
    for (int row = 0; row < 4 * DISKS; row++) /* column 3: dp = -2 dq */
        hd_frame_data(frame)[row * hd_frame_stride(frame) + 3] = row % 4 < 2 ? 1.5 : -3.0;
    hd_frame_halves(frame, cosine, ratio);
    CHECK_CLOSE(cosine[3], -1.0, 4 * DBL_EPSILON);
    CHECK_CLOSE(ratio[3], 2.0, 4 * DBL_EPSILON);
    for (int col = 0; col < VECTORS; col++) {
        double qq = 0, pp = 0, qp = 0;
        frame_column(frame, col, v);
        for (int row = 0; row < 4 * DISKS; row++) {
            qq += row % 4 < 2 ? v[row] * v[row] : 0;
            pp += row % 4 >= 2 ? v[row] * v[row] : 0;
            qp += row % 4 < 2 ? v[row] * v[row + 2] : 0;
        }
        CHECK_CLOSE(cosine[col], qp / sqrt(qq * pp), 8 * DBL_EPSILON);
        CHECK_CLOSE(ratio[col], sqrt(pp / qq), 8 * DBL_EPSILON * ratio[col]);
    }
}
