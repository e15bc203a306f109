/** A run -> what can be read of it: its parts, what it has cost, how far it is. */
#include <float.h>
#include <math.h>

#include "base/clock.h"
#include "run/order.h"
#include "run/run_state.h"

bool hd_run_report_due(const hd_run *run) { return run->due.report; }
bool hd_run_fields_due(const hd_run *run) { return run->due.fields; }
hd_stage hd_run_stage(const hd_run *run) { return run->schedule.stage; }
double hd_run_time(const hd_run *run) { return hd_advance_now(&run->advance); }
const hd_scene_def *hd_run_scene(const hd_run *run) { return &run->scene; }
int hd_run_vectors(const hd_run *run) { return run->vectors; }
int hd_run_ranks(const hd_run *run) { return hd_communicator_ranks(run->communicator); }
int hd_run_threads(const hd_run *run) { return run->threads; }
int hd_run_threads_denied(const hd_run *run) { return run->threads_denied; }
const hd_trajectory *hd_run_trajectory(const hd_run *run) { return run->advance.trajectory; }
const hd_frame *hd_run_frame(const hd_run *run) { return run->frame; }
const hd_spectrum *hd_run_spectrum(const hd_run *run) { return run->spectrum; }
const hd_modes *hd_run_modes(const hd_run *run) { return run->observer.modes; }
const hd_steps *hd_run_steps(const hd_run *run) { return run->observer.steps; }
const hd_phases *hd_run_phases(const hd_run *run) { return run->observer.phases[HD_FOLLOWED_LP]; }
const hd_phases *hd_run_t_phases(const hd_run *run) { return run->observer.phases[HD_FOLLOWED_T]; }
const hd_structure *hd_run_structure(const hd_run *run) { return run->observer.structure; }
const hd_covariant *hd_run_covariant(const hd_run *run) { return run->windows.covariant; }
const hd_gas *hd_run_gas(const hd_run *run) { return run->gas; }
hd_localization *hd_run_localization(const hd_run *run) { return run->shape; }

double hd_run_followed(const hd_run *run) { return run->followed; }

hd_columns hd_run_columns(const hd_run *run)
{
    return run->communicator ? run->gathered : run->observer.known;
}

hd_columns hd_run_frame_columns(const hd_run *run)
{
    if (run->communicator) return run->gathered;
    const hd_columns carried = hd_frame_columns(run->frame);
    return run->conjugate ? hd_conjugate_complete(run->conjugate, carried) : carried;
}

void hd_run_fields_from(hd_run *run, int first)
{
    hd_order_tell(run->communicator, (hd_order){.kind = HD_ORDER_FIELDS_FROM, .integer = first});
    run->fields_first = first;
}

void hd_run_halves(const hd_run *run, double *cos_theta, double *dp_dq_ratio)
{
    for (int col = 0; col < run->vectors; col++) {
        const double cosine = run->halves[col], ratio = run->halves[run->vectors + col];
        cos_theta[col] = cosine == HD_NO_HALF ? NAN : cosine;
        dp_dq_ratio[col] = ratio == HD_NO_HALF ? NAN : ratio;
    }
}

double hd_run_smallest_error(const hd_run *run)
{
    return hd_spectrum_error_of_last(run->spectrum, SMALLEST_EXPONENTS);
}

/** With the sample that has begun. */
double hd_run_averaged(const hd_run *run)
{
    return hd_spectrum_time(run->spectrum) + hd_spectrum_sample_time(run->spectrum);
}

double hd_run_errors_after(const hd_run *run)
{
    return run->spectrum ? HD_SPECTRUM_BLOCKS_MIN * hd_run_block_least(run) : 0.0;
}

/** Simulated time until the target is reached, as errors fall with the root of the time; INFINITY
 * if it is none, or not yet known. */
static double target_left(const hd_run *run)
{
    if (run->scene.target_std_error == 0 || run->schedule.stage != HD_AVERAGING || !run->spectrum)
        return INFINITY;
    const double ratio = hd_run_smallest_error(run) / run->scene.target_std_error;
    return hd_spectrum_time(run->spectrum) * fmax(ratio * ratio - 1.0, 0.0);
}

/** Simulated time still to come; INFINITY for an endless run. */
static double time_left(const hd_run *run)
{
    const hd_scene_def *scene = &run->scene;
    const hd_stage stage = run->schedule.stage;
    if (stage == HD_FINISHED) return 0.0;
    double left = fmin(hd_schedule_stage_end(&run->schedule) - hd_run_time(run), target_left(run));
    if (stage == HD_EQUILIBRATING) left += scene->warmup;
    if (stage < HD_AVERAGING) left += scene->duration > 0 ? scene->duration : INFINITY;
    return left;
}

hd_cost hd_run_cost(const hd_run *run)
{
    hd_cost cost = run->cost;
    const double now = hd_clock_now(), left = time_left(run);
    cost.covariant = run->windows.seconds;
    const hd_traffic traffic = hd_communicator_traffic(run->communicator);
    cost.communication = traffic.seconds;
    cost.bytes = traffic.bytes;
    cost.calls = traffic.calls;
    cost.wall = now - run->clocks.created;
    const double averaged = run->schedule.stage >= HD_AVERAGING && run->spectrum
                                ? hd_run_averaged(run)
                                : 0.0;
    const double rounded = HD_ENLARGED * run->rounding.sum + cost.defect * cost.defect;
    cost.error_bound = averaged > 0 ? rounded / averaged : NAN;
    if (cost.orthonormalisations == 0) {
        cost.interval = cost.condition = cost.defect = NAN;
        cost.limit = HD_LIMIT_NONE;
    }
    const double error = run->spectrum ? hd_run_smallest_error(run) : INFINITY;
    cost.std_error = error < INFINITY ? error : -1.0;
    cost.events_per_second = cost.events > 0
                                 ? (double)hd_trajectory_collisions(run->advance.trajectory) /
                                       cost.events
                                 : NAN;
    cost.progress = left < INFINITY ? hd_run_time(run) / fmax(hd_run_time(run) + left, DBL_MIN)
                                    : -1.0;
    if (run->schedule.stage == HD_FINISHED) cost.progress = 1.0;
    const double carried =
        hd_run_time(run) -
        run->clocks.frame_start_time; /* equilibration is no measure of the rest */
    const bool known = left == 0 ||
                       (run->clocks.frame_started != 0 && carried > 0 && left < INFINITY);
    cost.remaining = !known      ? -1.0
                     : left == 0 ? 0.0
                                 : left * (now - run->clocks.frame_started) / carried;
    return cost;
}
