/** The interval follows what the conditioning shows. */
#include "testing.h"
#include "base/random.h"
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

TEST(it_settles_where_the_condition_is_right)
{
    for (double rate = 0.01; rate < 50.0; rate *= 3.0) {
        hd_interval interval = hd_interval_first(1e-3, INFINITY, 1e-8);
        const double length = settled(&interval, rate, 200);
        const double most = hd_interval_condition_max(&interval, length);
        assert_true(exp(rate * length) < most / 2.0 && exp(rate * length) > most / 32.0);
    }
}

/** Rate doubled for good: it follows in some twenty intervals, the first of them repaired. */
TEST(it_follows_a_change)
{
    hd_interval interval = hd_interval_first(0.1, INFINITY, 1e-8);
    const double before = settled(&interval, 5.0, 100);
    hd_interval_learn(&interval, before, exp(10.0 * before), 10.0 * before);
    assert_true(hd_interval_next(&interval, 1e9).length < 0.95 * before);
    CHECK_CLOSE(settled(&interval, 10.0, 300), before / 2.0, 0.05 * before);
    CHECK_CLOSE(settled(&interval, 5.0, 300), before, 0.05 * before);
}

TEST(failures_shorten_it)
{
    hd_interval interval = hd_interval_first(0.1, INFINITY, 1e-8);
    const double before = settled(&interval, 5.0, 100);
    for (int k = 0; k < 10; k++) hd_interval_failed(&interval, 1.5 * before);
    assert_true(hd_interval_next(&interval, 1e9).length <= before);
    for (int k = 0; k < 10; k++) hd_interval_failed(&interval, before);
    assert_true(hd_interval_next(&interval, 1e9).length < 0.99 * before);
}

TEST(limits_are_kept)
{
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

TEST(the_reason_is_told)
{
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

TEST(shares_of_the_rest_are_equal)
{
    hd_interval interval = hd_interval_first(0.3, 0.3, 1e-8);
    CHECK_CLOSE(hd_interval_next(&interval, 1.0).length, 0.25, DBL_EPSILON);
    CHECK_CLOSE(hd_interval_next(&interval, 0.3).length, 0.3, 0.0);
    CHECK_CLOSE(hd_interval_next(&interval, 0.1).length, 0.1, 0.0);
}

/** Time units of accuracy that a condition uses up in error_bound. */
static double used_up(double condition, double accuracy)
{
    return 20.0 * 2.0 * DBL_EPSILON * condition / accuracy;
}

TEST(more_accuracy_allows_less_condition)
{
    const hd_interval tight = hd_interval_first(1.0, INFINITY, 1e-11);
    const hd_interval loose = hd_interval_first(1.0, INFINITY, 1e-2);
    CHECK_CLOSE(used_up(hd_interval_condition_max(&tight, 1.0), 1e-11), 4.0, 1e-9);
    CHECK_CLOSE(hd_interval_condition_max(&loose, 1.0), 1e12, 0.0);
}

static double gaussian(hd_random *random)
{
    double sum = 0.0; /* of twelve uniform variables */
    for (int k = 0; k < 12; k++) sum += 0.5 * hd_random_symmetric(random);
    return sum;
}

TEST(what_is_saved_may_be_used)
{
    const double shares[][2] = {{-5.0, 0.5},  {-0.6, 0.7}, {0.0, 1.0},     {13.0, 7.5},
                                {38.0, 20.0}, {1e9, 20.0}, {INFINITY, 4.0}};
    hd_interval interval = hd_interval_first(2.0, INFINITY, 1e-8);
    for (size_t k = 0; k < sizeof shares / sizeof *shares; k++) {
        interval.saved = shares[k][0];
        const double most = hd_interval_condition_max(&interval, 2.0);
        CHECK_CLOSE(used_up(most, 1e-8), 2.0 * shares[k][1], 1e-9);
    }
    interval.saved = 13.0; /* a short one, of what is there */
    CHECK_CLOSE(used_up(hd_interval_condition_max(&interval, 0.5), 1e-8), 13.5, 1e-9);
}

/** Conditions that scatter by a factor e: the sum that the error bound is made of never exceeds the
 * accuracy, and the intervals are hardly shorter than those which just use it up on average. */
TEST(the_bound_is_kept_and_used)
{
    enum { INTERVALS = 4000, FIRST = 200 };
    const double rate = 6.5, scatter = 1.0, accuracy = 1e-8;
    hd_interval interval = hd_interval_first(0.1, INFINITY, accuracy);
    hd_random random = hd_random_seeded(1, 0);
    double time = 0.0;
    int repaired = 0, averaged = 0;
    for (int k = 0; k < INTERVALS; k++) {
        if (k == FIRST) interval.saved = -8.0; /* four intervals */
        const double length = hd_interval_next(&interval, 1e9).length;
        const double seen = exp(rate * length + scatter * gaussian(&random));
        if (seen > hd_interval_condition_max(&interval, length)) {
            hd_interval_failed(&interval, length);
            repaired++;
            continue;
        }
        hd_interval_learn(&interval, length, fmax(seen, 1.0), rate * length);
        interval.saved += length - used_up(seen, accuracy);
        assert_true(k < FIRST + 8 || interval.saved >= 0.0);
        averaged += k >= FIRST;
        if (k >= FIRST) time += length;
    }
    const double mean = time / averaged;
    const double ideal = (log(accuracy * mean / (40.0 * DBL_EPSILON)) - 0.5 * scatter) / rate;
    CHECK_CLOSE(mean, ideal, 0.05 * ideal);
    assert_true(repaired < 0.1 * INTERVALS);
}

/** A piece of a repair has the share of its own length, or of a usual one; nothing is divided for a
 * condition of 1e3. */
TEST(pieces_keep_to_their_share)
{
    hd_interval interval = hd_interval_first(0.1, INFINITY, 1e-8);
    const double whole = hd_interval_condition_max(&interval, 2.0);
    CHECK_CLOSE(hd_interval_piece_max(&interval, 2.0, 2.0), whole, 0.0);
    CHECK_CLOSE(hd_interval_piece_max(&interval, 1.0, 2.0), whole / 8.0, 1e-9 * whole);
    interval.saved = -0.3;
    CHECK_CLOSE(hd_interval_piece_max(&interval, 1.0, 2.0), whole / 8.0 * 0.7, 1e-9 * whole);
    const hd_interval tight = hd_interval_first(0.1, INFINITY, 1e-12);
    CHECK_CLOSE(hd_interval_condition_max(&tight, 0.01), 1e3, 0.0);
    CHECK_CLOSE(hd_interval_piece_max(&tight, 0.01, 0.1), 1e3, 0.0);
}

/** Each norm has a growth of its own; one that has shown nothing yet goes by the other. */
TEST(norms_are_learnt_apart)
{
    hd_interval interval = hd_interval_first(0.1, INFINITY, 1e-8);
    const double full = settled(&interval, 6.0, 100);
    const double counts = log(hd_interval_counted(1.0, HD_NORM_DQ));
    interval.norm = HD_NORM_DQ;
    CHECK_CLOSE(hd_interval_longest(&interval).length, full - counts / 6.0, 0.02 * full);
    const double dq = settled(&interval, 5.0, 100);
    CHECK_CLOSE(dq, 1.2 * full - counts / 5.0, 0.05 * full);
    interval.norm = HD_NORM_FULL;
    CHECK_CLOSE(hd_interval_longest(&interval).length, full, 0.05 * full);
    CHECK_CLOSE(hd_interval_condition(&interval, 1.0), exp(6.0), 0.1 * exp(6.0));
}
