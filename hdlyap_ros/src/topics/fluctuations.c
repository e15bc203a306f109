/** Fluctuations of growth: diffusion of exponents, alone and in pairs, and the order of growth over
 * finite times -> message Fluctuations. */
#include "topics/moment.h"

#include <math.h>

#include "hdlyap/fluctuations.h"

/** The arrays of a message, and what they are filled from. */
typedef struct arrays {
    const hd_fluctuations *f;
    /** Number of vectors; number of lengths of time that this message tells. */
    int vectors, times;
    /** The steps whose columns are compared. */
    hd_step_columns of;
    double *diffusions, *errors;             /**< [vectors] each */
    double *covariances, *covariance_errors; /**< [steps^2] each */
    double *variances, *reversals;           /**< [times][vectors], [times][steps^2] */
    hdr_growth_order order[HD_TIMES_MAX];
    hdr_fluctuation_step step[HD_FLUCTUATING];
    uint32_t index[HD_FLUCTUATING]; /**< Lyapunov indices of the columns of all steps, one step
                                       after the other */
} arrays;

static size_t pairs(const arrays *a) { return (size_t)a->of.count * (size_t)a->of.count; }

/** Number of lengths of time, of which at least two stretches have passed; 0 unless fields are due,
 * as the message has these arrays only then. */
static int times_of(const moment *now, const hd_fluctuations *f)
{
    int times = hd_run_fields_due(now->run) ? hd_fluctuations_times(f) : 0;
    while (times > 0 && hd_fluctuations_order(f, times - 1).count < 2) times--;
    return times;
}

/** Takes memory for the arrays; false if there is none. */
static bool arrays_take(arrays *a, const moment *now)
{
    const size_t n = (size_t)a->vectors, s = pairs(a), times = (size_t)a->times;
    double *x = moment_take(now, 2 * n + 2 * s, sizeof *x);
    double *y = moment_take(now, times * (n + s), sizeof *y);
    if (!x || !y) return false;
    a->diffusions = x;
    a->errors = x + n;
    a->covariances = x + 2 * n;
    a->covariance_errors = x + 2 * n + s;
    a->variances = y;
    a->reversals = y + times * n;
    return true;
}

/** Unknown values are sent as NaN. */
static void put(double *value, double *error, hd_diffusion d)
{
    *value = d.error < 0 ? NAN : d.value;
    *error = d.error;
}

static void gather_limits(arrays *a)
{
    const int count = a->of.count;
    for (int col = 0; col < a->vectors; col++)
        put(&a->diffusions[col], &a->errors[col], hd_fluctuations_diffusion(a->f, col));
    for (int k = 0; k < count * count; k++)
        put(&a->covariances[k], &a->covariance_errors[k],
            hd_fluctuations_covariance(a->f, &a->of, k / count, k % count));
}

static void gather_times(arrays *a)
{
    const int count = a->of.count;
    for (int k = 0; k < a->times; k++) {
        a->order[k] = growth_order(hd_fluctuations_order(a->f, k), (size_t)a->vectors);
        for (int col = 0; col < a->vectors; col++)
            a->variances[k * a->vectors + col] = hd_fluctuations_variance(a->f, k, col);
        for (int p = 0; p < count * count; p++)
            a->reversals[k * count * count + p] = hd_fluctuations_reversed(a->f, k, &a->of,
                                                                           p / count, p % count);
    }
}

static void gather_steps(arrays *a, const hd_steps *steps)
{
    uint32_t *index = a->index;
    for (int k = 0; k < a->of.count; k++) {
        const hd_step *step = hd_steps_step(steps, a->of.step[k]);
        a->step[k] = (hdr_fluctuation_step){.kind = (uint8_t)step->kind,
                                            NODES(step->wave),
                                            .indices = {index, (uint32_t)a->of.columns[k]}};
        for (int i = 0; i < a->of.columns[k]; i++) *index++ = (uint32_t)a->of.own[k][i] + 1;
    }
}

hd_status topic_publish_fluctuations(const moment *now)
{
    const hd_parts parts = hd_run_parts(now->run);
    arrays a = {.f = parts.fluctuations, .vectors = hd_run_vectors(now->run)};
    if (hd_fluctuations_times(a.f) == 0) return HD_OK;
    a.times = times_of(now, a.f);
    if (parts.steps) a.of = hd_fluctuations_steps(a.f, parts.steps);
    if (!arrays_take(&a, now)) return HD_OK;
    gather_limits(&a);
    gather_times(&a);
    if (parts.steps) gather_steps(&a, parts.steps);
    const size_t n = (size_t)a.vectors, times = (size_t)a.times;
    hdr_fluctuations message = {
        .sim_time = hd_run_time(now->run),
        .averaged_time = hd_spectrum_time(parts.spectrum),
        .first_index = 1,
        .diffusions = message_array(a.diffusions, n, 1),
        .std_errors = message_array(a.errors, n, 1),
        .steps = {a.step, (uint32_t)a.of.count},
        .covariances = message_array(a.covariances, pairs(&a), 1),
        .covariance_errors = message_array(a.covariance_errors, pairs(&a), 1),
        .orders = {a.order, (uint32_t)a.times},
        .variances = message_array(a.variances, times * n, 1),
        .reversals = message_array(a.reversals, times * pairs(&a), 1),
    };
    return topic_send_fluctuations(now->out, &message);
}
