/** A dynamics of one's own, the chain of the examples, by several ranks: against one, and led. */
#define _GNU_SOURCE
#include "runs.h"
#include "together.h"

#define main chain_main
#include "../../../hdlyap_core/examples/chain.c"
#undef main

static hd_scene_def chain_of(int exponents, unsigned observe)
{
    hd_scene_def scene = hd_scene_def_of(&of_chain);
    scene.disks = 9;
    scene.own[BETA].real = scene.own[ENERGY].real = 10.0;
    scene.own[STEP].real = 0.01;
    scene.exponents = exponents;
    scene.observe = observe;
    scene.equilibration = 20.0;
    scene.warmup = scene.covariant_transient = 50.0;
    scene.covariant_window = 20.0;
    scene.duration = 100.0;
    scene.threads = 1;
    return scene;
}

/** Frames differ by rounding; the steps are the same bits. */
static void compare(hd_scene_def def)
{
    hd_run *run = NULL;
    double q[2][9];
    CHECK_OK(hd_run_create_shared(&run, &def, ranks, NULL, 0));
    finish(run);
    OWNED(hd_run) *alone = finished(def);
    check_same_exponents(run, alone, hd_run_cost(run).error_bound + hd_run_cost(alone).error_bound);
    hd_trajectory_state(hd_run_trajectory(run), q[0], NULL);
    hd_trajectory_state(hd_run_trajectory(alone), q[1], NULL);
    assert_memory_equal(q[0], q[1], sizeof q[0]);
    for (int col = 0; col < hd_run_vectors(run); col++)
        CHECK_CLOSE(hd_localization_widths(hd_run_localization(run))[col],
                    hd_localization_widths(hd_run_localization(alone))[col], 1e-6);
    hd_run_free(run);
}

TEST(halves_are_those_of_one_rank) { compare(chain_of(HD_EXPONENTS_ALL, HD_OBSERVE_LOCALIZATION)); }

TEST(all_and_their_covariant_vectors_are_those_of_one_rank)
{
    compare(chain_of(HD_EXPONENTS_ALL_INDEPENDENT, HD_OBSERVE_LOCALIZATION | HD_OBSERVE_COVARIANT));
}

/** Creates, keeps, resumes; the largest exponent. */
static double lead(hd_communicator *c)
{
    const char *path = "ranks_own.ckpt";
    char message[300];
    const hd_scene_def scene = chain_of(HD_EXPONENTS_POSITIVE, 0);
    hd_run *run;
    CHECK_OK(hd_run_create_shared(&run, &scene, c, message, sizeof message));
    until_time(run, 100.0);
    CHECK_OK(hd_run_save(run, path, "", message, sizeof message));
    hd_run_free(run);
    CHECK_OK(hd_run_resume_shared(&run, path, &scene, c, message, sizeof message));
    finish(run);
    const double largest = hd_spectrum_exponent(hd_run_spectrum(run), 0);
    hd_run_free(run);
    (void)remove(path);
    return largest;
}

TEST(others_follow)
{
    const hd_dynamics *const own[] = {&of_chain};
    if (ranks->rank > 0) {
        hd_run_follow(ranks, own, 1);
        return;
    }
    hd_run_lead(ranks);
    const double largest = lead(ranks);
    hd_run_dismiss(ranks);
    CHECK_CLOSE(largest, lead(NULL), 1e-6);
}

int main(int argc, char **argv) { return ranks_main(argc, argv); }
