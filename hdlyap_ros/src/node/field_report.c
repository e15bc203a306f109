/** One vector, and the L and P modes of its step -> ModeField. */
#include "field_report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "hdlyap/pmode.h"

enum { PAIRS_MAX = HD_MODULATIONS_MAX };

/** Reconstructed modes of one step, pair by pair; arrays [pairs][2N]: x0 y0 x1 y1 .. */
typedef struct pair_fields {
    uint32_t count;
    uint8_t modulation[PAIRS_MAX];
    double residual_l[PAIRS_MAX], residual_p[PAIRS_MAX];
    double rotation_distance;
    double *l, *p, *ratio;
} pair_fields;

struct field_report {
    const publishers *to;
    const field_choice *choice;
    size_t disks;
    pair_fields pairs;
    double *block; /**< of the arrays of pairs */
};

bool field_report_create(field_report **out, const publishers *to, const settings *set)
{
    field_report *r = *out = calloc(1, sizeof *r);
    if (!r) return false;
    r->to = to;
    r->choice = &set->fields;
    r->disks = (size_t)set->def.disks;
    const size_t length = PAIRS_MAX * 2 * r->disks;
    double *a = r->block = malloc(3 * length * sizeof *a);
    if (a) {
        r->pairs.l = a;
        r->pairs.p = a + length;
        r->pairs.ratio = a + 2 * length;
        return true;
    }
    field_report_free(r);
    *out = NULL;
    return false;
}

void field_report_free(field_report *r)
{
    if (!r) return;
    free(r->block);
    free(r);
}

double field_report_size(const field_report *r) { return (double)r->disks * (8 + 6 * PAIRS_MAX); }

/** Fills the pairs of a step; none if it has no vectors of its own. */
static void reconstruct(field_report *r, const hd_step *step, const snapshot *now)
{
    pair_fields *pairs = &r->pairs;
    const hd_modes *modes = hd_run_modes(now->run);
    *pairs = (pair_fields){.l = pairs->l, .p = pairs->p, .ratio = pairs->ratio};
    if (!step || step->kind != HD_MODE_LP) return;
    hd_pmode *pmode = hd_run_pmode(now->run);
    if (!hd_pmode_reconstruct(pmode, step, modes, hd_run_frame_columns(now->run))) return;
    const int d = hd_pmode_pairs(pmode);
    const hd_subspace *subspace = hd_fields_subspace(hd_modes_fields(modes), step->subspace);
    pairs->count = (uint32_t)d;
    pairs->rotation_distance = hd_pmode_rotation_distance(pmode);
    for (int c = 0; c < d; c++) {
        const size_t length = 2 * r->disks, at = (size_t)c * length;
        pairs->modulation[c] = subspace->modulations.bits[c];
        pairs->residual_l[c] = hd_pmode_residual(pmode, c);
        pairs->residual_p[c] = hd_pmode_residual(pmode, c + d);
        memcpy(pairs->l + at, hd_pmode_field(pmode, c), length * sizeof *pairs->l);
        memcpy(pairs->p + at, hd_pmode_field(pmode, c + d), length * sizeof *pairs->p);
        hd_pmode_divide(pmode, pairs->ratio + at, c + d, now->p);
    }
}

/** Component 0 .. 3 of a vector of the frame. */
static hdr_doubles column_of(hd_columns frame, int col, int component, size_t disks)
{
    const size_t stride = (size_t)frame.stride;
    return message_array(frame.data + (size_t)component * stride + (col - frame.first), disks,
                         4 * stride);
}

static void fill_vector(hdr_mode_field *message, const hd_run *run, int col, size_t disks)
{
    const hd_columns frame = hd_run_frame_columns(run);
    message->index = (uint32_t)col + 1;
    message->exponent = hd_spectrum_exponent(hd_run_spectrum(run), col);
    message->dqx = column_of(frame, col, 0, disks);
    message->dqy = column_of(frame, col, 1, disks);
    message->dpx = column_of(frame, col, 2, disks);
    message->dpy = column_of(frame, col, 3, disks);
}

static void fill_step(hdr_mode_field *message, const hd_step *step)
{
    message->wave_number = NAN;
    if (!step) return;
    message->kind = (uint8_t)step->kind;
    message->nx = (uint32_t)step->wave.n[0];
    message->ny = (uint32_t)step->wave.n[1];
    message->wave_number = step->wave.number;
}

static void fill_state(hdr_mode_field *message, const snapshot *now, size_t disks)
{
    message->x = message_array(now->q, disks, 2);
    message->y = message_array(now->q + 1, disks, 2);
    message->px = message_array(now->p, disks, 2);
    message->py = message_array(now->p + 1, disks, 2);
}

static void fill_pairs(hdr_mode_field *message, const pair_fields *pairs, size_t disks)
{
    const size_t count = pairs->count * disks;
    message->pairs = pairs->count;
    message->modulation = (hdr_bytes){.data = pairs->modulation, .count = pairs->count};
    message->residual_l = message_array(pairs->residual_l, pairs->count, 1);
    message->residual_p = message_array(pairs->residual_p, pairs->count, 1);
    message->rotation_distance = pairs->count ? pairs->rotation_distance : NAN;
    message->l_x = message_array(pairs->l, count, 2);
    message->l_y = message_array(pairs->l + 1, count, 2);
    message->p_x = message_array(pairs->p, count, 2);
    message->p_y = message_array(pairs->p + 1, count, 2);
    message->p_over_px = message_array(pairs->ratio, count, 2);
    message->p_over_py = message_array(pairs->ratio + 1, count, 2);
}

static bool is_finite(const hdr_mode_field *v)
{
    const hdr_doubles arrays[] = {v->x,   v->y,   v->px,         v->py,         v->dqx, v->dqy,
                                  v->dpx, v->dpy, v->residual_l, v->residual_p, v->l_x, v->l_y,
                                  v->p_x, v->p_y, v->p_over_px,  v->p_over_py};
    double sum = v->exponent + (v->pairs ? v->rotation_distance : 0.0);
    for (size_t a = 0; a < sizeof arrays / sizeof *arrays; a++)
        for (size_t k = 0; k < arrays[a].count; k++) sum += arrays[a].data[k * arrays[a].stride];
    return isfinite(sum); /* what is not finite stays so in a sum */
}

static hd_status publish_vector(field_report *r, const snapshot *now, int col)
{
    const hd_steps *steps = hd_run_steps(now->run);
    const int s = hd_steps_of_vector(steps, col);
    const hd_step *step = s < 0 ? NULL : hd_steps_step(steps, s);
    hdr_mode_field message = {
        .header = message_header(),
        .run_id = r->to->run_id,
        .sim_time = hd_run_time(now->run),
    };
    reconstruct(r, step, now);
    fill_vector(&message, now->run, col, r->disks);
    fill_step(&message, step);
    fill_state(&message, now, r->disks);
    fill_pairs(&message, &r->pairs, r->disks);
    if (!is_finite(&message)) return HD_NOT_FINITE;
    return publishers_sent(hdr_mode_field_publish(r->to->publisher[TOPIC_FIELDS], &message),
                           TOPIC_FIELDS);
}

/** Found in the positive half; of steps that share a set the first. */
static bool has_example(const hd_steps *steps, int s)
{
    const hd_step *step = hd_steps_step(steps, s);
    if (!step->resolved || step->conjugate || step->kind == HD_MODE_ZERO) return false;
    for (int k = 0; k < s; k++) {
        const hd_step *before = hd_steps_step(steps, k);
        if (before->resolved && before->set == step->set) return false;
    }
    return true;
}

int field_report_example(const hd_steps *steps, int s)
{
    const hd_step *step = hd_steps_step(steps, s);
    for (int col = step->col; col < step->col + step->count; col++)
        if (hd_steps_of_vector(steps, col) == s) return col;
    return step->col;
}

static hd_status publish_examples(field_report *r, const snapshot *now)
{
    const hd_steps *steps = hd_run_steps(now->run);
    hd_status status = HD_OK;
    for (int s = 0; s < hd_steps_count(steps) && status == HD_OK; s++)
        if (has_example(steps, s)) status = publish_vector(r, now, field_report_example(steps, s));
    return status;
}

hd_status field_report_publish(field_report *r, const snapshot *now)
{
    hd_status status = HD_OK;
    if (r->choice->count == 0) return publish_examples(r, now);
    for (int k = 0; k < r->choice->count && status == HD_OK; k++)
        status = publish_vector(r, now, r->choice->index[k] - 1);
    return status;
}
