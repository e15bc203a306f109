/** An observable is a file and a line: this file, and that of madeup/hdlyap/observables.inc. With
 * it the core that is compiled here measures, averages, keeps and gives what no other file knows.
 */
#include "base/memory.h"
#include "kept.h"
#include "observe/observable.h"
#include "runs.h"
#include "scene/scene.h"

typedef struct madeup {
    double mean, reports; /**< the result */
} madeup;

static double madeup_bytes(const hd_scene_def *scene, int ranks)
{
    (void)scene, (void)ranks;
    return sizeof(madeup);
}

static void *madeup_create(const hd_observing *with, hd_status *status)
{
    madeup *made = hd_memory_alloc(1, sizeof *made);
    (void)with;
    *status = made ? HD_OK : HD_NO_MEMORY;
    return made;
}

static void madeup_free(void *self) { hd_memory_free(self); }

static void madeup_clear(void *self, const hd_moment *now)
{
    (void)now;
    *(madeup *)self = (madeup){0.0, 0.0};
}

static void madeup_report(void *self, const hd_moment *now)
{
    madeup *m = self;
    const int dimension = hd_scene_dimension(now->with->scene), disks = now->with->scene->number;
    double sum = 0.0;
    for (int i = 0; i < disks; i++) {
        double square = 0.0;
        for (int d = 0; d < dimension; d++)
            square += now->p[dimension * i + d] * now->p[dimension * i + d];
        sum += square * square;
    }
    m->reports += 1.0;
    m->mean += (sum / disks - m->mean) / m->reports;
}

static void madeup_archive(void *self, const hd_moment *now)
{
    madeup *m = self;
    hd_archive_double(now->archive, "madeup mean", &m->mean);
    hd_archive_double(now->archive, "madeup reports", &m->reports);
}

const hd_observable hd_madeup_row = {.needs = HD_NEEDS_REPORTS | HD_NEEDS_STATE,
                                     .bytes = madeup_bytes,
                                     .create = madeup_create,
                                     .free = madeup_free,
                                     .clear = madeup_clear,
                                     .report = madeup_report,
                                     .archive = madeup_archive};

/* ---- what follows from it ------------------------------------------------------------------- */

static hd_scene_def scene_with(int exponents, unsigned observe)
{
    return scene(.number = 20, .density = 0.3, .exponents = exponents, .observe = observe,
                 .equilibration = 5.0, .warmup = exponents ? 5.0 : 0.0, .duration = 30.0,
                 .report_interval = 0.5, .threads = 1);
}

/** Mean of |p|^4 now. */
static double fourth_power(const hd_run *run)
{
    double q[40], p[40], sum = 0.0;
    hd_trajectory_state(hd_run_trajectory(run), q, p);
    for (int i = 0; i < 40; i += 2) sum += pow(p[i] * p[i] + p[i + 1] * p[i + 1], 2.0);
    return sum / 20.0;
}

static const int EXPONENTS[] = {HD_EXPONENTS_NONE, 3};

/** At every report of the averaging, with and without a frame. */
TEST(it_is_measured_and_given)
{
    for (int k = 0; k < 2; k++) {
        OWNED(hd_run) *run = created(scene_with(EXPONENTS[k], HD_OBSERVE_MADEUP));
        double sum = 0.0, reports = 0.0;
        until(run, HD_AVERAGING);
        while (going_on(run))
            if (hd_run_report_due(run)) sum += fourth_power(run), reports++;
        CHECK_CLOSE(hd_run_madeup(run)[1], reports, 0.0);
        CHECK_CLOSE(reports, 60.0, 0.0);
        CHECK_CLOSE(hd_run_madeup(run)[0], sum / reports, 1e-12 * sum / reports);
    }
}

TEST(it_is_kept_and_forgotten)
{
    for (int k = 0; k < 2; k++) {
        const hd_scene_def scene = scene_with(EXPONENTS[k], HD_OBSERVE_MADEUP);
        OWNED(hd_run) *run = created(scene), *resumed = NULL;
        until_time(run, 20.0);
        const bytes kept = kept_bytes(run);
        CHECK_OK(kept_read(&resumed, &kept, &scene, NULL, 0));
        free(kept.data);
        until_time(run, 30.0), until_time(resumed, 30.0);
        assert_true(hd_run_madeup(run)[1] > 20.0);
        assert_memory_equal(hd_run_madeup(run), hd_run_madeup(resumed), 2 * sizeof(double));
        CHECK_OK(hd_run_reset_average(run));
        CHECK_CLOSE(hd_run_madeup(run)[1], 0.0, 0.0);
    }
}

/** And changes nothing else. */
TEST(it_is_off_unless_asked_for)
{
    const hd_scene_def without = scene_with(3, 0), with = scene_with(3, HD_OBSERVE_MADEUP);
    OWNED(hd_run) *run = finished(without);
    assert_null(hd_run_madeup(run));
    assert_true(HD_OBSERVE_ALL & HD_OBSERVE_MADEUP);
    assert_false(HD_OBSERVE_WAVES & HD_OBSERVE_MADEUP);
    CHECK_CLOSE(hd_memory_needed(&with, 1, 1) - hd_memory_needed(&without, 1, 1),
                sizeof(madeup) + 80 * sizeof(double), 0.0); /* q and p */
}
