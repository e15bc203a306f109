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

TEST(runs_go_on_with_what_is_granted)
{
    hd_scene_def scene = scene_of(120, 0.8, 1.0, HD_PERIODIC, HD_PERIODIC, 1); /* worth a trial */
    scene.equilibration = 0.1;
    scene.warmup = 0.5;
    scene.duration = scene.report_interval = 0.5;
    for (int asked = 0; asked <= 2; asked += 2) {
        scene.threads = asked;
        hd_run *run = finished(&scene);
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
