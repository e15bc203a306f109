/** Errors that fall as in a stationary run, or do not; alone, and in the run that keeps them. */
#include "averages/error_trend.h"
#include "base/random.h"

#include "runs.h"

/** With errors of a tenth. */
static hd_error_trend trend_of(double (*error)(double))
{
    hd_random random = hd_random_seeded(1, 0);
    hd_error_trend trend = {.first = 0.0};
    for (double t = 16.0; t < 4000.0; t++)
        hd_error_trend_add(&trend, t, error(t) * (1.0 + 0.17 * hd_random_symmetric(&random)));
    return trend;
}

static double healthy(double t) { return 1.0 / sqrt(t); }

static double stalled(double t) { return t < 250.0 ? 1.0 / sqrt(t) : 0.3; }

TEST(what_falls_is_healthy)
{
    hd_error_at since;
    const hd_error_trend trend = trend_of(healthy);
    assert_false(hd_error_trend_stalled(&trend, &since));
    assert_true(trend.last.time >= 8.0 * since.time && trend.last.time < 33.0 * since.time);
}

TEST(what_stalls_is_told_until_it_falls_again)
{
    hd_error_at since;
    hd_error_trend trend = trend_of(stalled);
    assert_true(hd_error_trend_stalled(&trend, &since));
    for (double t = 4000.0; t < 1e5; t += 10.0) hd_error_trend_add(&trend, t, 19.0 / sqrt(t));
    assert_false(hd_error_trend_stalled(&trend, &since));
}

TEST(nothing_is_said_too_early)
{
    static const double odd[] = {1e-30, 1e-9, 1e3, 1e12, 1e300};
    hd_error_at since;
    hd_error_trend trend = {.first = 0.0};
    assert_false(hd_error_trend_stalled(&trend, &since));
    for (double t = 16.0; t < 4 * 8 * 16; t++) hd_error_trend_add(&trend, t, t < 64.0 ? 0.01 : 1.0);
    assert_false(hd_error_trend_stalled(&trend, &since));
    hd_error_trend_add(&trend, 4 * 8 * 16, 1.0);
    assert_true(hd_error_trend_stalled(&trend, &since));
    CHECK_CLOSE(since.time, 64.0, 0.0);
    hd_error_trend_add(&trend, 5 * 8 * 16, -1.0); /* not known: as before */
    assert_true(hd_error_trend_stalled(&trend, &since));
    hd_error_trend_add(&trend, 1.0, -1.0); /* averages reset */
    assert_false(hd_error_trend_stalled(&trend, &since));
    for (int k = 0; k < 5; k++) hd_error_trend_add(&trend, odd[k], 1.0);
    assert_true(hd_error_trend_stalled(&trend, &since));
}
