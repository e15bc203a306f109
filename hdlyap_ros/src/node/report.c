/** The run's numbers -> messages. Called by one thread at a time. */
#include "report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "clock.h"
#include "hdlyap/hdlyap.h"
#include "topic.h"

enum { QUEUE_MIN = 8, QUEUE_MAX = 1000 };
/** For each subscriber that is behind. */
static const double queue_bytes = 128e6;

/** The frame that positions are in. */
static const char *const frame_id = "box";

/** Arrays of a spectrum message, all of length n in one block. */
typedef struct spectrum_arrays {
    double *exponents, *std_errors, *local_exponents, *cos_theta, *dp_dq_ratio;
} spectrum_arrays;

struct report {
    const settings *set;
    char run_id[96];
    hdr_publisher *publisher[TOPICS]; /**< NULL if not asked for */
    uint32_t n;                       /**< tangent vectors */
    uint32_t disks;
    spectrum_arrays spectrum; /**< in block; [n] each */
    double *q, *p;            /**< in block; [2N] each, x0 y0 x1 y1 .. */
    double *block;
    double seconds; /**< spent here */
};

progress progress_of(const hd_run *run)
{
    return (progress){
        .phase = hd_run_phase(run),
        .time = hd_run_time(run),
        .collisions = hd_trajectory_collisions(hd_run_trajectory(run)),
        .cost = hd_run_cost(run),
    };
}

static hdr_header header_now(void)
{
    return (hdr_header){.stamp = hdr_time_now(), .frame_id = frame_id};
}

/** Start, process, seed: no two runs share all three. */
static void run_id_write(char *run_id, size_t size, const char *seed)
{
    struct timespec now;
    struct tm utc;
    char date[32];
    clock_gettime(CLOCK_REALTIME, &now);
    gmtime_r(&now.tv_sec, &utc);
    strftime(date, sizeof date, "%Y%m%dT%H%M%S", &utc);
    snprintf(run_id, size, "%s.%06ldZ-%ld-%s", date, now.tv_nsec / 1000, (long)getpid(), seed);
}

/** Messages of that many doubles that a queue may keep. */
static int queue_length(double doubles)
{
    const double messages = queue_bytes / (8.0 * doubles + 1000.0);
    return (int)fmax(QUEUE_MIN, fmin(QUEUE_MAX, messages));
}

static bool asked_for(const report *rep, topic t) { return rep->set->observables & topic_bit(t); }

static bool arrays_create(report *rep)
{
    const size_t n = asked_for(rep, TOPIC_SPECTRUM) ? rep->n : 0;
    const size_t disks = asked_for(rep, TOPIC_STATE) ? rep->disks : 0;
    double *a = rep->block = malloc((5 * n + 4 * disks + 1) * sizeof *a);
    if (!a) return false;
    rep->spectrum = (spectrum_arrays){a, a + n, a + 2 * n, a + 3 * n, a + 4 * n};
    rep->q = a + 5 * n;
    rep->p = rep->q + 2 * disks;
    return true;
}

static hdr_status advertise(report *rep, hdr_node *ros)
{
    hdr_publisher **to = rep->publisher;
    hdr_status status = hdr_run_info_advertise(&to[TOPIC_RUN_INFO], ros, "~run_info");
    if (status == HDR_OK)
        status = hdr_cost_advertise(&to[TOPIC_COST], ros, "~cost", queue_length(0));
    if (status == HDR_OK && asked_for(rep, TOPIC_SPECTRUM))
        status = hdr_spectrum_advertise(&to[TOPIC_SPECTRUM], ros, "~spectrum",
                                        queue_length(5.0 * rep->n));
    if (status == HDR_OK && asked_for(rep, TOPIC_STATE))
        status = hdr_state_advertise(&to[TOPIC_STATE], ros, "~state",
                                     queue_length(4.0 * rep->disks));
    return status;
}

bool report_create(report **out, hdr_node *ros, const settings *set, const hd_run *run,
                   char *message, size_t size)
{
    report *rep = *out = calloc(1, sizeof *rep);
    if (rep) {
        rep->set = set;
        rep->n = (uint32_t)hd_run_vectors(run);
        rep->disks = (uint32_t)set->def.disks;
        run_id_write(rep->run_id, sizeof rep->run_id, set->seed);
        if (arrays_create(rep) && advertise(rep, ros) == HDR_OK) return true;
    }
    snprintf(message, size, "topics: %s", rep && rep->block ? hdr_error_text() : "out of memory");
    report_free(rep);
    *out = NULL;
    return false;
}

void report_free(report *rep)
{
    if (!rep) return;
    free(rep->block);
    free(rep);
}

const char *report_run_id(const report *rep) { return rep->run_id; }

static bool has_subscriber(const report *rep, topic t)
{
    return rep->publisher[t] && hdr_publisher_subscribers(rep->publisher[t]) > 0;
}

bool report_awaited_here(const report *rep, unsigned awaited)
{
    for (topic t = 0; t < TOPICS; t++)
        if ((awaited & topic_bit(t)) && !has_subscriber(rep, t)) return false;
    return true;
}

static bool all_finite(const double *x, size_t count)
{
    for (size_t k = 0; k < count; k++)
        if (!isfinite(x[k])) return false;
    return true;
}

/** Messages that ROS refuses are lost with a line in the log; they do not end the run. */
static hd_status sent(hdr_status status, topic t)
{
    if (status != HDR_OK) hdr_log(HDR_ERROR, "%s not sent: %s", topic_name(t), hdr_error_text());
    return HD_OK;
}

static const char *boundary_name(hd_boundary boundary)
{
    return boundary == HD_PERIODIC ? "periodic" : "reflecting";
}

/** [count] names of a set of topics. */
static uint32_t names_of(const char *names[TOPICS], unsigned set)
{
    uint32_t count = 0;
    for (topic t = 0; t < TOPICS; t++)
        if (set & topic_bit(t)) names[count++] = topic_name(t);
    return count;
}

hdr_status report_run_info(report *rep, const hd_run *run)
{
    const settings *set = rep->set;
    const hd_scene_def *def = &set->def;
    const hd_blas blas = hd_blas_query();
    const char *names[TOPICS];
    double box[2];
    hd_scene_box(def, box);
    const hdr_run_info info = {
        .header = header_now(),
        .run_id = rep->run_id,
        .version = HDLYAP_VERSION,
        .scene = set->scene,
        .disks = rep->disks,
        .density = def->density,
        .aspect = def->aspect,
        .box_x = box[0],
        .box_y = box[1],
        .boundary_x = boundary_name(def->boundary[0]),
        .boundary_y = boundary_name(def->boundary[1]),
        .seed = set->seed,
        .exponents = set->exponents,
        .vectors = rep->n,
        .zero_exponents = (uint32_t)hd_scene_zero_exponents(def),
        .equilibration = def->equilibration,
        .warmup = def->warmup,
        .duration = def->duration,
        .target_std_error = def->target_std_error,
        .interval = def->interval,
        .accuracy = def->accuracy,
        .report_interval = def->report_interval,
        .observables = {.data = names, .count = names_of(names, set->observables)},
        .pace = set->pace,
        .threads = (uint32_t)hd_run_threads(run),
        .blas_threads = (uint32_t)blas.threads,
        .blas_library = blas.library,
        .blas_kernel = blas.kernel,
        .blas_threading = blas.threading,
    };
    return hdr_run_info_publish(rep->publisher[TOPIC_RUN_INFO], &info);
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
    hd_frame_halves(hd_run_frame(run), a->cos_theta, a->dp_dq_ratio);
}

static hdr_doubles array(const double *data, uint32_t count, uint32_t stride)
{
    return (hdr_doubles){.data = data, .count = count, .stride = stride};
}

static hd_status publish_spectrum(report *rep, const hd_run *run)
{
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    const spectrum_arrays *a = &rep->spectrum;
    const double pairing = hd_spectrum_pairing_error(spectrum);
    spectrum_gather(rep, run);
    const hdr_spectrum view = {
        .header = header_now(),
        .run_id = rep->run_id,
        .sim_time = hd_run_time(run),
        .averaged_time = hd_spectrum_time(spectrum),
        .collisions = hd_trajectory_collisions(hd_run_trajectory(run)),
        .lambda_max = hd_spectrum_lambda_max(spectrum),
        .ks_entropy = hd_spectrum_ks_entropy(spectrum),
        .pairing_error = pairing < 0.0 ? -1.0 : pairing,
        .first_index = 1,
        .exponents = array(a->exponents, rep->n, 1),
        .std_errors = array(a->std_errors, rep->n, 1),
        .local_exponents = array(a->local_exponents, rep->n, 1),
        .cos_theta = array(a->cos_theta, rep->n, 1),
        .dp_dq_ratio = array(a->dp_dq_ratio, rep->n, 1),
    };
    const double scalars[] = {view.averaged_time, view.lambda_max, view.ks_entropy, pairing};
    if (!all_finite(scalars, sizeof scalars / sizeof *scalars)) return HD_NOT_FINITE;
    if (!all_finite(a->exponents, 5 * (size_t)rep->n)) return HD_NOT_FINITE;
    return sent(hdr_spectrum_publish(rep->publisher[TOPIC_SPECTRUM], &view), TOPIC_SPECTRUM);
}

static hd_status publish_state(report *rep, const hd_run *run)
{
    const hd_trajectory *trajectory = hd_run_trajectory(run);
    hd_trajectory_state(trajectory, rep->q, rep->p);
    const hdr_state view = {
        .header = header_now(),
        .run_id = rep->run_id,
        .sim_time = hd_run_time(run),
        .kinetic_energy = hd_trajectory_kinetic_energy(trajectory),
        .x = array(rep->q, rep->disks, 2),
        .y = array(rep->q + 1, rep->disks, 2),
        .px = array(rep->p, rep->disks, 2),
        .py = array(rep->p + 1, rep->disks, 2),
    };
    if (!all_finite(rep->q, 4 * (size_t)rep->disks) || !isfinite(view.kinetic_energy))
        return HD_NOT_FINITE;
    return sent(hdr_state_publish(rep->publisher[TOPIC_STATE], &view), TOPIC_STATE);
}

static hd_status publish_cost(report *rep, const progress *now, hd_phase phase)
{
    const hd_cost *cost = &now->cost;
    const hdr_cost view = {
        .header = header_now(),
        .run_id = rep->run_id,
        .sim_time = now->time,
        .phase = (uint8_t)phase,
        .wall_seconds = cost->wall,
        .events_seconds = cost->events,
        .replay_seconds = cost->replay,
        .ortho_seconds = cost->ortho,
        .spectrum_seconds = cost->spectrum,
        .publish_seconds = rep->seconds,
        .events_per_second = cost->events_per_second,
        .interval = cost->interval,
        .condition = cost->condition,
        .orthogonality_defect = cost->defect,
        .error_bound = cost->error_bound,
        .orthonormalisations = (uint64_t)cost->orthonormalisations,
        .second_passes = (uint64_t)cost->second_passes,
        .repairs = (uint64_t)cost->repairs,
        .progress = cost->progress,
        .remaining_seconds = cost->remaining < 0.0 ? -1.0 : cost->remaining,
    };
    const double numbers[] = {
        cost->wall,      cost->events,      cost->replay,           cost->ortho, cost->spectrum,
        cost->interval,  cost->condition,   cost->defect,           now->time,   cost->progress,
        cost->remaining, cost->error_bound, cost->events_per_second};
    if (!all_finite(numbers, sizeof numbers / sizeof *numbers)) return HD_NOT_FINITE;
    return sent(hdr_cost_publish(rep->publisher[TOPIC_COST], &view), TOPIC_COST);
}

/** The cost of a finished run is left to report_finish: it is the last message. */
static hd_status publish_wanted(report *rep, const hd_run *run)
{
    const hd_spectrum *spectrum = hd_run_spectrum(run);
    const bool averaged = spectrum && hd_spectrum_time(spectrum) > 0.0;
    const bool finished = hd_run_phase(run) == HD_FINISHED;
    hd_status status = HD_OK;
    if (has_subscriber(rep, TOPIC_STATE)) status = publish_state(rep, run);
    if (status == HD_OK && averaged && has_subscriber(rep, TOPIC_SPECTRUM))
        status = publish_spectrum(rep, run);
    if (status == HD_OK && !finished && has_subscriber(rep, TOPIC_COST)) {
        const progress now = progress_of(run);
        status = publish_cost(rep, &now, now.phase);
    }
    return status;
}

hd_status report_publish(report *rep, const hd_run *run)
{
    const double start = clock_seconds();
    const hd_status status = publish_wanted(rep, run);
    rep->seconds += clock_seconds() - start;
    return status;
}

hd_status report_finish(report *rep, const progress *last)
{
    return publish_cost(rep, last, HD_FINISHED);
}
