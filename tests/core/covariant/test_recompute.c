/** Triangles that are computed again are those of the forward pass. */
#include "covariant/backward.h"
#include "forward_pass.h"
#include "covariant/recompute.h"
#include "triangles.h"
#include "tangent/interval.h"

enum { DISKS = 8, STRETCH = 4, SLOTS = 5 * STRETCH, KEPT = SLOTS - STRETCH, INTERVALS = 67 };

static hd_scene_def small(int exponents)
{
    return scene(.number = DISKS, .density = 0.5, .aspect = 0.9, .boundary[1] = R, .seed = 3,
                 .exponents = exponents);
}

static hd_recompute *created(int disks, int vectors, long slots, long stretch)
{
    const hd_recompute_def def = {.rows = 4 * disks,
                                  .vectors = vectors,
                                  .threads = 1,
                                  .slots = slots,
                                  .stretch = stretch,
                                  .of = DYNAMICS,
                                  .events = 1e4};
    hd_recompute *r;
    CHECK_OK(hd_recompute_create(&r, &def));
    return r;
}

/** The forward pass, and the triangles it left. */
typedef struct kept {
    forward_pass f;
    hd_recompute *r;
    double *factor[2 * INTERVALS];
    long end;
} kept;

/** [t_begin, t_end) of the log, its triangle, and the frame after it. */
static void add_piece(kept *k, double t_begin, double t_end)
{
    CHECK_OK(hd_frame_replay(k->f.frame, k->f.log, t_begin, t_end));
    forward_factor(&k->f);
    CHECK_OK(hd_recompute_events(k->r, k->end % SLOTS, k->f.log, t_begin, t_end));
    k->factor[k->end++] = triangle_copy(hd_ortho_factor(k->f.ortho), forward_vectors(&k->f));
    CHECK_OK(hd_recompute_frame(k->r, k->end % SLOTS, hd_frame_columns(k->f.frame)));
}

static kept *started(int exponents)
{
    kept *k = calloc(1, sizeof *k);
    k->f = forward_started(small(exponents), 1);
    k->r = created(DISKS, forward_vectors(&k->f), SLOTS, STRETCH);
    for (int warmup = 0; warmup < 20; warmup++) forward_interval(&k->f, 0.5);
    CHECK_OK(hd_recompute_frame(k->r, 0, hd_frame_columns(k->f.frame)));
    return k;
}

static void freed(kept *k)
{
    forward_pass_free(&k->f);
    hd_recompute_free(k->r);
    for (long i = 0; i < k->end; i++) free(k->factor[i]);
    free(k);
}

/** The events' times are those since the piece began, known to eps of their log; Q follows its
 * neighbours as the condition says, from where its stretch begins. */
static double rounding_of(const kept *k) { return 64.0 * DBL_EPSILON * STRETCH * k->f.worst; }

static void check_slot(kept *k, double *found, long interval)
{
    const long last = k->end - 1, slot = interval % SLOTS, to_wrap = SLOTS - 1 - slot;
    const long ahead = last - interval;
    CHECK_OK(
        hd_recompute_factor(k->r, found, NULL, slot, slot + (ahead < to_wrap ? ahead : to_wrap)));
    check_triangle(found, k->factor[interval], forward_vectors(&k->f), rounding_of(k));
}

/** Backwards, as the way back does. */
static void check_all(kept *k)
{
    const long first = k->end > KEPT ? k->end - KEPT : 0;
    const size_t n = (size_t)forward_vectors(&k->f);
    HEAP double *found = malloc(n * n * sizeof *found);
    for (long interval = k->end - 1; interval >= first; interval--) check_slot(k, found, interval);
}

/** The ring wraps several times, is read now and then in between, and some logs are cut into
 * pieces. */
static void check_ring(int exponents)
{
    kept *k = started(exponents);
    for (int interval = 0; interval < INTERVALS; interval++) {
        const double length = 0.3 + 0.1 * (interval % 3),
                     begin = hd_trajectory_time(k->f.trajectory);
        CHECK_OK(trajectory_to(k->f.trajectory, k->f.log, begin + length));
        assert_true(k->f.log->duration > 0.0);
        const double duration = k->f.log->duration,
                     cut = interval % 4 == 1 ? 0.4 * duration : duration;
        add_piece(k, 0.0, cut);
        if (cut < duration) add_piece(k, cut, duration);
        if (interval == 2 || interval % 9 == 0)
            check_all(k); /* also of a stretch that goes on afterwards */
    }
    assert_true(k->end > 4 * SLOTS);
    check_all(k);
    freed(k);
}

TEST(triangles_are_those_of_the_forward_pass)
{
    check_ring(HD_EXPONENTS_ALL_INDEPENDENT);
    check_ring(HD_EXPONENTS_POSITIVE);
    check_ring(1);
}

/** What products can factor is not factored by reflections here: the same bits. Panel by panel they
 * can in all, where the whole is far worse than one panel may be. */
TEST(what_passed_passes_again)
{
    const hd_ortho_limits limits = {HD_CONDITION_MAX, 1e-6, HD_NORM_FULL};
    kept *k = started(HD_EXPONENTS_ALL_INDEPENDENT);
    const int n = forward_vectors(&k->f);
    HEAP double *found = malloc((size_t)n * (size_t)n * sizeof *found);
    CHECK_OK(trajectory_to(k->f.trajectory, k->f.log, hd_trajectory_time(k->f.trajectory) + 3.2));
    CHECK_OK(hd_frame_replay(k->f.frame, k->f.log, 0.0, k->f.log->duration));
    CHECK_OK(hd_ortho_step(k->f.ortho, k->f.frame, limits));
    assert_true(hd_ortho_condition(k->f.ortho) > 1e8);
    CHECK_OK(hd_recompute_events(k->r, 0, k->f.log, 0.0, k->f.log->duration));
    CHECK_OK(hd_recompute_factor(k->r, found, NULL, 0, 0));
    check_same_triangle(found, hd_ortho_factor(k->f.ortho), n);
    freed(k);
}

/** Two disks that meet at these times, a normal turned a little further each time; `graze` is -p.n
 * of the second. */
static void write_log(hd_record *log, const double *times, int count, double duration, double graze)
{
    static hd_event event[8];
    for (int k = 0; k < count; k++) {
        const double turn = 0.7 * k, nx = cos(turn), ny = sin(turn), b = k == 1 ? -graze : -0.8;
        event[k] = (hd_event){.t = times[k],
                              .i = 0,
                              .j = 1,
                              .n = {nx, ny},
                              .p = {b * nx - 0.9 * ny, b * ny + 0.9 * nx}};
    }
    *log = record_of(event, (size_t)count, duration);
}

typedef struct pair {
    hd_frame *frame;
    hd_ortho *ortho;
    hd_recompute *r;
} pair;

enum { PAIR = 2, WIDE = 4 * PAIR };

static pair pair_created(void)
{
    pair p;
    CHECK_OK(hd_frame_create(&p.frame, DYNAMICS, PAIR, WIDE, 5, 1));
    CHECK_OK(hd_ortho_create(&p.ortho, WIDE, WIDE));
    CHECK_OK(hd_ortho_keep_factor(p.ortho));
    CHECK_OK(hd_ortho_step(p.ortho, p.frame, FORWARD_LIMITS));
    p.r = created(PAIR, WIDE, 2, 2);
    CHECK_OK(hd_recompute_frame(p.r, 0, hd_frame_columns(p.frame)));
    return p;
}

static void pair_free(pair *p)
{
    hd_frame_free(p->frame);
    hd_ortho_free(p->ortho);
    hd_recompute_free(p->r);
}

/** One event just at the cut, one at the log's end: both are the second piece's. */
TEST(an_event_at_a_cut_is_the_next_piece_s)
{
    const double times[] = {0.0, 0.25, 0.5, 1.0}, cut[] = {0.0, 0.5, 1.0};
    HELD(pair) p = pair_created();
    hd_record log;
    double *want[2], found[WIDE * WIDE];
    write_log(&log, times, 4, 1.0, 0.8);
    for (int slot = 0; slot < 2; slot++) {
        CHECK_OK(hd_frame_replay(p.frame, &log, cut[slot], cut[slot + 1]));
        CHECK_OK(hd_ortho_step(p.ortho, p.frame, FORWARD_LIMITS));
        want[slot] = triangle_copy(hd_ortho_factor(p.ortho), WIDE);
        CHECK_OK(hd_recompute_events(p.r, slot, &log, cut[slot], cut[slot + 1]));
    }
    for (int slot = 1; slot >= 0; slot--) {
        CHECK_OK(hd_recompute_factor(p.r, found, NULL, slot, 1));
        check_same_triangle(found, want[slot], WIDE); /* these times are exact */
        free(want[slot]);
    }
}

/** What Cholesky cannot factor takes reflections, in the forward pass as here; the next slot goes
 * on from there. */
TEST(a_grazing_slot_takes_the_stable_step)
{
    const double times[] = {0.2, 0.5, 0.8};
    HELD(pair) p = pair_created();
    hd_record log;
    double *want[2], found[WIDE * WIDE];
    for (int slot = 0; slot < 2; slot++) {
        write_log(&log, times, 3, 1.0, slot == 0 ? 1e-5 : 0.8);
        CHECK_OK(hd_frame_replay(p.frame, &log, 0.0, 1.0));
        if (slot == 0) {
            assert_int_equal(hd_ortho_step(p.ortho, p.frame, FORWARD_LIMITS), HD_ILL_CONDITIONED);
            hd_frame_rewind(p.frame);
            CHECK_OK(hd_frame_replay(p.frame, &log, 0.0, 1.0));
            CHECK_OK(hd_ortho_step_stable(p.ortho, p.frame, 1e13));
        } else {
            CHECK_OK(hd_ortho_step(p.ortho, p.frame, FORWARD_LIMITS));
        }
        want[slot] = triangle_copy(hd_ortho_factor(p.ortho), WIDE);
        CHECK_OK(hd_recompute_events(p.r, slot, &log, 0.0, 1.0));
    }
    for (int slot = 1; slot >= 0; slot--) {
        CHECK_OK(hd_recompute_factor(p.r, found, NULL, slot, 1));
        check_same_triangle(found, want[slot], WIDE);
        free(want[slot]);
    }
}

/** It is full with more events than it was made for; far more of them in one interval have no room.
 * What is forgotten makes room. */
TEST(a_ring_of_events_is_full)
{
    const double times[] = {0.1, 0.3, 0.5, 0.7, 0.8, 0.9};
    const hd_recompute_def def = {.rows = 4 * PAIR,
                                  .vectors = WIDE,
                                  .threads = 1,
                                  .slots = 1000,
                                  .stretch = 10,
                                  .of = DYNAMICS,
                                  .events = 600.0};
    hd_recompute *r;
    hd_record log;
    hd_status status = HD_OK;
    long slot = 0;
    write_log(&log, times, 6, 1.0, 0.8);
    CHECK_OK(hd_recompute_create(&r, &def));
    for (; !hd_recompute_is_full(r); slot++) CHECK_OK(hd_recompute_events(r, slot, &log, 0.0, 1.0));
    assert_int_equal(slot, 101);
    CHECK_CLOSE(hd_recompute_events_kept(r), 606.0, 0.0);
    hd_recompute_forget(r, 25);
    assert_false(hd_recompute_is_full(r));
    CHECK_CLOSE(hd_recompute_events_kept(r), 606.0 - 6.0 * 20.0, 0.0);
    for (; status == HD_OK; slot++) status = hd_recompute_events(r, slot, &log, 0.0, 1.0);
    assert_int_equal(status, HD_NO_ROOM);
    assert_true(hd_recompute_events_kept(r) * sizeof(hd_event) < hd_recompute_bytes(&def));
    hd_recompute_free(r);
}

/** Twice the stretch or half of it needs more. */
TEST(the_stretch_needs_the_fewest_numbers)
{
    for (long slots = 64; slots <= 65536; slots *= 32)
        for (int vectors = 50; vectors <= 400; vectors *= 2) {
            hd_recompute_def def = {
                .rows = 400, .vectors = vectors, .threads = 1, .slots = slots, .of = DYNAMICS};
            const long best = hd_recompute_stretch(slots, def.rows, vectors);
            assert_true(best >= 1 && best <= slots);
            def.stretch = best;
            const double least = hd_recompute_bytes(&def);
            def.stretch = 2 * best;
            assert_true(hd_recompute_bytes(&def) > least);
            def.stretch = (best + 1) / 2;
            assert_true(best == 1 || hd_recompute_bytes(&def) > least);
        }
    assert_int_equal(hd_recompute_stretch(2, 400, 1), 2);
}
