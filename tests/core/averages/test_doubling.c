/** Growth over times that double, against sums over all of them by their definition. */
#include "averages/doubling.h"
#include "base/random.h"
#include "kept.h"

enum { N = 9, FIRST = 3, PAIRED = 5, SAMPLES = 50 };
static const double ROUNDING = 1e-12;

OWNABLE(hd_doubling)

typedef struct history {
    int count;
    double growth[SAMPLES][N], dt[SAMPLES];
} history;

static hd_doubling *created(int count, double shortest)
{
    hd_doubling *d;
    CHECK_OK(hd_doubling_create(&d, (hd_doubling_def){N, FIRST, count, shortest}));
    return d;
}

static history made(uint64_t seed)
{
    hd_random random = hd_random_seeded(seed, 0);
    history h = {.count = SAMPLES};
    for (int k = 0; k < SAMPLES; k++) {
        h.dt[k] = 1.0 + 0.5 * hd_random_symmetric(&random);
        for (int col = 0; col < N; col++)
            h.growth[k][col] = -0.3 * col * h.dt[k] + 1.2 * hd_random_symmetric(&random);
    }
    return h;
}

/** Two become one; an odd one is not whole. */
static history joined(const history *h)
{
    history j = {.count = h->count / 2};
    for (int k = 0; k < j.count; k++) {
        j.dt[k] = h->dt[2 * k] + h->dt[2 * k + 1];
        for (int col = 0; col < N; col++)
            j.growth[k][col] = h->growth[2 * k][col] + h->growth[2 * k + 1][col];
    }
    return j;
}

static double total(const double *x, int count, size_t stride)
{
    double sum = 0.0;
    for (int k = 0; k < count; k++) sum += x[(size_t)k * stride];
    return sum;
}

static double covariance(const history *h, int a, int b)
{
    const double time = total(h->dt, h->count, 1);
    const double rate[] = {total(&h->growth[0][a], h->count, N) / time,
                           total(&h->growth[0][b], h->count, N) / time};
    double sum = 0.0;
    for (int k = 0; k < h->count; k++)
        sum += (h->growth[k][a] - rate[0] * h->dt[k]) * (h->growth[k][b] - rate[1] * h->dt[k]) /
               h->dt[k];
    return sum / (h->count - 1);
}

/** How often one column grew less than a later one. */
static int reversed(const history *h, int col, int later)
{
    int times = 0;
    for (int k = 0; k < h->count; k++) times += h->growth[k][col] < h->growth[k][later];
    return times;
}

static int entangled(const history *h, int col)
{
    int times = 0;
    for (int k = 0; k < h->count; k++) {
        bool crossed = false;
        for (int before = 0; before <= col; before++)
            for (int later = col + 1; later < N; later++)
                crossed |= h->growth[k][before] < h->growth[k][later];
        times += crossed;
    }
    return times;
}

static void check_kind(const hd_doubling *d, int k, const history *h)
{
    const hd_order_over order = hd_doubling_order(d, k);
    const double count = h->count;
    assert_int_equal(order.count, h->count);
    CHECK_CLOSE(order.time, total(h->dt, h->count, 1) / count, ROUNDING);
    for (int col = 0; col < N; col++) {
        if (h->count > 1)
            CHECK_CLOSE(hd_doubling_variance(d, k, col), covariance(h, col, col), ROUNDING);
        if (col + 1 == N) break;
        CHECK_CLOSE(order.violations[col], reversed(h, col, col + 1) / count, ROUNDING);
        CHECK_CLOSE(order.domination_violations[col], entangled(h, col) / count, ROUNDING);
    }
    for (int a = FIRST; a < FIRST + PAIRED; a++) {
        for (int b = FIRST; h->count > 1 && b < FIRST + PAIRED; b++)
            CHECK_CLOSE(hd_doubling_covariance(d, k, a, b), covariance(h, a, b), ROUNDING);
        for (int b = a + 1; b < FIRST + PAIRED; b++)
            CHECK_CLOSE(hd_doubling_reversed(d, k, a, b), reversed(h, a, b) / count, ROUNDING);
    }
}

static void check_all(const hd_doubling *d, const history *h)
{
    history of = *h;
    int kinds = 0;
    for (; of.count > 0; of = joined(&of)) check_kind(d, kinds++, &of);
    assert_int_equal(hd_doubling_times(d), kinds);
}

TEST(sums_are_those_of_whole_times)
{
    const history h = made(8);
    OWNED(hd_doubling) *d = created(PAIRED, 0.0);
    assert_int_equal(hd_doubling_times(d), 0);
    for (int k = 0; k < h.count; k++) {
        hd_doubling_add(d, h.growth[k], h.dt[k]);
        history so_far = h;
        so_far.count = k + 1;
        check_all(d, &so_far);
    }
    assert_true(isnan(hd_doubling_variance(d, 5, 0))); /* of one time */
    hd_doubling_clear(d);
    assert_int_equal(hd_doubling_times(d), 0);
    history one = h;
    one.count = 1;
    hd_doubling_add(d, h.growth[0], h.dt[0]);
    check_all(d, &one);
}

/** The case tells: some of the fractions are neither 0 nor 1. */
TEST(order_is_open)
{
    const history h = made(8);
    int open = 0;
    for (int col = 0; col + 1 < N; col++)
        open += reversed(&h, col, col + 1) < entangled(&h, col) && entangled(&h, col) < h.count;
    assert_true(open > 3);
}

/** Order changes where it was planted, and over twice the time no more. */
TEST(planted_changes_are_counted)
{
    OWNED(hd_doubling) *d = created(PAIRED, 0.0);
    for (int k = 0; k < 24; k++) {
        double growth[N];
        for (int col = 0; col < N; col++) growth[col] = N - col;
        if (k % 3 == 0) growth[4] = growth[5] - 0.5; /* 2 ahead of 3 otherwise: 1 + 1.5 > 0 */
        hd_doubling_add(d, growth, 1.0);
    }
    const double once[] = {8.0 / 24.0, 0.0};
    for (int k = 0; k < 2; k++) {
        const hd_order_over order = hd_doubling_order(d, k);
        for (int col = 0; col + 1 < N; col++) {
            CHECK_CLOSE(order.violations[col], col == 4 ? once[k] : 0.0, ROUNDING);
            CHECK_CLOSE(order.domination_violations[col], col == 4 ? once[k] : 0.0, ROUNDING);
        }
        CHECK_CLOSE(hd_doubling_reversed(d, k, 4, 5), once[k], ROUNDING);
        CHECK_CLOSE(hd_doubling_reversed(d, k, 3, 5), 0.0, 0.0);
    }
}

/** As many samples as come nearest to the shortest time. */
TEST(short_samples_make_one_time)
{
    const double dt[] = {0.3, 0.5, 2.0}, count[] = {3.0, 2.0, 1.0};
    const double growth[N] = {1.0};
    for (int c = 0; c < 3; c++) {
        OWNED(hd_doubling) *d = created(0, 1.0);
        for (int k = 0; k < 6; k++) hd_doubling_add(d, growth, dt[c]);
        assert_int_equal(hd_doubling_order(d, 0).count, (int)(6.0 / count[c]));
        CHECK_CLOSE(hd_doubling_order(d, 0).time, count[c] * dt[c], ROUNDING);
    }
}

/** No time reaches over a break. */
TEST(times_that_have_begun_are_dropped)
{
    const history h = made(3);
    OWNED(hd_doubling) *d = created(PAIRED, 0.0), *other = created(PAIRED, 0.0);
    for (int k = 0; k < 3; k++) hd_doubling_add(d, h.growth[k], h.dt[k]);
    hd_doubling_break(d);
    for (int k = 3; k < 5; k++) hd_doubling_add(d, h.growth[k], h.dt[k]);
    assert_int_equal(hd_doubling_order(d, 0).count, 5);
    assert_int_equal(hd_doubling_order(d, 1).count, 2); /* 0 1, 3 4 */
    CHECK_CLOSE(hd_doubling_order(d, 1).time, (h.dt[0] + h.dt[1] + h.dt[3] + h.dt[4]) / 2.0,
                ROUNDING);
    hd_doubling_add(other, h.growth[0], h.dt[0]);
    assert_int_equal(hd_doubling_order(d, 2).count, 0);
}

/** What is kept stays as it is, however many samples there are. */
TEST(times_are_no_longer_than_the_longest)
{
    OWNED(hd_doubling) *d = created(0, 0.0);
    const double growth[N] = {1.0};
    for (long k = 0; k < 1L << (HD_TIMES_MAX + 1); k++) hd_doubling_add(d, growth, 1.0);
    assert_int_equal(hd_doubling_times(d), HD_TIMES_MAX);
    assert_int_equal(hd_doubling_order(d, HD_TIMES_MAX - 1).count, 4);
}
