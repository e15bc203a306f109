/** Scene -> spectrum, one interval at a time.
 *
 * The schedule says where stages and reports end. The frame goes from one orthonormalisation to the
 * next, as far apart as the conditioning allows; the log of the events since the last one waits
 * until then. A sample is one or several such intervals. It ends with a measured state: the frame
 * is orthonormal, and averages, modes and phases take it up. A report in between states them as of
 * the last one, unless somebody looks at the vectors: then the sample ends with it. */
#include "hdlyap/run.h"

#include <float.h>
#include <math.h>

#include "base/check.h"
#include "base/clock.h"
#include "base/memory.h"
#include "hdlyap/blas.h"
#include "hdlyap/room.h"
#include "run/factorise.h"
#include "run/localize.h"
#include "run/measure.h"
#include "run/order.h"
#include "run/plan.h"
#include "run/ranks.h"
#include "run/run_state.h"
#include "tangent/threads.h"
#include "tangent/verify.h"

/** Loss of orthogonality of a random frame that does not matter; a pass leaves less. */
static const double ORTHONORMAL = 1e-10;
/** Collisions of each disk between two orthonormalisations that no accuracy and no density exceed.
 */
static const double COLLISIONS_MOST = 60.0;
/** Collisions of each disk that growth remembers: shorter blocks tell no error. */
static const double COLLISIONS_PER_BLOCK = 8.0;

/* ---- creation ------------------------------------------------------------------------------ */

/** A random frame, orthonormal. Random vectors are hardly ever dependent: then reflections. */
static hd_status create_frame(hd_run *run)
{
    const hd_scene_def *scene = &run->scene;
    const hd_ortho_limits once = {1e7, ORTHONORMAL, HD_NORM_FULL};
    HD_TRY(hd_frame_create_shared(&run->frame, scene->disks, run->carried, scene->seed,
                                  run->threads, run->communicator));
    if (run->carried < run->vectors) return hd_conjugate_start(run->frame);
    if (hd_ortho_step(run->ortho, run->frame, once) == HD_OK) return HD_OK;
    hd_frame_free(run->frame);
    run->frame = NULL;
    HD_TRY(hd_frame_create_shared(&run->frame, scene->disks, run->carried, scene->seed,
                                  run->threads, run->communicator));
    return hd_ortho_step_stable(run->ortho, run->frame, 1.0 / DBL_EPSILON);
}

double hd_run_block_least(const hd_run *run)
{
    const double collision = run->sample_max / HD_COLLISIONS_PER_SAMPLE;
    return fmax(COLLISIONS_PER_BLOCK * collision, hd_scene_sound_crossing(&run->scene));
}

static hd_status prepare_threads(hd_run *run)
{
    const int wanted = run->scene.threads, disks = run->scene.disks, n = run->carried;
    const int most = hd_run_threads_most(run);
    if (most > 1) HD_TRY(hd_blas_room(most)); /* one has its buffer since the start */
    const int granted = run->threads = hd_blas_threads_granted(most);
    hd_blas_use_threads(granted);
    if (wanted == 0 && !run->communicator)
        HD_TRY(hd_threads_choose(&run->threads, run->ortho, disks, n, granted));
    run->threads_denied = run->threads == granted ? most - granted : 0;
    hd_blas_use_threads(run->threads);
    return HD_OK;
}

/** Of a frame that is orthonormal in the whole norm: the next one may be so in that of dq alone. */
static hd_status keep_halves(hd_run *run)
{
    const hd_shared shared = {2, (size_t)run->vectors, (size_t)hd_frame_stride(run->frame),
                              (size_t)run->carried, 0};
    const hd_columns own = hd_frame_columns(run->frame);
    double *cos_theta = run->halves, *ratio = run->halves + run->vectors;
    if (own.count > 0) hd_frame_halves(run->frame, cos_theta + own.first, ratio + own.first);
    HD_TRY(hd_communicator_share(run->communicator, run->halves, shared));
    if (run->conjugate) hd_conjugate_halves(cos_theta, ratio, run->carried);
    for (int k = 0; k < 2 * run->vectors; k++)
        if (isnan(run->halves[k])) run->halves[k] = HD_NO_HALF;
    return HD_OK;
}

static hd_status prepare_conjugate(hd_run *run)
{
    const int here = run->communicator ? hd_frame_stride(run->frame) : run->carried;
    const bool completed = run->scene.observe & HD_OBSERVE_OF_MODES;
    if (run->carried == run->vectors) return HD_OK;
    return hd_conjugate_create(&run->conjugate, 4 * run->scene.disks, completed ? here : 0);
}

static hd_status prepare_frame(hd_run *run)
{
    const int rows = 4 * run->scene.disks, n = run->vectors;
    HD_TRY(hd_run_agree(run, hd_event_log_create(&run->log)));
    HD_TRY(hd_ortho_create_shared(&run->ortho, rows, run->carried, run->communicator));
    HD_TRY(hd_run_agree(run, prepare_threads(run)));
    HD_TRY(hd_run_agree(run, hd_spectrum_create(&run->spectrum, rows, n, hd_run_block_least(run))));
    run->whole = true;
    run->halves = hd_memory_alloc(2 * (size_t)n, sizeof *run->halves);
    HD_TRY(hd_run_agree(run, run->halves ? HD_OK : HD_NO_MEMORY));
    HD_TRY(create_frame(run));
    HD_TRY(hd_run_agree(run, prepare_conjugate(run)));
    return keep_halves(run);
}

static hd_status prepare_windows(hd_run *run, char *message, size_t size)
{
    const double longest = fmin(COLLISIONS_MOST * run->sample_max / HD_COLLISIONS_PER_SAMPLE,
                                run->interval.limit);
    if (!(run->scene.observe & HD_OBSERVE_COVARIANT)) return HD_OK;
    run->windows.communicator = run->communicator;
    return hd_run_agree(run, hd_windows_create(&run->windows, &run->scene, run->ortho, longest,
                                               run->threads, message, size));
}

static hd_status prepare(hd_run *run, char *message, size_t size)
{
    const hd_scene_def *scene = &run->scene;
    HD_TRY(hd_run_agree(run, hd_advance_create(&run->advance, scene)));
    run->vectors = hd_scene_vectors(scene);
    run->carried = hd_scene_carried(scene);
    run->threads = 1;
    const double per_disk = 2.0 * hd_trajectory_collision_rate(run->advance.trajectory) /
                            scene->disks;
    const double limit = scene->interval > 0 ? scene->interval : INFINITY;
    run->sample_max = HD_COLLISIONS_PER_SAMPLE / per_disk;
    run->cost.limit = HD_LIMIT_NONE;
    run->watch = (hd_watch){.interval = INFINITY, .first = run->vectors};
    run->interval = hd_interval_first(2.0 / per_disk, limit, scene->accuracy);
    run->schedule = hd_schedule_of(scene);
    run->in_force.target_std_error = scene->target_std_error;
    if (scene->observe & HD_OBSERVE_GAS)
        HD_TRY(hd_run_agree(run, hd_gas_create(&run->gas, scene, hd_run_block_least(run))));
    if (run->vectors == 0) return HD_OK;
    HD_TRY(prepare_frame(run));
    HD_TRY(prepare_windows(run, message, size));
    HD_TRY(hd_run_agree(run, hd_run_localize_from(run)));
    run->observe = scene->observe;
    if (!(scene->observe & HD_OBSERVE_OF_MODES)) return HD_OK;
    return hd_run_agree(run, hd_observer_create(&run->observer, scene, run->vectors, run->threads));
}

static void averages_clear(hd_run *run)
{
    hd_spectrum_clear(run->spectrum);
    hd_observer_clear(&run->observer);
    if (run->shape) hd_localization_clear(run->shape);
    if (run->windows.covariant) hd_windows_clear(&run->windows);
}

static void enter_stage(hd_run *run, hd_stage stage)
{
    const double now = hd_run_time(run);
    run->due.stage_end = false;
    hd_schedule_enter(&run->schedule, stage, now);
    run->sample = (hd_sample){.begin = now};
    run->followed = -1.0;
    run->advance.plan.end = now;
    stage = run->schedule.stage;
    if (run->gas && stage == HD_AVERAGING) hd_gas_begin(run->gas, run->advance.trajectory);
    if (run->spectrum && stage == HD_AVERAGING) averages_clear(run);
    if (stage == HD_AVERAGING) run->rounding.sum = HD_ROUNDING * run->rounding.condition_max;
    hd_run_save_accuracy(run);
    if (stage == HD_EQUILIBRATING || run->clocks.frame_started != 0) return;
    run->clocks.frame_started = hd_clock_now();
    run->clocks.frame_start_time = now;
}

hd_status hd_run_create(hd_run **out, const hd_scene_def *def, char *message, size_t size)
{
    return hd_run_create_shared(out, def, NULL, message, size);
}

hd_status hd_run_create_shared(hd_run **out, const hd_scene_def *def, hd_communicator *communicator,
                               char *message, size_t size)
{
    hd_order_tell(communicator, (hd_order){.kind = HD_ORDER_CREATE, .scene = def});
    return hd_run_make(out, def, communicator, message, size);
}

hd_status hd_run_make(hd_run **out, const hd_scene_def *def, hd_communicator *communicator,
                      char *message, size_t size)
{
    *out = NULL;
    HD_TRY(hd_run_check_together(def, communicator, message, size));
    hd_run *run = hd_memory_alloc(1, sizeof *run);
    HD_TRY(hd_communicator_agree(communicator, run ? HD_OK : HD_NO_MEMORY));
    run->communicator = communicator;
    run->fields_first = 4 * def->disks; /* none */
    run->scene = *def;
    run->scene.warmup = hd_scene_warmup(def);
    run->clocks.created = hd_clock_now();
    const hd_status status = prepare(run, message, size);
    if (status != HD_OK) {
        hd_run_drop(run);
        return status;
    }
    enter_stage(run, HD_EQUILIBRATING);
    *out = run;
    return HD_OK;
}

void hd_run_free(hd_run *run)
{
    if (run) hd_order_tell(run->communicator, (hd_order){.kind = HD_ORDER_FREE});
    hd_run_drop(run);
}

void hd_run_drop(hd_run *run)
{
    if (!run) return;
    hd_advance_clear(&run->advance);
    hd_observer_free(&run->observer);
    hd_windows_free(&run->windows);
    hd_gas_free(run->gas);
    hd_localization_free(run->shape);
    hd_event_log_free(run->log);
    hd_frame_free(run->frame);
    hd_ortho_free(run->ortho);
    hd_conjugate_free(run->conjugate);
    hd_spectrum_free(run->spectrum);
    hd_memory_free(run->halves);
    hd_memory_free(run->gathered_room);
    hd_memory_free(run);
}

/* ---- what is looked at ---------------------------------------------------------------------- */

/** True if the exponents nearest to zero are known as well as the scene asks. */
static bool target_reached(const hd_run *run)
{
    const double target = run->in_force.target_std_error;
    return target > 0 && run->spectrum && hd_run_smallest_error(run) <= target;
}

/** Takes up what has been asked for since. The averaging may end with it. */
static void take_changes(hd_run *run)
{
    const double now = hd_run_time(run);
    if (!run->in_force.changing) return;
    run->in_force = (hd_in_force){.target_std_error = run->scene.target_std_error,
                                  .field_interval = run->field_interval};
    hd_schedule_change(&run->schedule, &run->scene, now);
    run->advance.plan.end = fmin(run->advance.plan.end, hd_schedule_cut(&run->schedule));
    if (run->schedule.stage != HD_AVERAGING) return;
    run->due.stage_end = hd_schedule_is_over(&run->schedule, now) || target_reached(run);
    if (run->due.stage_end) run->due.report = run->due.fields = true;
}

/* ---- from one orthonormalisation to the next ----------------------------------------------- */

/** True where a sample has ended. */
static bool is_measured(const hd_run *run) { return hd_run_time(run) == run->sample.begin; }

/** Ends the interval here, and with it the sample: the frame becomes orthonormal in the whole norm.
 */
static hd_status end_sample(hd_run *run)
{
    if (is_measured(run)) return HD_OK; /* an averaging can be too short for time to move */
    HD_TRY(hd_run_factorise(run, true));
    run->sample = (hd_sample){.begin = hd_run_time(run)};
    HD_TRY(keep_halves(run));
    if (run->schedule.stage != HD_AVERAGING) return HD_OK;
    hd_spectrum_sample(run->spectrum);
    if (run->gas) hd_gas_add(run->gas, run->advance.trajectory);
    HD_TRY(hd_run_localize(run));
    return hd_run_is_observing(run) ? hd_run_measure_and_add(run) : HD_OK;
}

/** The sample also ends if a watcher wants the vectors. */
static hd_status end_interval(hd_run *run)
{
    run->cost.limit = run->limit;
    return run->sample.ends || hd_run_is_watched(run) ? end_sample(run)
                                                      : hd_run_factorise(run, false);
}

static hd_status end_early(hd_run *run)
{
    run->cost.limit = HD_LIMIT_LOOK;
    return end_sample(run);
}

/** The vectors of this very time, if a watcher wants them and they are not known. */
static hd_status look(hd_run *run)
{
    if (!hd_run_is_watched(run) || run->observer.known.count > 0) return HD_OK;
    if (!is_measured(run)) {
        run->cost.slow_vector_samples++;
        return end_early(run);
    }
    HD_TRY(hd_run_measure(run));
    return hd_run_gather(run);
}

/* ---- from one cut to the next -------------------------------------------------------------- */

/** True while there is a way back to go. */
static bool is_going_back(const hd_run *run)
{
    return hd_run_is_windowing(run) && hd_windows_is_going(&run->windows);
}

/** Once covariant vectors have gone their way back, if a stage is to end. The last one may end
 * early. */
static void leave_stage(hd_run *run)
{
    if (!run->due.stage_end || is_going_back(run)) return;
    enter_stage(run, run->schedule.stage + 1);
}

static hd_status go_back(hd_run *run, bool to_its_end)
{
    if (is_going_back(run)) HD_TRY(hd_windows_go(&run->windows, to_its_end));
    leave_stage(run);
    return HD_OK;
}

hd_status hd_run_settle(hd_run *run) { return go_back(run, true); }

/** At a cut a report is due. */
static hd_status take_cut(hd_run *run)
{
    const bool averaging = run->schedule.stage == HD_AVERAGING;
    bool reached = averaging && target_reached(run);
    if (reached && !is_measured(run)) { /* with the sample that ends here it may not be any more */
        HD_TRY(end_early(run));
        reached = target_reached(run);
    }
    const double multiple = hd_schedule_next_multiple(&run->schedule, run->in_force.field_interval);
    run->due.report = true;
    run->due.fields = averaging && (reached || multiple <= hd_schedule_cut(&run->schedule));
    run->due.stage_end = hd_schedule_pass(&run->schedule) & HD_ENDS_STAGE || reached;
    const bool first = averaging && run->spectrum && hd_spectrum_time(run->spectrum) == 0;
    const bool looked_at = hd_run_is_observing(run) && run->observe & HD_OBSERVE_AT_REPORTS;
    const bool ends = run->due.stage_end || first || looked_at || hd_run_vectors_wanted(run);
    const bool carried = run->frame && run->schedule.stage != HD_EQUILIBRATING;
    HD_TRY(hd_run_compare_disks(run));
    if (!carried || !ends) return HD_OK;
    return is_measured(run) ? hd_run_gather(run) : end_early(run);
}

/** Moves the disks on, as far as a watcher lets them. */
static hd_status advance(hd_run *run, hd_event_log *log)
{
    const double start = hd_clock_now();
    HD_TRY(hd_run_agree(run, hd_advance_on(&run->advance, log, run->watch.interval)));
    run->cost.events += hd_clock_now() - start;
    if (HD_VERIFIES) hd_verify_disks(run->advance.trajectory, &run->scene);
    if (HD_VERIFIES && log) hd_verify_log(log, run->scene.disks);
    return HD_OK;
}

/** The disks alone, up to a report, or to the end of a sample of what they do. */
static hd_status advance_disks(hd_run *run)
{
    take_changes(run);
    if (run->due.stage_end) return go_back(run, false);
    const bool sampled = run->gas && run->schedule.stage == HD_AVERAGING;
    const double now = hd_run_time(run), cut = hd_schedule_cut(&run->schedule);
    const double end = sampled ? run->sample.begin + hd_run_sample_longest(run) : INFINITY;
    const double stop = fmin(cut, fmax(end, now)); /* a file may say that it is overdue */
    if (hd_advance_is_done(&run->advance)) hd_advance_make_plan(&run->advance, stop);
    HD_TRY(advance(run, NULL));
    if (sampled && hd_run_time(run) >= stop) {
        hd_gas_add(run->gas, run->advance.trajectory);
        run->sample.begin = hd_run_time(run);
    }
    if (hd_run_time(run) >= cut) HD_TRY(take_cut(run));
    leave_stage(run);
    return HD_OK;
}

/** Disks and frame, up to a report or the end of an interval. */
static hd_status advance_frame(hd_run *run)
{
    const bool averaging = run->schedule.stage == HD_AVERAGING;
    if (!averaging || hd_run_time(run) >= run->interval_end) take_changes(run);
    if (run->due.stage_end) return go_back(run, false);
    if (hd_run_time(run) >= run->interval_end) hd_run_plan(run);
    const double cut = hd_schedule_cut(&run->schedule);
    if (hd_advance_is_done(&run->advance))
        hd_advance_make_plan(&run->advance, fmin(cut, run->interval_end));
    HD_TRY(advance(run, run->log));
    if (hd_run_time(run) >= run->interval_end) HD_TRY(end_interval(run));
    if (hd_run_time(run) >= cut) HD_TRY(take_cut(run));
    HD_TRY(look(run));
    if (averaging && is_measured(run)) take_changes(run);
    if (!run->due.stage_end && hd_run_time(run) >= run->interval_end) hd_run_plan(run);
    leave_stage(run);
    return HD_OK;
}

hd_status hd_run_advance(hd_run *run)
{
    hd_order_tell(run->communicator, (hd_order){.kind = HD_ORDER_ADVANCE});
    const bool told = run->due.report && run->schedule.stage == HD_AVERAGING;
    if (told && run->spectrum) hd_spectrum_local_restart(run->spectrum);
    run->due.report = run->due.fields = false;
    run->observer.known.count = run->gathered.count = 0;
    if (run->schedule.stage == HD_FINISHED) return HD_OK;
    const bool with_frame = run->frame && run->schedule.stage != HD_EQUILIBRATING;
    if (with_frame) hd_blas_use_threads(run->threads); /* with OpenMP: of the calling thread */
    if (is_going_back(run) || run->due.stage_end) return go_back(run, false);
    return with_frame ? advance_frame(run) : advance_disks(run);
}

void hd_run_observe(hd_run *run, unsigned stages)
{
    const unsigned now = stages & run->scene.observe, begun = now & ~run->observe;
    if (now == run->observe) return;
    hd_order_tell(run->communicator, (hd_order){.kind = HD_ORDER_OBSERVE, .integer = (int)now});
    hd_observer_forget_phases(&run->observer, begun);          /* not followed in between */
    if (begun & HD_OBSERVE_COVARIANT) run->windows.due = true; /* nor this */
    run->observe = now;
}

hd_status hd_run_reset_average(hd_run *run)
{
    hd_order_tell(run->communicator, (hd_order){.kind = HD_ORDER_RESET});
    if (run->schedule.stage != HD_AVERAGING) return HD_OK;
    if (run->frame) hd_blas_use_threads(run->threads);
    if (run->frame) HD_TRY(hd_run_factorise(run, true));
    enter_stage(run, HD_AVERAGING);
    return HD_OK;
}

void hd_run_watch(hd_run *run, double interval, int first)
{
    HD_ASSERT(interval > 0.0 && first >= 0);
    if (interval == run->watch.interval && first == run->watch.first) return;
    hd_order_tell(run->communicator,
                  (hd_order){.kind = HD_ORDER_WATCH, .integer = first, .number = interval});
    run->watch.interval = interval;
    run->watch.first = first;
}
