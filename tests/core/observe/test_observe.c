/** Whole runs that look at their modes: narrow boxes, in which a few disks show clean steps. */

#include "runs.h"

enum { DISKS = 50 };

static const unsigned EVERYTHING = HD_OBSERVE_MODES | HD_OBSERVE_STEPS | HD_OBSERVE_PHASES;

/** A channel, Lx = 66.7, Ly = 1.5, in which disks cannot pass each other. */
static hd_scene_def channel(hd_boundary x, hd_boundary y)
{
    return scene(.number = DISKS, .density = 0.5, .aspect = 0.0225, .boundary[0] = x,
                 .boundary[1] = y, .equilibration = 100.0, .warmup = 400.0, .duration = 600.0,
                 .observe = EVERYTHING);
}

static const hd_step *step_of(const hd_run *run, hd_mode_kind kind, int nx, int ny, bool conjugate)
{
    const hd_steps *steps = hd_run_steps(run);
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (step->kind == kind && step->wave.n[0] == nx && step->wave.n[1] == ny &&
            step->conjugate == conjugate)
            return step;
    }
    return NULL;
}

/** A resolved step that ends `before` vectors before the end of the positive half. */
static const hd_step *expect_step(const hd_run *run, hd_mode_kind kind, int nx, int before,
                                  int count)
{
    const hd_step *step = step_of(run, kind, nx, 0, false);
    const int half = (4 * DISKS - hd_scene_zero_exponents(hd_run_scene(run))) / 2;
    assert_non_null(step);
    assert_true(step->resolved);
    assert_int_equal(step->expected, count);
    assert_int_equal(step->count, count);
    assert_int_equal(step->members, 1);
    assert_int_equal(step->col + step->count, half - before);
    return step;
}

TEST(the_boundary_says_which_modes_there_are)
{
    const struct {
        hd_boundary x, y;
        int transverse, pairs;
    } cases[] = {{P, P, 2, 4}, {P, R, 0, 4}, {R, P, 1, 2}, {R, R, 0, 2}};
    for (int k = 0; k < 4; k++) {
        OWNED(hd_run) *run = finished(channel(cases[k].x, cases[k].y));
        const hd_steps *steps = hd_run_steps(run);
        for (int s = 0; s < hd_steps_count(steps); s++) /* narrow: waves along x alone */
            assert_int_equal(hd_steps_step(steps, s)->wave.n[1], 0);
        if (cases[k].transverse > 0)
            expect_step(run, HD_MODE_T, 1, 0, cases[k].transverse);
        else
            assert_null(step_of(run, HD_MODE_T, 1, 0, false));
        expect_step(run, HD_MODE_LP, 1, cases[k].transverse, cases[k].pairs);
    }
}

/** Before the first look, and after a reset, phases are those of no time. */
TEST(a_reset_forgets_when_phases_were_followed)
{
    OWNED(hd_run) *run = created(scene_from(channel(P, P), .warmup = 100.0));
    assert_true(hd_run_phase_time(run) < 0);
    until_time(run, 300.0);
    assert_true(hd_run_phase_time(run) > 200.0);
    CHECK_OK(hd_run_reset_average(run));
    assert_true(hd_run_phase_time(run) < 0);
}

/** LP(1,0) of the periodic channel by two ways of looking. Within 4 standard errors of the two. */
TEST(coarse_reports_see_the_same_rotation)
{
    hd_scene_def scene = channel(P, P);
    OWNED(hd_run) *fine = finished(scene);
    scene.report_interval = 20.0; /* turns by more than pi */
    OWNED(hd_run) *coarse = created(scene);
    int followed = 0;
    for (double last = -INFINITY; hd_run_stage(coarse) != HD_FINISHED;) {
        CHECK_OK(hd_run_advance(coarse));
        followed += hd_run_phase_time(coarse) > last;
        last = hd_run_phase_time(coarse);
    }
    const hd_velocity a = hd_phases_velocity(hd_run_phases(fine));
    const hd_velocity b = hd_phases_velocity(hd_run_phases(coarse));
    const double k = 2.0 * PI / sqrt(DISKS / (0.5 * 0.0225));
    assert_true(a.v * k * 20.0 > PI);
    assert_true(followed > scene.duration / 20.0);
    assert_true(a.v_sampling_error > 0 && b.v_sampling_error > 0);
    assert_true(b.v_sampling_error < 0.1 * b.v);
    CHECK_CLOSE(a.v, b.v, 4.0 * hypot(a.v_sampling_error, b.v_sampling_error));
}

/** Within so many of the bounds that the two runs state for themselves. */
static void check_looking(hd_scene_def scene, unsigned observe, double bounds)
{
    scene.observe = observe;
    OWNED(hd_run) *looked = finished(scene);
    scene.observe = 0;
    OWNED(hd_run) *blind = finished(scene);
    assert_null(hd_run_modes(blind));
    assert_null(hd_run_steps(blind));
    assert_null(hd_run_phases(blind));
    assert_null(hd_run_t_phases(blind));
    assert_true(hd_trajectory_totals(hd_run_trajectory(looked)).collisions ==
                hd_trajectory_totals(hd_run_trajectory(blind)).collisions);
    const double tolerance = bounds *
                             (hd_run_cost(looked).error_bound + hd_run_cost(blind).error_bound);
    check_same_exponents(looked, blind, tolerance);
}

/** What is looked at does not change what happens: modes and steps not a bit; phases and fields but
 * for where the frame is orthonormalised: rounding. */
TEST(looking_changes_nothing)
{
    hd_scene_def scene = scene_from(channel(P, R), .duration = 100.0);
    check_looking(scene, HD_OBSERVE_MODES | HD_OBSERVE_STEPS, 0.0);
    check_looking(scene, EVERYTHING, 1.0);
    check_looking(scene, EVERYTHING | HD_OBSERVE_FIELDS, 1.0);
}

/** Largest difference between the coefficients of the slowest vectors that two runs have measured.
 */
static double coefficients_apart(const hd_run *a, const hd_run *b, int slowest)
{
    const hd_modes *x = hd_run_modes(a), *y = hd_run_modes(b);
    const int n = hd_run_vectors(a);
    double worst = 0.0;
    for (int c = 0; c < hd_fields_columns(hd_modes_fields(x)); c++)
        for (int col = n - slowest; col < n; col++) {
            const double off = hd_modes_coefficients(x, c)[col] - hd_modes_coefficients(y, c)[col];
            assert_true(isfinite(off));
            worst = fmax(worst, fabs(off));
        }
    return worst;
}

/** What is known for a watcher, beside a run that orthonormalises for every report: fields are
 * looked at. */
TEST(a_watcher_sees_what_a_measured_state_shows)
{
    enum { SLOWEST = 8 };
    hd_scene_def scene = scene_from(channel(P, P), .duration = 200.0);
    OWNED(hd_run) *watched = created(scene);
    scene.observe |= HD_OBSERVE_FIELDS;
    scene.field_interval = 0.0;
    OWNED(hd_run) *measuring = created(scene);
    double worst = 0.0;
    int compared = 0;
    hd_run_watch(watched, 1.0);
    while (hd_run_stage(watched) != HD_FINISHED) {
        do {
            CHECK_OK(hd_run_advance(watched));
            CHECK_OK(hd_run_measure(watched, hd_run_vectors(watched) - SLOWEST));
        } while (!hd_run_report_due(watched));
        do CHECK_OK(hd_run_advance(measuring));
        while (!hd_run_report_due(measuring));
        CHECK_CLOSE(hd_run_time(watched), hd_run_time(measuring), 0.0);
        if (hd_modes_samples(hd_run_modes(measuring)) == 0) continue; /* not yet the averaging */
        worst = fmax(worst, coefficients_apart(watched, measuring, SLOWEST));
        compared++;
    }
    assert_true(compared > 150);
    assert_int_equal(hd_run_cost(measuring).slow_vector_samples, 0);
    assert_true(worst < 2e-6); /* DEFECT_MEASURED of carrier.c, twice */
}

TEST(only_what_is_needed_is_measured)
{
    OWNED(hd_run) *run = created(
        scene_from(channel(P, P), .observe = HD_OBSERVE_STEPS, .warmup = 10.0, .duration = 40.0));
    assert_non_null(hd_run_steps(run));
    assert_null(hd_run_phases(run));
    hd_run_observe(run, 0);
    while (hd_spectrum_time(hd_run_spectrum(run)) < 19.5 || !hd_run_report_due(run))
        CHECK_OK(hd_run_advance(run));
    assert_int_equal(hd_modes_samples(hd_run_modes(run)), 0);
    CHECK_CLOSE(hd_run_cost(run).modes, 0.0, 0.0);
    hd_run_observe(run, EVERYTHING);
    int measured = 0;
    for (double before = hd_spectrum_time(hd_run_spectrum(run));
         hd_run_stage(run) != HD_FINISHED;) {
        CHECK_OK(hd_run_advance(run));
        measured += hd_spectrum_time(hd_run_spectrum(run)) > before;
        before = hd_spectrum_time(hd_run_spectrum(run));
    }
    assert_true(measured >= 4);
    assert_int_equal(hd_modes_samples(hd_run_modes(run)), measured);
    assert_true(hd_run_cost(run).modes > 0);
}

/** Fields every 10 time units: vectors of these reports are orthonormal then and there, and only
 * for these the intervals end early; all else is as without fields. */
TEST(fields_are_due_now_and_then)
{
    hd_scene_def scene = scene_from(channel(P, P), .warmup = 50.0, .duration = 95.0);
    OWNED(hd_run) *without = finished(scene);
    scene.observe |= HD_OBSERVE_FIELDS;
    OWNED(hd_run) *always = finished(scene_from(scene, .field_interval = 0.0));
    OWNED(hd_run) *run = created(scene_from(scene, .field_interval = 10.0));
    int due = 0;
    while (going_on(run)) {
        if (!hd_run_fields_due(run)) continue;
        const double averaged = hd_spectrum_time(hd_run_spectrum(run));
        assert_true(hd_run_report_due(run));
        CHECK_CLOSE(averaged, due == 0 ? 1.0 : fmin(10.0 * due, 95.0), 1e-9);
        CHECK_CLOSE(hd_run_time(run), 150.0 + averaged, 1e-9);
        due++;
    }
    const long ends[] = {hd_run_cost(without).orthonormalisations,
                         hd_run_cost(run).orthonormalisations,
                         hd_run_cost(always).orthonormalisations};
    assert_int_equal(due, 11);
    assert_true(ends[1] <= ends[0] + due);
    assert_true(ends[2] > ends[0] + 20);
}

static void check_none_coarse(const hd_run *run)
{
    for (int k = 0; k < hd_phases_count(hd_run_phases(run)); k++)
        assert_int_not_equal(hd_phases_phase(hd_run_phases(run), k)->state, HD_PHASE_COARSE);
}

/** Phases that nobody looked at for a while begin anew, and are not taken for coarse. */
TEST(a_look_away_begins_the_phases_anew)
{
    OWNED(hd_run) *run = created(channel(P, P));
    int tracked = 0;
    for (int away = 0; away < 3; away++) {
        const double until = 50.0 * (away + 1);
        hd_run_observe(run, away == 1 ? 0 : EVERYTHING);
        while (hd_spectrum_time(hd_run_spectrum(run)) < until) {
            CHECK_OK(hd_run_advance(run));
            check_none_coarse(run);
        }
    }
    for (int k = 0; k < hd_phases_count(hd_run_phases(run)); k++) {
        const hd_phase *phase = hd_phases_phase(hd_run_phases(run), k);
        assert_true(phase->time < 50.5);
        tracked += phase->state == HD_PHASE_TRACKED && phase->time > 20.0;
    }
    assert_true(tracked >= 4);
}

/** Longest that a phase of a step has been tracked for. */
static double tracked_for(const hd_run *run, const hd_step *step)
{
    const hd_phases *phases = hd_run_phases(run);
    double longest = 0.0;
    for (int k = 0; k < hd_phases_count(phases); k++) {
        const hd_phase *phase = hd_phases_phase(phases, k);
        if (hd_steps_step(hd_run_steps(run), phase->step) == step)
            longest = fmax(longest, phase->time);
    }
    return longest;
}

/** Looks are close together while the rotation is learnt, and rarer then; what LP(1,0) has been
 * tracked for never falls. */
TEST(rarer_looks_lose_no_phase)
{
    OWNED(hd_run) *run = created(scene(.number = 200, .aspect = 0.2, .warmup = 50.0,
                                       .duration = 150.0, .report_interval = 2.0,
                                       .observe = EVERYTHING));
    const hd_step *step = step_of(run, HD_MODE_LP, 1, 0, false);
    double closest = INFINITY, farthest = 0.0, followed = -1.0;
    for (double tracked = 0.0; hd_run_stage(run) != HD_FINISHED;) {
        CHECK_OK(hd_run_advance(run));
        const double now = hd_run_phase_time(run), apart = now - followed;
        const bool again = followed >= 0.0 && apart > 0.0;
        if (again && now < 250.0) closest = fmin(closest, apart);
        if (again) farthest = fmax(farthest, apart);
        followed = now;
        assert_true(!step->resolved || tracked_for(run, step) >= tracked);
        tracked = tracked_for(run, step);
    }
    assert_true(farthest > 1.8 * closest);
    assert_true(tracked_for(run, step) > 100.0);
}

/** As somebody wants phases who looks at how they turn within a quarter. */
TEST(phases_are_known_as_often_as_asked)
{
    OWNED(hd_run) *run = created(
        scene_from(channel(P, P), .phase_interval = 0.3, .duration = 60.0));
    double farthest = 0.0, followed = -1.0;
    int states = 0;
    while (going_on(run)) {
        const bool over = hd_run_stage(run) == HD_FINISHED; /* with a state that ends it */
        const double now = over ? hd_run_time(run) : hd_run_phase_time(run);
        if (now > 530.0) { /* its steps are known */
            states += now > followed;
            farthest = fmax(farthest, now - followed);
        }
        followed = now;
    }
    CHECK_WITHIN(farthest, 0.25, 0.3 + 1e-9);
    assert_true(states >= 100);
}

/* ---- the negative half --------------------------------------------------------------------- */

/** Part of J (dq, dp) = (dp, -dq) of column `from` that lies in columns [col, col + count). */
static double conjugate_part(const hd_frame *frame, int from, int col, int count)
{
    const double *v = hd_frame_read(frame);
    const size_t stride = (size_t)hd_frame_stride(frame);
    double part = 0.0;
    for (int c = col; c < col + count; c++) {
        double dot = 0.0;
        for (int j = 0; j < DISKS; j++)
            for (int d = 0; d < 2; d++) {
                const double *q = v + (size_t)(4 * j + d) * stride, *p = q + 2 * stride;
                dot += p[from] * q[c] - q[from] * p[c];
            }
        part += dot * dot;
    }
    return part;
}

/** Sum over a step of |dq|^2 (or of |dp|^2 = 1 - |dq|^2): does not depend on how its vectors mix.
 */
static double half_of_step(const double *ratio, const hd_step *step, bool dp)
{
    double sum = 0.0;
    for (int col = step->col; col < step->col + step->count; col++) {
        const double dq2 = 1.0 / (1.0 + ratio[col] * ratio[col]);
        sum += dp ? 1.0 - dq2 : dq2;
    }
    return sum;
}

static void check_mirror(const hd_run *run, const hd_step *step, const double *cosine,
                         const double *ratio)
{
    /* spans forget their start like exp(-gap t), gap 0.03 to the next step, t = 1000; what is left
       is the orthogonality of a measured state, 1e-6 */
    const double MIRROR = 1e-4;
    const hd_step *mirror = step_of(run, step->kind, step->wave.n[0], step->wave.n[1], true);
    assert_true(step->resolved && mirror->resolved);
    assert_int_equal(mirror->col, 4 * DISKS - step->col - step->count);
    CHECK_CLOSE(mirror->exponent, -step->exponent, 1e-3);
    CHECK_CLOSE(half_of_step(ratio, step, false), half_of_step(ratio, mirror, true), MIRROR);
    for (int v = 0; v < step->count; v++) {
        const int here = step->col + v;
        assert_true(cosine[here] > 0.9 && cosine[mirror->col + v] < -0.9);
        CHECK_CLOSE(conjugate_part(hd_run_frame(run), here, mirror->col, mirror->count), 1.0,
                    MIRROR);
    }
}

/** Also rotates with it: the same z at all times. */
static void check_rotation(const hd_run *run)
{
    const hd_phases *phases = hd_run_phases(run);
    int tracked[2] = {0, 0};
    for (int k = 0; k < hd_phases_count(phases); k++) {
        const hd_phase *phase = hd_phases_phase(phases, k);
        if (phase->state != HD_PHASE_TRACKED || phase->time < 300.0) continue;
        assert_true(phase->omega > 0);
        assert_true(phase->omega_error > 0 && phase->omega_error < 0.1 * phase->omega);
        tracked[hd_steps_step(hd_run_steps(run), phase->step)->conjugate]++;
    }
    assert_true(tracked[0] >= 4 && tracked[1] >= 4);
}

/** J maps each mode onto its conjugate: dp = C dq becomes dq = -C' dp with C' = C. */
TEST(the_negative_half_mirrors_the_positive_one)
{
    OWNED(hd_run) *run = finished(
        scene_from(channel(P, P), .exponents = HD_EXPONENTS_ALL_INDEPENDENT));
    static double cosine[4 * DISKS], ratio[4 * DISKS];
    hd_run_dq_dp(run, cosine, ratio);
    const hd_step *zero = step_of(run, HD_MODE_ZERO, 0, 0, false);
    assert_true(zero->resolved);
    assert_int_equal(zero->count, 6);
    CHECK_CLOSE(zero->multiplicity, 6.0, 1e-6);
    check_mirror(run, step_of(run, HD_MODE_T, 1, 0, false), cosine, ratio);
    check_mirror(run, step_of(run, HD_MODE_LP, 1, 0, false), cosine, ratio);
    check_rotation(run);
}
