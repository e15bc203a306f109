/** Runs that are watched, for pictures. */
#include "run/run_state.h"
#include "runs.h"

static const unsigned EVERYTHING = HD_OBSERVE_MODES | HD_OBSERVE_STEPS | HD_OBSERVE_PHASES;
enum { WANTED = 12 };

/** A long box whose steps are found within seconds. */
static hd_scene_def long_box(double duration)
{
    return scene(.number = 100, .density = 0.8, .aspect = 0.2, .seed = 3, .equilibration = 5.0,
                 .warmup = 40.0, .duration = duration, .observe = EVERYTHING, .threads = 1);
}

/** Steps to the end, with `wanted` of the slowest vectors after each, and returns their number. */
static int finish_counting(hd_run *run, int wanted)
{
    int steps = 0;
    for (; going_on(run); steps++)
        if (wanted > 0) CHECK_OK(hd_run_measure(run, hd_run_vectors(run) - wanted));
    return steps;
}

static void check_same_phases(const hd_run *a, const hd_run *b)
{
    int tracked = 0;
    for (int k = 0; k < hd_phases_count(hd_run_phases(a)); k++) {
        const hd_phase *x = hd_phases_phase(hd_run_phases(a), k);
        const hd_phase *y = hd_phases_phase(hd_run_phases(b), k);
        tracked += x->state == HD_PHASE_TRACKED;
        assert_int_equal(x->state, y->state);
        assert_true(x->phase == y->phase && x->omega == y->omega && x->time == y->time);
    }
    assert_true(tracked > 0);
}

/** Whoever only looks at the disks changes no bit, however short the steps become. */
TEST(a_view_of_the_disks_changes_nothing)
{
    const hd_scene_def scene = long_box(60.0);
    OWNED(hd_run) *plain = created(scene), *viewed = created(scene);
    hd_run_watch(viewed, 0.037);
    const int few = finish_counting(plain, 0), many = finish_counting(viewed, 0);
    assert_true(many > 105.0 / 0.037);
    assert_true(few < many / 10);
    check_same_exponents(plain, viewed, 0.0);
    check_same_phases(plain, viewed);
}

static double dot(hd_columns v, int a, hd_columns w, int b, int rows)
{
    double sum = 0.0;
    for (int row = 0; row < rows; row++)
        sum += v.data[row * v.stride + a - v.first] * w.data[row * w.stride + b - w.first];
    return sum;
}

static void check_orthonormal(hd_columns v, int rows)
{
    for (int a = v.first; a < v.first + v.count; a++)
        for (int b = v.first; b <= a; b++)
            CHECK_CLOSE(dot(v, a, v, b, rows), a == b,
                        2e-6); /* DEFECT_MEASURED of carrier.c, twice */
}

/** Until the averaging has steps. */
static void begin_to_look(hd_run *run)
{
    while (hd_run_stage(run) != HD_AVERAGING || hd_modes_samples(hd_run_modes(run)) < 3)
        CHECK_OK(hd_run_advance(run));
}

/** Brings a run that reports often and is orthonormalised for each report to the time of another.
 */
static void catch_up(hd_run *run, double time)
{
    until_time(run, time - 1e-6);
    CHECK_CLOSE(hd_run_time(run), time, 1e-9);
}

/** Each of the slowest vectors, against those of a twin that is orthonormalised at this time. */
TEST(each_step_ends_with_the_vectors_wanted)
{
    hd_scene_def scene = scene_from(long_box(30.0), .report_interval = 0.25);
    OWNED(hd_run) *run = created(scene);
    scene.observe |= HD_OBSERVE_FIELDS;
    scene.field_interval = 0.0;
    OWNED(hd_run) *twin = created(scene);
    const int n = hd_run_vectors(run), rows = 4 * scene.number;
    int compared = 0;
    begin_to_look(run);
    hd_run_watch(run, 0.25);
    while (hd_run_stage(run) != HD_FINISHED) {
        CHECK_OK(hd_run_advance(run));
        if (hd_run_time(run) > run->agenda.sample_begin)
            assert_int_equal(hd_run_vectors_now(run).count,
                             0); /* those of before are none of now */
        CHECK_OK(hd_run_measure(run, n - WANTED));
        const hd_columns v = hd_run_vectors_now(run);
        assert_true(v.first == 0 && v.count == n);
        check_orthonormal(v, rows);
        if (!hd_run_report_due(run)) continue;
        catch_up(twin, hd_run_time(run));
        const hd_columns exact = hd_frame_columns(hd_run_frame(twin));
        for (int col = n - WANTED; col < n; col++)
            CHECK_CLOSE(fabs(dot(v, col, exact, col, rows)), 1.0, 2e-6); /* as above */
        compared++;
    }
    assert_true(compared > 50);
    assert_true(hd_run_cost(run).slow_vector_samples > 50);
}

/** The exponents of a run that is looked at are those of one that is not, within what both may be
 * off. */
TEST(looking_spoils_no_exponent)
{
    const hd_scene_def scene = long_box(40.0);
    OWNED(hd_run) *plain = created(scene), *viewed = created(scene);
    hd_run_watch(viewed, 0.3);
    finish_counting(plain, 0);
    finish_counting(viewed, WANTED);
    const double bound = hd_run_cost(plain).error_bound + hd_run_cost(viewed).error_bound;
    assert_true(bound > 0.0 && bound < 4e-8); /* accuracy 1e-8, stated with room [T6] */
    check_same_exponents(viewed, plain, bound);
}

/** A state that was measured when nobody listened is measured once more for who listens now, and
 * counts once. */
TEST(listening_late_adds_no_sample)
{
    OWNED(hd_run) *run = created(long_box(20.0));
    begin_to_look(run);
    hd_run_observe(run, 0);
    do CHECK_OK(hd_run_advance(run));
    while (hd_run_time(run) > run->agenda.sample_begin);
    hd_run_observe(run, HD_OBSERVE_MODES);
    const long samples = hd_modes_samples(hd_run_modes(run));
    CHECK_OK(hd_run_measure(run, 0));
    assert_int_equal(hd_run_vectors_now(run).count, hd_run_vectors(run));
    assert_int_equal(hd_modes_samples(hd_run_modes(run)), samples);
}

/** Nothing is measured before and after it; afterwards the vectors are those of its end. */
TEST(only_the_averaging_is_measured)
{
    OWNED(hd_run) *run = created(long_box(20.0));
    while (hd_run_stage(run) < HD_AVERAGING) {
        CHECK_OK(hd_run_measure(run, 0));
        assert_int_equal(hd_run_vectors_now(run).count, 0);
        CHECK_OK(hd_run_advance(run));
    }
    finish(run);
    CHECK_OK(hd_run_measure(run, 0));
    assert_int_equal(hd_run_cost(run).slow_vector_samples, 0);
    assert_int_equal(hd_run_vectors_now(run).count, hd_run_vectors(run));
}
