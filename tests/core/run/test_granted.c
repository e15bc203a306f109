/** A run whose parallel regions get fewer threads than it asks for goes on with those. CMake starts
 * this with and without what limits them, each time for so many threads (EXPECTED). */
#include <stdlib.h>

#include "hdlyap/blas.h"
#include "runs.h"
#include "scenes.h"

static int expected(void)
{
    const char *number = getenv("EXPECTED");
    return number ? atoi(number) : 2;
}

static void runs_go_on_with_what_is_granted(void **state)
{
    (void)state;
    hd_scene_def scene = scene_of(120, 0.8, 1.0, HD_PERIODIC, HD_PERIODIC, 1); /* worth a trial */
    scene.equilibration = 0.1;
    scene.warmup = 0.5;
    scene.duration = scene.report_interval = 0.5;
    for (int asked = 0; asked <= 2; asked += 2) {
        scene.threads = asked;
        hd_run *run = created(&scene);
        while (hd_run_stage(run) != HD_FINISHED) CHECK_OK(hd_run_advance(run));
        if (asked == 2) assert_int_equal(hd_run_threads(run), expected());
        if (asked == 2)
            assert_int_equal(hd_run_threads(run) + hd_run_threads_denied(run), 2);
        else
            assert_true(hd_run_threads(run) <= hd_blas_query().cores);
        hd_run_free(run);
    }
    assert_int_equal(hd_blas_threads_granted(2), expected());
    assert_int_equal(hd_blas_threads_granted(1), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(runs_go_on_with_what_is_granted)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
