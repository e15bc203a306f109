/** Scene -> spectrum, one interval at a time.
 *
 *  Phases follow each other at fixed simulated times: equilibration (trajectory alone), warm-up of the
 *  frame, averaging. A phase is cut into samples of equal length, a whole number of which make a report
 *  interval; a sample into the intervals that the conditioning allows. At the end of a report interval
 *  the frame is a measured state: orthonormal as far as the accuracy asks. */
#include "hdlyap/run.h"

#include <float.h>
#include <math.h>

#include "check.h"
#include "clock.h"
#include "hdlyap/blas.h"
#include "interval.h"
#include "memory.h"

/** Between measured states Q may be loosely conditioned, as the logarithms telescope [T5]. */
static const double DEFECT_LOOSE = 0.1;
/** At a measured state, for who looks at the vectors; see defect_max. */
static const double DEFECT_MEASURED = 1e-6;
static const double COLLISIONS_PER_SAMPLE = 32.0; /* of one disk */
static const double EVENTS_PER_STEP = 200000.0;   /* bounds memory, and the wait for an answer */
/** Householder reflections stay right to eps * condition: 1e-3 of one interval, once. */
static const double CONDITION_STABLE = 1e13;
enum { PIECES_MAX = 64, SMALLEST_EXPONENTS = 8 };

struct hd_run {
    hd_scene_def scene;
    hd_trajectory *trajectory;
    hd_event_log *log;
    hd_frame *frame; /**< NULL without exponents, as the two below */
    hd_ortho *ortho;
    hd_spectrum *spectrum;
    hd_modes *modes; /**< NULL unless observed, as the next two */
    hd_steps *steps;
    hd_phases *phases;
    double *q, *p;    /**< [2N], state of a snapshot */
    unsigned observe; /**< stages needed now */
    int pieces;       /**< of a sample, at whose ends the phases are followed */
    int piece;        /**< whole ones since the sample began */
    hd_interval interval;
    double step_max; /**< longest step that keeps to EVENTS_PER_STEP, as far as events are known */
    int vectors, threads;
    hd_phase phase;
    double phase_start; /**< simulated time */
    double now;         /**< simulated time */
    double sample_length;
    long samples_per_report;
    long samples; /**< whole ones since phase_start */
    bool report_due;
    double created, frame_started,
        frame_start_time; /**< wall clock, and simulated time, for estimates */
    double rounding;      /**< sum of eps * condition since phase_start of averaging */
    hd_cost cost;
};

/* ---- creation --------------------------------------------------------------------------------- */

/** More threads than the work is worth would cost: each pass over the frame should outlast a wake-up. */
static int threads_for(int wanted, int rows, int vectors)
{
    const double entries_worth_a_thread = 2e5;
    const int cores = hd_blas_query().cores;
    if (wanted > 0) return wanted;
    return (double)rows * vectors < entries_worth_a_thread ? 1 : cores;
}

/** A random frame, orthonormal. Random vectors are hardly ever dependent: then reflections. */
static hd_status create_frame(hd_run *run)
{
    const hd_scene_def *scene = &run->scene;
    const hd_ortho_limits twice = {1e7, DBL_EPSILON};
    HD_TRY(hd_frame_create(&run->frame, scene->disks, run->vectors, scene->seed, run->threads));
    if (hd_ortho_step(run->ortho, run->frame, twice) == HD_OK) return HD_OK;
    hd_frame_free(run->frame);
    run->frame = NULL;
    HD_TRY(hd_frame_create(&run->frame, scene->disks, run->vectors, scene->seed, run->threads));
    return hd_ortho_step_stable(run->ortho, run->frame, 1.0 / DBL_EPSILON);
}

static hd_status prepare_frame(hd_run *run)
{
    const int rows = 4 * run->scene.disks, n = run->vectors;
    run->threads = threads_for(run->scene.threads, rows, n);
    hd_blas_use_threads(run->threads);
    HD_TRY(hd_event_log_create(&run->log));
    HD_TRY(hd_ortho_create(&run->ortho, rows, n));
    HD_TRY(hd_spectrum_create(&run->spectrum, rows, n));
    return create_frame(run);
}

/** Kinds of modes need steps; only phases cost more. */
static hd_status prepare_modes(hd_run *run)
{
    const hd_scene_def *scene = &run->scene;
    const size_t size = 2 * (size_t)scene->disks;
    run->observe = scene->observe;
    run->q = hd_memory_alloc(size, sizeof(double));
    run->p = hd_memory_alloc(size, sizeof(double));
    if (!run->q || !run->p) return HD_NO_MEMORY;
    HD_TRY(hd_modes_create(&run->modes, scene, run->vectors, run->threads));
    HD_TRY(hd_steps_create(&run->steps, scene, run->modes));
    return scene->observe & HD_OBSERVE_PHASES ? hd_phases_create(&run->phases, run->steps) : HD_OK;
}

static hd_status prepare(hd_run *run)
{
    const hd_scene_def *scene = &run->scene;
    HD_TRY(hd_trajectory_create(&run->trajectory, scene));
    run->vectors = hd_scene_vectors(scene);
    run->threads = 1;
    const double rate = hd_trajectory_collision_rate(run->trajectory);
    const double per_disk = 2.0 * rate / scene->disks;
    run->samples_per_report = (long)fmax(
        1.0, ceil(scene->report_interval * per_disk / COLLISIONS_PER_SAMPLE));
    run->sample_length = scene->report_interval / (double)run->samples_per_report;
    const double limit = scene->interval > 0 ? scene->interval : INFINITY;
    run->step_max = 1e-3 / per_disk;
    run->interval = hd_interval_first(1.0 / per_disk, limit, scene->accuracy);
    run->pieces = 1;
    if (run->vectors == 0) return HD_OK;
    HD_TRY(prepare_frame(run));
    return scene->observe ? prepare_modes(run) : HD_OK;
}

static void averages_clear(hd_run *run)
{
    hd_spectrum_clear(run->spectrum);
    if (run->modes) hd_modes_clear(run->modes);
    if (run->steps) hd_steps_clear(run->steps);
    if (run->phases) hd_phases_clear(run->phases);
}

/** Enters the first phase at or after `phase` that has any length. */
static void enter_phase(hd_run *run, hd_phase phase)
{
    const hd_scene_def *scene = &run->scene;
    if (phase == HD_EQUILIBRATING && scene->equilibration == 0) phase = HD_WARMING_UP;
    if (phase == HD_WARMING_UP && scene->warmup == 0) phase = HD_AVERAGING;
    run->phase = phase;
    run->phase_start = run->now;
    run->samples = 0;
    run->piece = 0;
    if (run->spectrum && phase == HD_AVERAGING) averages_clear(run);
    if (phase == HD_AVERAGING) run->rounding = 0.0;
    if (phase == HD_EQUILIBRATING || run->frame_started > 0) return;
    run->frame_started = hd_clock_now();
    run->frame_start_time = run->now;
}

hd_status hd_run_create(hd_run **out, const hd_scene_def *def, char *message, size_t size)
{
    *out = NULL;
    HD_TRY(hd_scene_check(def, message, size));
    hd_run *run = hd_memory_alloc(1, sizeof *run);
    if (!run) return HD_NO_MEMORY;
    run->scene = *def;
    run->created = hd_clock_now();
    const hd_status status = prepare(run);
    if (status != HD_OK) {
        hd_run_free(run);
        return status;
    }
    enter_phase(run, HD_EQUILIBRATING);
    *out = run;
    return HD_OK;
}

void hd_run_free(hd_run *run)
{
    if (!run) return;
    hd_trajectory_free(run->trajectory);
    hd_event_log_free(run->log);
    hd_frame_free(run->frame);
    hd_ortho_free(run->ortho);
    hd_spectrum_free(run->spectrum);
    hd_phases_free(run->phases);
    hd_steps_free(run->steps);
    hd_modes_free(run->modes);
    hd_memory_free(run->q);
    hd_memory_free(run->p);
    hd_memory_free(run);
}

/* ---- one interval ----------------------------------------------------------------------------- */

/** End of the present phase; INFINITY for averaging without a duration. */
static double phase_end(const hd_run *run)
{
    switch (run->phase) {
    case HD_EQUILIBRATING: return run->phase_start + run->scene.equilibration;
    case HD_WARMING_UP: return run->phase_start + run->scene.warmup;
    default: break;
    }
    return run->scene.duration > 0 ? run->phase_start + run->scene.duration : INFINITY;
}

/** Ends of samples, and of their pieces, are products, not sums: rounding does not add up. */
static double piece_end(const hd_run *run)
{
    const double done = (double)(run->piece + 1) / run->pieces; /* exactly 1 for the last */
    const double end = run->phase_start + ((double)run->samples + done) * run->sample_length;
    const double last = phase_end(run);
    return end < last - 1e-6 * run->sample_length ? end : last;
}

/** Carries the frame from t_begin to t_end of the log and orthonormalises it. */
static hd_status frame_piece(hd_run *run, double t_begin, double t_end, double defect)
{
    const double start = hd_clock_now(), duration = run->log->duration;
    HD_TRY(hd_frame_replay(run->frame, run->log, t_begin, t_end));
    const double replayed = hd_clock_now();
    const hd_ortho_limits limits = {hd_interval_condition_max(&run->interval, duration), defect};
    const hd_status status = t_end - t_begin > duration / PIECES_MAX
                                 ? hd_ortho_step(run->ortho, run->frame, limits)
                                 : hd_ortho_step_stable(run->ortho, run->frame, CONDITION_STABLE);
    run->cost.replay += replayed - start;
    run->cost.ortho += hd_clock_now() - replayed;
    return status;
}

/** What an accepted orthonormalisation says about spectrum, interval and cost. */
static void piece_accepted(hd_run *run, double length)
{
    const double start = hd_clock_now();
    const double *stretch = hd_ortho_log_stretch(run->ortho);
    const double condition = hd_ortho_condition(run->ortho);
    double most = 0.0;
    for (int col = 0; col < run->vectors; col++) most = fmax(most, fabs(stretch[col]));
    hd_interval_learn(&run->interval, length, condition, most);
    if (run->phase == HD_AVERAGING) hd_spectrum_add(run->spectrum, stretch, length);
    hd_cost *cost = &run->cost;
    cost->interval = length;
    cost->condition = condition;
    cost->defect = hd_ortho_defect(run->ortho);
    run->rounding += DBL_EPSILON * condition;
    cost->orthonormalisations++;
    cost->second_passes += hd_ortho_passes(run->ortho) > 1;
    cost->spectrum += hd_clock_now() - start;
}

/** Loss of orthogonality allowed at the end of this interval. A running mean errs by that at the ends of
 *  its time; so the state at which averaging starts is orthonormal to rounding. */
static double defect_max(const hd_run *run, bool measured)
{
    if (!measured) return DEFECT_LOOSE;
    if (run->phase != HD_AVERAGING)
        return run->now >= phase_end(run) ? DBL_EPSILON : DEFECT_MEASURED;
    return fmin(DEFECT_MEASURED, 0.5 * run->scene.accuracy * (run->now - run->phase_start));
}

/** The whole log. An interval that turned out too long is taken back and replayed in pieces; a shortest
 *  piece that is still too much holds a grazing collision and is factored by reflections. */
static hd_status frame_interval(hd_run *run, bool measured)
{
    const double duration = run->log->duration;
    double begin = 0.0, end = duration;
    while (begin < duration) {
        const double defect = defect_max(run, measured && end >= duration);
        const hd_status status = frame_piece(run, begin, end, defect);
        if (status != HD_OK && status != HD_ILL_CONDITIONED) return status;
        if (status == HD_OK) {
            piece_accepted(run, end - begin);
            const double next = fmin(duration, end + (end - begin));
            begin = end;
            end = next;
            continue;
        }
        if (end - begin <= duration / PIECES_MAX) return HD_ILL_CONDITIONED;
        run->cost.repairs += end >= duration && begin == 0.0;
        hd_interval_failed(&run->interval, end - begin);
        hd_frame_rewind(run->frame);
        end = begin + 0.5 * (end - begin);
    }
    return HD_OK;
}

/** Largest standard error of the exponents nearest to zero; INFINITY while one is unknown. */
static double smallest_error(const hd_run *run)
{
    double worst = 0.0;
    const int first = run->vectors > SMALLEST_EXPONENTS ? run->vectors - SMALLEST_EXPONENTS : 0;
    for (int col = first; col < run->vectors; col++) {
        const double error = hd_spectrum_std_error(run->spectrum, col);
        worst = error >= 0 ? fmax(worst, error) : INFINITY; /* NaN is not known either */
    }
    return worst;
}

/** True if the exponents nearest to zero are known as well as the scene asks. */
static bool target_reached(const hd_run *run)
{
    return run->scene.target_std_error > 0 && run->spectrum &&
           smallest_error(run) <= run->scene.target_std_error;
}

/** Bookkeeping at the end of a sample; moves on to the next phase when this one is over. */
static void finish_sample(hd_run *run)
{
    const bool over = run->now >= phase_end(run);
    const double length = run->now - (run->phase_start + (double)run->samples * run->sample_length);
    run->samples++;
    run->piece = 0;
    if (run->phase == HD_AVERAGING && run->spectrum && length > 0.999 * run->sample_length) {
        hd_spectrum_sample(run->spectrum);
        if (run->steps) hd_steps_sample(run->steps, run->spectrum, length);
    }
    run->report_due = over || run->samples % run->samples_per_report == 0;
    if (run->phase == HD_AVERAGING && run->report_due && (over || target_reached(run)))
        run->phase = HD_FINISHED;
    else if (over)
        enter_phase(run, run->phase + 1);
}

static uint64_t events_so_far(const hd_run *run)
{
    return hd_trajectory_collisions(run->trajectory) + hd_trajectory_wall_events(run->trajectory);
}

/** Moves the disks on by `length`, and learns how long a step may be: a channel of hardly more than a
 *  disk's width can have 1e9 wall events in a time unit. */
static hd_status advance_disks(hd_run *run, hd_event_log *log, double length, double end)
{
    const double start = hd_clock_now();
    const uint64_t before = events_so_far(run);
    HD_TRY(hd_trajectory_advance(run->trajectory, log, end));
    run->now = end;
    const double events = fmax(1.0, (double)(events_so_far(run) - before));
    run->step_max = fmin(4.0 * fmax(length, run->step_max / 4.0),
                         length * EVENTS_PER_STEP / events);
    run->cost.events += hd_clock_now() - start;
    return HD_OK;
}

/** Longest time between two looks at the phases; INFINITY if nobody looks. */
static double phases_due(const hd_run *run)
{
    return run->observe & HD_OBSERVE_PHASES ? hd_phases_sampling(run->steps) : INFINITY;
}

/** The frame is measured at the end of a report interval, and where the phases would turn too far until
 *  then. */
static bool ends_measured(const hd_run *run, bool ends_sample)
{
    if (run->scene.report_interval > phases_due(run)) return true;
    return ends_sample &&
           ((run->samples + 1) % run->samples_per_report == 0 || piece_end(run) >= phase_end(run));
}

/** Modes, steps and phases of a measured state; what is asked for is enough for each. */
static hd_status observe(hd_run *run)
{
    const double start = hd_clock_now();
    if (!run->observe || hd_spectrum_time(run->spectrum) == 0) return HD_OK;
    hd_trajectory_state(run->trajectory, run->q, run->p);
    HD_TRY(hd_modes_measure(run->modes, run->frame, run->q, run->p));
    if (run->report_due) {
        hd_modes_add(run->modes);
        hd_steps_find(run->steps, run->spectrum);
    }
    if (run->observe & HD_OBSERVE_PHASES) hd_phases_add(run->phases, run->steps, run->now);
    run->cost.modes += hd_clock_now() - start;
    return HD_OK;
}

/** At the end of a piece that is no end of a sample, or of a sample: pieces are chosen anew. */
static hd_status finish_piece(hd_run *run, bool measured)
{
    const bool averaging = run->phase == HD_AVERAGING;
    if (++run->piece == run->pieces || run->now >= phase_end(run)) finish_sample(run);
    if (measured && averaging && run->modes) HD_TRY(observe(run));
    if (run->piece == 0) run->pieces = (int)fmax(1.0, ceil(run->sample_length / phases_due(run)));
    return HD_OK;
}

hd_status hd_run_step(hd_run *run)
{
    run->report_due = false;
    if (run->phase == HD_FINISHED) return HD_OK;
    const bool with_frame = run->frame && run->phase != HD_EQUILIBRATING;
    const double stop = piece_end(run), left = stop - run->now;
    const double wanted = with_frame ? hd_interval_next(&run->interval, left) : left;
    const double length = wanted <= run->step_max ? wanted : left / ceil(left / run->step_max);
    const bool ends_piece = length >= left;
    const bool ends_sample = run->piece + 1 == run->pieces || stop >= phase_end(run);
    const bool measured = ends_piece && ends_measured(run, ends_sample);
    HD_TRY(advance_disks(run, with_frame ? run->log : NULL, length,
                         ends_piece ? stop : run->now + length));
    if (with_frame) {
        hd_blas_use_threads(run->threads); /* with OpenMP it holds for the calling thread */
        HD_TRY(frame_interval(run, measured));
    }
    return ends_piece ? finish_piece(run, measured) : HD_OK;
}

void hd_run_observe(hd_run *run, unsigned stages)
{
    const unsigned now = stages & run->scene.observe, begun = now & ~run->observe;
    if (begun & HD_OBSERVE_PHASES) hd_phases_clear(run->phases); /* not followed in between */
    run->observe = now;
}

void hd_run_reset_average(hd_run *run)
{
    if (run->phase == HD_AVERAGING) enter_phase(run, HD_AVERAGING);
}

/* ---- what can be read ------------------------------------------------------------------------- */

bool hd_run_report_due(const hd_run *run) { return run->report_due; }
hd_phase hd_run_phase(const hd_run *run) { return run->phase; }
double hd_run_time(const hd_run *run) { return run->now; }
const hd_scene_def *hd_run_scene(const hd_run *run) { return &run->scene; }
int hd_run_vectors(const hd_run *run) { return run->vectors; }
int hd_run_threads(const hd_run *run) { return run->threads; }
const hd_trajectory *hd_run_trajectory(const hd_run *run) { return run->trajectory; }
const hd_frame *hd_run_frame(const hd_run *run) { return run->frame; }
const hd_spectrum *hd_run_spectrum(const hd_run *run) { return run->spectrum; }
const hd_modes *hd_run_modes(const hd_run *run) { return run->modes; }
const hd_steps *hd_run_steps(const hd_run *run) { return run->steps; }
const hd_phases *hd_run_phases(const hd_run *run) { return run->phases; }

int hd_run_samples_per_report(const hd_run *run)
{
    const bool often = run->scene.report_interval > phases_due(run);
    return often ? run->pieces * (int)run->samples_per_report : 1;
}

/** Simulated time until the target is reached, as errors fall with the root of the time; INFINITY if it is none,
 *  or not yet known. */
static double target_left(const hd_run *run)
{
    if (run->scene.target_std_error == 0 || run->phase != HD_AVERAGING || !run->spectrum)
        return INFINITY;
    const double ratio = smallest_error(run) / run->scene.target_std_error;
    return hd_spectrum_time(run->spectrum) * fmax(ratio * ratio - 1.0, 0.0);
}

/** Simulated time still to come; INFINITY for an endless run. */
static double time_left(const hd_run *run)
{
    const hd_scene_def *scene = &run->scene;
    if (run->phase == HD_FINISHED) return 0.0;
    double left = fmin(phase_end(run) - run->now, target_left(run));
    if (run->phase == HD_EQUILIBRATING) left += scene->warmup;
    if (run->phase < HD_AVERAGING) left += scene->duration > 0 ? scene->duration : INFINITY;
    return left;
}

hd_cost hd_run_cost(const hd_run *run)
{
    hd_cost cost = run->cost;
    const double now = hd_clock_now(), left = time_left(run);
    cost.wall = now - run->created;
    if (run->phase >= HD_AVERAGING && run->now > run->phase_start)
        cost.error_bound = (run->rounding + cost.defect) / (run->now - run->phase_start);
    cost.events_per_second = cost.events > 0
                                 ? (double)hd_trajectory_collisions(run->trajectory) / cost.events
                                 : 0.0;
    cost.progress = left < INFINITY ? run->now / fmax(run->now + left, DBL_MIN) : 0.0;
    if (run->phase == HD_FINISHED) cost.progress = 1.0;
    const double carried = run->now -
                           run->frame_start_time; /* equilibration is no measure of the rest */
    const bool known = left == 0 || (run->frame_started > 0 && carried > 0 && left < INFINITY);
    cost.remaining = !known ? -1.0 : left == 0 ? 0.0 : left * (now - run->frame_started) / carried;
    return cost;
}
