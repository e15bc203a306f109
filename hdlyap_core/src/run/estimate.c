/** Scene -> a short trial -> the time and memory that a run will take, and the errors that it will
 * reach.
 *
 * The trial is warmed up until intervals have reached their length; then it goes on for a second,
 * and for at least two orthonormalisations. A warm-up that takes longer than a second is cut short,
 * and the length of intervals is extrapolated from what the frame has shown. */
#include "hdlyap/estimate.h"

#include <math.h>

#include "base/check.h"
#include "base/clock.h"
#include "hdlyap/memory_limit.h"
#include "run/run.h"
#include "run/run_state.h"
#include "scene/scene.h"
#include "scene/wave.h"

/** Shortest time of the trial, and longest one of its warm-up [s]. */
static const double TRIAL_SECONDS = 1.0;
/** Collisions of each particle after which intervals, which begin with 2 and double, have reached
 * their length. */
static const double WARMUP_COLLISIONS = 120.0;
/** Largest N n^2 of a trial, with N particles and n vectors: above it one interval takes longer
 * than a trial may. */
static const double TRIAL_WORK = 800.0 * 1600.0 * 1600.0;
/** Length of the first interval of a trial, in usual first ones, from which it doubles: one of many
 * particles takes longer than a trial may. */
static const double FIRST_INTERVAL = 1.0 / 32.0;
/** Observables that need more time than a trial has. */
static const unsigned UNTRIED = HD_OBSERVE_COVARIANT;
/** Averaged time for an error of 1 % in c_T, in shortest blocks; measured with 780 disks, see
 * doc/performance.md. */
static const double BLOCKS_OF_SLOPES = 32.0;

hd_result_counts hd_result_counts_of(const hd_scene_def *def, const hd_run *run)
{
    return hd_observables_extent(def, run->observables.part);
}

/* ---- what it takes ------------------------------------------------------------------------- */

/** A smaller scene of the same shape and waves whose trial is short; the scene itself if its trial
 * is short, or if there is no such scene. */
static hd_scene_def smaller(const hd_scene_def *def)
{
    const double vectors = hd_scene_carried(def), work = def->number * vectors * vectors;
    const double part = cbrt(TRIAL_WORK / fmax(work, TRIAL_WORK));
    hd_scene_def scene = *def;
    if (part >= 1.0) return scene;
    scene.number = (int)(part * def->number);
    if (def->exponents > 0) scene.exponents = (int)(part * vectors); /* a number of them */
    if (def->max_wave_number > 0) /* the same waves are shorter in a smaller box */
        scene.max_wave_number *= hd_wave_limits_of(&scene).smallest /
                                 hd_wave_limits_of(def).smallest;
    return hd_scene_check(&scene, NULL, 0) == HD_OK ? scene : *def;
}

static hd_agenda agenda_of(const hd_scene_def *def)
{
    return hd_agenda_of(def, 1.0 / hd_scene_collision_time(def));
}

static double errors_after(const hd_scene_def *def)
{
    const hd_agenda agenda = agenda_of(def);
    return hd_scene_vectors(def) > 0 ? hd_agenda_errors_after(&agenda) : 0.0;
}

static double slopes_after(const hd_scene_def *def)
{
    const hd_agenda agenda = agenda_of(def);
    return hd_scene_vectors(def) > 0 ? BLOCKS_OF_SLOPES * agenda.block : 0.0;
}

hd_status hd_estimate_errors(double *after, const hd_scene_def *def)
{
    *after = errors_after(def);
    return HD_OK;
}

hd_scene_def hd_estimate_trial(const hd_scene_def *def)
{
    hd_scene_def trial = *def;
    hd_scene_settle(&trial);
    trial.equilibration = hd_scene_collision_time(def);
    trial.warmup = WARMUP_COLLISIONS * trial.equilibration;
    trial.duration = 0.0;
    trial.target = (hd_text){""};
    trial.observe = def->observe & ~UNTRIED;
    return smaller(&trial);
}

/** What a stretch of the trial has taken: seconds in all and those for orthonormalising, simulated
 * time, and orthonormalisations. */
typedef struct stretch {
    double wall, ortho, time;
    long done;
} stretch;

static stretch so_far(const hd_run *run)
{
    return (stretch){hd_clock_now(), run->cost.ortho, hd_run_time(run),
                     run->cost.orthonormalisations};
}

static stretch since(const stretch *begin, const hd_run *run)
{
    const stretch now = so_far(run);
    return (stretch){now.wall - begin->wall, now.ortho - begin->ortho, now.time - begin->time,
                     now.done - begin->done};
}

/** Warms up, but for no longer than a second and the interval under way, once it orthonormalises as
 * a long run does. Writes what it took since then; true in *cut if it came to no end. */
static hd_status warm_up(stretch *took, bool *cut, hd_run *run)
{
    const double last = hd_clock_now() + TRIAL_SECONDS;
    const bool framed = hd_run_vectors(run) > 0;
    stretch begin = so_far(run);
    bool ended = false;
    while (hd_run_stage(run) < HD_AVERAGING && !(ended && hd_clock_now() >= last)) {
        const bool usual = framed ? hd_carrier_is_usual(&run->carrier) : true;
        const long before = run->cost.orthonormalisations;
        HD_TRY(hd_run_advance(run));
        if (!usual) begin = so_far(run);
        *took = since(&begin, run);
        ended = framed ? took->done > 0 && run->cost.orthonormalisations > before : true;
    }
    *cut = hd_run_stage(run) < HD_AVERAGING;
    return *cut ? hd_run_average_now(run) : HD_OK;
}

/** The length of intervals once they have reached it, by the growth that the frame has shown. */
static double interval_grown(const hd_run *run)
{
    enum { DOUBLINGS = 40 };
    hd_interval grown = run->carrier.interval;
    double shortest, longest;
    for (int k = 0; k < DOUBLINGS; k++) grown.last = hd_interval_longest(&grown).length;
    hd_advance_bounds(&run->advance, &shortest, &longest);
    return fmin(fmin(grown.last, longest), hd_agenda_sample_most(&run->agenda));
}

/** What a warm-up that was cut short says: carrying takes as long at all times, and observables, of
 * which one state is measured here, are measured once a sample. */
static hd_status extrapolate(hd_estimate *out, hd_run *run, const stretch *took)
{
    const int vectors = hd_run_vectors(run);
    const double before = run->cost.modes;
    out->extrapolated = took->time;
    out->seconds = (took->wall - took->ortho) / took->time;
    if (vectors == 0) return HD_OK;
    HD_TRY(hd_run_measure(run, vectors));
    out->interval = interval_grown(run);
    out->seconds += took->ortho / (double)took->done / out->interval +
                    (run->cost.modes - before) / hd_agenda_sample_most(&run->agenda);
    return HD_OK;
}

static hd_status measure(hd_estimate *out, hd_run *run)
{
    bool cut;
    stretch took;
    const long least = hd_run_vectors(run) > 0 ? 2 : 0;
    out->interval = NAN;
    hd_agenda_begin_grown(&run->agenda); /* a run is young for a short time */
    run->carrier.interval.last *= FIRST_INTERVAL;
    HD_TRY(warm_up(&took, &cut, run));
    if (cut) return extrapolate(out, run, &took);
    const stretch begin = so_far(run);
    do {
        HD_TRY(hd_run_advance(run));
        took = since(&begin, run);
    } while (took.wall < TRIAL_SECONDS || took.done < least);
    out->seconds = took.wall / took.time;
    if (least > 0) out->interval = took.time / (double)took.done;
    return HD_OK;
}

/** Averaged time at which an error, which is smaller by now, was as large as the target allows. */
static double reached_after(const hd_target_progress *s, double averaged)
{
    const double falls = s->error * s->error - s->open * s->open;
    const double may = s->wanted * s->wanted - s->open * s->open;
    return may > 0.0 ? averaged * falls / may : averaged;
}

/** Averaged time at which a run that has averaged as long as the scene would reach the target; not
 * before errors are stated. */
static double target_after(const hd_run *run, const hd_scene_def *def, double stated)
{
    const hd_agenda agenda = agenda_of(def);
    const bool same = hd_run_scene(run)->number == def->number;
    if (!same || !*def->target.line) return NAN;
    const hd_target_progress end = hd_target_standing(run, &def->target);
    const double averaged = hd_run_time(run) - run->agenda.start;
    const double after = end.reached ? reached_after(&end, averaged) : averaged + end.left;
    return end.error < 0.0 ? NAN : hd_agenda_reported(&agenda, fmax(after, stated));
}

/** Scales a trial of fewer particles up: the work of a frame grows as N^3. */
static void enlarge(hd_estimate *e, const hd_scene_def *tried, const hd_scene_def *def)
{
    e->particles = tried->number;
    if (tried->number == def->number) return;
    e->seconds *= pow((double)def->number / tried->number, 3.0);
}

hd_status hd_estimate_run(hd_estimate *out, const hd_scene_def *def, char *message, size_t size)
{
    const hd_scene_def tried = hd_estimate_trial(def);
    hd_run *run;
    *out = (hd_estimate){.before = def->equilibration + hd_scene_warmup(def),
                         .untried = def->observe & UNTRIED};
    HD_TRY(hd_memory_check_windows(def, message, size));
    HD_TRY(hd_run_create(&run, &tried, message, size));
    const hd_status status = measure(out, run);
    out->errors_after = errors_after(def);
    out->slopes_after = slopes_after(def);
    out->target_after = target_after(run, def, out->errors_after);
    enlarge(out, &tried, def);
    out->extent = hd_result_counts_of(def, run);
    hd_run_free(run);
    return status;
}
