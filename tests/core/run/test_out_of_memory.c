/** Out of memory at every single allocation of a run: it is named, and all of what was had is given
 * back. */
#include "chain.h"
#include "dynamics/trajectory.h"
#include "hdlyap/checkpoint.h"
#include "ledger.h"
#include "rotors.h"
#include "said.h"

enum { EVERYTHING = 31 | HD_OBSERVE_GAS | HD_OBSERVE_LOCALIZATION | HD_OBSERVE_FLUCTUATIONS };
static const char FILE_NAME[] = "out_of_memory.test", SAVED[] = "saved_out_of_memory.test";

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
    const bool steps = scene->observe & HD_OBSERVE_STEPS;
    if (status == HD_OK && steps) status = hd_pmode_create(&w->pmode, scene);
    if (status == HD_OK && steps) status = hd_hydro_create(&w->hydro, scene, hd_run_steps(w->run));
    while (status == HD_OK && hd_run_stage(w->run) != HD_FINISHED) status = hd_run_advance(w->run);
    if (status == HD_OK) status = hd_run_save(w->run, SAVED, "", NULL, 0);
    (void)remove(SAVED); /* there is none of a life that has failed */
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

/** Of each kind of particles, with what it keeps beside them. */
static hd_scene_def of_kind(hd_particles particles)
{
    const hd_scene_def def = scene_of_kind(particles, 36, 0.4, 1.0);
    return scene_from(def, .exponents = 4, .threads = 1, .equilibration = 0.1, .warmup = 0.5,
                      .observe = hd_dynamics_of(&def)->totals ? HD_OBSERVE_GAS : 0,
                      .duration = 1.0);
}

static hd_scene_def windows(void)
{
    return scene(.number = 8, .density = 0.4, .aspect = 1.0, .exponents = HD_EXPONENTS_ALL,
                 .observe = HD_OBSERVE_COVARIANT, .equilibration = 1.0, .warmup = 3.0,
                 .duration = 9.0, .covariant_window = 3.0, .covariant_transient = 3.0,
                 .covariant_sampling = 1.0, .threads = 1);
}

/** Resumed in the middle of the averaging. */
static void out_at_each_of_resumed(const char *name, hd_scene_def scene)
{
    hd_run *run = until(created(scene), HD_AVERAGING);
    CHECK_OK(hd_run_advance(run));
    CHECK_OK(hd_run_save(run, FILE_NAME, "", NULL, 0));
    hd_run_free(run);
    const size_t before = ledger_now().allocations;
    CHECK_OK(life(&scene, FILE_NAME, 0, 0));
    out_at_each(name, &scene, FILE_NAME, ledger_now().allocations - before);
    assert_int_equal(remove(FILE_NAME), 0);
}

static void out_at_each_of_both(const char *name, hd_scene_def scene)
{
    size_t of_creation;
    out_at_each(name, &scene, NULL, needed(&scene, &of_creation));
    out_at_each_of_resumed(name, scene);
}

TEST(of_each_kind)
{
    for (hd_particles kind = HD_DISKS; kind < HD_PARTICLES_END; kind++) {
        const hd_scene_def scene = of_kind(kind);
        out_at_each_of_both(hd_dynamics_of(&scene)->particles, scene);
    }
    out_at_each_of_both("chain", scene_from(chain_of(N, 10.0, HD_EXPONENTS_ALL),
                                            .equilibration = 1.0, .duration = 5.0));
}

/** With a time step that is asked for: without memory for a trial, one is chosen later. */
TEST(of_particles_by_their_forces)
{
    static const hd_parameter step[] = {HD_OWN_TIME_STEP(0)};
    hd_dynamics row = of_rotors;
    row.parameter = step;
    out_at_each_of_both("rotors",
                        scene_from(hd_scene_def_of(&row), .number = N, .threads = 1,
                                   .own[0].real = 0.05, .equilibration = 1.0, .duration = 5.0));
}

TEST(of_covariant_windows) { out_at_each_of_both("windows", windows()); }

/** The head of a file is that of a scene whose check takes memory. */
TEST(of_what_is_read_of_a_file)
{
    OWNED(hd_run) *run = created(of_kind(HD_SOFT_DISKS));
    hd_checkpoint kept;
    char line[256] = "";
    CHECK_OK(hd_run_save(run, FILE_NAME, "", NULL, 0));
    ledger_refuse(0, SIZE_MAX);
    const hd_status status = hd_checkpoint_read(&kept, FILE_NAME, NULL, 0, line, sizeof line);
    ledger_refuse(0, 0);
    assert_string_equal(hd_status_text(status), hd_status_text(HD_NO_MEMORY));
    assert_string_equal(line, hd_status_text(HD_NO_MEMORY));
    assert_int_equal(remove(FILE_NAME), 0);
}

/** What is read of a run needs none. */
static void expect_read_without(hd_scene_def scene)
{
    OWNED(hd_run) *run = finished(scene);
    const uint32_t fingerprint = hd_trajectory_fingerprint(hd_run_trajectory(run));
    said before = said_by(run);
    ledger_refuse(0, SIZE_MAX);
    said without = said_by(run);
    const uint32_t then = hd_trajectory_fingerprint(hd_run_trajectory(run));
    ledger_refuse(0, 0);
    expect_same_said(&before, &without);
    assert_true(then == fingerprint);
    said_free(&before);
    said_free(&without);
}

TEST(nothing_is_needed_to_read)
{
    expect_read_without(all_observables());
    expect_read_without(windows());
    for (hd_particles kind = HD_DISKS; kind < HD_PARTICLES_END; kind++)
        expect_read_without(of_kind(kind));
    expect_read_without(scene_from(chain_of(N, 10.0, HD_EXPONENTS_NONE), .duration = 5.0));
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
TEST(of_a_resumed_run) { out_at_each_of_resumed("resumed", growing_log()); }
