/** The interval follows what the conditioning shows. */
#include <float.h>

#include "testing.h"

#include "tangent/interval.h"

/** A frame whose ln(condition) is rate * length, seen over `steps` intervals. */
static double settled(hd_interval *interval, double rate, int steps)
{
    double length = 0.0;
    for (int k = 0; k < steps; k++) {
        length = hd_interval_next(interval, 1e9).length;
        hd_interval_learn(interval, length, exp(rate * length), rate * length);
    }
    return length;
}

static void it_settles_where_the_condition_is_right(void **state)
{
    (void)state;
    for (double rate = 0.01; rate < 50.0; rate *= 3.0) {
        hd_interval interval = hd_interval_first(1e-3, INFINITY, 1e-8);
        const double length = settled(&interval, rate, 200);
        const double most = hd_interval_condition_max(&interval, length);
        assert_true(exp(rate * length) < most / 2.0 && exp(rate * length) > most / 32.0);
    }
}

/** Rate doubled for good: it follows in some twenty intervals, the first of them repaired. */
static void it_follows_a_change(void **state)
{
    (void)state;
    hd_interval interval = hd_interval_first(0.1, INFINITY, 1e-8);
    const double before = settled(&interval, 5.0, 100);
    hd_interval_learn(&interval, before, exp(10.0 * before), 10.0 * before);
    assert_true(hd_interval_next(&interval, 1e9).length < 0.95 * before);
    CHECK_CLOSE(settled(&interval, 10.0, 300), before / 2.0, 0.05 * before);
    CHECK_CLOSE(settled(&interval, 5.0, 300), before, 0.05 * before);
}

static void failures_shorten_it(void **state)
{
    (void)state;
    hd_interval interval = hd_interval_first(0.1, INFINITY, 1e-8);
    const double before = settled(&interval, 5.0, 100);
    for (int k = 0; k < 10; k++) hd_interval_failed(&interval, 1.5 * before);
    assert_true(hd_interval_next(&interval, 1e9).length <= before);
    for (int k = 0; k < 10; k++) hd_interval_failed(&interval, before);
    assert_true(hd_interval_next(&interval, 1e9).length < 0.99 * before);
}

/** ln(condition) = rate * length + scatter, the scatter the same at all lengths: kept free above
 * the mean, so that few intervals are repaired, and not multiplied with the length. */
static void scatter_is_kept_free_once(void **state)
{
    (void)state;
    hd_interval interval = hd_interval_first(0.1, INFINITY, 1e-8);
    const double rate = 6.5, scatter = 1.0;
    int repaired = 0;
    double sum = 0.0;
    for (int k = 0; k < 2000; k++) {
        const double length = hd_interval_next(&interval, 1e9).length;
        const double most = hd_interval_condition_max(&interval, length);
        const double seen = exp(rate * length + scatter * sqrt(2.0) * cos(k * k * 0.7));
        repaired += seen > most;
        sum += length;
        if (seen > most)
            hd_interval_failed(&interval, length);
        else
            hd_interval_learn(&interval, length, fmax(seen, 1.0), rate * length);
    }
    const double mean = sum / 2000;
    const double ideal = log(hd_interval_condition_max(&interval, mean)) / rate;
    print_message("mean length %.2f of %.2f, %.1f %% repaired\n", mean, ideal, repaired / 20.0);
    assert_true(mean > 0.75 * ideal && mean < ideal);
    assert_true(repaired < 0.1 * 2000);
}

static void limits_are_kept(void **state)
{
    (void)state;
    hd_interval interval = hd_interval_first(1.0, 0.25, 1e-8);
    for (int k = 0; k < 50; k++) {
        const double length = hd_interval_next(&interval, 1.0).length;
        assert_true(length <= 0.25);
        hd_interval_learn(&interval, length, 1.0, 0.0);
    }
    hd_interval one = hd_interval_first(1.0, INFINITY, 1e-8); /* one vector: only overflow limits */
    for (int k = 0; k < 100; k++) {
        const double length = hd_interval_next(&one, 1e9).length;
        assert_true(length * 2.0 < log(DBL_MAX) / 2.0);
        hd_interval_learn(&one, length, 1.0, 2.0 * length);
    }
}

static void the_reason_is_told(void **state)
{
    (void)state;
    hd_interval interval = hd_interval_first(0.1, INFINITY, 1e-8);
    assert_int_equal(hd_interval_next(&interval, 0.15).limit, HD_LIMIT_SCHEDULE);
    assert_int_equal(hd_interval_next(&interval, 10.0).limit, HD_LIMIT_GROWTH);
    (void)settled(&interval, 5.0, 50);
    assert_int_equal(hd_interval_next(&interval, 1e9).limit, HD_LIMIT_CONDITION);
    interval.limit = 0.01;
    assert_int_equal(hd_interval_next(&interval, 1e9).limit, HD_LIMIT_SCENE);
    hd_interval one = hd_interval_first(100.0, INFINITY, 1e-8);
    hd_interval_learn(&one, 100.0, 1.0, 200.0);
    assert_int_equal(hd_interval_next(&one, 1e9).limit, HD_LIMIT_OVERFLOW);
}

static void shares_of_the_rest_are_equal(void **state)
{
    (void)state;
    hd_interval interval = hd_interval_first(0.3, 0.3, 1e-8);
    CHECK_CLOSE(hd_interval_next(&interval, 1.0).length, 0.25, DBL_EPSILON);
    CHECK_CLOSE(hd_interval_next(&interval, 0.3).length, 0.3, 0.0);
    CHECK_CLOSE(hd_interval_next(&interval, 0.1).length, 0.1, 0.0);
}

static void more_accuracy_allows_less_condition(void **state)
{
    (void)state;
    const hd_interval tight = hd_interval_first(1.0, INFINITY, 1e-12);
    const hd_interval loose = hd_interval_first(1.0, INFINITY, 1e-2);
    CHECK_CLOSE(hd_interval_condition_max(&tight, 1.0), 0.5e-12 / DBL_EPSILON, 1e-6);
    CHECK_CLOSE(hd_interval_condition_max(&loose, 1.0), 1e12, 0.0);
}

/** A piece of a repair has a twentieth of its own share; nothing is divided for a condition of 1e3.
 */
static void pieces_keep_to_their_share(void **state)
{
    (void)state;
    const hd_interval interval = hd_interval_first(0.1, INFINITY, 1e-8);
    const double whole = hd_interval_condition_max(&interval, 2.0);
    CHECK_CLOSE(hd_interval_piece_max(&interval, 2.0, 2.0), whole, 0.0);
    CHECK_CLOSE(hd_interval_piece_max(&interval, 1.0, 2.0), whole / 40.0, 1e-9 * whole);
    const hd_interval tight = hd_interval_first(0.1, INFINITY, 1e-12);
    CHECK_CLOSE(hd_interval_condition_max(&tight, 0.01), 1e3, 0.0);
    CHECK_CLOSE(hd_interval_piece_max(&tight, 0.01, 0.1), 1e3, 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_settles_where_the_condition_is_right),
        cmocka_unit_test(it_follows_a_change),
        cmocka_unit_test(failures_shorten_it),
        cmocka_unit_test(scatter_is_kept_free_once),
        cmocka_unit_test(limits_are_kept),
        cmocka_unit_test(the_reason_is_told),
        cmocka_unit_test(shares_of_the_rest_are_equal),
        cmocka_unit_test(more_accuracy_allows_less_condition),
        cmocka_unit_test(pieces_keep_to_their_share),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
