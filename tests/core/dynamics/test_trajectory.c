/** Trajectory: creation, refusal, cutting into intervals, bookkeeping. */
#include "base/memory.h"
#include "bodies.h"
#include "prepared.h"

/** Log times are sums of two rounded times of at most T. */
static const double TIME_ROUNDING = 2.0 * DBL_EPSILON;

enum { SCENES = 5 };
static hd_scene_def scene_number(int k)
{
    const hd_scene_def scene[SCENES] = {
        scene_of(2, 0.3, 1.0, P, P, 1),    scene_of(7, 0.5, 0.7, R, R, 2),
        scene_of(30, 0.8, 0.867, P, R, 3), scene_in_box(6, 9.0, 1.3, P, P, 4),
        scene_of(100, 0.05, 0.1, R, P, 5),
    };
    return scene[k];
}

/* ---- cutting into intervals ---------------------------------------------------------------- */

typedef struct whole {
    hd_scene_def def;
    double t_end;
    hd_record *log;
    double *state; /**< q[2N], p[2N] at t_end */
} whole;

static double *state_of(const hd_trajectory *tr)
{
    const size_t n = (size_t)hd_trajectory_particles(tr);
    double *state = calloc(4 * n, sizeof *state);
    assert_non_null(state);
    hd_trajectory_state(tr, state, state + 2 * n);
    return state;
}

static whole whole_run(int scene, double events)
{
    whole w = {.def = scene_number(scene), .log = new_log()};
    OWNED(hd_trajectory) *tr = trajectory_of(w.def);
    w.t_end = events / hd_trajectory_totals(tr).expected;
    CHECK_OK(trajectory_to(tr, w.log, w.t_end));
    assert_true(w.log->count > 100);
    w.state = state_of(tr);
    return w;
}

static void whole_free(whole *w)
{
    hd_record_free(w->log);
    free(w->state);
}

static void check_same_event(const hd_event *got, const hd_event *want, double t_begin)
{
    CHECK_CLOSE(got->i, want->i, 0.0);
    CHECK_CLOSE(got->j, want->j, 0.0);
    assert_memory_equal(got->n, want->n, sizeof got->n);
    assert_memory_equal(got->p, want->p, sizeof got->p);
    CHECK_CLOSE(t_begin + got->t, want->t, TIME_ROUNDING * want->t);
}

/** Runs w again, cut at cut[count] and its end, and expects the same events, times and state. */
static void check_cut(const whole *w, const double *cut, size_t count)
{
    OWNED(hd_trajectory) *tr = trajectory_of(w->def);
    OWNED(hd_record) *log = new_log();
    size_t number = 0;
    double t = 0;
    for (size_t k = 0; k <= count; k++) {
        const double t_next = k < count ? cut[k] : w->t_end;
        CHECK_OK(trajectory_to(tr, log, t_next));
        assert_true(hd_trajectory_time(tr) == t_next && log->duration == t_next - t);
        for (size_t e = 0; e < log->count; e++) {
            assert_true(number < w->log->count);
            assert_true(events_in(log)[e].t >= 0 && events_in(log)[e].t <= log->duration);
            check_same_event(&events_in(log)[e], &events_in(w->log)[number++], t);
        }
        t = t_next;
    }
    assert_int_equal(number, w->log->count);
    HEAP double *state = state_of(tr);
    assert_memory_equal(state, w->state, 4 * (size_t)w->def.number * sizeof *state);
}

static void check_equal_pieces(const whole *w, size_t pieces)
{
    HEAP double *cut = calloc(pieces, sizeof *cut);
    assert_non_null(cut);
    for (size_t k = 1; k < pieces; k++) cut[k - 1] = w->t_end * (double)k / (double)pieces;
    check_cut(w, cut, pieces - 1);
}

TEST(intervals_of_equal_length)
{
    for (int k = 0; k < SCENES; k++) {
        HELD(whole) w = whole_run(k, 3000.0);
        check_equal_pieces(&w, 1);
        check_equal_pieces(&w, 7);
        check_equal_pieces(&w, 5000);
    }
}

/** None is lost or doubled. */
TEST(intervals_cut_at_events)
{
    for (int k = 0; k < SCENES; k++) {
        HELD(whole) w = whole_run(k, 2000.0);
        HEAP double *cut = calloc(3 * w.log->count, sizeof *cut);
        size_t count = 0;
        assert_non_null(cut);
        for (size_t e = 0; e < w.log->count; e += 3) {
            const double t = events_in(w.log)[e].t;
            if (count && t < cut[count - 1]) continue; /* same instant as the event before */
            cut[count++] = t;
            if (e % 2) cut[count++] = t; /* an empty interval */
            if (e % 4 == 0 && nextafter(t, 1e300) < w.t_end) cut[count++] = nextafter(t, 1e300);
        }
        check_cut(&w, cut, count);
    }
}

TEST(event_at_the_end_belongs_to_the_next_interval)
{
    const hd_scene_def def = scene_in_box(2, 8.0, 8.0, P, P, 1);
    const double q[] = {2.0, 2.0, 5.0, 2.0}, p[] = {1, 0, -1, 0};
    OWNED(hd_trajectory) *tr = NULL;
    OWNED(hd_record) *log = new_log();
    CHECK_OK(hd_trajectory_create_from(&tr, &def, q, p));
    CHECK_OK(trajectory_to(tr, log, 1.0));
    assert_int_equal(log->count, 0);
    CHECK_OK(trajectory_to(tr, log, 1.0));
    assert_true(log->count == 0 && log->duration == 0);
    CHECK_OK(trajectory_to(tr, log, 1.5));
    assert_true(log->count == 1 && events_in(log)[0].t == 0);
}

/** Epochs are a power of two long: cuts at all multiples of every candidate, and a bit around them.
 */
TEST(intervals_cut_at_epochs)
{
    for (int k = 0; k < SCENES; k++) {
        HELD(whole) w = whole_run(k, 200.0 * scene_number(k).number);
        for (double epoch = ldexp(1.0, -4); epoch < w.t_end; epoch *= 2.0) {
            const size_t count = (size_t)(w.t_end / epoch);
            HEAP double *cut = calloc(3 * count, sizeof *cut);
            assert_non_null(cut);
            for (size_t c = 0; c < count; c++) {
                const double t = epoch * (double)(c + 1);
                cut[3 * c] = nextafter(t, 0.0);
                cut[3 * c + 1] = t;
                cut[3 * c + 2] = fmin(nextafter(t, 1e300), w.t_end);
            }
            check_cut(&w, cut, 3 * count);
        }
    }
}

TEST(log_may_be_left_out)
{
    for (int k = 0; k < SCENES; k++) {
        HELD(whole) w = whole_run(k, 3000.0);
        OWNED(hd_trajectory) *tr = trajectory_of(w.def);
        CHECK_OK(hd_trajectory_extend(tr, NULL, 0.3 * w.t_end));
        CHECK_OK(hd_trajectory_extend(tr, NULL, w.t_end));
        HEAP double *end = state_of(tr);
        assert_memory_equal(end, w.state, 4 * (size_t)w.def.number * sizeof *end);
        assert_true(hd_trajectory_totals(tr).collisions + hd_trajectory_totals(tr).wall_events ==
                    w.log->count);
    }
}

static void check_unit_vectors(const hd_event *e)
{
    const double unit = 4.0 * DBL_EPSILON; /* sqrt, two quotients, squares */
    CHECK_CLOSE(e->n[0] * e->n[0] + e->n[1] * e->n[1], 1.0, unit);
    if (e->j >= 0)
        assert_true(e->i < e->j && e->n[0] * e->p[0] + e->n[1] * e->p[1] < 0);
    else
        assert_true(e->j == HD_WALL_X ? e->n[0] == 1 && e->p[0] != 0
                                      : e->n[1] == 1 && e->p[1] != 0);
}

TEST(events_are_approaching_unit_contacts)
{
    for (int k = 0; k < SCENES; k++) {
        HELD(whole) w = whole_run(k, 20000.0);
        for (size_t e = 0; e < w.log->count; e++) check_unit_vectors(&events_in(w.log)[e]);
    }
}

/* ---- creation ------------------------------------------------------------------------------ */

TEST(starts_at_rest_of_the_centre)
{
    for (int k = 0; k < SCENES; k++) {
        const hd_scene_def def = scene_number(k);
        OWNED(hd_trajectory) *tr = trajectory_of(def);
        double *q = state_of(tr), *p = q + 2 * def.number, sum[2] = {0, 0};
        const double rounding = 4.0 * DBL_EPSILON * def.number;
        for (int i = 0; i < 2 * def.number; i++) sum[i % 2] += p[i];
        for (int d = 0; d < 2; d++)
            if (def.boundary[d] == P) CHECK_CLOSE(sum[d], 0.0, rounding);
        CHECK_CLOSE(hd_trajectory_examined(tr).kinetic_energy, def.number, rounding);
        assert_true(hd_trajectory_time(tr) == 0 && hd_trajectory_particles(tr) == def.number);
        assert_true(hd_trajectory_totals(tr).collisions == 0 &&
                    hd_trajectory_totals(tr).wall_events == 0);
        free(q);
    }
}

TEST(seeds_differ_and_repeat)
{
    const uint64_t seed[] = {1, 1, 2};
    double *p[3];
    for (int k = 0; k < 3; k++) {
        OWNED(hd_trajectory) *tr = trajectory_of(scene_from(scene_number(2), .seed = seed[k]));
        p[k] = state_of(tr);
    }
    const size_t bytes = 4 * (size_t)scene_number(2).number * sizeof *p[0];
    assert_memory_equal(p[0], p[1], bytes);
    assert_memory_not_equal(p[0], p[2], bytes);
    for (int k = 0; k < 3; k++) free(p[k]);
}

static hd_status start(hd_boundary boundary, const double q[4], const double p[4])
{
    const hd_scene_def def = scene_in_box(2, 8.0, 8.0, boundary, boundary, 1);
    OWNED(hd_trajectory) *tr = (hd_trajectory *)&def;
    const hd_status status = hd_trajectory_create_from(&tr, &def, q, p);
    if (status != HD_OK) assert_null(tr);
    return status;
}

TEST(prepared_states_are_checked)
{
    const double bad[] = {NAN, INFINITY, -INFINITY, -0.001, 8.001, 1e300};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++)
        for (int c = 0; c < 4; c++) {
            double q[] = {2.0, 2.0, 6.0, 6.0}, p[] = {1, 0, -1, 0};
            assert_int_equal(start(P, q, p), HD_OK);
            q[c] = bad[k];
            assert_int_equal(start(P, q, p), HD_REFUSED);
            q[c] = 2.0;
            p[c] = bad[k];
            if (!isfinite(bad[k])) assert_int_equal(start(P, q, p), HD_REFUSED);
        }
    const double in_wall[] = {0.4999, 2.0, 6.0, 6.0}, at_wall[] = {0.5, 7.5, 6.0, 6.0}, p[4] = {0};
    assert_int_equal(start(R, in_wall, p), HD_REFUSED);
    assert_int_equal(start(P, in_wall, p), HD_OK);
    assert_int_equal(start(R, at_wall, p), HD_OK);
}

/** Depth 1e-9 is where rounding ends and overlap begins; also through an edge, and never a wall. */
TEST(overlap_is_refused)
{
    const double p[4] = {0}, allowed = 1e-9;
    const double touching[] = {2.0, 2.0, 3.0, 2.0},
                 shallow[] = {2.0, 2.0, 3.0 - 0.9 * allowed, 2.0};
    const double deep[] = {2.0, 2.0, 3.0 - 1.1 * allowed, 2.0}, same[] = {2.0, 2.0, 2.0, 2.0};
    const double over_edge[] = {0.25, 2.0, 7.5, 2.0}, over_corner[] = {0.25, 0.25, 7.75, 7.75};
    assert_int_equal(start(P, touching, p), HD_OK);
    assert_int_equal(start(P, shallow, p), HD_OK);
    assert_int_equal(start(P, deep, p), HD_OVERLAP);
    assert_int_equal(start(P, same, p), HD_OVERLAP);
    assert_int_equal(start(P, over_edge, p), HD_OVERLAP);
    assert_int_equal(start(P, over_corner, p), HD_OVERLAP);
    const double by_the_walls[] = {0.5, 2.0, 7.5, 2.0};
    assert_int_equal(start(R, by_the_walls, p), HD_OK);
}

/** Two of six disks in one of four cells overlap, whichever they are: two disks have places of
 * their own there, the others are in a list. */
TEST(overlap_in_a_crowded_cell_is_refused)
{
    enum { DISKS = 6 };
    const hd_scene_def def = scene_in_box(DISKS, 100.0, 100.0, P, P, 1);
    const double p[2 * DISKS] = {0};
    for (int a = 0; a < DISKS; a++)
        for (int b = 0; b < DISKS; b++) {
            double q[2 * DISKS];
            OWNED(hd_trajectory) *tr = NULL;
            for (int k = 0; k < DISKS; k++) q[2 * k] = 5.0 + 7.0 * k, q[2 * k + 1] = 20.0;
            if (b != a) q[2 * b] = q[2 * a] + 0.9;
            const hd_status status = hd_trajectory_create_from(&tr, &def, q, p);
            assert_int_equal(status, b == a ? HD_OK : HD_OVERLAP);
        }
}

/** Disks keep the turns that they have made since they collided: of two that both have made some.
 */
TEST(overlap_is_seen_after_turns_around_the_box)
{
    enum { DISKS = 200 };
    OWNED(hd_trajectory) *tr = trajectory_of(scene_of(DISKS, 0.05, 0.1, P, P, 3));
    double q[2 * DISKS], box[2], least = INFINITY, way[2] = {0.0};
    hd_disk *moved = NULL, *disk = hard_in(tr)->motion.disk;
    CHECK_OK(trajectory_to(tr, NULL, 50.0));
    hd_trajectory_state(tr, q, NULL);
    box_around(tr, box);
    for (int i = 0; i < DISKS; i++)
        for (int j = 0; j < i; j++) {
            double r[2];
            if (disk[i].wrap[1] == 0 || disk[j].wrap[1] == 0) continue;
            for (int d = 0; d < 2; d++) {
                r[d] = q[2 * j + d] - q[2 * i + d];
                r[d] -= box[d] * round(r[d] / box[d]);
            }
            if (hypot(r[0], r[1]) >= least) continue;
            least = hypot(r[0], r[1]);
            moved = &disk[i];
            memcpy(way, r, sizeof way);
        }
    assert_true(least < 3.8); /* an edge of a cell */
    for (int d = 0; d < 2; d++) moved->q[d] += (1.0 - 0.9 / least) * way[d];
    CHECK_WITHIN(hd_trajectory_examined(tr).overlap, 0.1 - 1e-12, 1.0);
}

TEST(refused_scenes_give_nothing)
{
    hd_scene_def def = hd_scene_def_default();
    hd_trajectory *tr = (hd_trajectory *)&def;
    def.density = 1.15;
    assert_int_equal(hd_trajectory_create(&tr, &def), HD_REFUSED);
    assert_null(tr);
    hd_trajectory_free(NULL);
    hd_record_free(NULL);
}

/* ---- memory and size ----------------------------------------------------------------------- */

TEST(warm_log_allocates_nothing)
{
    for (int k = 0; k < SCENES; k++) {
        OWNED(hd_trajectory) *tr = trajectory_of(scene_number(k));
        OWNED(hd_record) *log = new_log();
        const double piece = 1000.0 / hd_trajectory_totals(tr).expected;
        double t = 4.0 * piece;
        CHECK_OK(trajectory_to(tr, log, t)); /* grows to more than it will need */
        const size_t allocations = hd_memory_allocations();
        for (int n = 0; n < 100; n++) CHECK_OK(trajectory_to(tr, log, t += piece));
        assert_int_equal(hd_memory_allocations(), allocations);
    }
}

TEST(a_million_disks)
{
    OWNED(hd_trajectory) *tr = trajectory_of(scene_of(1000000, 0.7, 0.8, P, R, 1));
    OWNED(hd_record) *log = new_log();
    const double t = 5e5 / hd_trajectory_totals(tr).expected;
    CHECK_OK(trajectory_to(tr, log, t));
    assert_true(hd_trajectory_examined(tr).overlap < 1e-9);
    assert_true(hd_trajectory_totals(tr).collisions > 50000);
}
