/** What is saved is resumed: particles of each kind, few and many, with few vectors and all. */
#include "chain.h"
#include "kept.h"
#include "same.h"

enum { MIXED = HD_PARTICLES_END, MIXED_SPHERES, CIRCLE, CHAIN, KINDS };

/** Particles of the core, disks or spheres of two kinds, disks in a circle, or those of a program.
 */
static hd_scene_def of_kind(int kind, int number, int exponents)
{
    const hd_particles core = kind < HD_PARTICLES_END ? (hd_particles)kind
                              : kind == MIXED_SPHERES ? HD_SPHERES
                                                      : HD_DISKS;
    hd_scene_def def = kind == CHAIN ? chain_of(number, 10.0, exponents)
                                     : scene_of_kind(core, number, 0.4, 1.0);
    if (kind == MIXED || kind == MIXED_SPHERES) def = with_second(def, 0.3, 1.5, 2.0);
    if (kind == CIRCLE)
        def = scene_from(def, .container = HD_CIRCLE, .aspect = usual_scene().aspect);
    def.exponents = exponents;
    def.equilibration = def.warmup = 0.05;
    def.duration = 1.0;
    def.report_interval = 0.1;
    def.threads = 1;
    return def;
}

static void expect_resumed(hd_run *run, const char *when)
{
    const hd_scene_def *scene = hd_run_scene(run);
    const bytes kept = kept_bytes(run);
    char line[512] = "";
    hd_run *resumed;
    if (kept_read(&resumed, &kept, scene, line, sizeof line) != HD_OK)
        fail_msg("%d %s, exponents %d, %s: %s", scene->number, hd_dynamics_of(scene)->particles,
                 scene->exponents, when, line);
    expect_same_state(run, resumed);
    hd_run_free(resumed);
    free(kept.data);
}

/** Of each stage; at first nothing is recorded, so that a file is as short as it can be. */
static void expect_resumed_at_any_time(hd_scene_def scene)
{
    OWNED(hd_run) *run = kept_run(scene);
    expect_resumed(run, "at the start");
    until(run, HD_WARMING_UP);
    (void)kept_steps(run, 1);
    expect_resumed(run, "in the warm-up");
    until(run, HD_AVERAGING);
    (void)kept_steps(run, 2);
    expect_resumed(run, "in the averaging");
}

TEST(each_kind_is_resumed)
{
    static const int exponents[] = {HD_EXPONENTS_NONE, 1, 4, 20, HD_EXPONENTS_POSITIVE,
                                    HD_EXPONENTS_ALL};
    for (int kind = 0; kind < KINDS; kind++)
        for (int k = 0; k < 6; k++) expect_resumed_at_any_time(of_kind(kind, 24, exponents[k]));
}

/** With nothing recorded, the files are as short as they can be. */
TEST(many_of_each_kind_are_resumed)
{
    static const struct {
        int number, exponents;
    } sizes[] = {{400, HD_EXPONENTS_NONE}, {400, 4}, {400, 20}, {20000, 2}};
    for (int kind = 0; kind < KINDS; kind++)
        for (int k = 0; k < 4; k++) {
            OWNED(hd_run) *run = kept_run(of_kind(kind, sizes[k].number, sizes[k].exponents));
            expect_resumed(run, "at the start");
        }
    if (!second_tier()) return;
    OWNED(hd_run) *most = kept_run(of_kind(HD_SOFT_DISKS, 1000000, 2));
    expect_resumed(most, "at the start");
}

/** Vectors in which all else is lost. */
TEST(a_long_chain_is_resumed)
{
    OWNED(hd_run) *run = kept_run(of_kind(CHAIN, 1000, HD_EXPONENTS_POSITIVE));
    expect_resumed(run, "at the start");
}

static void keep_no_particle(void *state, hd_archive *file)
{
    hd_archive_doubles(file, "chain time", &((chain *)state)->now, 1);
}

/** What could not be resumed is not saved. */
TEST(a_row_that_keeps_less_than_its_particles_is_not_saved)
{
    hd_dynamics of_less = of_chain;
    of_less.archive = keep_no_particle;
    hd_scene_def scene = of_kind(CHAIN, 1000, HD_EXPONENTS_NONE);
    scene.dynamics = &of_less;
    OWNED(hd_run) *run = kept_run(scene);
    char line[512] = "";
    assert_int_equal(hd_run_save(run, "kinds.test", "", line, sizeof line), HD_FILE_FAULT);
    assert_non_null(strstr(line, "scene: what follows is too short for its particles"));
    assert_null(fopen("kinds.test", "rb"));
}
