/** Only what a scene asks for has memory, and the loop asks for none: blocks and bytes, exactly. */
#include "ledger.h"
#include "runs.h"

enum { DISKS = 100, HALF = 2 * DISKS - 3, EVERYTHING = 223 };

static hd_scene_def small(int exponents, unsigned observe)
{
    return scene(.number = DISKS, .density = 0.7, .aspect = 1.0, .exponents = exponents,
                 .observe = observe, .equilibration = 5.0, .warmup = 5.0, .duration = 100.0,
                 .threads = 1);
}

/** Blocks and bytes that a run holds when it is `time` old. */
static ledger held(const hd_scene_def *scene, double time)
{
    const ledger before = ledger_now();
    hd_run *run = created(*scene);
    until_time(run, time);
    const ledger now = ledger_now();
    hd_run_free(run);
    assert_int_equal(ledger_now().live, before.live); /* all of it is given back */
    return (ledger){.allocations = now.allocations - before.allocations,
                    .live = now.live - before.live};
}

/** Bytes that a run begins with, more than the trajectory alone. */
static double bytes_for(int exponents, unsigned observe)
{
    const hd_scene_def alone = small(HD_EXPONENTS_NONE, 0), with = small(exponents, observe);
    return (double)held(&with, 0.0).live - (double)held(&alone, 0.0).live;
}

/** Disks, predictions, cells, queue, twice their places and the run itself; and it never keeps a
 * log. What is asked of a frame that is not there costs nothing either. */
TEST(the_trajectory_alone_is_all_there_is)
{
    const hd_scene_def scene = small(HD_EXPONENTS_NONE, 0);
    const ledger before = ledger_now();
    hd_trajectory *trajectory;
    CHECK_OK(hd_trajectory_create(&trajectory, &scene));
    const size_t bytes = ledger_now().live - before.live;
    const size_t blocks = ledger_now().allocations - before.allocations;
    hd_trajectory_free(trajectory);
    for (double time = 0.0; time <= 100.0; time += 50.0) {
        const ledger run = held(&scene, time);
        assert_int_equal(run.allocations, blocks + 3);
        assert_int_equal(run.live, bytes + sizeof(hd_run) + 2 * 2 * DISKS * sizeof(double));
    }
}

/** A frame of n vectors: some copies of V, the Gram matrix, and what does not grow with n. */
TEST(bytes_are_those_of_the_vectors_asked_for)
{
    const double copies = 4.0, rest = 20000.0, m = 4.0 * DISKS;
    const double half = bytes_for(HD_EXPONENTS_POSITIVE, 0);
    static const int wanted[] = {1, 2, 8, 10, 32, HALF};
    for (size_t k = 0; k < sizeof wanted / sizeof *wanted; k++) {
        const double bytes = bytes_for(wanted[k], 0);
        const double n = 16.0 * ceil(wanted[k] / 16.0); /* whole blocks of columns */
        assert_true(bytes > 8.0 * m * wanted[k]);
        assert_true(bytes <= copies * 8.0 * m * n + 8.0 * n * n + rest);
    }
    assert_true(bytes_for(1, 0) < 0.02 * half);
    assert_true(bytes_for(10, 0) < 0.12 * half);
}

/** Each stage has memory of its own, and only if it is asked for. */
TEST(stages_have_memory_when_asked_for)
{
    static const unsigned stages[] = {0, HD_OBSERVE_STEPS, HD_OBSERVE_STEPS | HD_OBSERVE_PHASES,
                                      HD_OBSERVE_STEPS | HD_OBSERVE_PHASES | HD_OBSERVE_T_PHASES,
                                      EVERYTHING};
    double before = 0.0;
    for (size_t k = 0; k < sizeof stages / sizeof *stages; k++) {
        const double bytes = bytes_for(HD_EXPONENTS_POSITIVE, stages[k]);
        assert_true(bytes > before + 1000.0);
        before = bytes;
    }
    assert_true(bytes_for(HD_EXPONENTS_NONE, HD_OBSERVE_GAS) > 0.0);
    assert_true(bytes_for(1, HD_OBSERVE_LOCALIZATION) > bytes_for(1, 0));
    CHECK_CLOSE(bytes_for(HD_EXPONENTS_POSITIVE, HD_OBSERVE_MODES),
                bytes_for(HD_EXPONENTS_POSITIVE, HD_OBSERVE_STEPS), 0.0);
    CHECK_CLOSE(bytes_for(HD_EXPONENTS_POSITIVE, EVERYTHING), before,
                0.0); /* the rest is the caller's */
}

TEST(what_is_not_asked_for_is_not_there)
{
    for (int exponents = HD_EXPONENTS_POSITIVE; exponents <= 1; exponents++) {
        OWNED(hd_run) *run = created(small(exponents, 0));
        assert_int_equal(hd_run_frame(run) != NULL, exponents != HD_EXPONENTS_NONE);
        assert_int_equal(hd_run_spectrum(run) != NULL, exponents != HD_EXPONENTS_NONE);
        assert_null(hd_run_modes(run));
        assert_null(hd_run_steps(run));
        assert_null(hd_run_phases(run));
        assert_null(hd_run_t_phases(run));
        assert_null(hd_run_structure(run));
    }
}

/** In each mode, once the log and its maps have grown to their size. */
TEST(a_long_run_allocates_nothing)
{
    static const struct {
        int exponents;
        unsigned observe;
    } modes[] = {{HD_EXPONENTS_NONE, 0},
                 {HD_EXPONENTS_NONE, HD_OBSERVE_GAS},
                 {1, 0},
                 {10, 0},
                 {HD_EXPONENTS_POSITIVE, 0},
                 {HD_EXPONENTS_ALL, 0},
                 {HD_EXPONENTS_POSITIVE, HD_OBSERVE_STEPS},
                 {10, EVERYTHING},
                 {HD_EXPONENTS_POSITIVE, EVERYTHING},
                 {HD_EXPONENTS_ALL,
                  EVERYTHING | HD_OBSERVE_GAS | HD_OBSERVE_LOCALIZATION | HD_OBSERVE_FLUCTUATIONS}};
    for (size_t k = 0; k < 2 * (sizeof modes / sizeof *modes); k++) {
        OWNED(hd_run) *run = created(scene_from(small(modes[k / 2].exponents, modes[k / 2].observe),
                                                .boundary[0] = k % 2 ? R : P,
                                                .boundary[1] = k % 2 ? R : P, .number = 40));
        until_time(run, 60.0);
        const size_t before = ledger_now().allocations;
        until_time(run, HUGE_VAL);
        assert_int_equal(ledger_now().allocations, before);
    }
}
