/** Scene -> spectrum, one interval at a time.
 *
 * The schedule says where samples and reports end. The frame goes from one orthonormalisation to
 * the next, as far apart as the conditioning allows; the log of the events since the last one waits
 * until then. A report in between states exponents and modes as of the last one, unless somebody
 * looks at the vectors: then the frame is orthonormalised for it. */
#include "hdlyap/run.h"

#include <float.h>
#include <math.h>

#include "advance.h"
#include "check.h"
#include "clock.h"
#include "hdlyap/blas.h"
#include "lookback.h"
#include "memory.h"
#include "run_state.h"
#include "threads.h"
#include "verify.h"

/** Loss of orthogonality allowed where nobody looks at the vectors, as the logarithms telescope
 * [T5]; its square enters a mean. */
static const double DEFECT_LOOSE = 1e-4;
/** The same where somebody does. */
static const double DEFECT_MEASURED = 1e-6;
/** Single precision leaves a tenth of the tail's vectors astray there, and a thousandth of their
 * phases. */
static const double CONDITION_TAIL = 1e4;
/** Householder reflections stay right to eps * condition: 1e-3 of one interval, once. */
static const double CONDITION_STABLE = 1e13;
enum { PIECES_MAX = 64, TAIL_MAX = 60 };
/** What modes are needed for. */
static const unsigned OF_MODES = HD_OBSERVE_MODES | HD_OBSERVE_STEPS | HD_OBSERVE_PHASES |
                                 HD_OBSERVE_FIELDS | HD_OBSERVE_HYDRO;

/* ---- creation ------------------------------------------------------------------------------ */

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
    run->threads = hd_threads_most(run->scene.threads, rows, n);
    if (run->threads > 1)
        HD_TRY(hd_blas_room(run->threads)); /* one has its buffer since the start */
    hd_blas_use_threads(run->threads);
    HD_TRY(hd_event_log_create(&run->log));
    HD_TRY(hd_ortho_create(&run->ortho, rows, n));
    HD_TRY(hd_spectrum_create(&run->spectrum, rows, n));
    HD_TRY(create_frame(run));
    return hd_threads_choose(&run->threads, run->ortho, run->frame, run->scene.threads);
}

static hd_status prepare_phases(hd_run *run)
{
    const int most = run->vectors / 4;
    HD_TRY(hd_phases_create(&run->phases, run->steps));
    const hd_status status = hd_tail_create(&run->tail, &run->scene,
                                            most < TAIL_MAX ? most : TAIL_MAX);
    return status == HD_REFUSED ? HD_OK : status;
}

/** Kinds of modes need steps; only phases cost more. */
static hd_status prepare_modes(hd_run *run)
{
    const hd_scene_def *scene = &run->scene;
    const size_t size = 2 * (size_t)scene->disks;
    run->q = hd_memory_alloc(size, sizeof(double));
    run->p = hd_memory_alloc(size, sizeof(double));
    if (!run->q || !run->p) return HD_NO_MEMORY;
    HD_TRY(hd_modes_create(&run->modes, scene, run->vectors, run->threads));
    HD_TRY(hd_steps_create(&run->steps, scene, run->modes));
    return scene->observe & HD_OBSERVE_PHASES ? prepare_phases(run) : HD_OK;
}

static hd_status prepare(hd_run *run, char *message, size_t size)
{
    const hd_scene_def *scene = &run->scene;
    HD_TRY(hd_trajectory_create(&run->trajectory, scene));
    run->vectors = hd_scene_vectors(scene);
    run->threads = 1;
    const double per_disk = 2.0 * hd_trajectory_collision_rate(run->trajectory) / scene->disks;
    const double limit = scene->interval > 0 ? scene->interval : INFINITY;
    run->sample_max = HD_COLLISIONS_PER_SAMPLE / per_disk;
    hd_advance_first(run, per_disk);
    run->watch = (hd_watch){.interval = INFINITY, .first = run->vectors};
    run->interval = hd_interval_first(2.0 / per_disk, limit, scene->accuracy);
    run->schedule = hd_schedule_of(scene);
    if (run->vectors == 0) return HD_OK;
    HD_TRY(prepare_frame(run));
    HD_TRY(hd_lookback_create(run, message, size));
    run->observe = scene->observe;
    return scene->observe & OF_MODES ? prepare_modes(run) : HD_OK;
}

static void averages_clear(hd_run *run)
{
    hd_spectrum_clear(run->spectrum);
    if (run->modes) hd_modes_clear(run->modes);
    if (run->steps) hd_steps_clear(run->steps);
    if (run->phases) hd_phases_clear(run->phases);
    hd_lookback_clear(run);
}

/** Intervals shorter than a collision of each disk, because the warm-up was, have taught nothing
 * yet. */
static bool interval_is_learnt(const hd_run *run)
{
    const double collision = run->sample_max / HD_COLLISIONS_PER_SAMPLE;
    return run->cost.orthonormalisations > 0 &&
           run->interval.last >= fmin(collision, run->interval.limit);
}

/** Longest sample that one orthonormalisation at its end can serve. */
static double sample_longest(const hd_run *run)
{
    if (!run->frame || !interval_is_learnt(run)) return run->sample_max;
    return fmin(run->sample_max, hd_interval_longest(&run->interval).length);
}

static void enter_phase(hd_run *run, hd_phase phase)
{
    run->phase_ends = false;
    hd_schedule_enter(&run->schedule, phase, run->now, sample_longest(run));
    run->plan.end = run->now;
    phase = run->schedule.phase;
    if (run->spectrum && phase == HD_AVERAGING) averages_clear(run);
    if (phase == HD_AVERAGING) run->rounding = HD_ROUNDING * run->condition_max;
    if (phase == HD_EQUILIBRATING || run->frame_started != 0) return;
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
    const hd_status status = prepare(run, message, size);
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
    hd_covariant_free(run->covariant);
    hd_spectrum_free(run->spectrum);
    hd_tail_free(run->tail);
    hd_phases_free(run->phases);
    hd_steps_free(run->steps);
    hd_modes_free(run->modes);
    hd_memory_free(run->q);
    hd_memory_free(run->p);
    hd_memory_free(run);
}

/* ---- one interval -------------------------------------------------------------------------- */

static hd_status replay(hd_run *run, double t_begin, double t_end)
{
    hd_symplectic before;
    if (HD_VERIFIES) before = hd_verify_sample(run->frame);
    HD_TRY(hd_frame_replay(run->frame, run->log, t_begin, t_end));
    if (HD_VERIFIES) hd_verify_symplectic(run->frame, &before, (double)run->log->count);
    return HD_OK;
}

/** Pieces of the log that are taken back no more: a collision of each disk is the least that can be
 * divided. */
static double shortest_piece(const hd_run *run)
{
    return fmin(run->log->duration / PIECES_MAX, run->sample_max / HD_COLLISIONS_PER_SAMPLE);
}

/** Carries the frame from t_begin to t_end of the log and orthonormalises it. */
static hd_status frame_piece(hd_run *run, double t_begin, double t_end, double defect)
{
    const double start = hd_clock_now(), length = t_end - t_begin;
    HD_TRY(replay(run, t_begin, t_end));
    const double replayed = hd_clock_now();
    const double allowed = hd_interval_piece_max(&run->interval, length, run->log->duration);
    const hd_ortho_limits limits = {allowed, defect};
    const hd_status status = length > shortest_piece(run)
                                 ? hd_ortho_step(run->ortho, run->frame, limits)
                                 : hd_ortho_step_stable(run->ortho, run->frame, CONDITION_STABLE);
    run->cost.replay += replayed - start;
    run->cost.ortho += hd_clock_now() - replayed;
    if (HD_VERIFIES && status == HD_OK) hd_verify_ortho(run->ortho, run->frame);
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
    if (run->schedule.phase == HD_AVERAGING) hd_spectrum_add(run->spectrum, stretch, length);
    hd_cost *cost = &run->cost;
    cost->interval = length;
    cost->condition = condition;
    cost->defect = hd_ortho_defect(run->ortho);
    run->condition_max = fmax(run->condition_max, condition);
    run->rounding += HD_ROUNDING * condition;
    cost->orthonormalisations++;
    cost->second_passes += hd_ortho_passes(run->ortho) > 1;
    cost->spectrum += hd_clock_now() - start;
}

/** True while modes are looked at. */
static bool observing(const hd_run *run)
{
    return run->modes && run->observe & OF_MODES && run->schedule.phase == HD_AVERAGING;
}

/** The whole log. An interval that turned out too long is taken back and replayed in pieces; a
 * shortest piece that is still too much holds a grazing collision and is factored by reflections.
 */
static hd_status frame_interval(hd_run *run)
{
    const double duration = run->log->duration;
    const bool looked_at = observing(run) || hd_lookback_is_watched(run);
    const double defect = looked_at ? DEFECT_MEASURED : DEFECT_LOOSE;
    double begin = 0.0, end = duration;
    HD_TRY(hd_lookback_start(run));
    while (begin < duration) {
        const double piece = end - begin;
        const hd_status status = frame_piece(run, begin, end, defect);
        if (status != HD_OK && status != HD_ILL_CONDITIONED) return status;
        if (status == HD_OK) {
            piece_accepted(run, piece);
            HD_TRY(hd_lookback_add(run, begin, end));
            begin = end;
            end = duration - end < 1.5 * piece ? duration
                                               : end + piece; /* no crumb of rounding is left */
            continue;
        }
        if (piece <= shortest_piece(run)) return HD_ILL_CONDITIONED;
        run->cost.repairs += piece >= duration;
        run->cost.limit = HD_LIMIT_REPAIR;
        hd_interval_failed(&run->interval, piece);
        hd_frame_rewind(run->frame);
        end = begin + 0.5 * piece;
    }
    hd_event_log_clear(run->log);
    run->interval_end = run->plan.end = run->now;
    return hd_lookback_end(run);
}

/** True if the exponents nearest to zero are known as well as the scene asks. */
static bool target_reached(const hd_run *run)
{
    return run->scene.target_std_error > 0 && run->spectrum &&
           hd_run_smallest_error(run) <= run->scene.target_std_error;
}

/** Longest time between two looks at the phases; INFINITY if nobody looks. */
static double phases_due(const hd_run *run)
{
    return run->observe & HD_OBSERVE_PHASES ? hd_phases_sampling(run->steps) : INFINITY;
}

/** The modes of an orthonormal frame. */
static hd_status measure(hd_run *run)
{
    const double start = hd_clock_now();
    run->watch.columns = hd_frame_columns(run->frame);
    hd_trajectory_state(run->trajectory, run->q, run->p);
    HD_TRY(hd_modes_measure(run->modes, run->watch.columns, run->q, run->p));
    run->cost.modes += hd_clock_now() - start;
    return HD_OK;
}

/** Modes, steps and phases of a measured state; what is asked for is enough for each. */
static hd_status observe(hd_run *run, bool report)
{
    HD_TRY(measure(run));
    const double start = hd_clock_now();
    if (report) {
        hd_modes_add(run->modes);
        hd_steps_find(run->steps, run->spectrum);
    }
    if (run->observe & HD_OBSERVE_PHASES) hd_phases_add(run->phases, run->steps, run->now);
    run->cost.modes += hd_clock_now() - start;
    return HD_OK;
}

static void sample_spectrum(hd_run *run)
{
    hd_spectrum_sample(run->spectrum);
    if (run->observe & OF_MODES)
        hd_steps_sample(run->steps, run->spectrum, run->schedule.sample_length);
}

/** True where somebody wants all of the vectors of this very time. */
static bool vectors_wanted(const hd_run *run)
{
    const unsigned due = HD_OBSERVE_HYDRO | (run->fields_due ? HD_OBSERVE_FIELDS : 0u);
    return observing(run) && (run->observe & due);
}

/** True if the tail will do for `count` phases at this time. */
static bool tail_suffices(const hd_run *run, int count)
{
    return run->tail && count <= hd_tail_count_max(run->tail) &&
           hd_interval_condition(&run->interval, run->log->duration) <= CONDITION_TAIL;
}

/** Finds the slowest vectors in the middle of an interval; the frame stays as it was at its start.
 */
static hd_status look(hd_run *run, int count)
{
    const double start = hd_clock_now();
    HD_TRY(replay(run, 0.0, run->log->duration));
    const double replayed = hd_clock_now();
    hd_trajectory_state(run->trajectory, run->q, run->p);
    hd_status status = hd_tail_measure(run->tail, run->frame, run->p, count);
    hd_frame_rewind(run->frame);
    if (status == HD_OK)
        status = hd_modes_measure(run->modes, hd_tail_columns(run->tail), run->q, run->p);
    if (status == HD_OK) run->watch.columns = hd_tail_columns(run->tail);
    run->cost.replay += replayed - start;
    run->cost.modes += hd_clock_now() - replayed;
    run->cost.looks += status == HD_OK;
    return status;
}

static hd_status end_early(hd_run *run)
{
    run->cost.limit = HD_LIMIT_LOOK;
    return frame_interval(run);
}

/** The slowest vectors, by a look or else by an early end of the interval. */
static hd_status find_slowest(hd_run *run, int count)
{
    const hd_status status = tail_suffices(run, count) ? look(run, count) : HD_ILL_CONDITIONED;
    return status == HD_ILL_CONDITIONED ? end_early(run) : status;
}

/** Number of slowest vectors that a watcher wants now. */
static int watched(const hd_run *run)
{
    return observing(run) && run->watch.first < run->vectors ? run->vectors - run->watch.first : 0;
}

/** In the middle of an interval: what is wanted there. What a look cannot give, an early end does;
 * the first report has something to say that way. */
static hd_status look_or_end(hd_run *run)
{
    const bool averaging = run->schedule.phase == HD_AVERAGING;
    if (vectors_wanted(run) || (averaging && hd_spectrum_time(run->spectrum) == 0))
        return end_early(run);
    const bool follows = observing(run) && (run->observe & HD_OBSERVE_PHASES);
    const int count = follows ? hd_phases_vectors(run->steps) : 0;
    const int most = count > watched(run) ? count : watched(run);
    if (most == 0) return HD_OK;
    HD_TRY(find_slowest(run, most));
    if (count > 0 && run->now < run->interval_end) hd_phases_add(run->phases, run->steps, run->now);
    return HD_OK;
}

/** Between two cuts: what a watcher wants. */
static hd_status show(hd_run *run)
{
    if (watched(run) == 0) return HD_OK;
    if (run->now < run->interval_end) HD_TRY(find_slowest(run, watched(run)));
    return run->now == run->interval_end ? measure(run) : HD_OK;
}

/** Once covariant vectors have gone their way back, if a phase is to end. The last one may end
 * early. */
static void leave_phase(hd_run *run)
{
    if (!run->phase_ends || hd_lookback_is_going(run)) return;
    enter_phase(run, run->schedule.phase + 1);
}

static hd_status go_back(hd_run *run)
{
    HD_TRY(hd_lookback_go(run, false));
    leave_phase(run);
    return HD_OK;
}

hd_status hd_run_settle(hd_run *run)
{
    HD_TRY(hd_lookback_go(run, true));
    leave_phase(run);
    return HD_OK;
}

/** At the end of a piece: what is measured there, and what ends. */
static hd_status take_cut(hd_run *run)
{
    const bool averaging = run->schedule.phase == HD_AVERAGING, measuring = observing(run);
    run->fields_due = averaging &&
                      hd_schedule_reaches_multiple(&run->schedule, run->field_interval);
    if (run->frame && run->now < run->interval_end) HD_TRY(look_or_end(run));
    const bool factored = run->frame && run->now == run->interval_end;
    const unsigned ends = hd_schedule_pass(&run->schedule, phases_due(run));
    run->report_due = ends & HD_ENDS_REPORT;
    if (averaging && run->spectrum && (ends & HD_ENDS_WHOLE_SAMPLE)) sample_spectrum(run);
    if (measuring && factored) HD_TRY(observe(run, run->report_due));
    const bool reached = averaging && run->report_due && factored && target_reached(run);
    run->fields_due |= reached;
    run->phase_ends = ends & HD_ENDS_PHASE || reached;
    leave_phase(run);
    return HD_OK;
}

/** Where the next orthonormalisation falls. */
static void plan_interval(hd_run *run)
{
    const double end = hd_schedule_sample_end(&run->schedule), left = end - run->now;
    const double most = hd_advance_longest(run);
    hd_interval_length next = hd_interval_next(&run->interval, left);
    if (next.length > most) next = (hd_interval_length){left / ceil(left / most), HD_LIMIT_EVENTS};
    next.length = fmax(next.length, hd_advance_shortest(run));
    run->interval_end = next.length >= left ? end : run->now + next.length;
    run->cost.limit = next.limit;
}

hd_status hd_run_step(hd_run *run)
{
    run->report_due = run->fields_due = false;
    run->watch.columns.count = 0;
    if (run->schedule.phase == HD_FINISHED) return HD_OK;
    const bool with_frame = run->frame && run->schedule.phase != HD_EQUILIBRATING;
    if (with_frame) hd_blas_use_threads(run->threads); /* with OpenMP: of the calling thread */
    if (hd_lookback_is_going(run) || run->phase_ends) return go_back(run);
    const double cut = hd_schedule_cut(&run->schedule);
    if (with_frame && run->now >= run->interval_end) plan_interval(run);
    if (run->now >= run->plan.end)
        hd_advance_plan(run, with_frame ? fmin(cut, run->interval_end) : cut);
    HD_TRY(hd_advance(run, with_frame ? run->log : NULL));
    if (with_frame && run->now >= run->interval_end) HD_TRY(frame_interval(run));
    return run->now >= cut ? take_cut(run) : show(run);
}

void hd_run_observe(hd_run *run, unsigned stages)
{
    const unsigned now = stages & run->scene.observe, begun = now & ~run->observe;
    if (begun & HD_OBSERVE_PHASES) hd_phases_clear(run->phases); /* not followed in between */
    if (begun & HD_OBSERVE_COVARIANT) hd_lookback_interrupt(run);
    run->observe = now;
}

void hd_run_fields_every(hd_run *run, double interval) { run->field_interval = interval; }

hd_status hd_run_reset_average(hd_run *run)
{
    if (run->schedule.phase != HD_AVERAGING) return HD_OK;
    if (run->frame) hd_blas_use_threads(run->threads);
    if (run->frame && run->now < run->interval_end) HD_TRY(frame_interval(run));
    enter_phase(run, HD_AVERAGING);
    return HD_OK;
}

void hd_run_watch(hd_run *run, double interval, int first)
{
    HD_ASSERT(interval > 0.0 && first >= 0);
    run->watch.interval = interval;
    run->watch.first = first;
}
