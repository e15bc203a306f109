/** Waves of a whole run: T modes stay where they are, LP modes rotate. */
#include "runs.h"

enum { DISKS = 50 };

/** A channel, Lx = 66.7, Ly = 1.5, in which disks cannot pass each other. */
static hd_scene_def channel(unsigned observe)
{
    return scene(.number = DISKS, .density = 0.5, .aspect = 0.0225, .equilibration = 100.0,
                 .warmup = 400.0, .duration = 1500.0, .report_interval = 50.0, .observe = observe);
}

/** Longest tracked of the vectors of a step at one node along x. */
static int longest(const hd_run *run, const hd_phases *phases)
{
    int found = -1;
    for (int k = 0; k < hd_phases_count(phases); k++) {
        const hd_phase *phase = hd_phases_phase(phases, k);
        if (hd_steps_step(hd_run_steps(run), phase->step)->wave.n[0] != 1) continue;
        if (found < 0 || phase->time > hd_phases_phase(phases, found)->time) found = k;
    }
    return found;
}

/** T(1,0): no rotation within 4 of its errors, which are small beside the rate of LP(1,0); that
 * diffuses, too, and all the same turns. */
TEST(t_waves_diffuse_and_do_not_turn)
{
    OWNED(hd_run) *run = finished(channel(HD_OBSERVE_PHASES | HD_OBSERVE_T_PHASES));
    const int of_t = longest(run, hd_run_t_phases(run)), of_lp = longest(run, hd_run_phases(run));
    const hd_phase *t = hd_phases_phase(hd_run_t_phases(run), of_t);
    const hd_phase *lp = hd_phases_phase(hd_run_phases(run), of_lp);
    double error;
    const double diffusion = hd_phases_diffusion(hd_run_t_phases(run), of_t, &error);
    assert_int_equal(hd_steps_step(hd_run_steps(run), t->step)->kind, HD_MODE_T);
    assert_true(t->time > 1000.0 && lp->time > 1000.0);
    CHECK_CLOSE(t->omega, 0.0, 4.0 * t->omega_error);
    assert_true(t->omega_error > 0 && t->omega_error < 0.1 * lp->omega);
    assert_true(lp->omega > 10.0 * lp->omega_error);
    assert_true(error > 0 && diffusion > 4.0 * error);
}

/** Who asks for T phases alone has no others, and states as often as they need. */
TEST(t_phases_come_alone)
{
    OWNED(hd_run) *run = created(
        scene_from(channel(HD_OBSERVE_T_PHASES), .duration = 60.0, .phase_interval = 0.5));
    double followed = -1.0, farthest = 0.0;
    while (going_on(run)) {
        if (hd_run_time(run) > 530.0) farthest = fmax(farthest, hd_run_phase_time(run) - followed);
        followed = hd_run_phase_time(run);
    }
    assert_null(hd_run_phases(run));
    assert_true(farthest > 0.4 && farthest <= 0.5 + 1e-9);
    assert_true(hd_phases_phase(hd_run_t_phases(run), longest(run, hd_run_t_phases(run)))->time >
                30.0);
}

/** Every vector of a step of its own has its largest structure factor at the wave of the step. */
static int check_peaks(const hd_run *run)
{
    const hd_steps *steps = hd_run_steps(run);
    const hd_structure *s = hd_run_structure(run);
    int resolved = 0;
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (!step->resolved || step->kind == HD_MODE_ZERO || step->members > 1) continue;
        for (int col = step->col; col < step->col + step->count; col++) {
            const hd_wave *wave = hd_structure_wave(s, hd_structure_peak(s, col));
            assert_int_equal(wave->n[0], step->wave.n[0]);
            assert_int_equal(wave->n[1], step->wave.n[1]);
        }
        resolved++;
    }
    return resolved;
}

/** The sums over time of one vector's amplitudes along k, both modulations, times exp(-i omega t).
 */
typedef struct series {
    double time[4000], amplitude[4000][4][2];
    int count;
} series;

static void take(series *x, const hd_run *run, const hd_step *step)
{
    x->time[x->count] = hd_run_time(run);
    for (int v = 0; v < step->count; v++)
        for (unsigned bits = 0; bits < 2; bits++)
            x->amplitude[x->count][v][bits] = hd_structure_amplitude(hd_run_structure(run),
                                                                     HD_ALONG, bits)[step->col + v];
    x->count++;
}

/** Hann's window: lines that do not leak. */
static double power_at(const series *x, int vectors, double omega)
{
    const double begin = x->time[0], length = x->time[x->count - 1] - begin;
    double sum = 0.0;
    for (int v = 0; v < vectors; v++)
        for (int bits = 0; bits < 2; bits++) {
            double re = 0.0, im = 0.0;
            for (int k = 0; k < x->count; k++) {
                const double t = x->time[k] - begin;
                const double a = (1.0 - cos(2.0 * PI * t / length)) * x->amplitude[k][v][bits];
                re += a * cos(omega * t);
                im += a * sin(omega * t);
            }
            sum += re * re + im * im;
        }
    return sum;
}

/** Middle of the power, which falls off to both sides as phases diffuse. */
static double middle_of(const series *x, int vectors, double from, double to)
{
    double sum = 0.0, moment = 0.0;
    for (int k = 0; k <= 200; k++) {
        const double omega = from + (to - from) * k / 200.0, power = power_at(x, vectors, omega);
        sum += power;
        moment += omega * power;
    }
    return moment / sum;
}

/** Power of LP(1,0) along k is at the rate at which its phases turn; where nothing turns there is
 * less of it. */
static void check_line(hd_boundary along)
{
    static series x;
    hd_scene_def scene = scene_from(channel(HD_OBSERVE_PHASES | HD_OBSERVE_STRUCTURE),
                                    .boundary[0] = along);
    x.count = 0;
    scene.report_interval = 3.0;
    OWNED(hd_run) *run = created(scene);
    const hd_step *step = NULL;
    while (going_on(run)) {
        if (!hd_run_report_due(run) || hd_run_time(run) < 700.0) continue;
        step = hd_steps_step(
            hd_run_steps(run),
            hd_phases_phase(hd_run_phases(run), longest(run, hd_run_phases(run)))->step);
        assert_true(step->resolved);
        take(&x, run, step);
    }
    const int resolved = check_peaks(run);
    assert_true(resolved >= 2);
    const hd_velocity v = hd_phases_velocity(hd_run_phases(run));
    const double omega = v.v * step->wave.number, error = v.v_error * step->wave.number;
    const double found = middle_of(&x, step->count, 0.5 * omega, 1.5 * omega);
    assert_true(x.count > 350);
    CHECK_CLOSE(found, omega, 6.0 * error);
    assert_true(power_at(&x, step->count, 0.0) < 0.3 * power_at(&x, step->count, found));
}

TEST(structure_factors_see_the_classified_waves)
{
    check_line(P);
    check_line(R);
}

/** With fewer exponents than it says none is of a step: each step that is found lies within what is
 * needed for waves as short as its own. And the last of all is one. */
TEST(no_step_lies_before_the_first_that_is_expected)
{
    const hd_scene_def scenes[] = {
        scene(.number = 60, .density = 0.8, .aspect = 0.06, .max_mode_number = 6),
        scene(.number = 120, .density = 0.7, .aspect = 0.1, .max_mode_number = 6),
        scene(.number = 100, .density = 0.7, .container = HD_CIRCLE, .max_mode_number = 2)};
    int found = 0;
    for (int k = 0; k < 3; k++) {
        OWNED(hd_run) *run = finished(scene_from(scenes[k], .equilibration = 10.0, .warmup = 150.0,
                                                 .duration = 50.0, .observe = HD_OBSERVE_STEPS,
                                                 .threads = 1));
        int last = 0;
        for (int s = 0; s < hd_steps_count(hd_run_steps(run)); s++) {
            const hd_step *step = hd_steps_step(hd_run_steps(run), s);
            const int end = step->col + step->count;
            if (!step->resolved || step->kind == HD_MODE_ZERO) continue;
            const hd_scene_def as_short = scene_from(scenes[k], .max_mode_number = 0,
                                                     .max_wave_number = step->wave.number);
            assert_true(hd_steps_exponents_least(&as_short) <= end);
            last = end > last ? end : last;
            found++;
        }
        assert_int_equal(last, hd_scene_positive_exponents(&scenes[k]));
    }
    assert_true(found >= 9);
    hd_scene_def none = scene(.number = 6, .density = 0.2, .aspect = 1.0, .max_wave_number = 0.1);
    assert_int_equal(hd_steps_exponents_least(&none), 0);
}
