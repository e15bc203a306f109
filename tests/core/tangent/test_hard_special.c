/** Numbers at the ends of the range: momenta of 1e-300, disks at rest, positions on edges, zeros of
 * either sign, vectors so short that their squares vanish. Nothing becomes NaN or infinite, and
 * what cannot be told is refused. */
#include "prepared.h"
#include "tangent.h"
#include "twin.h"

enum { DISKS = 4 };

typedef struct special {
    const char *what;
    double q[2 * DISKS], p[2 * DISKS];
    long events; /**< at least, within END; 0: none at all */
} special;

static const double END = 64.0;

/** In a box of 8 x 8; cells are 4 wide. */
static const special SPECIAL[] = {
    {"all hardly move",
     {2, 2, 6, 2, 2, 6, 6, 6},
     {1e-300, 0, -1e-300, 1e-300, 0, -1e-300, 1e-300, 1e-300},
     0},
    {"denormal momenta",
     {2, 2, 3, 2, 2, 3, 6, 6},
     {5e-324, 0, -5e-324, 0, 0, -5e-324, 1e-310, 1e-310},
     0},
    {"touching, and their square a denormal number",
     {2, 2, 3, 2, 2, 6, 6, 6},
     {1e-155, 1e-156, -1e-155, 1e-155, 0, 0, 0, 0},
     1},
    {"one moves into three that hardly do",
     {2, 2, 6, 2, 2, 6, 6, 6},
     {1, 0.01, 1e-300, 0, 0, 1e-300, -1e-300, 1e-300},
     2},
    {"one moves", {2, 2, 6, 2, 2, 6, 6, 6}, {1, 0.02, 0, 0, 0, 0, 0, 0}, 2},
    {"one is at rest", {2, 2, 6, 2, 2, 6, 6, 6}, {1, 0.3, 0, 0, -0.5, -0.7, 0.2, -0.9}, 2},
    {"along an axis", {2, 2, 6, 2, 2, 6, 6, 5.5}, {1, 0, -1, 0, 0, -1, 0, 1}, 2},
    {"along an axis, zeros negative",
     {2, 2, 6, 2, 2, 6, 6, 5.5},
     {1, -0.0, -1, -0.0, -0.0, -1, -0.0, 1},
     2},
    {"on cell edges", {4, 2, 2, 4, 4, 4, 6, 4}, {0, 1, 1, 0, 1, 1, -1, 0}, 2},
    {"along cell edges", {4, 1, 4, 3, 4, 5, 4, 7}, {0, 1, 0, -1, 0, 1, 0, -1}, 2},
    {"speeds 1e6 apart", {2, 2, 6, 2, 2, 6, 6, 6}, {1e3, 77, -1e-3, 0, 0, 1e-3, 1e-3, 1e-3}, 1000},
};
enum { SPECIALS = sizeof SPECIAL / sizeof *SPECIAL };

static void check_finite(const hd_event_log *log)
{
    for (size_t k = 0; k < log->count; k++) {
        const hd_event *e = &log->event[k];
        assert_true(isfinite(e->t + e->n[0] + e->n[1] + e->p[0] + e->p[1]));
        assert_true(k == 0 || e->t >= log->event[k - 1].t);
    }
}

/** The map of the first events: each of a size that leaves S^T J S comparable to J. */
static void check_first_maps(hd_event_log *log)
{
    hd_event_log first = *log;
    if (first.count == 0) return;
    first.count = first.count < 3 ? first.count : 3;
    first.duration = first.event[first.count - 1].t;
    check_symplectic_map(&first, DISKS);
}

static void check_special(const special *s, const hd_scene_def *def)
{
    OWNED(hd_trajectory) *tr = started(def, s->q, s->p);
    OWNED(hd_event_log) *log = new_log();
    double q[2 * DISKS], p[2 * DISKS];
    const double energy = hd_trajectory_kinetic_energy(tr);
    CHECK_OK(trajectory_to(tr, log, END));
    hd_trajectory_state(tr, q, p);
    for (int k = 0; k < 2 * DISKS; k++) assert_true(isfinite(q[k] + p[k]));
    check_finite(log);
    check_first_maps(log);
    const double rounding = 8.0 * DBL_EPSILON * energy * (double)(log->count + 1);
    CHECK_CLOSE(hd_trajectory_kinetic_energy(tr), energy, rounding);
    const long pairs = (long)hd_trajectory_collisions(tr);
    const long events = pairs + (long)hd_trajectory_wall_events(tr);
    assert_true(s->events ? events >= s->events : pairs == 0);
    if (s->events) twin_compare(started(def, s->q, s->p), def, (size_t)s->events);
}

TEST(special_states_stay_finite)
{
    for (int k = 0; k < 2 * SPECIALS; k++) {
        const hd_boundary boundary = k % 2 ? R : P;
        const hd_scene_def def = scene_in_box(DISKS, 8.0, 8.0, boundary, boundary, 1);
        check_special(&SPECIAL[k / 2], &def);
    }
}

/** However long: nothing happens. */
TEST(disks_at_rest_stay_there)
{
    const double p[2 * DISKS] = {0, -0.0};
    for (int k = 0; k < 2 * SPECIALS; k++) {
        const hd_boundary boundary = k % 2 ? R : P;
        const hd_scene_def def = scene_in_box(DISKS, 8.0, 8.0, boundary, boundary, 1);
        const double *q = SPECIAL[k / 2].q;
        OWNED(hd_trajectory) *tr = started(&def, q, p);
        double now[2 * DISKS];
        for (double t = 1.0; t < 1e300; t *= 1e15) CHECK_OK(hd_trajectory_extend(tr, NULL, t));
        hd_trajectory_state(tr, now, NULL);
        assert_memory_equal(now, q, sizeof now);
        assert_int_equal(hd_trajectory_collisions(tr) + hd_trajectory_wall_events(tr), 0);
    }
}

/** At the origin, a zero of either sign, and on the far edge, which is the same place. */
TEST(edges_of_the_box_are_one_place)
{
    const hd_scene_def def = scene_in_box(2, 8.0, 8.0, P, P, 1);
    const double edge[] = {0.0, -0.0, 8.0};
    hd_event_log *log[3];
    for (int k = 0; k < 3; k++) {
        const double q[] = {edge[k], edge[k], 3.0, 0.5}, p[] = {1, 0, -0.5, 0.0};
        log[k] = log_of(&def, q, p, 20.0);
        assert_true(log[k]->count >= 1);
        for (int c = 0; c < 2; c++) { /* positions of size 8, a few roundings */
            CHECK_CLOSE(log[k]->event[0].n[c], log[0]->event[0].n[c], 64.0 * DBL_EPSILON);
            CHECK_CLOSE(log[k]->event[0].p[c], log[0]->event[0].p[c], 0.0);
        }
        CHECK_CLOSE(log[k]->event[0].t, log[0]->event[0].t, 64.0 * DBL_EPSILON);
    }
    assert_int_equal(log[0]->count, log[1]->count);
    assert_memory_equal(log[0]->event, log[1]->event, log[0]->count * sizeof *log[0]->event);
    for (int k = 0; k < 3; k++) hd_event_log_free(log[k]);
}

enum { FRAME_DISKS = 12, ROWS = 4 * FRAME_DISKS };

/** Maps are linear: 2^-1030 of a vector becomes 2^-1030 of what it becomes, but for what denormal
 * numbers, known to 2^-1074, lose at each of ten operations an event and disk, stretched by what
 * follows. */
TEST(denormal_vectors_are_carried_as_others)
{
    const hd_scene_def def = scene_of(FRAME_DISKS, 0.5, 1.0, P, R, 3);
    const double small = ldexp(1.0, -1030);
    OWNED(hd_event_log) *log = new_log();
    double a[ROWS], b[ROWS];
    MADE(hd_trajectory, tr, &def);
    CHECK_OK(trajectory_to(tr, log, 1.0));
    MADE(hd_frame, frame, FRAME_DISKS, 2, 1, 1);
    for (int row = 0; row < ROWS; row++)
        *frame_entry(frame, row, 1) = small * *frame_entry(frame, row, 0);
    CHECK_OK(hd_frame_replay(frame, log, 0.0, 1.0));
    frame_column(frame, 0, a);
    frame_column(frame, 1, b);
    const double stretch = sqrt(dot(a, a, ROWS)),
                 lost = 10.0 * (double)log->count * ldexp(1.0, -1074);
    for (int row = 0; row < ROWS; row++) CHECK_CLOSE(b[row], small * a[row], lost * stretch);
}

typedef enum shape { INDEPENDENT, NEARLY_DEPENDENT, DEPENDENT } shape;

/** Orthonormal vectors; the last one may be the first plus a bit of itself. Returns what ln R of
 * the last becomes. */
static double shape_frame(hd_frame *frame, shape how)
{
    const double bit = how == DEPENDENT ? 0.0 : 1e-6;
    const int last = hd_frame_vectors(frame) - 1;
    if (how == INDEPENDENT || last == 0) return 0.0;
    for (int row = 0; row < ROWS; row++)
        *frame_entry(frame, row, last) = *frame_entry(frame, row, 0) +
                                         bit * *frame_entry(frame, row, last);
    return log(bit);
}

typedef struct scaled {
    int vectors, power, stable;
    shape how;
} scaled;

/** Times 2^power: factored rightly, or refused. The logarithms of such scales are of size 700, and
 * the bit of the last vector is known to eps / 1e-6. Returns 1 if it is factored. */
static int check_scaled(const scaled *s)
{
    const hd_ortho_limits twice = {1e9, DBL_EPSILON, HD_NORM_FULL};
    const double known = s->how == INDEPENDENT ? 1e-12 : 1e-8;
    double before[ROWS], after[ROWS];
    MADE(hd_frame, frame, FRAME_DISKS, s->vectors, 3, 1);
    MADE(hd_ortho, ortho, ROWS, s->vectors);
    CHECK_OK(hd_ortho_step(ortho, frame, twice));
    frame_column(frame, s->vectors - 1, before);
    const double last = shape_frame(frame, s->how);
    for (int row = 0; row < ROWS; row++)
        for (int col = 0; col < s->vectors; col++)
            *frame_entry(frame, row, col) = ldexp(*frame_entry(frame, row, col), s->power);
    const hd_status status = s->stable ? hd_ortho_step_stable(ortho, frame, 1e13)
                                       : hd_ortho_step(ortho, frame, twice);
    if (status == HD_OK) {
        for (int col = 0; col < s->vectors; col++)
            CHECK_CLOSE(hd_ortho_log_stretch(ortho)[col],
                        s->power * log(2.0) + (col == s->vectors - 1 ? last : 0.0), known);
        frame_column(frame, s->vectors - 1, after);
        for (int row = 0; row < ROWS; row++) CHECK_CLOSE(after[row], before[row], known);
    } else {
        assert_int_equal(status, HD_ILL_CONDITIONED);
    }
    return status == HD_OK;
}

/** Finer where squares begin to underflow or overflow. */
static int step_from(int power)
{
    if (abs(power) >= 480 && abs(power) <= 560) return HD_SANITIZED ? 9 : 1;
    return HD_SANITIZED ? 53 : 13;
}

/** Everything that a run can come to, e^150 either way, is factored; from 2^-1074 to 2^1000 nothing
 * is wrong. */
TEST(vectors_of_any_length_are_factored_or_refused)
{
    const int vectors[] = {1, 2, 8, 20, 40};
    int count[2] = {0, 0};
    for (int k = 0; k < 5 * 2 * 3; k++)
        for (int power = -1074; power <= 1000; power += step_from(power)) {
            const scaled s = {vectors[k % 5], power, k / 5 % 2, (shape)(k / 10)};
            const int factored = check_scaled(&s);
            count[factored]++;
            if (abs(power) < 217 && (s.how != DEPENDENT || s.vectors == 1)) assert_true(factored);
            if (s.how == DEPENDENT && s.vectors > 1) assert_false(factored);
        }
    assert_true(count[0] > 100 && count[1] > 100);
}
