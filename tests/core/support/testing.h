/** What the core's tests share: cmocka, and comparisons that print both numbers and fail on NaN. */
#ifndef HD_TESTING_H
#define HD_TESTING_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "hdlyap/status.h"

static inline void check_close(double got, double want, double tolerance, const char *what,
                               const char *file, int line)
{
    if (fabs(got - want) <= tolerance) return;
    print_error("%s: got %.17g, want %.17g +- %.3g, off by %.3g\n", what, got, want, tolerance,
                got - want);
    _fail(file, line);
}

/** |got - want| <= tolerance, false for NaN. */
#define CHECK_CLOSE(got, want, tolerance)                                                          \
    check_close((got), (want), (tolerance), #got, __FILE__, __LINE__)

/** The call returned HD_OK. */
#define CHECK_OK(call) assert_string_equal(hd_status_text(call), hd_status_text(HD_OK))

/** In the second tier a test tries as many cases of a kind as it has; in the first one some of
 * them. tests/run.sh --all sets the variable. */
static inline bool second_tier(void) { return getenv("HDLYAP_SECOND_TIER") != NULL; }

/** A test of this program, TEST(what_it_says) { .. }: it runs in its turn, by being there. */
#define TEST(name)                                                                                 \
    static void name(void **state_);                                                               \
    __attribute__((constructor)) static void name##_is_there(void) { tests_add(#name, name); }     \
    static void name(void **state_ __attribute__((unused)))

void tests_add(const char *name, CMUnitTestFunction test);
/** All of them, or those whose name fits; the number of failures. */
int tests_run(const char *filter);

#endif
