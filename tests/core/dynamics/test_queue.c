/** Queue against a plain search of all keys. */
#include "dynamics/hard/queue.h"
#include "base/random.h"
#include "testing.h"

enum { DISKS = 40, NOBODY = -1 };
static const double HORIZON = 4.0;

/** The reference: every disk's key, present or not. */
typedef struct list {
    hd_queue_key key[DISKS];
    int present[DISKS];
} list;

static hd_queue_key key_of(double t, int32_t kind, int32_t i, int32_t j)
{
    return (hd_queue_key){t, hd_queue_order(kind, i, j)};
}

static int key_order(const hd_queue_key *a, const hd_queue_key *b)
{
    if (a->t != b->t) return a->t < b->t ? -1 : 1;
    return (a->order > b->order) - (a->order < b->order);
}

static int list_next(const list *l)
{
    int best = NOBODY;
    for (int k = 0; k < DISKS; k++)
        if (l->present[k] && (best == NOBODY || key_order(&l->key[k], &l->key[best]) < 0)) best = k;
    return best;
}

static void put_both(hd_queue *queue, list *l, int disk, hd_queue_key key)
{
    hd_queue_put(queue, disk, key);
    l->key[disk] = key;
    l->present[disk] = key.t < HORIZON;
}

static void check_next(hd_queue *queue, const list *l)
{
    const int got = hd_queue_next(queue), want = list_next(l);
    if ((got < 0) != (want < 0)) fail_msg("next is disk %d, wanted %d", got, want);
    if (got >= 0 && (!l->present[got] || key_order(&l->key[got], &l->key[want]) != 0))
        fail_msg("next is disk %d at %.17g, wanted %d at %.17g", got, l->key[got].t, want,
                 l->key[want].t);
}

static double uniform(hd_random *random) { return 0.5 + 0.5 * hd_random_symmetric(random); }

static int below(hd_random *random, int n) { return (int)(uniform(random) * n); }

/** From the present on; every fifth on a coarse grid (ties), some beyond the horizon or never. */
static hd_queue_key random_key(hd_random *random, double now)
{
    double t = now + 0.3 * HORIZON * uniform(random) * uniform(random);
    if (below(random, 5) == 0) t = ceil(8.0 * t) / 8.0;
    if (below(random, 20) == 0) t = now;
    if (below(random, 30) == 0) t = INFINITY;
    return key_of(t, below(random, 3), below(random, 4), below(random, 4));
}

static hd_queue created(int32_t disks)
{
    hd_queue queue;
    CHECK_OK(hd_queue_create(&queue, disks, HORIZON));
    return queue;
}

TEST(random_puts_like_a_sorted_list)
{
    hd_random random = hd_random_seeded(5, 0);
    hd_queue queue = created(DISKS);
    for (int round = 0; round < 50; round++) {
        list l = {.present = {0}};
        double now = 0;
        for (int disk = 0; disk < DISKS; disk++)
            put_both(&queue, &l, disk, random_key(&random, now));
        for (int steps = 0; list_next(&l) != NOBODY; steps++) {
            assert_true(steps < 100000);
            const int next = hd_queue_next(&queue);
            check_next(&queue, &l);
            assert_true(l.key[next].t >= now);
            now = l.key[next].t;
            put_both(&queue, &l, next, random_key(&random, now));
            put_both(&queue, &l, below(&random, DISKS), random_key(&random, now));
        }
        check_next(&queue, &l);
        hd_queue_restart(&queue);
    }
    hd_queue_clear(&queue);
}

/** Equal times: by kind, then i, then j, in whatever order they were put. */
TEST(ties_by_kind_then_disks)
{
    enum { N = 11, MOST = INT32_MAX };
    const hd_queue_key order[N] = {
        key_of(1.0, 0, 1, 9),    key_of(1.0, 0, 2, 3),  key_of(1.0, 0, 2, 4),
        key_of(1.0, 0, MOST, 0), key_of(1.0, 1, 0, -2), key_of(1.0, 1, 0, -1),
        key_of(1.0, 1, 5, -2),   key_of(1.0, 2, 0, 0),  key_of(1.0, 2, 0, MOST - 2),
        key_of(1.0, 2, 1, -2),   key_of(1.5, 0, 0, 0)};
    for (int shift = 0; shift < N; shift++)
        for (int step = 1; step < N; step++) {
            hd_queue queue = created(N);
            for (int k = 0; k < N; k++) hd_queue_put(&queue, k, order[(k * step + shift) % N]);
            for (int k = 0; k < N; k++) {
                const int32_t disk = hd_queue_next(&queue);
                assert_true(disk >= 0 && (disk * step + shift) % N == k);
                hd_queue_put(&queue, disk, key_of(INFINITY, 0, 0, 0));
            }
            assert_int_equal(hd_queue_next(&queue), -1);
            hd_queue_clear(&queue);
        }
}

TEST(order_is_read_back)
{
    const int32_t number[] = {0, 1, 77, INT32_MAX - 2};
    for (int32_t kind = 0; kind < 4; kind++)
        for (int a = 0; a < 4; a++)
            for (int b = -2; b < 4; b++) {
                const int32_t j = b < 0 ? b : number[b];
                const uint64_t order = hd_queue_order(kind, number[a], j);
                assert_int_equal(hd_queue_kind(order), kind);
                assert_int_equal(hd_queue_i(order), number[a]);
                assert_int_equal(hd_queue_j(order), j);
            }
}

TEST(beyond_the_horizon_is_forgotten)
{
    const double beyond[] = {HORIZON, HORIZON * 1.5, 1e300, INFINITY, NAN};
    for (size_t k = 0; k < sizeof beyond / sizeof *beyond; k++) {
        hd_queue queue = created(2);
        hd_queue_put(&queue, 0, key_of(beyond[k], 0, 0, 1));
        assert_int_equal(hd_queue_next(&queue), -1);
        hd_queue_clear(&queue);
    }
    hd_queue queue = created(2); /* an event that moves beyond it is gone, whether near or far */
    hd_queue_put(&queue, 0, key_of(0.0, 0, 0, 1));
    hd_queue_put(&queue, 1, key_of(3.0, 0, 0, 1));
    assert_int_equal(hd_queue_next(&queue), 0);
    hd_queue_put(&queue, 0, key_of(HORIZON, 0, 0, 1));
    assert_int_equal(hd_queue_next(&queue), 1);
    hd_queue_put(&queue, 1, key_of(HORIZON, 0, 0, 1));
    assert_int_equal(hd_queue_next(&queue), -1);
    hd_queue_clear(&queue);
}

/** The last moment before the horizon is not lost, for any number of buckets. */
TEST(last_moment_is_kept)
{
    for (int32_t disks = 2; disks < 2000; disks += 1 + disks / 3) {
        hd_queue queue = created(disks);
        hd_queue_put(&queue, 1, key_of(nextafter(HORIZON, 0.0), 0, 0, 1));
        assert_int_equal(hd_queue_next(&queue), 1);
        hd_queue_clear(&queue);
    }
}

TEST(restart_forgets_everything)
{
    hd_queue queue = created(3);
    assert_int_equal(hd_queue_next(&queue), -1);
    for (int round = 0; round < 3; round++) {
        hd_queue_restart(&queue);
        hd_queue_put(&queue, 0, key_of(0.0, 0, 0, 1));
        hd_queue_put(&queue, 1, key_of(2.0, 0, 0, 1));
        hd_queue_put(&queue, 2, key_of(3.9, 0, 0, 1));
        assert_int_equal(hd_queue_next(&queue), 0);
        hd_queue_restart(&queue);
        assert_int_equal(hd_queue_next(&queue), -1);
        hd_queue_restart(&queue);
        hd_queue_put(&queue, 1, key_of(0.5, 0, 0, 1)); /* time starts again at 0 */
        assert_int_equal(hd_queue_next(&queue), 1);
    }
    hd_queue_clear(&queue);
}
