/** A run whose parallel regions get fewer threads than it asks for goes on with those. CMake starts
 * this with and without what limits them, each time for so many threads (EXPECTED). */
#include "runs.h"

static int expected(void)
{
    const char *number = getenv("EXPECTED");
    return number ? atoi(number) : 2;
}

TEST(runs_go_on_with_what_is_granted)
{
    for (int asked = 0; asked <= 2; asked += 2) {
        OWNED(hd_run) *run = finished(scene(.number = 120, .aspect = 1.0, .equilibration = 0.1,
                                            .warmup = 0.5, .duration = 0.5, .report_interval = 0.5,
                                            .threads = asked)); /* worth a trial */
        if (asked == 2) assert_int_equal(hd_run_threads(run), expected());
        if (asked == 2)
            assert_int_equal(hd_run_threads(run) + hd_run_threads_denied(run), 2);
        else
            assert_true(hd_run_threads(run) <= hd_blas_query().cores);
    }
    assert_int_equal(hd_blas_threads_granted(2), expected());
    assert_int_equal(hd_blas_threads_granted(1), 1);
}
