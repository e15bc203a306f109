/** All that a run says, with all observables: kept in a checkpoint, and forgotten by a reset. */
#include "kept.h"
#include "said.h"
#include "same.h"
#include "runs.h"

/** A narrow channel, whose LP and T steps are soon known; spheres in a long box. */
static hd_scene_def channel(int exponents, hd_boundary y)
{
    return scene(.number = 24, .density = 0.6, .aspect = 0.08, .boundary[1] = y, .threads = 1,
                 .exponents = exponents, .equilibration = 5.0, .warmup = 30.0, .duration = 100.0,
                 .observe = HD_OBSERVE_ALL, .report_interval = 2.0, .covariant_window = 5.0,
                 .covariant_transient = 5.0, .covariant_sampling = 1.0);
}

static hd_scene_def spheres_in_a_tube(void)
{
    return scene_from(channel(HD_EXPONENTS_ALL, P), .particles = HD_SPHERES, .density = 0.5,
                      .aspect = 0.15, .aspect_z = 0.15, .number = 16);
}

/** Whether a part has said another number than before. */
static bool differ(const said *a, const said *b, const char *part)
{
    if (a->count != b->count) return true;
    for (size_t k = 0; k < a->count; k++)
        if (strcmp(a->number[k].part, part) == 0 && a->number[k].value != b->number[k].value)
            return true;
    return false;
}

static void expect_kept(hd_run *run)
{
    CHECK_OK(hd_run_settle(run)); /* as hd_run_save does */
    const bytes kept = kept_bytes(run);
    hd_run *resumed;
    CHECK_OK(kept_read(&resumed, &kept, NULL, NULL, 0));
    expect_same_state(run, resumed);
    hd_run_free(resumed);
    free(kept.data);
}

/** At each report, and in between. */
static void expect_all_kept(hd_scene_def scene)
{
    OWNED(hd_run) *run = kept_run(scene);
    said before = said_of_averages(run), after;
    for (int step = 0; going_on(run); step++)
        if (hd_run_report_due(run) || step % 50 == 0) expect_kept(run);
    expect_kept(run);
    after = said_of_averages(run);
#define HD_OBSERVABLE(name, NAME, bit, of_waves, result)                                           \
    if (hd_run_parts(run).name) assert_true(differ(&before, &after, #name));
#include "hdlyap/observables.inc"
    said_free(&before);
    said_free(&after);
}

TEST(a_resumed_run_says_all_that_the_run_said)
{
    expect_all_kept(channel(HD_EXPONENTS_ALL, P));
    expect_all_kept(channel(HD_EXPONENTS_ALL_INDEPENDENT, R));
    expect_all_kept(spheres_in_a_tube());
}

/** Also while the next one, which begins anew, is under way. */
TEST(the_last_window_that_has_ended_stays_the_last)
{
    OWNED(hd_run) *run = kept_run(channel(HD_EXPONENTS_ALL, P)), *resumed = NULL;
    while (hd_covariant_read(hd_run_covariant(run)).windows < 3) CHECK_OK(hd_run_advance(run));
    const double end = hd_covariant_read(hd_run_covariant(run)).window_end;
    until_time(run, end + 7.3);
    const bytes kept = kept_bytes(run);
    CHECK_OK(kept_read(&resumed, &kept, NULL, NULL, 0));
    free(kept.data);
    for (; hd_covariant_read(hd_run_covariant(resumed)).windows == 3; (void)going_on(resumed))
        CHECK_CLOSE(hd_covariant_read(hd_run_covariant(resumed)).window_end, end, 0.0);
}

/** As it was where the averaging began; whoever looks, and in a run that was resumed, too. */
static void expect_forgotten(hd_scene_def scene, unsigned looked_at, bool resumed)
{
    OWNED(hd_run) *run = until(kept_run(scene), HD_AVERAGING);
    said before = said_of_averages(run), after;
    until_time(run, 95.0);
    if (resumed) {
        CHECK_OK(hd_run_settle(run));
        const bytes kept = kept_bytes(run);
        hd_run_free(run);
        CHECK_OK(kept_read(&run, &kept, NULL, NULL, 0));
        free(kept.data);
    }
    hd_run_observe(run, looked_at);
    CHECK_OK(hd_run_reset_average(run));
    after = said_of_averages(run);
    expect_same_said(&before, &after);
    said_free(&before);
    said_free(&after);
}

TEST(a_reset_run_says_what_it_said_when_the_averaging_began)
{
    expect_forgotten(channel(HD_EXPONENTS_ALL, P), HD_OBSERVE_ALL, false);
    expect_forgotten(channel(HD_EXPONENTS_ALL, P), 0, true);
    expect_forgotten(channel(HD_EXPONENTS_ALL_INDEPENDENT, R), HD_OBSERVE_ALL, true);
    expect_forgotten(spheres_in_a_tube(), HD_OBSERVE_ALL, false);
}
