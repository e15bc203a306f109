/** What the forward pass leaves comes back as it was. */
#include "covariant/backward.h"
#include "forward_pass.h"
#include "base/memory.h"
#include "covariant/history.h"
#include "triangles.h"

enum { DISKS = 6, INTERVALS = 24, SNAPSHOTS = 8, STEPS = 150 };

static hd_history_def def_of(int vectors)
{
    return (hd_history_def){.particles = DISKS,
                            .vectors = vectors,
                            .threads = 1,
                            .intervals = INTERVALS,
                            .snapshots = SNAPSHOTS,
                            .of = DYNAMICS};
}

/** What each interval left. */
typedef struct left {
    double *factor, *vectors, q[2 * DISKS], p[2 * DISKS], time, length;
} left;

typedef struct forward {
    forward_pass f;
    hd_history *past;
    left left[STEPS];
    long end;
} forward;

static forward *started(int exponents)
{
    forward *x = calloc(1, sizeof *x);
    x->f = forward_started(
        scene(.number = DISKS, .density = 0.5, .aspect = 0.9, .seed = 3, .exponents = exponents),
        1);
    for (int warmup = 0; warmup < 20; warmup++) forward_interval(&x->f, 0.5);
    const hd_history_def def = def_of(forward_vectors(&x->f));
    CHECK_OK(hd_history_create(&x->past, &def, PARTICLES(DISKS)));
    hd_history_begin(x->past, hd_trajectory_time(x->f.trajectory));
    return x;
}

static void forget(forward *x)
{
    for (long k = 0; k < x->end; k++) {
        free(x->left[k].factor);
        free(x->left[k].vectors);
    }
    x->end = 0;
}

static void freed(forward *x)
{
    forget(x);
    hd_history_free(x->past);
    forward_pass_free(&x->f);
    free(x);
}

/** One interval: from t_begin to t_end of the log, which the frame is yet to be carried through. */
static void add_piece(forward *x, double t_begin, double t_end, bool snapshot)
{
    const hd_record *log = x->f.log;
    left *new = &x->left[x->end++];
    CHECK_OK(hd_frame_replay(x->f.frame, log, t_begin, t_end));
    forward_factor(&x->f);
    new->factor = triangle_copy(hd_ortho_factor(x->f.ortho), forward_vectors(&x->f));
    new->vectors = forward_copy(&x->f);
    new->length = t_end - t_begin;
    new->time = hd_trajectory_time(x->f.trajectory) - log->duration + t_end;
    hd_trajectory_state(x->f.trajectory, new->q,
                        new->p); /* of the log's end: whatever they are, they come back */
    assert_false(hd_history_is_full(x->past));
    CHECK_OK(hd_history_add(x->past, hd_ortho_factor(x->f.ortho), x->f.frame, log, t_begin, t_end));
    if (snapshot)
        CHECK_OK(hd_history_snapshot(x->past, hd_frame_columns(x->f.frame), new->q, new->p));
}

/** One interval or, as a log that was too long, two; a snapshot is that of every third. */
static void add(forward *x, double length, bool cut)
{
    const double end = hd_trajectory_time(x->f.trajectory) + length;
    CHECK_OK(trajectory_to(x->f.trajectory, x->f.log, end));
    const double duration = x->f.log->duration, first = cut ? 0.4 * duration : duration;
    add_piece(x, 0.0, first, x->end % 3 == 0);
    if (cut) add_piece(x, first, duration, x->end % 3 == 0);
}

static void check_snapshot(const forward *x, hd_history *past, long interval)
{
    const left *want = &x->left[interval];
    const size_t size = 4 * DISKS * (size_t)forward_vectors(&x->f);
    double *vectors = malloc(size * sizeof *vectors), q[2 * DISKS], p[2 * DISKS];
    hd_history_vectors(past, vectors, q, p, interval);
    assert_memory_equal(vectors, want->vectors, size * sizeof *vectors);
    assert_memory_equal(q, want->q, sizeof q);
    assert_memory_equal(p, want->p, sizeof p);
    free(vectors);
}

/** Backwards; intervals first .. end - 1, a snapshot at the end of every third. */
static void check_past(const forward *x, long first)
{
    const int n = forward_vectors(&x->f);
    hd_history *past = x->past;
    HEAP double *found = malloc((size_t)(n * n) * sizeof *found);
    assert_int_equal(hd_history_first(past), first);
    assert_int_equal(hd_history_end(past), x->end);
    for (long k = x->end - 1; k >= first; k--) {
        CHECK_CLOSE(hd_history_time(past, k), x->left[k].time, 64 * DBL_EPSILON * x->left[k].time);
        CHECK_CLOSE(hd_history_length(past, k), x->left[k].length, 0.0);
        hd_history_factor(past, found, NULL, k);
        check_same_triangle(found, x->left[k].factor, n);
        assert_int_equal(hd_history_has_snapshot(past, k), k % 3 == 0);
        if (k % 3 == 0) check_snapshot(x, past, k);
    }
}

/** The rings wrap several times; what is dropped makes room, up to the interval that ends at that
 * very time. */
static void check_rings(int exponents)
{
    forward *x = started(exponents);
    long first = 0;
    while (x->end + 1 < STEPS) {
        add(x, 0.3 + 0.05 * (double)(x->end % 5), x->end % 4 == 1);
        if (x->end - first < INTERVALS - 2) continue;
        check_past(x, first);
        first += 7;
        hd_history_drop(x->past, hd_history_time(x->past, first - 1));
        check_past(x, first);
    }
    freed(x);
}

TEST(what_was_left_comes_back)
{
    check_rings(HD_EXPONENTS_ALL_INDEPENDENT);
    check_rings(5);
    check_rings(1);
}

TEST(a_past_is_full_with_so_many_intervals)
{
    forward *x = started(HD_EXPONENTS_ALL_INDEPENDENT);
    while (x->end < INTERVALS) add(x, 0.2, false);
    assert_true(hd_history_is_full(x->past));
    check_past(x, 0);
    hd_history_drop(x->past, 0.5 * (x->left[0].time + x->left[1].time));
    assert_int_equal(hd_history_first(x->past), 1);
    assert_false(hd_history_is_full(x->past));
    freed(x);
}

TEST(a_new_beginning_forgets_everything)
{
    forward *x = started(HD_EXPONENTS_ALL_INDEPENDENT);
    for (int again = 0; again < 4; again++) {
        hd_history_begin(x->past, hd_trajectory_time(x->f.trajectory));
        assert_int_equal(hd_history_end(x->past), 0);
        forget(x);
        while (x->end < 9 + 2 * again) add(x, 0.2, false);
        check_past(x, 0);
    }
    freed(x);
}

/** By what is in it: triangles, and snapshots of vectors and disks; and what keeps the order of
 * them. */
TEST(the_room_is_stated)
{
    const int n = 4 * DISKS;
    const hd_history_def def = def_of(n);
    const double snapshots = 8.0 * SNAPSHOTS * (n * n + n);
    const double order = 64.0, triangles = 8.0 * INTERVALS * n * (n + 1) / 2;
    CHECK_WITHIN(hd_history_bytes(&def) - triangles - snapshots, 0.0, order * INTERVALS);
}

/** Beyond the first round a past takes no more memory. */
TEST(a_ring_takes_its_memory_once)
{
    forward *x = started(HD_EXPONENTS_ALL_INDEPENDENT);
    const int n = forward_vectors(&x->f);
    HEAP double *factor = malloc((size_t)(n * n) * sizeof *factor);
    size_t before = 0;
    hd_history *past = x->past;
    for (int k = 0; k < 6 * INTERVALS; k++) {
        if (hd_history_is_full(past))
            hd_history_drop(past, hd_history_time(past, hd_history_first(past) + 5));
        forward_interval(&x->f, 0.25);
        const hd_columns columns = hd_frame_columns(x->f.frame);
        const double q[2 * DISKS] = {0};
        if (k == 2 * INTERVALS) before = hd_memory_allocations();
        const size_t outside = hd_memory_allocations();
        CHECK_OK(hd_history_add(past, hd_ortho_factor(x->f.ortho), x->f.frame, x->f.log, 0.0,
                                x->f.log->duration));
        CHECK_OK(hd_history_snapshot(past, columns, q, q));
        hd_history_factor(past, factor, NULL,
                          hd_history_end(past) - 2 < 0 ? 0 : hd_history_end(past) - 2);
        if (before > 0) assert_int_equal(hd_memory_allocations(), outside);
    }
    freed(x);
}
