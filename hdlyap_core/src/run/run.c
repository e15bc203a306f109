/** Scene -> spectrum and observables, one interval at a time.
 *
 * The agenda says when something is due. The particles move to that time; then go_on does what is
 * due, in one order. The frame goes from one orthonormalisation to the next; the record of what
 * happened since the last one waits until then. A sample ends with a measured state: the frame is
 * orthonormal in the full norm, and all averages are updated. A report between two samples states
 * the averages of the last one, unless a listener needs the vectors: then the sample ends with the
 * report. */
#include "hdlyap/run.h"

#include <math.h>

#include "averages/spectrum.h"
#include "base/blas.h"
#include "base/check.h"
#include "base/clock.h"
#include "base/memory.h"
#include "hdlyap/memory_limit.h"
#include "run/order.h"
#include "run/ranks.h"
#include "run/run_state.h"
#include "scene/scene.h"
#include "tangent/verify.h"

double hd_run_time(const hd_run *run) { return hd_trajectory_time(run->advance.trajectory); }

static bool is_averaging(const hd_run *run) { return run->agenda.stage == HD_AVERAGING; }

/** True if this is due at the present time (HD_DUE_*). */
static bool is_due(const hd_run *run, unsigned what) { return run->agenda.due & what; }

/** True in stages in which vectors are carried. */
static bool is_framed(const hd_run *run)
{
    return run->carrier.frame && run->agenda.stage != HD_EQUILIBRATING;
}

/** True if a sample has just ended. */
static bool is_measured(const hd_run *run) { return hd_run_time(run) == run->agenda.sample_begin; }

/** True if averages are taken and an observable that somebody listens to has all of these needs. */
static bool is_needed(const hd_run *run, unsigned needs)
{
    return is_averaging(run) && hd_observables_need(&run->observables, needs);
}

/** The windows of covariant vectors, while averages are taken; NULL if nobody listens to them. */
static hd_windows *windows_of(const hd_run *run)
{
    return is_averaging(run) ? hd_observables_windows(&run->observables) : NULL;
}

/** What observables see of the present state. */
static hd_moment moment_of(const hd_run *run)
{
    const hd_carrier *c = &run->carrier;
    hd_moment now = {.trajectory = run->advance.trajectory, .spectrum = c->spectrum};
    if (!c->frame) return now;
    now.carried = hd_frame_columns(c->frame);
    if (!is_needed(run, HD_NEEDS_VECTORS)) return now;
    now.vectors[0] = run->communicator ? now.carried : hd_carrier_vectors(c);
    if (run->communicator && c->conjugate)
        now.vectors[1] = hd_conjugate_partners(c->conjugate, now.carried);
    return now;
}

/* ---- creation ------------------------------------------------------------------------------ */

static hd_status prepare_observables(hd_run *run)
{
    const hd_carrier *c = &run->carrier;
    const hd_observing with = {.scene = &run->scene,
                               .vectors = c->vectors,
                               .carried = c->carried,
                               .width = c->frame ? hd_frame_stride(c->frame) : 0,
                               .threads = c->threads,
                               .communicator = run->communicator,
                               .block = run->agenda.block,
                               .sample = hd_agenda_sample_grown(&run->agenda),
                               .ortho = c->ortho,
                               .spectrum = c->spectrum};
    return hd_observables_create(&run->observables, &with);
}

/** Says that there is no start: more particles than hd_scene_check tries can turn out to have none.
 */
static hd_status refuse_start(const hd_scene_def *scene, char *message, size_t size)
{
    const hd_dynamics *of = hd_dynamics_of(scene);
    if (of->dimension == 0)
        return hd_refuse(message, size, "particles = %s: create has refused the scene",
                         of->particles);
    return hd_refuse(message, size,
                     "density = %.15g: must be lower with particles = %s, number = %d: no start is "
                     "found",
                     scene->density, of->particles, scene->number);
}

static hd_status prepare(hd_run *run, bool resumed, char *message, size_t size)
{
    const hd_scene_def *scene = &run->scene;
    const hd_status moving = hd_communicator_agree(
        run->communicator, hd_advance_create(&run->advance, scene, resumed));
    if (moving == HD_REFUSED) return refuse_start(scene, message, size);
    HD_TRY(moving);
    HD_TRY(hd_communicator_agree(run->communicator, hd_cages_create(&run->cages, scene)));
    const double rate = 2.0 * hd_trajectory_totals(run->advance.trajectory).expected /
                        scene->number;
    run->cost.limit = HD_LIMIT_NONE;
    run->agenda = hd_agenda_of(scene, rate);
    HD_TRY(hd_carrier_create(&run->carrier, scene, 1.0 / rate, run->agenda.block, run->communicator,
                             &run->cost));
    run->watch = INFINITY;
    return prepare_observables(run);
}

static void enter_stage(hd_run *run, hd_stage stage)
{
    const double now = hd_run_time(run);
    hd_agenda_enter(&run->agenda, stage, now);
    hd_advance_stop(&run->advance, now);
    if (stage != HD_FINISHED)
        run->followed = -1.0; /* a run that is made longer may go on from here */
    if (run->agenda.stage != HD_EQUILIBRATING && run->clocks.frame_started == 0) {
        run->clocks.frame_started = hd_clock_now();
        run->clocks.frame_start_time = now;
    }
    hd_carrier_begin(&run->carrier, is_averaging(run), now - run->clocks.frame_start_time,
                     hd_trajectory_divergence(run->advance.trajectory));
    if (is_averaging(run)) {
        hd_cages_begin(&run->cages, run->advance.trajectory);
        run->errors = (hd_error_trend){.first = 0.0};
        hd_observables_clear(&run->observables, (hd_moment){.trajectory = run->advance.trajectory});
    }
}

hd_status hd_run_create(hd_run **out, const hd_scene_def *def, char *message, size_t size)
{
    return hd_run_create_shared(out, def, NULL, message, size);
}

hd_status hd_run_create_shared(hd_run **out, const hd_scene_def *def, hd_communicator *communicator,
                               char *message, size_t size)
{
    hd_order_tell(communicator, (hd_order){.kind = HD_ORDER_CREATE, .scene = def});
    return hd_run_make(out, def, false, communicator, message, size);
}

hd_status hd_run_make(hd_run **out, const hd_scene_def *def, bool resumed,
                      hd_communicator *communicator, char *message, size_t size)
{
    const double created = hd_clock_now();
    const hd_traffic before = hd_communicator_traffic(communicator);
    *out = NULL;
    HD_TRY(hd_ranks_check(def, communicator, message, size));
    HD_TRY(hd_target_check(def, message, size));
    HD_TRY(resumed ? hd_windows_check_memory(def, hd_carrier_longest(def), message, size)
                   : hd_memory_check_windows(def, message, size));
    hd_run *run = hd_memory_alloc(1, sizeof *run);
    const hd_status found = hd_communicator_agree(communicator, run ? HD_OK : HD_NO_MEMORY);
    if (found != HD_OK) {
        hd_memory_free(run);
        return found;
    }
    run->communicator = communicator;
    run->cost = (hd_cost){
        .communication = -before.seconds, .bytes = -before.bytes, .calls = -before.calls};
    run->scene = *def;
    run->scene.warmup = hd_scene_warmup(def);
    hd_scene_settle(&run->scene);
    run->clocks.created = created;
    hd_status status = prepare(run, resumed, message, size);
    if (status == HD_OK)
        status = hd_communicator_agree(
            communicator, hd_trajectory_check_null(run->advance.trajectory, def, message, size));
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
    hd_observables_free(&run->observables);
    hd_carrier_free(&run->carrier);
    hd_gathered_free(&run->gathered);
    hd_cages_clear(&run->cages);
    hd_advance_clear(&run->advance);
    hd_memory_free(run);
}

/* ---- what is due --------------------------------------------------------------------------- */

/** Puts changes in force that hold from now on. The averaging may end with them. */
static void take_changes(hd_run *run)
{
    const bool reached = run->agenda.in_force.changing &&
                         hd_target_standing(run, &run->scene.target).reached;
    hd_advance_stop(&run->advance, hd_agenda_change(&run->agenda, &run->scene, reached,
                                                    hd_run_time(run), run->carrier.frame));
}

/** Longest time from one measured state to the next that observables allow. */
static double sampling(const hd_run *run)
{
    return is_averaging(run) ? hd_observables_sampling(&run->observables) : INFINITY;
}

/** Makes the frame orthonormal now; measured: in the full norm. */
static hd_status orthonormalise(hd_run *run, bool measured)
{
    const hd_carrying how = {.averaging = is_averaging(run),
                             .measured = measured,
                             .observed = is_needed(run, HD_NEEDS_FRAME),
                             .whole = is_needed(run, HD_NEEDS_WHOLE),
                             .windows = windows_of(run),
                             .expected = run->agenda.expected,
                             .trajectory = run->advance.trajectory};
    const bool carried = hd_record_duration(run->carrier.record) > 0;
    HD_TRY(hd_carrier_orthonormalise(&run->carrier, how));
    if (!carried) return HD_OK;
    run->agenda.interval_end = hd_run_time(run);
    hd_advance_stop(&run->advance, hd_run_time(run));
    return HD_OK;
}

/** Takes a snapshot of this state; add: and adds it to the averages. */
static hd_status measure(hd_run *run, bool add)
{
    if (!is_needed(run, 0)) return HD_OK;
    const double start = hd_clock_now();
    HD_TRY(hd_observables_measure(&run->observables, moment_of(run), add));
    if (add && is_needed(run, HD_NEEDS_CLOSE)) run->followed = hd_run_time(run);
    run->known = is_needed(run, HD_NEEDS_VECTORS);
    run->cost.modes += hd_clock_now() - start;
    return HD_OK;
}

/** Adds the present error of the exponents nearest to zero to its trend. */
static void add_error(hd_run *run)
{
    const double error = hd_carrier_smallest_error(&run->carrier);
    hd_error_trend_add(&run->errors, hd_spectrum_time(run->carrier.spectrum),
                       error < INFINITY ? error : -1.0);
}

/** Ends the sample with a measured state. */
static hd_status end_sample(hd_run *run)
{
    if (is_measured(run)) return HD_OK; /* the averaging may be too short for time to move */
    if (is_framed(run)) HD_TRY(orthonormalise(run, true));
    hd_agenda_pass_sample(&run->agenda, hd_run_time(run));
    if (is_framed(run))
        HD_TRY(hd_carrier_sample(&run->carrier, is_averaging(run),
                                 hd_trajectory_divergence(run->advance.trajectory)));
    if (is_framed(run) && is_averaging(run)) add_error(run);
    return measure(run, true);
}

/** Ends the sample before its interval ends. */
static hd_status end_early(hd_run *run)
{
    run->cost.limit = HD_LIMIT_LOOK;
    return end_sample(run);
}

static hd_status end_interval(hd_run *run, bool sample_ends)
{
    run->cost.limit = run->agenda.limit;
    return sample_ends ? end_sample(run) : orthonormalise(run, false);
}

/** True if what is due at this report needs a measured state. */
static bool needs_state(const hd_run *run)
{
    return is_due(run, HD_DUE_STAGE) || is_needed(run, HD_NEEDS_REPORTS);
}

/** Looks whether the particles have left their places. */
static void look_at_places(hd_run *run)
{
    const double start = hd_clock_now();
    hd_cages_look(&run->cages, run->advance.trajectory, &run->scene);
    run->cost.events += hd_clock_now() - start;
}

static hd_status report(hd_run *run)
{
    bool reached = is_averaging(run) && hd_target_reached(run);
    if (reached && !is_measured(run)) { /* with this sample the target may be missed again */
        HD_TRY(end_early(run));
        reached = hd_target_reached(run);
    }
    hd_agenda_pass_report(&run->agenda, reached);
    HD_TRY(hd_ranks_compare(run->communicator, run->advance.trajectory));
    if (is_averaging(run)) look_at_places(run);
    if (is_framed(run) && needs_state(run) && !is_measured(run)) HD_TRY(end_early(run));
    if (!is_needed(run, HD_NEEDS_REPORTS)) return HD_OK;
    const double start = hd_clock_now();
    hd_moment now = {.trajectory = run->advance.trajectory};
    HD_TRY(hd_gather(&run->gathered, &run->carrier, hd_observables_first(&run->observables)));
    now.vectors[0] = run->gathered.columns;
    hd_observables_report(&run->observables, now);
    run->cost.modes += hd_clock_now() - start;
    return HD_OK;
}

/** Leaves the stage if it is over and no window has to be gone back through. */
static void leave_stage(hd_run *run)
{
    if (!is_due(run, HD_DUE_STAGE) || hd_windows_are_behind(windows_of(run))) return;
    enter_stage(run, run->agenda.stage + 1);
}

static hd_status go_back(hd_run *run, bool to_its_end)
{
    hd_windows *windows = windows_of(run);
    const double start = hd_clock_now();
    const hd_status status = hd_windows_go_back(windows, to_its_end);
    if (windows) run->cost.following += hd_clock_now() - start;
    if (status == HD_OK) leave_stage(run);
    return status;
}

hd_status hd_run_settle(hd_run *run)
{
    if (run->status == HD_OK) run->status = go_back(run, true);
    return run->status;
}

/* ---- from one time to the next ------------------------------------------------------------- */

/** Plans the next orthonormalisation of the frame, unless one is planned; the next time at which
 * something is due. */
static double plan(hd_run *run, hd_interval_request *request)
{
    const bool framed = is_framed(run);
    const double now = hd_run_time(run), phases = sampling(run),
                 apart = hd_observables_apart(&run->scene, run->observables.seen);
    *request = (hd_interval_request){
        .now = now,
        .framed = framed,
        .sampled = !framed && is_needed(run, 0),
        .first = framed && hd_spectrum_time(run->carrier.spectrum) == 0,
        .at_reports = is_needed(run, HD_NEEDS_REPORTS),
        .at_fields = is_needed(run, HD_NEEDS_ALL),
        .phases = phases,
        .apart = fmin(apart, phases),
        .snapshot = hd_windows_due(windows_of(run), now),
        .norm = hd_carrier_norm(&run->carrier, is_needed(run, HD_NEEDS_WHOLE)),
        .interval = &run->carrier.interval};
    hd_advance_bounds(&run->advance, &request->shortest, &request->longest);
    return hd_agenda_plan(&run->agenda, request);
}

/** Vectors that were made readable belong to a time that is over. */
static void forget_vectors(hd_run *run)
{
    run->known = false;
    run->gathered.columns.count = 0;
}

/** Moves the particles towards the time `end`, or only to the next time at which a viewer looks. */
static hd_status move_particles(hd_run *run, double end)
{
    const double start = hd_clock_now();
    hd_record *record = is_framed(run) ? run->carrier.record : NULL;
    forget_vectors(run);
    HD_TRY(hd_communicator_agree(run->communicator, hd_advance_on(&run->advance, &run->observables,
                                                                  record, end, run->watch)));
    run->cost.events += hd_clock_now() - start;
    if (HD_VERIFIES) hd_verify_trajectory(run->advance.trajectory, &run->scene);
    if (HD_VERIFIES && record) hd_verify_record(record, &run->scene);
    return HD_OK;
}

static hd_status go_on(hd_run *run)
{
    take_changes(run);
    if (is_due(run, HD_DUE_STAGE)) return go_back(run, false);
    hd_interval_request request;
    HD_TRY(move_particles(run, plan(run, &request)));
    request.now = hd_run_time(run);
    const unsigned due = hd_agenda_reached(&run->agenda, &request);
    if (due & HD_DUE_INTERVAL)
        HD_TRY(end_interval(run, due & HD_DUE_SAMPLE));
    else if (due & HD_DUE_SAMPLE)
        HD_TRY(end_sample(run));
    if (due & HD_DUE_REPORT) HD_TRY(report(run));
    if (is_averaging(run) && request.framed && is_measured(run)) take_changes(run);
    if (!is_due(run, HD_DUE_STAGE)) (void)plan(run, &request);
    leave_stage(run);
    return HD_OK;
}

static hd_status advance(hd_run *run)
{
    if (is_due(run, HD_DUE_REPORT) && is_averaging(run) && run->carrier.spectrum)
        hd_spectrum_local_restart(run->carrier.spectrum);
    hd_agenda_begin(&run->agenda);
    if (run->agenda.stage == HD_FINISHED) return HD_OK;
    if (is_framed(run)) hd_blas_use_threads(run->carrier.threads); /* set for the calling thread */
    const bool behind = hd_windows_are_behind(windows_of(run));
    return behind || is_due(run, HD_DUE_STAGE) ? go_back(run, false) : go_on(run);
}

hd_status hd_run_advance(hd_run *run)
{
    hd_order_tell(run->communicator, (hd_order){.kind = HD_ORDER_ADVANCE});
    if (run->status == HD_OK) run->status = advance(run);
    return run->status;
}

/** Changes that were asked for hold from the sample on that begins here. A state that was measured
 * when nobody listened to the observables is measured once more. */
static hd_status measure_now(hd_run *run, int first)
{
    const bool averaging = is_averaging(run) && is_framed(run);
    if (averaging) hd_blas_use_threads(run->carrier.threads);
    if (averaging && !is_measured(run)) {
        run->cost.slow_vector_samples++;
        HD_TRY(end_early(run));
        run->agenda.interval_end = hd_run_time(run);
    } else if (averaging && !run->known && is_needed(run, HD_NEEDS_VECTORS)) {
        HD_TRY(measure(run, false));
    }
    return run->known ? hd_gather(&run->gathered, &run->carrier, first) : HD_OK;
}

hd_status hd_run_measure(hd_run *run, int first)
{
    HD_ASSERT(first >= 0 && first <= run->carrier.vectors);
    hd_order_tell(run->communicator, (hd_order){.kind = HD_ORDER_MEASURE, .integer = first});
    if (run->status == HD_OK) run->status = measure_now(run, first);
    return run->status;
}

static hd_status average_now(hd_run *run)
{
    if (run->carrier.frame) hd_blas_use_threads(run->carrier.threads);
    if (run->carrier.frame) HD_TRY(orthonormalise(run, true));
    enter_stage(run, HD_AVERAGING);
    forget_vectors(run);
    return HD_OK;
}

hd_status hd_run_reset_average(hd_run *run)
{
    hd_order_tell(run->communicator, (hd_order){.kind = HD_ORDER_RESET});
    if (run->status == HD_OK && is_averaging(run)) run->status = average_now(run);
    return run->status;
}

hd_status hd_run_average_now(hd_run *run)
{
    if (run->status == HD_OK) run->status = average_now(run);
    return run->status;
}
