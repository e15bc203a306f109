/** A dynamics of one's own in checkpoints: a chain by hand. */
#include "chain.h"
#include "kept.h"
#include "same.h"

#define PATH "own.ckpt"

static void check_not_resumed(const char *path, const hd_scene_def *scene, hd_status status,
                              const char *line)
{
    char message[512] = "";
    hd_run *run;
    const hd_status found = hd_run_resume(&run, path, scene, message, sizeof message);
    assert_string_equal(message, line);
    assert_int_equal(found, status);
}

TEST(a_resumed_run_is_the_same)
{
    hd_scene_def scene = with_covariant(HD_EXPONENTS_ALL);
    OWNED(hd_run) *alone = created(scene);
    for (double time = 30.0; time < 600.0; time += 97.3) { /* of each stage */
        until_time(alone, time);
        CHECK_OK(hd_run_save(alone, PATH, "", NULL, 0));
        hd_run *resumed;
        CHECK_OK(hd_run_resume(&resumed, PATH, &scene, NULL, 0));
        expect_same_state(alone, resumed);
        for (int k = 0; k < 5; k++) {
            CHECK_OK(hd_run_advance(resumed));
            CHECK_OK(hd_run_advance(alone));
        }
        if (hd_run_stage(alone) < HD_AVERAGING) expect_same_state(alone, resumed);
        hd_run_free(resumed);
    }
    (void)remove(PATH);
}

TEST(another_dynamics_is_not_resumed)
{
    hd_scene_def scene = chain_of(N, 10.0, 3), other = scene;
    OWNED(hd_run) *run = created(scene);
    until_time(run, 60.0);
    CHECK_OK(hd_run_save(run, PATH, "", NULL, 0));
    other.own[BETA].real = 0.5;
    check_not_resumed(PATH, &other, HD_REFUSED, "beta = 0.5: must be 10, as in the checkpoint");
    other = scene_from(hd_scene_def_default(), .number = N, .density = 0.5, .aspect = 1.0);
    check_not_resumed(PATH, &other, HD_REFUSED,
                      "particles = disks: must be chain, as in the checkpoint");
    check_not_resumed(PATH, NULL, HD_FILE_FAULT,
                      PATH ": is of particles = chain, which this program does not know");
    const hd_dynamics *const own[] = {&of_chain};
    hd_checkpoint kept;
    CHECK_OK(hd_checkpoint_read(&kept, PATH, own, 1, NULL, 0));
    assert_string_equal(kept.particles, "chain");
    assert_ptr_equal(kept.scene.dynamics, &of_chain);
    CHECK_CLOSE(kept.scene.own[STEP].real, 0.005, 0.0);
    assert_int_equal(hd_checkpoint_read(&kept, PATH, NULL, 0, NULL, 0), HD_FILE_FAULT);
    OWNED(hd_run) *disks = created(other);
    CHECK_OK(hd_run_save(disks, PATH, "", NULL, 0));
    check_not_resumed(PATH, &scene, HD_REFUSED,
                      "particles = chain: must be disks, as in the checkpoint");
    (void)remove(PATH);
}

/** Exponents that grow with beta: an automatic warm-up follows from it. */
static double rate_of_beta(const hd_scene_def *s) { return 0.1 * s->number * s->own[BETA].real; }

/** Refused is what was asked for, not what follows from it. */
TEST(a_changed_parameter_is_named)
{
    hd_dynamics of_rate = of_chain;
    of_rate.collision_rate = rate_of_beta;
    hd_scene_def scene = hd_scene_def_of(&of_rate), other;
    scene.number = N;
    OWNED(hd_run) *run = created(scene);
    CHECK_OK(hd_run_save(run, PATH, "", NULL, 0));
    other = scene;
    other.own[BETA].real = 0.5;
    check_not_resumed(PATH, &other, HD_REFUSED, "beta = 0.5: must be 1, as in the checkpoint");
    other = scene;
    other.number = N + 1;
    check_not_resumed(PATH, &other, HD_REFUSED, "number = 9: must be 8, as in the checkpoint");
    (void)remove(PATH);
}

/** A row whose parameters are words, an integer, and a word or a number. */
TEST(own_parameters_can_be_words)
{
    static const hd_parameter_word kinds[] = {{"soft", 3}, {"stiff", 7}, {NULL, 0}};
    static const hd_parameter words[] = {
        {"beta", HD_PARAMETER_REAL, NULL, HD_OWN(BETA), 1, 0, 1e3, "from 0 to 1000", "",
         .text = ""},
        {"energy", HD_PARAMETER_INTERVAL, kinds, HD_OWN(ENERGY), 7, 10, 20,
         "soft, stiff or from 10 to 20", "", .text = ""},
        {"time_step", HD_PARAMETER_REAL, NULL, HD_OWN(STEP), 0.02, 1e-6, 0.1, "from 1e-6 to 0.1",
         "", .text = ""},
        {"kind", HD_PARAMETER_WORD, kinds, HD_OWN(3), 3, 3, 7, "soft or stiff", "", .text = ""},
        {"pieces", HD_PARAMETER_INT, NULL, HD_OWN(4), 5, 1, 9, "an integer from 1 to 9", "",
         .text = ""}};
    hd_dynamics of_words = of_chain;
    of_words.parameter = words;
    of_words.parameters = 5;
    hd_scene_def scene = hd_scene_def_of(&of_words), other;
    scene.number = N;
    scene.threads = 1;
    assert_int_equal(scene.own[3].whole, 3);
    assert_int_equal(scene.own[4].whole, 5);
    OWNED(hd_run) *run = created(scene);
    until_time(run, 20.0);
    CHECK_OK(hd_run_save(run, PATH, "", NULL, 0));
    other = scene;
    other.own[3].whole = 7;
    check_not_resumed(PATH, &other, HD_REFUSED, "kind = stiff: must be soft, as in the checkpoint");
    other = scene;
    other.own[ENERGY].real = 12.0;
    check_not_resumed(PATH, &other, HD_REFUSED, "energy = 12: must be stiff, as in the checkpoint");
    other = scene;
    other.own[4].whole = 6;
    check_not_resumed(PATH, &other, HD_REFUSED, "pieces = 6: must be 5, as in the checkpoint");
    scene.own[ENERGY].real = 8.0;
    check_refused(scene, "energy = 8: must be soft, stiff or from 10 to 20");
    (void)remove(PATH);
}
