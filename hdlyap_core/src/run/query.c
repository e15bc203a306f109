/** A run -> its parts, its cost and its progress. */
#include <float.h>
#include <math.h>

#include "base/clock.h"
#include "run/run.h"
#include "run/run_state.h"

bool hd_run_report_due(const hd_run *run) { return run->agenda.due & HD_DUE_REPORT; }
bool hd_run_fields_due(const hd_run *run) { return run->agenda.due & HD_DUE_FIELDS; }
hd_status hd_run_status(const hd_run *run) { return run->status; }
const char *hd_run_fault(const hd_run *run)
{
    const char *told = hd_trajectory_fault(run->advance.trajectory);
    if (run->status != HD_DYNAMICS_FAULT) return "";
    return *told ? told : "null_vectors: more vectors than zero_exponents";
}

hd_stage hd_run_stage(const hd_run *run) { return run->agenda.stage; }
const hd_scene_def *hd_run_scene(const hd_run *run) { return &run->scene; }
int hd_run_vectors(const hd_run *run) { return run->carrier.vectors; }
int hd_run_ranks(const hd_run *run) { return hd_communicator_ranks(run->communicator); }
int hd_run_threads(const hd_run *run) { return run->carrier.threads; }
int hd_run_threads_denied(const hd_run *run) { return run->carrier.threads_denied; }
const hd_frame *hd_run_frame(const hd_run *run) { return run->carrier.frame; }

hd_parts hd_run_parts(const hd_run *run)
{
    hd_windows *windows = hd_observables_part(&run->observables, HD_OBSERVED_covariant);
    hd_parts parts = {
        .trajectory = run->advance.trajectory,
        .spectrum = run->carrier.spectrum,
#define HD_OBSERVABLE(name, NAME, bit, of_waves, type)                                             \
    .name = hd_observables_part(&run->observables, HD_OBSERVED_##name),
#include "hdlyap/observables.inc"
    };
    /* that row's part is its windows */
    if (windows) parts.covariant = hd_windows_covariant(windows);
    return parts;
}

double hd_run_phase_time(const hd_run *run) { return run->followed; }

hd_columns hd_run_vectors_now(const hd_run *run)
{
    if (run->communicator) return run->gathered.columns;
    return run->known ? hd_carrier_vectors(&run->carrier) : (hd_columns){.count = 0};
}

void hd_run_dq_dp(const hd_run *run, double *cos_theta, double *dp_dq_ratio)
{
    hd_carrier_dq_dp(&run->carrier, cos_theta, dp_dq_ratio);
}

double hd_run_divergence(const hd_run *run) { return hd_carrier_divergence(&run->carrier); }
double hd_run_divergence_error(const hd_run *run)
{
    return hd_carrier_divergence_error(&run->carrier);
}

bool hd_run_is_caged(const hd_run *run)
{
    return hd_cages_hold(&run->cages, HD_SPECTRUM_BLOCKS_MIN * run->agenda.block);
}

double hd_run_shortest_duration(const hd_run *run)
{
    const hd_agenda *agenda = &run->agenda;
    return agenda->stage == HD_AVERAGING ? hd_run_change_time(run) - agenda->start : NAN;
}

/** Simulated time that is left; `target`: that to the target; INFINITY for an endless run. */
static double time_left(const hd_run *run, double target)
{
    const hd_scene_def *scene = &run->scene;
    const hd_stage stage = hd_run_stage(run);
    if (stage == HD_FINISHED) return 0.0;
    double left = fmin(hd_agenda_stage_end(&run->agenda) - hd_run_time(run), target);
    if (stage == HD_EQUILIBRATING) left += scene->warmup;
    if (stage < HD_AVERAGING) left += hd_agenda_averaging(scene->duration);
    return left;
}

static void add_progress(hd_cost *cost, const hd_run *run)
{
    const hd_clocks *clocks = &run->clocks;
    const double now = hd_clock_now(), left = time_left(run, cost->target.left),
                 time = hd_run_time(run);
    const double carried = time - clocks->frame_start_time; /* equilibration has another speed */
    const bool known = clocks->frame_started != 0 && carried > 0 && left < INFINITY;
    cost->wall = now - clocks->created;
    cost->progress = left < INFINITY ? time / fmax(time + left, DBL_MIN) : -1.0;
    if (hd_run_stage(run) == HD_FINISHED) cost->progress = 1.0;
    cost->remaining = known ? left * (now - clocks->frame_started) / carried : -1.0;
    if (left == 0) cost->remaining = 0.0;
}

static void add_trend(hd_cost *cost, const hd_run *run)
{
    hd_error_at since;
    const bool stalled = hd_error_trend_stalled(&run->errors, &since);
    cost->stalled_since = stalled ? since.time : -1.0;
    cost->stalled_error = stalled ? since.error : -1.0;
}

hd_cost hd_run_cost(const hd_run *run)
{
    hd_cost cost = run->cost;
    const hd_traffic traffic = hd_communicator_traffic(run->communicator);
    const double error = hd_carrier_smallest_error(&run->carrier);
    const double collisions = (double)hd_trajectory_totals(run->advance.trajectory).collisions;
    cost.target = hd_target_standing(run, &run->agenda.in_force.target);
    add_progress(&cost, run);
    add_trend(&cost, run);
    cost.communication += traffic.seconds;
    cost.bytes += traffic.bytes;
    cost.calls += traffic.calls;
    cost.error_bound = hd_run_stage(run) < HD_AVERAGING ? NAN
                                                        : hd_carrier_error_bound(&run->carrier);
    if (cost.orthonormalisations == 0) {
        cost.interval = cost.condition = cost.defect = NAN;
        cost.limit = HD_LIMIT_NONE;
    }
    cost.std_error = error < INFINITY ? error : -1.0;
    cost.events_per_second = cost.events > 0 ? collisions / cost.events : NAN;
    return cost;
}
