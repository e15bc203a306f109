/** The run's numbers -> messages. Called by one thread at a time. */
#include "report.h"

#include <math.h>
#include <stdlib.h>

#include "clock.h"
#include "covariant_report.h"
#include "field_report.h"
#include "gas_report.h"
#include "localization_report.h"
#include "mode_report.h"
#include "publishers.h"
#include "run_info.h"
#include "slow_vectors_report.h"
#include "structure_report.h"
#include "subscriber_wait.h"

_Static_assert((int)HD_LIMIT_NONE == (int)HDR_COST_LIMIT_NONE, "limits as in the core");
_Static_assert((int)HD_FINISHED == (int)HDR_RUN_STATUS_FINISHED, "stages as in the core");

/** Topics whose messages are made of positions and momenta. */
static const unsigned of_state = 1u << TOPIC_STATE | 1u << TOPIC_FIELDS | 1u << TOPIC_HYDRO;

/** Arrays of a spectrum message, all of length n in one block. */
typedef struct spectrum_arrays {
    double *exponents, *std_errors, *local_exponents, *cos_theta, *dp_dq_ratio;
} spectrum_arrays;

struct report {
    const settings *set;
    publishers out;
    uint32_t n; /**< tangent vectors */
    uint32_t disks;
    spectrum_arrays spectrum; /**< in block; [n] each */
    double *q, *p;            /**< in block; [2N] each, x0 y0 x1 y1 .. */
    double *block;
    mode_report *modes;   /**< NULL unless some of its topics are asked for */
    field_report *fields; /**< NULL unless asked for, as the next */
    structure_report *structure;
    covariant_report *covariant;
    localization_report *localization;
    slow_vectors_report *slow;
    subscriber_wait awaited;
    unsigned demand; /**< set of topics that the step under way is made for */
    double seconds;  /**< spent here */
};

/** -1 while nobody looks at them. */
static int resolved_steps(const hd_run *run)
{
    const hd_modes *modes = hd_run_modes(run);
    const hd_steps *steps = hd_run_steps(run);
    int resolved = 0;
    if (!modes || hd_modes_samples(modes) == 0) return -1;
    for (int s = 0; s < hd_steps_count(steps); s++) resolved += hd_steps_step(steps, s)->resolved;
    return resolved;
}

progress progress_of(const hd_run *run)
{
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    return (progress){
        .stage = hd_run_stage(run),
        .time = hd_run_time(run),
        .collisions = hd_trajectory_collisions(hd_run_trajectory(run)),
        .cost = hd_run_cost(run),
        .averaged = spectrum ? hd_spectrum_time(spectrum) : 0.0,
        .resolved_steps = resolved_steps(run),
    };
}

static bool arrays_create(report *rep)
{
    const size_t n = rep->set->observables & topic_bit(TOPIC_SPECTRUM) ? rep->n : 0;
    const size_t disks = rep->set->observables & of_state ? rep->disks : 0;
    double *a = rep->block = malloc((5 * n + 4 * disks + 1) * sizeof *a);
    if (!a) return false;
    rep->spectrum = (spectrum_arrays){a, a + n, a + 2 * n, a + 3 * n, a + 4 * n};
    rep->q = a + 5 * n;
    rep->p = rep->q + 2 * disks;
    return true;
}

static bool parts_create(report *rep, const hd_run *run)
{
    const unsigned set = rep->set->observables;
    if (!arrays_create(rep)) return false;
    if ((set & TOPICS_OF_MODES) && !mode_report_create(&rep->modes, &rep->out, run)) return false;
    if ((set & topic_bit(TOPIC_FIELDS)) && !field_report_create(&rep->fields, &rep->out, rep->set))
        return false;
    if ((set & topic_bit(TOPIC_LOCALIZATION)) &&
        !localization_report_create(&rep->localization, &rep->out, run))
        return false;
    if ((set & topic_bit(TOPIC_STRUCTURE)) &&
        !structure_report_create(&rep->structure, &rep->out, run))
        return false;
    return !(set & topic_bit(TOPIC_COVARIANT)) ||
           covariant_report_create(&rep->covariant, &rep->out, run);
}

static hdr_status advertise(report *rep, hdr_node *ros)
{
    double doubles[TOPICS] = {[TOPIC_SPECTRUM] = 5.0 * rep->n,
                              [TOPIC_STATE] = 4.0 * rep->disks,
                              [TOPIC_GAS] = GAS_REPORT_SIZE};
    if (rep->modes) mode_report_sizes(rep->modes, doubles);
    if (rep->fields) doubles[TOPIC_FIELDS] = field_report_size(rep->fields);
    if (rep->structure) doubles[TOPIC_STRUCTURE] = structure_report_size(rep->structure);
    if (rep->covariant) doubles[TOPIC_COVARIANT] = covariant_report_size(rep->covariant);
    if (rep->localization)
        doubles[TOPIC_LOCALIZATION] = localization_report_size(rep->localization);
    return publishers_advertise(&rep->out, ros, rep->set->observables | TOPICS_ALWAYS, doubles,
                                rep->set->seed);
}

hdr_status report_create(report **out, hdr_node *ros, const settings *set, const hd_run *run)
{
    report *rep = *out = calloc(1, sizeof *rep);
    if (!rep) return HDR_NO_MEMORY;
    rep->set = set;
    rep->n = (uint32_t)hd_run_vectors(run);
    rep->disks = (uint32_t)set->def.disks;
    hdr_status status = parts_create(rep, run) ? advertise(rep, ros) : HDR_NO_MEMORY;
    if (status == HDR_OK) status = slow_vectors_report_create(&rep->slow, ros, &rep->out, set, run);
    if (status == HDR_OK) return HDR_OK;
    report_free(rep);
    *out = NULL;
    return status;
}

void report_free(report *rep)
{
    if (!rep) return;
    mode_report_free(rep->modes);
    field_report_free(rep->fields);
    structure_report_free(rep->structure);
    covariant_report_free(rep->covariant);
    localization_report_free(rep->localization);
    slow_vectors_report_free(rep->slow);
    free(rep->block);
    free(rep);
}

const char *report_run_id(const report *rep) { return rep->out.run_id; }

hdr_lag report_lag(const report *rep) { return publishers_lag(&rep->out); }

bool report_awaited_here(report *rep)
{
    return subscriber_wait_over(&rep->awaited, &rep->out, rep->set->awaited);
}

/** The message of steps has the velocity of the LP phases in it, and slow vectors belong to steps.
 */
unsigned report_demand(report *rep)
{
    const unsigned set = rep->set->observables, phases = topic_bit(TOPIC_LP_PHASES) & set;
    rep->demand = publishers_subscribed(&rep->out);
    unsigned stages = topic_stages(rep->demand);
    if (rep->demand & topic_bit(TOPIC_STEPS)) stages |= topic_stages(phases);
    if (rep->set->table > 0.0) stages |= topic_stages((topic_bit(TOPIC_STEPS) & set) | phases);
    if (rep->modes && slow_vectors_report_watched(rep->slow))
        stages |= topic_stages(topic_bit(TOPIC_STEPS));
    return stages;
}

void report_demand_slow(report *rep, hd_run *run) { slow_vectors_report_demand(rep->slow, run); }

hd_status report_slow(report *rep, const hd_run *run, bool at_rest)
{
    const double start = clock_seconds();
    const hd_status status = at_rest ? slow_vectors_report_rest(rep->slow, run)
                                     : slow_vectors_report_publish(rep->slow, run);
    rep->seconds += clock_seconds() - start;
    return status;
}

hdr_status report_run_info(report *rep, const hd_run *run, const changes *all)
{
    return run_info_publish(&rep->out, rep->set, run, all);
}

static void spectrum_gather(report *rep, const hd_run *run)
{
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    const spectrum_arrays *a = &rep->spectrum;
    for (uint32_t k = 0; k < rep->n; k++) {
        a->exponents[k] = hd_spectrum_exponent(spectrum, (int)k);
        a->std_errors[k] = hd_spectrum_std_error(spectrum, (int)k);
        if (a->std_errors[k] < 0.0) a->std_errors[k] = -1.0;
        a->local_exponents[k] = hd_spectrum_local(spectrum, (int)k);
    }
    hd_run_halves(run, a->cos_theta, a->dp_dq_ratio);
}

/** True if what must be measured is finite: not the halves of a vector, nor local exponents without
 * a sample. */
static bool spectrum_finite(const report *rep, const hd_spectrum *spectrum)
{
    const spectrum_arrays *a = &rep->spectrum;
    bool finite = message_finite(a->exponents, rep->n) && message_finite(a->std_errors, rep->n);
    for (uint32_t k = 0; k < rep->n; k++)
        finite &= !isinf(a->cos_theta[k]) && !isinf(a->dp_dq_ratio[k]);
    return finite &&
           (hd_spectrum_local_time(spectrum) == 0 || message_finite(a->local_exponents, rep->n));
}

static hd_status publish_spectrum(report *rep, const hd_run *run)
{
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    const spectrum_arrays *a = &rep->spectrum;
    const double pairing = hd_spectrum_pairing_error(spectrum);
    const double entropy_error = hd_spectrum_ks_entropy_error(spectrum);
    spectrum_gather(rep, run);
    const hdr_spectrum message = {
        .header = message_header(),
        .run_id = rep->out.run_id,
        .sim_time = hd_run_time(run),
        .averaged_time = hd_spectrum_time(spectrum),
        .collisions = hd_trajectory_collisions(hd_run_trajectory(run)),
        .lambda_max = hd_spectrum_lambda_max(spectrum),
        .ks_entropy = hd_spectrum_ks_entropy(spectrum),
        .ks_entropy_error = entropy_error < 0.0 ? -1.0 : entropy_error,
        .pairing_error = pairing < 0.0 ? -1.0 : pairing,
        .first_index = 1,
        .exponents = message_array(a->exponents, rep->n, 1),
        .std_errors = message_array(a->std_errors, rep->n, 1),
        .local_time = hd_spectrum_local_time(spectrum),
        .local_exponents = message_array(a->local_exponents, rep->n, 1),
        .cos_theta = message_array(a->cos_theta, rep->n, 1),
        .dp_dq_ratio = message_array(a->dp_dq_ratio, rep->n, 1),
    };
    const double scalars[] = {message.averaged_time, message.lambda_max, message.ks_entropy,
                              entropy_error, pairing};
    if (!message_finite(scalars, sizeof scalars / sizeof *scalars)) return HD_NOT_FINITE;
    if (!spectrum_finite(rep, spectrum)) return HD_NOT_FINITE;
    return publishers_sent(hdr_spectrum_publish(rep->out.publisher[TOPIC_SPECTRUM], &message),
                           TOPIC_SPECTRUM);
}

/** Of the positions and momenta in rep. */
static hd_status publish_state(report *rep, const hd_run *run)
{
    const hd_trajectory *trajectory = hd_run_trajectory(run);
    const hdr_state message = {
        .header = message_header(),
        .run_id = rep->out.run_id,
        .sim_time = hd_run_time(run),
        .kinetic_energy = hd_trajectory_kinetic_energy(trajectory),
        .x = message_array(rep->q, rep->disks, 2),
        .y = message_array(rep->q + 1, rep->disks, 2),
        .px = message_array(rep->p, rep->disks, 2),
        .py = message_array(rep->p + 1, rep->disks, 2),
    };
    if (!message_finite(rep->q, 4 * (size_t)rep->disks) || !isfinite(message.kinetic_energy))
        return HD_NOT_FINITE;
    return publishers_sent(hdr_state_publish(rep->out.publisher[TOPIC_STATE], &message),
                           TOPIC_STATE);
}

static hd_status publish_status(report *rep, const progress *now, hd_stage stage)
{
    const hd_cost *cost = &now->cost;
    const hdr_run_status message = {
        .header = message_header(),
        .run_id = rep->out.run_id,
        .sim_time = now->time,
        .stage = (uint8_t)stage,
        .progress = cost->progress < 0.0 ? -1.0 : cost->progress,
        .remaining_seconds = cost->remaining < 0.0 ? -1.0 : cost->remaining,
        .std_error = cost->std_error < 0.0 ? -1.0 : cost->std_error,
    };
    const double numbers[] = {now->time, cost->progress, cost->remaining, cost->std_error};
    if (!message_finite(numbers, sizeof numbers / sizeof *numbers)) return HD_NOT_FINITE;
    return publishers_sent(hdr_run_status_publish(rep->out.publisher[TOPIC_STATUS], &message),
                           TOPIC_STATUS);
}

static hd_status publish_cost(report *rep, const progress *now)
{
    const hd_cost *cost = &now->cost;
    const hdr_cost message = {
        .header = message_header(),
        .run_id = rep->out.run_id,
        .sim_time = now->time,
        .wall_seconds = cost->wall,
        .events_seconds = cost->events,
        .replay_seconds = cost->replay,
        .ortho_seconds = cost->ortho,
        .spectrum_seconds = cost->spectrum,
        .modes_seconds = cost->modes,
        .covariant_seconds = cost->covariant,
        .publish_seconds = rep->seconds,
        .events_per_second = cost->events_per_second,
        .interval = cost->interval,
        .interval_limit = (uint8_t)cost->limit,
        .condition = cost->condition,
        .orthogonality_defect = cost->defect,
        .error_bound = cost->error_bound,
        .orthonormalisations = (uint64_t)cost->orthonormalisations,
        .second_passes = (uint64_t)cost->second_passes,
        .slow_vector_samples = (uint64_t)cost->slow_vector_samples,
        .repairs = (uint64_t)cost->repairs,
        .communication_seconds = cost->communication,
        .communication_bytes = cost->bytes,
        .communication_calls = cost->calls,
    };
    const double numbers[] = {now->time,   cost->wall,     cost->events, cost->replay,
                              cost->ortho, cost->spectrum, cost->modes,  cost->covariant};
    const double measured[] = {cost->interval, cost->condition, cost->defect};
    if (!message_finite(numbers, sizeof numbers / sizeof *numbers)) return HD_NOT_FINITE;
    if (cost->orthonormalisations > 0 && !message_finite(measured, 3)) return HD_NOT_FINITE;
    if (isinf(cost->error_bound) || isinf(cost->events_per_second)) return HD_NOT_FINITE;
    return publishers_sent(hdr_cost_publish(rep->out.publisher[TOPIC_COST], &message), TOPIC_COST);
}

/** Cost, if anybody listens, and status. */
static hd_status publish_progress(report *rep, const progress *now, hd_stage stage)
{
    const bool heard = publishers_subscribed(&rep->out) & topic_bit(TOPIC_COST);
    hd_status status = heard ? publish_cost(rep, now) : HD_OK;
    if (status == HD_OK) status = publish_status(rep, now, stage);
    return status;
}

/** Topics that have something to say after this step and someone to listen. Vectors were
 * measured only if someone listened before. */
static unsigned topics_due(const report *rep, const hd_run *run)
{
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    const hd_modes *modes = hd_run_modes(run);
    const unsigned of_vectors = TOPICS_OF_MODES | topic_bit(TOPIC_LOCALIZATION);
    unsigned set = publishers_subscribed(&rep->out);
    if (!spectrum || !(hd_spectrum_time(spectrum) > 0.0)) set &= ~topic_bit(TOPIC_SPECTRUM);
    if (!modes || hd_modes_samples(modes) == 0) set &= ~(unsigned)TOPICS_OF_MODES;
    if (!hd_run_fields_due(run)) set &= ~topic_bit(TOPIC_FIELDS);
    return set & (rep->demand | ~of_vectors);
}

/** The last word about a run that has finished is left to report_finish. */
static hd_status publish_due(report *rep, const hd_run *run)
{
    const unsigned set = topics_due(rep, run);
    const snapshot now = {.run = run, .q = rep->q, .p = rep->p};
    hd_status status = HD_OK;
    if (set & of_state) hd_trajectory_state(hd_run_trajectory(run), rep->q, rep->p);
    if (set & topic_bit(TOPIC_STATE)) status = publish_state(rep, run);
    if (status == HD_OK && (set & topic_bit(TOPIC_SPECTRUM))) status = publish_spectrum(rep, run);
    if (status == HD_OK && (set & topic_bit(TOPIC_GAS)))
        status = gas_report_publish(&rep->out, run);
    if (status == HD_OK && (set & topic_bit(TOPIC_LOCALIZATION)))
        status = localization_report_publish(rep->localization, run);
    if (status == HD_OK && (set & TOPICS_OF_MODES))
        status = mode_report_publish(rep->modes, &now, set);
    if (status == HD_OK && (set & topic_bit(TOPIC_FIELDS)))
        status = field_report_publish(rep->fields, &now);
    if (status == HD_OK && (set & topic_bit(TOPIC_STRUCTURE)))
        status = structure_report_publish(rep->structure, &now);
    if (status != HD_OK || hd_run_stage(run) == HD_FINISHED) return status;
    const progress last = progress_of(run);
    return publish_progress(rep, &last, last.stage);
}

hd_status report_publish(report *rep, const hd_run *run)
{
    const double start = clock_seconds();
    const hd_status status = publish_due(rep, run);
    rep->seconds += clock_seconds() - start;
    return status;
}

hd_status report_window(report *rep, const hd_run *run)
{
    const double start = clock_seconds();
    const hd_status status = rep->covariant ? covariant_report_publish(rep->covariant, run) : HD_OK;
    rep->seconds += clock_seconds() - start;
    return status;
}

hd_status report_finish(report *rep, const progress *last)
{
    return publish_progress(rep, last, HD_FINISHED);
}
