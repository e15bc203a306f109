/** What each of several ranks asks for, and what becomes of a run if one of them does not get it.
 */
#include "ledger.h"
#include "runs.h"
#include "together.h"

static double room_of_machine = 1e15;

/** What a machine leaves to all of its ranks. */
hd_memory_limit __wrap_hd_memory_available(void)
{
    return (hd_memory_limit){room_of_machine, "machine", 1};
}

static hd_scene_def short_scene(int disks, unsigned observe)
{
    return scene(.number = disks, .density = 0.7, .aspect = 0.3, .seed = 3, .equilibration = 0.1,
                 .warmup = 2.0, .duration = 2.0, .threads = 1, .observe = observe);
}

/** 8 m n + 8 n^2 bytes of all ranks together, times 1.4, for two copies of the frame and what
 * belongs to them; and a little that each has. */
TEST(memory_falls_with_the_ranks)
{
    const hd_scene_def scene = short_scene(400, 0);
    const double m = 1600.0, n = 797.0, alike = 6e6;
    ledger_reset_peak();
    const double before = (double)ledger_now().live;
    OWNED(hd_run) *run = shared(scene);
    finish(run);
    const double peak = (double)ledger_now().peak - before;
    const double needed = hd_memory_needed(&scene, 1, ranks->ranks);
    if (ranks->rank == 0)
        print_message("%.2f MB of each rank, estimated %.3f times that\n", 1e-6 * peak,
                      needed / peak);
    assert_true(peak < 1.4 * 8.0 * (m * n + n * n) / ranks->ranks + alike);
    assert_true(needed > 0.95 * peak && needed < 1.25 * peak);
}

/** At a report both halves are on each rank, and the half from which they follow. */
TEST(gathered_vectors_are_estimated)
{
    const hd_scene_def scene = scene_from(short_scene(200, HD_OBSERVE_HYDRO),
                                          .exponents = HD_EXPONENTS_ALL);
    ledger_reset_peak();
    const double before = (double)ledger_now().live;
    OWNED(hd_run) *run = shared(scene);
    const double created = (double)ledger_now().live;
    hd_run_watch(run, 1.0);
    while (going_on(run)) CHECK_OK(hd_run_measure(run, 0));
    const double peak = (double)ledger_now().peak;
    const double needed = hd_memory_needed(&scene, 1, ranks->ranks);
    if (ranks->rank == 0)
        print_message("%.2f MB gathered; %.2f MB of each rank, estimated %.3f times that\n",
                      1e-6 * (peak - created), 1e-6 * (peak - before), needed / (peak - before));
    assert_true(peak - created >= 3.0 * 8.0 * 800.0 * 400.0);
    assert_true(needed > 0.95 * (peak - before) && needed < 1.25 * (peak - before));
}

static bool other_kernels;

hd_blas __real_hd_blas_query(void);
hd_blas __wrap_hd_blas_query(void)
{
    hd_blas blas = __real_hd_blas_query();
    if (other_kernels) blas.kernel = "others";
    return blas;
}

/** Each in turn, but for rank 0, whose kernels all others have to have. */
TEST(kernels_of_every_rank_are_compared)
{
    const hd_scene_def scene = short_scene(10, 0);
    for (int other = 1; other < ranks->ranks; other++) {
        char message[200];
        hd_run *run;
        other_kernels = ranks->rank == other;
        const hd_status status = hd_run_create_shared(&run, &scene, ranks, message, sizeof message);
        other_kernels = false;
        assert_int_equal(status, HD_REFUSED);
        assert_non_null(strstr(message, "others kernels"));
    }
}

/** The room of a machine is that of all its ranks. */
TEST(ranks_share_a_machine)
{
    const hd_scene_def scene = short_scene(50, 0);
    const double all = ranks->ranks * hd_memory_needed(&scene, 1, ranks->ranks);
    OWNED(hd_run) *run = NULL;
    room_of_machine = 0.99 * all;
    assert_int_equal(hd_run_create_shared(&run, &scene, ranks, NULL, 0), HD_NO_MEMORY);
    room_of_machine = 1.01 * all;
    CHECK_OK(hd_run_create_shared(&run, &scene, ranks, NULL, 0));
    room_of_machine = 1e15;
}

/** Also where it is another rank's machine that has too little. */
static void check_told(double room, const char *what)
{
    const hd_scene_def scene = short_scene(50, 0);
    const bool last = ranks->rank == ranks->ranks - 1;
    char line[256] = "";
    hd_run *run;
    if (last) room_of_machine = room;
    assert_int_equal(hd_run_create_shared(&run, &scene, ranks, line, sizeof line), HD_NO_MEMORY);
    assert_non_null(strstr(line, last ? what : "another rank: out of memory"));
    room_of_machine = 1e15;
}

TEST(all_are_told_of_one_machine)
{
    const hd_scene_def scene = short_scene(50, 0);
    check_told(hd_memory_needed(&scene, 1, ranks->ranks), "would fit");
    check_told(1.0, "not even one particle would fit");
}

/** Whatever it is that the last rank does not get: all of them end, say so, and give back what they
 * had. */
TEST(what_one_does_not_get_ends_all)
{
    const size_t before = ledger_now().live;
    hd_scene_def scene = short_scene(16, HD_OBSERVE_STEPS | HD_OBSERVE_PHASES);
    for (int kind = 0; kind < 3; kind++) {
        size_t refused = 0;
        if (kind == 1) scene.exponents = HD_EXPONENTS_ALL;
        if (kind == 2) {
            scene.exponents = HD_EXPONENTS_ALL_INDEPENDENT;
            scene.observe |= HD_OBSERVE_COVARIANT;
            scene.covariant_window = scene.covariant_transient = 10.0;
            scene.covariant_sampling = 1.0;
            scene.warmup = 10.0;
            scene.duration = 30.0;
        }
        for (bool whole = false; !whole; refused++) {
            hd_run *run;
            if (ranks->rank == ranks->ranks - 1) ledger_refuse(refused, 1);
            const hd_status status = hd_run_create_shared(&run, &scene, ranks, NULL, 0);
            ledger_refuse(0, 0);
            whole = status == HD_OK;
            if (whole)
                hd_run_free(run);
            else
                assert_int_equal(status, HD_NO_MEMORY);
            assert_int_equal(ledger_now().live, before);
        }
        assert_true(refused > 30);
    }
}

/** In mid-run: all of them say so for good, and the file that is there stays. */
TEST(what_one_does_not_get_later_ends_all_for_good)
{
    static const char path[] = "ranks_memory.checkpoint";
    OWNED(hd_run) *run = shared(short_scene(16, 0));
    OWNED(hd_run) *resumed = NULL;
    hd_status status = HD_OK;
    CHECK_OK(hd_run_save(run, path, "", NULL, 0));
    if (ranks->rank == ranks->ranks - 1) ledger_refuse(0, 1);
    while (status == HD_OK && hd_run_stage(run) != HD_FINISHED) status = hd_run_advance(run);
    ledger_refuse(0, 0);
    assert_int_equal(status, HD_NO_MEMORY);
    assert_int_equal(hd_run_status(run), HD_NO_MEMORY);
    assert_int_equal(hd_run_advance(run), HD_NO_MEMORY);
    assert_int_equal(hd_run_save(run, path, "", NULL, 0), HD_NO_MEMORY);
    CHECK_OK(hd_run_resume_shared(&resumed, path, NULL, ranks, NULL, 0));
    CHECK_CLOSE(hd_run_time(resumed), 0.0, 0.0);
    finish(resumed);
    CHECK_OK(hd_communicator_agree(ranks, HD_OK)); /* all have read it */
    if (ranks->rank == 0) (void)remove(path);
}

int main(int argc, char **argv) { return ranks_main(argc, argv); }
