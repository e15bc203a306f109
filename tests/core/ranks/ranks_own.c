/** A dynamics of one's own, a chain by hand, by several ranks: against one, and led. */
#define _GNU_SOURCE
#include "chain.h"
#include "together.h"

static hd_scene_def short_chain(int exponents, unsigned observe)
{
    return scene_from(chain_of(9, 10.0, exponents), .own[STEP].real = 0.01, .observe = observe,
                      .equilibration = 20.0, .warmup = 50.0, .covariant_transient = 50.0,
                      .covariant_window = 20.0, .duration = 100.0);
}

static void compare(hd_scene_def def)
{
    OWNED(hd_run) *run = shared(def);
    OWNED(hd_run) *alone = finished(def);
    finish(run);
    check_same_run(run, alone);
}

TEST(halves_are_those_of_one_rank)
{
    compare(short_chain(HD_EXPONENTS_ALL, HD_OBSERVE_LOCALIZATION));
}

TEST(all_and_their_covariant_vectors_are_those_of_one_rank)
{
    compare(
        short_chain(HD_EXPONENTS_ALL_INDEPENDENT, HD_OBSERVE_LOCALIZATION | HD_OBSERVE_COVARIANT));
}

static void measure(const hd_scene_def *scene, const double *q, const double *p, double *value)
{
    (void)q;
    value[0] = 0.0;
    for (int i = 0; i < scene->number; i++) value[0] += p[i] * p[i];
}

/** To the bit, as all ranks move the same particles. */
TEST(averages_are_those_of_one_rank)
{
    static const hd_average told[] = {{"squares", ""}};
    hd_dynamics row = of_chain;
    hd_scene_def def = short_chain(HD_EXPONENTS_ALL, HD_OBSERVE_AVERAGES);
    row.average = told;
    row.averages = 1;
    row.measure = measure;
    def.dynamics = &row;
    def.duration = 1000.0;
    OWNED(hd_run) *run = shared(def);
    OWNED(hd_run) *alone = finished(def);
    finish(run);
    const hd_mean found = hd_averages_read(hd_run_averages(run), 0),
                  wanted = hd_averages_read(hd_run_averages(alone), 0);
    CHECK_CLOSE(found.mean, wanted.mean, 0.0);
    CHECK_CLOSE(found.std_error, wanted.std_error, 0.0);
    assert_true(wanted.std_error > 0);
}

/** Creates, keeps, resumes; the largest exponent. */
static double lead(hd_communicator *c)
{
    const char *path = "ranks_own.ckpt";
    char message[300];
    const hd_scene_def scene = short_chain(HD_EXPONENTS_POSITIVE, 0);
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
