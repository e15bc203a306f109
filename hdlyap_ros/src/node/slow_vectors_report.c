/** The disks and the slowest vectors, at the time of a step -> SlowVectors. */
#include "slow_vectors_report.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "clock.h"
#include "field_report.h"

enum { PAIRS_MAX = HD_MODULATIONS_MAX };

/** A message this old is as good as new for a run that stands still [s]. */
static const double rest_seconds = 1.0;
/** Of the time between two messages, one may be so early: steps are somewhat shorter than that, and
 * every other one would be too early. On average there are no more than asked for. */
static const double early = 0.5;

/** What is said of each vector, [vectors] each unless said otherwise. */
typedef struct vector_arrays {
    double *exponents, *a, *b; /**< [vectors], [PAIRS_MAX * vectors] twice */
    uint32_t *nx, *ny;
    uint8_t *kind, *pairs;
    double *dq; /**< dqx of all vectors, then dqy; grows to room numbers */
    size_t room;
} vector_arrays;

struct slow_vectors_report {
    const publishers *to;
    const settings *set;
    hdr_publisher *publisher;
    int end;       /**< columns of positive exponent are before it */
    double *q, *p; /**< [2N] each, in one block at q */
    vector_arrays of;
    bool due;          /**< for the step under way */
    double next, last; /**< wall times of messages */
};

static bool arrays_create(slow_vectors_report *r)
{
    const size_t size = 2 * (size_t)r->set->def.disks, count = (size_t)r->end + 1;
    vector_arrays *of = &r->of;
    r->q = malloc(2 * size * sizeof *r->q);
    of->exponents = malloc((1 + 2 * PAIRS_MAX) * count * sizeof *of->exponents);
    of->nx = malloc(2 * count * sizeof *of->nx);
    of->kind = malloc(2 * count * sizeof *of->kind);
    if (!r->q || !of->exponents || !of->nx || !of->kind) return false;
    r->p = r->q + size;
    of->a = of->exponents + count;
    of->b = of->a + PAIRS_MAX * count;
    of->ny = of->nx + count;
    of->pairs = of->kind + count;
    return true;
}

static int positive_exponents(const hd_run *run)
{
    const int positive = hd_scene_positive_exponents(hd_run_scene(run));
    const int vectors = hd_run_vectors(run);
    return vectors < positive ? vectors : positive;
}

hdr_status slow_vectors_report_create(slow_vectors_report **out, hdr_node *ros,
                                      const publishers *to, const settings *set, const hd_run *run)
{
    slow_vectors_report *r = *out = calloc(1, sizeof *r);
    if (!r) return HDR_NO_MEMORY;
    r->to = to;
    r->set = set;
    r->end = positive_exponents(run);
    r->last = -HUGE_VAL;
    hdr_status status = arrays_create(r) ? HDR_OK : HDR_NO_MEMORY;
    if (status == HDR_OK)
        status = hdr_slow_vectors_advertise_latched(&r->publisher, ros, "~slow_vectors", 1);
    if (status == HDR_OK) return HDR_OK;
    slow_vectors_report_free(r);
    *out = NULL;
    return status;
}

void slow_vectors_report_free(slow_vectors_report *r)
{
    if (!r) return;
    free(r->q);
    free(r->of.exponents);
    free(r->of.nx);
    free(r->of.kind);
    free(r->of.dq);
    free(r);
}

bool slow_vectors_report_watched(const slow_vectors_report *r)
{
    return hdr_publisher_subscribers(r->publisher) > 0;
}

/* ---- which vectors ------------------------------------------------------------------------- */

/** Column that stands for the lowest step of a kind; `end` while none is found. */
static int lowest_of(const hd_steps *steps, hd_mode_kind kind, int end)
{
    int lowest = -1;
    for (int s = 0; s < hd_steps_count(steps); s++) {
        const hd_step *step = hd_steps_step(steps, s);
        if (step->kind != kind || !step->resolved || step->conjugate) continue;
        if (lowest < 0 || step->exponent < hd_steps_step(steps, lowest)->exponent) lowest = s;
    }
    return lowest < 0 ? end : field_report_example(steps, lowest);
}

/** Column of the first vector of a message; r->end if there is none. */
static int first_of(const slow_vectors_report *r, const hd_run *run)
{
    const hd_steps *steps = hd_run_steps(run);
    const int asked = r->set->slow_vectors_count;
    if (!steps || hd_run_stage(run) != HD_AVERAGING) return r->end;
    if (asked > 0) return asked < r->end ? r->end - asked : 0;
    const int t = lowest_of(steps, HD_MODE_T, r->end), lp = lowest_of(steps, HD_MODE_LP, r->end);
    return t < lp ? t : lp;
}

void slow_vectors_report_demand(slow_vectors_report *r, hd_run *run)
{
    const bool watched = slow_vectors_report_watched(r), paced = r->set->pace > 0.0;
    const bool averaging = hd_run_stage(run) == HD_AVERAGING;
    const double between = paced && averaging
                               ? fmax(r->set->pace / r->set->slow_vectors_rate, DBL_MIN)
                               : INFINITY;
    r->due = watched && clock_seconds() >= r->next - early / r->set->slow_vectors_rate;
    const int first = r->due ? first_of(r, run) : r->end;
    hd_run_watch(run, watched ? between : INFINITY, first < r->end ? first : hd_run_vectors(run));
}

/** True if the vectors from a column on are known: a step may end elsewhere. */
static bool is_known(const slow_vectors_report *r, hd_columns known, int first)
{
    return first < r->end && known.count > 0 && known.first <= first;
}

/* ---- the message --------------------------------------------------------------------------- */

static void fill_step(vector_arrays *of, int k, const hd_run *run, int col, bool known)
{
    const int s = hd_steps_of_vector(hd_run_steps(run), col);
    const hd_step *step = s < 0 ? NULL : hd_steps_step(hd_run_steps(run), s);
    const hd_modes *modes = hd_run_modes(run);
    of->kind[k] = (uint8_t)(step ? step->kind : HD_MODE_NONE);
    of->nx[k] = step ? (uint32_t)step->wave.n[0] : 0;
    of->ny[k] = step ? (uint32_t)step->wave.n[1] : 0;
    of->pairs[k] = 0;
    for (int c = 0; c < PAIRS_MAX; c++) of->a[PAIRS_MAX * k + c] = of->b[PAIRS_MAX * k + c] = 0.0;
    if (!known || !step || step->kind != HD_MODE_LP) return;
    const hd_subspace *subspace = hd_fields_subspace(hd_modes_fields(modes), step->subspace);
    const int pairs = subspace->dimension / 2;
    of->pairs[k] = (uint8_t)pairs;
    for (int c = 0; c < pairs; c++) {
        of->a[PAIRS_MAX * k + c] = hd_modes_coefficients(modes, subspace->column + c)[col];
        of->b[PAIRS_MAX * k + c] = hd_modes_coefficients(modes, subspace->column + pairs + c)[col];
    }
}

/** Room for the dq halves of so many vectors. */
static bool grow(vector_arrays *of, size_t disks, size_t vectors)
{
    if (2 * disks * vectors <= of->room) return true;
    double *dq = realloc(of->dq, 2 * disks * vectors * sizeof *dq);
    if (!dq) return false;
    of->dq = dq;
    of->room = 2 * disks * vectors;
    return true;
}

/** Row-major columns -> vector by vector. */
static void fill_dq(vector_arrays *of, hd_columns known, int first, size_t vectors, size_t disks)
{
    const size_t stride = (size_t)known.stride;
    for (size_t j = 0; j < disks; j++) {
        const double *row = known.data + 4 * j * stride + (size_t)(first - known.first);
        for (size_t k = 0; k < vectors; k++) {
            of->dq[k * disks + j] = row[k];
            of->dq[(vectors + k) * disks + j] = row[stride + k];
        }
    }
}

/** False without memory. */
static bool fill_vectors(hdr_slow_vectors *message, slow_vectors_report *r, const hd_run *run)
{
    vector_arrays *of = &r->of;
    const hd_columns known = hd_run_columns(run);
    const int first = first_of(r, run);
    const size_t disks = (size_t)r->set->def.disks, count = (size_t)(r->end - first);
    const bool is_here = is_known(r, known, first);
    if (is_here && !grow(of, disks, count)) return false;
    for (int k = 0; k < r->end - first; k++) {
        of->exponents[k] = hd_spectrum_exponent(hd_run_spectrum(run), first + k);
        fill_step(of, k, run, first + k, is_here);
    }
    if (is_here) fill_dq(of, known, first, count, disks);
    message->first_index = (uint32_t)first + 1;
    message->vectors = (uint32_t)count;
    message->exponents = message_array(of->exponents, count, 1);
    message->kind = (hdr_bytes){of->kind, (uint32_t)count};
    message->nx = (hdr_uints){of->nx, (uint32_t)count};
    message->ny = (hdr_uints){of->ny, (uint32_t)count};
    message->pairs = (hdr_bytes){of->pairs, (uint32_t)count};
    message->a = message_array(of->a, PAIRS_MAX * count, 1);
    message->b = message_array(of->b, PAIRS_MAX * count, 1);
    message->dqx = message_array(of->dq, is_here ? disks * count : 0, 1);
    message->dqy = message->dqx;
    if (is_here) message->dqy.data += disks * count;
    return true;
}

static bool is_finite(const slow_vectors_report *r, const hdr_slow_vectors *m)
{
    return message_finite(r->q, 4 * (size_t)r->set->def.disks) &&
           message_finite(m->exponents.data, m->exponents.count) &&
           message_finite(m->a.data, m->a.count) && message_finite(m->b.data, m->b.count) &&
           message_finite(m->dqx.data, m->dqx.count) && message_finite(m->dqy.data, m->dqy.count);
}

static hd_status publish(slow_vectors_report *r, const hd_run *run)
{
    const size_t disks = (size_t)r->set->def.disks;
    hdr_slow_vectors message = {
        .header = message_header(),
        .run_id = r->to->run_id,
        .sim_time = hd_run_time(run),
        .x = message_array(r->q, disks, 2),
        .y = message_array(r->q + 1, disks, 2),
        .px = message_array(r->p, disks, 2),
        .py = message_array(r->p + 1, disks, 2),
    };
    hd_trajectory_state(hd_run_trajectory(run), r->q, r->p);
    if (!fill_vectors(&message, r, run)) {
        hdr_log(HDR_ERROR, "slow_vectors not sent: out of memory");
        return HD_OK;
    }
    if (!is_finite(r, &message)) return HD_NOT_FINITE;
    if (hdr_slow_vectors_publish(r->publisher, &message) != HDR_OK)
        hdr_log(HDR_ERROR, "slow_vectors not sent: %s", hdr_error_text());
    return HD_OK;
}

hd_status slow_vectors_report_publish(slow_vectors_report *r, const hd_run *run)
{
    const int first = r->due ? first_of(r, run) : r->end;
    if (!r->due || (first < r->end && !is_known(r, hd_run_columns(run), first))) return HD_OK;
    const double now = clock_seconds();
    r->next = fmax(r->next + 1.0 / r->set->slow_vectors_rate, now);
    r->last = now;
    return publish(r, run);
}

hd_status slow_vectors_report_rest(slow_vectors_report *r, const hd_run *run)
{
    return clock_seconds() - r->last < rest_seconds ? HD_OK : publish(r, run);
}
