/** The state of particles and the vectors of the smallest positive exponents, after a step ->
 * message SlowVectors. */
#include "topics/slow_vectors.h"

#include <float.h>
#include <math.h>

#include "node/clock.h"

/** When the run comes to rest, a message at most this old is not sent again [s]. */
static const double rest_seconds = 1.0;
/** A message may be early by this part of the time between two. Steps are somewhat shorter than
 * that time, so otherwise only every other step would send one. On average there are no more
 * messages than slow_vectors_rate says. */
static const double early = 0.5;

/** The arrays of a message; [vectors] each unless another length is given. */
typedef struct vector_arrays {
    size_t directions, coordinates;    /**< dimension of space; coordinates of a particle */
    size_t pairs_most;                 /**< most pairs of a step */
    double *exponents, *a, *b;         /**< [vectors], [pairs_most * vectors] twice */
    uint32_t *nodes[HD_DIMENSION_MAX]; /**< nx, ny, .. */
    uint8_t *kind, *pairs;
    double *dq; /**< dqx of all vectors, then dqy and so on for each coordinate */
} vector_arrays;

/** Takes memory for `count` vectors, of which `known` have dq. Returns false if there is none. */
static bool arrays_take(vector_arrays *of, const moment *now, size_t count, size_t known)
{
    const size_t particles = (size_t)now->set->def.number;
    of->directions = (size_t)moment_dimension(now);
    of->coordinates = (size_t)moment_coordinates(now);
    of->pairs_most = (size_t)HD_MODULATIONS_IN(of->directions);
    of->exponents = moment_take(now, (1 + 2 * of->pairs_most) * count, sizeof *of->exponents);
    of->nodes[0] = moment_take(now, HD_DIMENSION_MAX * count, sizeof *of->nodes[0]);
    of->kind = moment_take(now, 2 * count, sizeof *of->kind);
    of->dq = moment_take(now, of->coordinates * particles * known, sizeof *of->dq);
    if (!of->exponents || !of->nodes[0] || !of->kind || !of->dq) return false;
    of->a = of->exponents + count;
    of->b = of->a + of->pairs_most * count;
    for (size_t d = 1; d < HD_DIMENSION_MAX; d++) of->nodes[d] = of->nodes[d - 1] + count;
    of->pairs = of->kind + count;
    return true;
}

/** The column after the last one with a positive exponent. */
static int end_of(const hd_run *run)
{
    const int positive = hd_scene_counts(hd_run_scene(run)).positive;
    const int vectors = hd_run_vectors(run);
    return vectors < positive ? vectors : positive;
}

/* ---- which vectors ------------------------------------------------------------------------- */

/** The column of the lowest step's example, for a kind; `end` if no step is resolved. */
static int lowest_of(const hd_steps *steps, hd_mode_kind kind, int end)
{
    const int lowest = hd_steps_lowest(steps, kind);
    return lowest < 0 ? end : hd_steps_example(steps, lowest);
}

/** The column of the first vector in a message; the end if there is none. */
static int first_of(const settings *set, const hd_run *run)
{
    const hd_steps *steps = hd_run_parts(run).steps;
    const int asked = set->slow_vectors_count, end = end_of(run);
    if (!steps || hd_run_stage(run) != HD_AVERAGING) return end;
    if (asked > 0) return asked < end ? end - asked : 0;
    const int t = lowest_of(steps, HD_MODE_T, end), lp = lowest_of(steps, HD_MODE_LP, end);
    return t < lp ? t : lp;
}

void slow_vectors_demand(slow_vectors_pace *pace, const publishers *out, const settings *set,
                         hd_run *run)
{
    const bool watched = publishers_subscribed(out) & topic_bit(TOPIC_slow_vectors);
    const bool averaging = hd_run_stage(run) == HD_AVERAGING;
    const double between = set->pace > 0.0 && averaging
                               ? fmax(set->pace / set->slow_vectors_rate, DBL_MIN)
                               : INFINITY;
    pace->due = watched && clock_seconds() >= pace->next - early / set->slow_vectors_rate;
    hd_run_watch(run, watched ? between : INFINITY);
}

int slow_vectors_first(const slow_vectors_pace *pace, const settings *set, const hd_run *run)
{
    const int end = end_of(run), first = pace->due ? first_of(set, run) : end;
    return first < end ? first : hd_run_vectors(run);
}

/** Whether the vectors from a column on are known. They are not where their sample has found a
 * lower step. */
static bool is_known(hd_columns known, int first, int end)
{
    return first < end && known.count > 0 && known.first <= first;
}

/* ---- the message --------------------------------------------------------------------------- */

static void fill_step(vector_arrays *of, int k, const hd_parts *parts, int col, bool known)
{
    const int s = hd_steps_of_vector(parts->steps, col);
    const hd_step *step = s < 0 ? NULL : hd_steps_step(parts->steps, s);
    const hd_modes *modes = parts->modes;
    double *a = of->a + of->pairs_most * (size_t)k, *b = of->b + of->pairs_most * (size_t)k;
    of->kind[k] = (uint8_t)(step ? step->kind : HD_MODE_NONE);
    for (int d = 0; d < HD_DIMENSION_MAX; d++)
        of->nodes[d][k] = step ? (uint32_t)step->wave.n[d] : 0;
    of->pairs[k] = 0;
    for (size_t c = 0; c < of->pairs_most; c++) a[c] = b[c] = 0.0;
    if (!known || !step || step->kind != HD_MODE_LP) return;
    const hd_subspace *subspace = hd_fields_subspace(hd_modes_fields(modes), step->subspace);
    const int pairs = subspace->dimension / 2;
    of->pairs[k] = (uint8_t)pairs;
    for (int c = 0; c < pairs; c++) {
        a[c] = hd_modes_coefficients(modes, subspace->column + c)[col];
        b[c] = hd_modes_coefficients(modes, subspace->column + pairs + c)[col];
    }
}

/** Copies dq from the rows of the frame to one array after the other for each vector. */
static void fill_dq(vector_arrays *of, hd_columns known, int first, size_t vectors,
                    size_t particles)
{
    const size_t stride = (size_t)known.stride, rows = 2 * of->coordinates;
    for (size_t j = 0; j < particles; j++) {
        const double *row = known.data + rows * j * stride + (size_t)(first - known.first);
        for (size_t d = 0; d < of->coordinates; d++)
            for (size_t k = 0; k < vectors; k++)
                of->dq[(d * vectors + k) * particles + j] = row[d * stride + k];
    }
}

/** Fills what the message says of vectors. Returns false if there is no memory. */
static bool fill_vectors(hdr_slow_vectors *message, const moment *now)
{
    const hd_run *run = now->run;
    const hd_parts parts = hd_run_parts(run);
    const hd_columns known = hd_run_vectors_now(run);
    const int first = first_of(now->set, run), end = end_of(run);
    const size_t particles = (size_t)now->set->def.number, count = (size_t)(end - first);
    const bool is_here = is_known(known, first, end);
    const size_t numbers = is_here ? particles * count : 0;
    vector_arrays of;
    if (!arrays_take(&of, now, count, is_here ? count : 0)) return false;
    for (int k = 0; k < end - first; k++) {
        of.exponents[k] = hd_spectrum_exponent(parts.spectrum, first + k);
        fill_step(&of, k, &parts, first + k, is_here);
    }
    if (is_here) fill_dq(&of, known, first, count, particles);
    message->first_index = (uint32_t)first + 1;
    message->vectors = (uint32_t)count;
    message->exponents = message_array(of.exponents, count, 1);
    message->kind = (hdr_bytes){of.kind, (uint32_t)count};
    message->nx = (hdr_uints){of.nodes[0], (uint32_t)count};
    message->ny = (hdr_uints){of.nodes[1], (uint32_t)count};
    if (of.directions > 2) message->nz = (hdr_uints){of.nodes[2], (uint32_t)count};
    message->pairs = (hdr_bytes){of.pairs, (uint32_t)count};
    message->a = message_array(of.a, of.pairs_most * count, 1);
    message->b = message_array(of.b, of.pairs_most * count, 1);
    message->dqx = message_array(of.dq, numbers, 1);
    message->dqy = message_array(of.dq + numbers, numbers, 1);
    hdr_doubles *const last = of.directions > 2 ? &message->dqz : &message->dq_angle;
    if (of.coordinates > 2) *last = message_array(of.dq + 2 * numbers, numbers, 1);
    return true;
}

static hd_status send(const moment *now)
{
    const size_t particles = (size_t)now->set->def.number;
    const double *q, *p;
    if (!moment_state(now, &q, &p)) return HD_OK;
    hdr_slow_vectors message = {.sim_time = hd_run_time(now->run), STATE_FIELDS(now, q, particles)};
    if (!fill_vectors(&message, now)) return HD_OK;
    return topic_send_slow_vectors(now->out, &message);
}

hd_status topic_publish_slow_vectors(const moment *now)
{
    slow_vectors_pace *pace = &now->kept->slow_vectors;
    const int end = end_of(now->run), first = pace->due ? first_of(now->set, now->run) : end;
    if (!pace->due || (first < end && !is_known(hd_run_vectors_now(now->run), first, end)))
        return HD_OK;
    pace->last = clock_seconds();
    pace->next = fmax(pace->next + 1.0 / now->set->slow_vectors_rate, pace->last);
    pace->sent = true;
    return send(now);
}

hd_status slow_vectors_rest(const moment *now)
{
    const slow_vectors_pace *pace = &now->kept->slow_vectors;
    return pace->sent && clock_seconds() - pace->last < rest_seconds ? HD_OK : send(now);
}
