/** One thread or all of them: never the slower by much, and what the user asks for in any case. */
#include "testing.h"
#include "tangent/threads.h"

static int chosen(int disks, int vectors, int wanted, int *most)
{
    int threads = 0;
    *most = hd_threads_most(wanted, 4 * disks, vectors);
    MADE(hd_ortho, ortho, 4 * disks, vectors);
    CHECK_OK(hd_threads_choose(&threads, ortho, PARTICLES(disks), vectors, *most));
    return threads;
}

TEST(small_frames_have_one_thread)
{
    int most;
    assert_int_equal(chosen(10, 17, 0, &most), 1);
    assert_int_equal(most, 1);
    assert_int_equal(chosen(64, 125, 0, &most), 1);
}

TEST(in_between_it_is_tried)
{
    int most;
    const int cores = hd_blas_query().cores, threads = chosen(160, 317, 0, &most);
    assert_int_equal(most, cores);
    assert_true(threads == 1 || threads == cores);
}

TEST(large_frames_have_all_threads)
{
    assert_int_equal(hd_threads_most(0, 3120, 1557), hd_blas_query().cores);
}

TEST(what_is_asked_for_is_not_doubted)
{
    assert_int_equal(hd_threads_most(2, 40, 17), 2);
    assert_int_equal(hd_threads_most(1, 640, 317), 1);
}

/** Also after a product, before which OpenBLAS 0.3.29 thinks again. */
TEST(as_many_compute_as_were_asked_for)
{
    MADE(hd_frame, frame, PARTICLES(160), 317, 1, 2);
    MADE(hd_ortho, ortho, 4 * 160, 317);
    for (int threads = 1; threads <= 2; threads++) {
        hd_blas_use_threads(threads);
        CHECK_OK(hd_ortho_step(ortho, frame, (hd_ortho_limits){1e7, 1.0, HD_NORM_FULL}));
        assert_int_equal(hd_blas_query().threads, threads);
    }
}
