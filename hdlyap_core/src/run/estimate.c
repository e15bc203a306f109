/** Scene -> a short trial -> the time and memory that a run will take, and the errors that it will
 * reach.
 *
 * The trial is warmed up until intervals have reached their length; then it goes on for a second,
 * and for at least two orthonormalisations. */
#include "hdlyap/estimate.h"

#include <math.h>

#include "base/check.h"
#include "base/clock.h"
#include "hdlyap/memory_limit.h"
#include "run/run.h"
#include "run/run_state.h"
#include "scene/scene.h"
#include "scene/wave.h"

/** Shortest time of the trial [s]. */
static const double TRIAL_SECONDS = 1.0;
/** Collisions of each particle after which intervals, which begin with 2 and double, have reached
 * their length. */
static const double WARMUP_COLLISIONS = 120.0;
/** Largest N n^2 of a trial, with N particles and n vectors: above it one interval takes longer
 * than a trial may. */
static const double TRIAL_WORK = 800.0 * 1600.0 * 1600.0;
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

static hd_status measure(hd_estimate *out, hd_run *run)
{
    hd_agenda_begin_grown(&run->agenda); /* a run is young for a short time */
    while (hd_run_stage(run) < HD_AVERAGING) HD_TRY(hd_run_advance(run));
    const double begin = hd_clock_now(), from = hd_run_time(run);
    const long before = hd_run_cost(run).orthonormalisations, vectors = hd_run_vectors(run);
    double seconds = 0.0;
    long done = 0;
    while (seconds < TRIAL_SECONDS || (vectors > 0 && done < 2)) {
        HD_TRY(hd_run_advance(run));
        seconds = hd_clock_now() - begin;
        done = hd_run_cost(run).orthonormalisations - before;
    }
    out->seconds = seconds / (hd_run_time(run) - from);
    out->interval = vectors > 0 ? (hd_run_time(run) - from) / (double)done : NAN;
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
