/** Few disks, square boxes, branches that cross, zeros in the middle: everything runs, nothing
 * jumps. */
#include "published.h"
#include "runs.h"

static const unsigned EVERYTHING = HD_OBSERVE_MODES | HD_OBSERVE_STEPS | HD_OBSERVE_PHASES |
                                   HD_OBSERVE_FIELDS | HD_OBSERVE_HYDRO | HD_OBSERVE_T_PHASES |
                                   HD_OBSERVE_STRUCTURE;

/** 2, 3 and 4 disks in a square box, in a channel and in between, behind all walls, with every
 * number of exponents, positive and all: none is refused. */
TEST(few_disks_run_with_everything)
{
    static const double aspects[] = {1.0, 0.6, 0.15};
    int runs = 0;
    for (int disks = 2; disks <= 4; disks++)
        for (int k = 0; k < 3 * 4; k++)
            for (int exponents = HD_EXPONENTS_ALL; exponents <= 4 * disks; exponents++) {
                if (exponents == HD_EXPONENTS_NONE) continue;
                const hd_scene_def few = scene(.disks = disks, .density = 0.2,
                                               .aspect = aspects[k / 4],
                                               .boundary[0] = k & 1 ? R : P,
                                               .boundary[1] = k & 2 ? R : P, .seed = 5,
                                               .exponents = exponents, .equilibration = 2.0,
                                               .warmup = 3.0, .duration = HD_SANITIZED ? 4.0 : 20.0,
                                               .observe = EVERYTHING, .threads = 1);
                OWNED(hd_run) *run = created(few);
                while (going_on(run))
                    if (hd_run_report_due(run)) check_published(run);
                CHECK_CLOSE(hd_spectrum_time(hd_run_spectrum(run)), few.duration,
                            1e-9 * few.duration);
                runs++;
            }
    assert_int_equal(runs, 504);
}

/** One step as it was found first, and what became of it. */
typedef struct history {
    bool resolved;
    int col, count, members;
    long moves;         /**< reports at which it lay elsewhere, or was lost or found */
    double least, most; /**< measured multiplicity over the expected one */
} history;

enum { STEPS_MAX = 64, TRACKS_MAX = 2048 };

typedef struct watch {
    history step[STEPS_MAX];
    int resolved;
    double time[TRACKS_MAX], phase[TRACKS_MAX];
    double largest; /**< miss of what its rate foresaw, of any phase between two reports [rad] */
    long turns;
} watch;

static void watch_begin(watch *w, const hd_steps *steps)
{
    *w = (watch){0};
    assert_true(hd_steps_count(steps) <= STEPS_MAX);
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        w->step[k] = (history){step->resolved, step->col, step->count, step->members, 0, 1e9, 0.0};
        w->resolved += step->resolved;
    }
    for (int t = 0; t < TRACKS_MAX; t++) w->time[t] = -1.0;
}

static void watch_steps(watch *w, const hd_steps *steps)
{
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        history *h = &w->step[k];
        const double part = step->multiplicity / step->expected;
        h->moves += step->resolved != h->resolved || step->col != h->col || step->count != h->count;
        h->resolved = step->resolved, h->col = step->col, h->count = step->count;
        if (!step->resolved) continue;
        h->least = fmin(h->least, part);
        h->most = fmax(h->most, part);
    }
}

/** Tracks that went on since the last look, by one sample. */
static void watch_phases(watch *w, const hd_phases *phases)
{
    assert_true(hd_phases_count(phases) <= TRACKS_MAX);
    for (int t = 0; t < hd_phases_count(phases); t++) {
        const hd_phase *phase = hd_phases_phase(phases, t);
        const bool known = phase->state == HD_PHASE_TRACKED;
        if (known && w->time[t] >= 0 && phase->time > w->time[t]) {
            const double foreseen = phase->omega * (phase->time - w->time[t]);
            w->largest = fmax(w->largest, fabs(phase->phase - w->phase[t] - foreseen));
            w->turns++;
        }
        w->time[t] = known ? phase->time : -1.0;
        w->phase[t] = phase->phase;
    }
}

/** Averages for `settling`, then watches to the end. */
static void watch_run(watch *w, const hd_scene_def *scene, double settling)
{
    OWNED(hd_run) *run = created(*scene);
    bool begun = false;
    while (going_on(run)) {
        if (!hd_run_report_due(run) || hd_spectrum_time(hd_run_spectrum(run)) < settling) continue;
        if (!begun) watch_begin(w, hd_run_steps(run));
        begun = true;
        watch_steps(w, hd_run_steps(run));
        watch_phases(w, hd_run_phases(run));
    }
    check_published(run);
}

/** Steps lie elsewhere, or are lost or found, at no more than `moves` reports. Where sets are
 * shared fields overlap by N^(-1/2): multiplicities stay within a quarter above what is expected,
 * and above the threshold of a half. */
static void check_watch(const watch *w, int resolved, long moves)
{
    long moved = 0;
    double least = 1e9, most = 0.0;
    for (int k = 0; k < STEPS_MAX; k++) {
        moved += w->step[k].moves;
        if (w->step[k].most == 0) continue;
        least = fmin(least, w->step[k].least);
        most = fmax(most, w->step[k].most);
    }
    assert_true(w->resolved >= resolved);
    assert_true(moved <= moves);
    CHECK_WITHIN(least, 0.5, 1.25);
    CHECK_WITHIN(most, 0.5, 1.25);
    assert_true(w->turns > 100);
    assert_true(w->largest < PI);
}

/** One sample of the phases in each report. */
static hd_scene_def watched(int disks, double density, double aspect, hd_boundary x, hd_boundary y)
{
    return scene(.disks = disks, .density = density, .aspect = aspect, .boundary[0] = x,
                 .boundary[1] = y, .equilibration = 50.0, .warmup = 200.0,
                 .duration = HD_SANITIZED ? 200.0 : 300.0, .report_interval = 0.25,
                 .observe = HD_OBSERVE_MODES | HD_OBSERVE_STEPS | HD_OBSERVE_PHASES,
                 .max_mode_number = 1, .threads = 1);
}

/** A step is lost and found, or moves, at two of 800 looks at most. */
static const long MOVES = 2;

static void watch_scene(const hd_scene_def *scene, int resolved, watch *w)
{
    watch_run(w, scene, 100.0);
    check_watch(w, resolved, MOVES);
}

/** T and LP coincide, as LP(1,0) and LP(0,1) do: five vectors of three steps. */
TEST(a_square_box_keeps_its_steps)
{
    static watch w;
    const hd_scene_def apart = watched(100, 0.7, 1.0, R, R),
                       crossing = watched(100, 0.8, 1.0, R, R);
    watch_scene(&apart, 3, &w);
    assert_int_equal(w.step[1].members, 2);
    assert_int_equal(w.step[1].count, 4);
    watch_scene(&crossing, 3, &w);
    assert_int_equal(w.step[2].members, 3);
    assert_int_equal(w.step[2].count, 5);
}

/** T(1,1) and LP(0,1) alone, at c_T |k| = c_L |k| by accident. */
TEST(an_accidental_crossing_keeps_its_steps)
{
    static watch w;
    const hd_scene_def scene = watched(100, 0.8, 0.9, R, R);
    watch_scene(&scene, 3, &w);
    assert_int_equal(w.step[1].members, 2);
    assert_int_equal(w.step[1].count, 3);
}

/** Six zeros between the halves, which separate like ln(t) / t: they stay where they are. */
TEST(zeros_in_the_middle_stay_there)
{
    static watch w;
    hd_scene_def scene = scene_from(watched(36, 0.5, 0.03125, P, P), .exponents = HD_EXPONENTS_ALL);
    watch_scene(&scene, 4, &w);
    assert_int_equal(w.step[2].col, 4 * 36 / 2 - 3);
    assert_int_equal(w.step[2].count, 6);
    assert_int_equal(w.step[2].moves, 0);
    CHECK_CLOSE(w.step[2].least, 1.0, 1e-6); /* orthogonality of a measured state */
    CHECK_CLOSE(w.step[2].most, 1.0, 1e-6);
}
