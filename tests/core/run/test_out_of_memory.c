/** Out of memory at every single allocation of a run: it is named, and all of what was had is given
 * back. */
#include "ledger.h"
#include "runs.h"

enum { EVERYTHING = 31 | HD_OBSERVE_GAS | HD_OBSERVE_LOCALIZATION | HD_OBSERVE_FLUCTUATIONS };
static const char FILE_NAME[] = "out_of_memory.test";

/** Everything that a node makes of a scene. */
typedef struct world {
    const char *resumed; /**< file to begin with, NULL for a new run */
    hd_run *run;
    hd_pmode *pmode; /**< NULL without modes, as the next */
    hd_hydro *hydro;
} world;

/** With phases found from the slowest vectors alone, which takes 64 vectors. */
static hd_scene_def all_observables(void)
{
    return scene(.number = 34, .density = 0.7, .aspect = 1.0, .observe = EVERYTHING,
                 .equilibration = 2.0, .warmup = 2.0, .duration = 2.0, .threads = 1);
}

/** One vector of many disks: the log of an interval grows, and with it what the frame makes of it.
 */
static hd_scene_def growing_log(void)
{
    return scene(.number = 2000, .density = 0.7, .aspect = 1.0, .boundary[1] = R, .exponents = 1,
                 .equilibration = 0.1, .warmup = 2.0, .duration = 2.0, .report_interval = 2.0,
                 .threads = 1);
}

static hd_status live(world *w, const hd_scene_def *scene)
{
    hd_status status = w->resumed ? hd_run_resume(&w->run, w->resumed, scene, NULL, 0)
                                  : hd_run_create(&w->run, scene, NULL, 0);
    if (status == HD_OK && scene->observe) status = hd_pmode_create(&w->pmode, scene);
    if (status == HD_OK && scene->observe)
        status = hd_hydro_create(&w->hydro, scene, hd_run_steps(w->run));
    while (status == HD_OK && hd_run_stage(w->run) != HD_FINISHED) status = hd_run_advance(w->run);
    return status;
}

/** A life in which memory is out `times` times, after so many allocations; what it ends with. */
static hd_status life(const hd_scene_def *scene, const char *resumed, size_t first, size_t times)
{
    const ledger before = ledger_now();
    world w = {resumed, NULL, NULL, NULL};
    ledger_refuse(first, times);
    const hd_status status = live(&w, scene);
    ledger_refuse(0, 0);
    hd_hydro_free(w.hydro);
    hd_pmode_free(w.pmode);
    hd_run_free(w.run);
    assert_int_equal(ledger_now().live, before.live);
    return status;
}

/** Allocations of a life, and how many of them are of its creation. */
static size_t needed(const hd_scene_def *scene, size_t *of_creation)
{
    const size_t before = ledger_now().allocations;
    hd_run *run = created(*scene);
    hd_run_free(run);
    const size_t created = ledger_now().allocations;
    CHECK_OK(life(scene, NULL, 0, 0));
    *of_creation = created - before;
    return ledger_now().allocations - created;
}

/** Memory out at allocation 0, 1, .. of the scene: for once, and for good. */
static void out_at_each(const char *name, const hd_scene_def *scene, const char *resumed,
                        size_t count)
{
    static const size_t times[] = {1, SIZE_MAX};
    for (size_t k = 0; k < 2 * count; k++) {
        const hd_status status = life(scene, resumed, k / 2, times[k % 2]);
        if (status == HD_NO_MEMORY) continue;
        print_error("%s, allocation %zu of %zu: %s\n", name, k / 2, count, hd_status_text(status));
        fail();
    }
    CHECK_OK(life(scene, resumed, count, SIZE_MAX));
    print_message("%s: out of memory at each of %zu allocations\n", name, count);
}

TEST(of_all_observables)
{
    const hd_scene_def scene = all_observables();
    size_t of_creation;
    const size_t count = needed(&scene, &of_creation);
    assert_true(of_creation > 100);
    out_at_each("all observables", &scene, NULL, count);
}

TEST(of_a_growing_log)
{
    const hd_scene_def scene = growing_log();
    size_t of_creation;
    const size_t count = needed(&scene, &of_creation);
    assert_true(count > of_creation + 3); /* the log and the maps, more than once each */
    out_at_each("growing log", &scene, NULL, count);
}

/** In mid-interval, with a log that has grown: what is read needs room before anything is advanced.
 */
TEST(of_a_resumed_run)
{
    const hd_scene_def scene = growing_log();
    hd_run *run = created(scene);
    until(run, HD_AVERAGING);
    CHECK_OK(hd_run_advance(run));
    CHECK_OK(hd_run_save(run, FILE_NAME, "", NULL, 0));
    hd_run_free(run);
    const size_t before = ledger_now().allocations;
    CHECK_OK(life(&scene, FILE_NAME, 0, 0));
    out_at_each("resumed", &scene, FILE_NAME, ledger_now().allocations - before);
    assert_int_equal(remove(FILE_NAME), 0);
}
