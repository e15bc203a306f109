/** One vector, and the L and P modes of its step -> message ModeField. */
#include "topics/moment.h"

#include <string.h>

#include "hdlyap/pmode.h"

enum { PAIRS_MAX = HD_MODULATIONS_MAX };

/** Reconstructed modes of one step, pair by pair; arrays [pairs][coordinates N]: x0 y0 x1 y1 .. */
typedef struct pair_fields {
    uint32_t count;
    uint8_t modulation[PAIRS_MAX];
    double residual_l[PAIRS_MAX], residual_p[PAIRS_MAX];
    double rotation_distance;
    double *l, *p, *ratio;
} pair_fields;

static void reconstruct(pair_fields *pairs, const hd_run *run, const hd_step *step,
                        const double *momenta)
{
    const size_t length = (size_t)(hd_scene_coordinates(hd_run_scene(run)) *
                                   hd_run_scene(run)->number);
    const hd_modes *modes = hd_run_parts(run).modes;
    hd_pmode *pmode = hd_run_parts(run).fields;
    if (!hd_pmode_reconstruct(pmode, step, modes, hd_run_vectors_now(run))) return;
    const int d = hd_pmode_pairs(pmode);
    const hd_subspace *subspace = hd_fields_subspace(hd_modes_fields(modes), step->subspace);
    pairs->count = (uint32_t)d;
    pairs->rotation_distance = hd_pmode_rotation_distance(pmode);
    for (int c = 0; c < d; c++) {
        const size_t at = (size_t)c * length;
        pairs->modulation[c] = subspace->modulations.bits[c];
        pairs->residual_l[c] = hd_pmode_residual(pmode, c);
        pairs->residual_p[c] = hd_pmode_residual(pmode, c + d);
        memcpy(pairs->l + at, hd_pmode_field(pmode, c), length * sizeof *pairs->l);
        memcpy(pairs->p + at, hd_pmode_field(pmode, c + d), length * sizeof *pairs->p);
        hd_pmode_divide(pmode, pairs->ratio + at, c + d, momenta);
    }
}

/** One of the `components` of a vector of the frame, for all particles. */
static hdr_doubles column_of(hd_columns frame, int col, int component, int components,
                             size_t particles)
{
    const size_t stride = (size_t)frame.stride;
    return message_array(frame.data + (size_t)component * stride + (col - frame.first), particles,
                         (size_t)components * stride);
}

static void fill_vector(hdr_mode_field *message, const hd_run *run, int col, size_t particles)
{
    const hd_columns frame = hd_run_vectors_now(run);
    message->index = (uint32_t)col + 1;
    message->exponent = hd_spectrum_exponent(hd_run_parts(run).spectrum, col);
    const int coordinates = hd_scene_coordinates(hd_run_scene(run));
    const bool turns = hd_scene_inertia(hd_run_scene(run)) > 0; /* the last one is an angle */
    hdr_doubles *const dq[] = {&message->dqx, &message->dqy,
                               turns ? &message->dq_angle : &message->dqz};
    hdr_doubles *const dp[] = {&message->dpx, &message->dpy,
                               turns ? &message->dp_angle : &message->dpz};
    for (int d = 0; d < coordinates; d++) {
        *dq[d] = column_of(frame, col, d, 2 * coordinates, particles);
        *dp[d] = column_of(frame, col, coordinates + d, 2 * coordinates, particles);
    }
}

static void fill_step(hdr_mode_field *message, const hd_step *step)
{
    if (!step) return;
    message->kind = (uint8_t)step->kind;
    PUT_NODES(message, step->wave);
    message->wave_number = step->wave.number;
}

static void fill_pairs(hdr_mode_field *message, const moment *now, const pair_fields *pairs,
                       size_t particles)
{
    const size_t count = pairs->count * particles;
    message->pairs = pairs->count;
    message->modulation = (hdr_bytes){.data = pairs->modulation, .count = pairs->count};
    message->residual_l = message_array(pairs->residual_l, pairs->count, 1);
    message->residual_p = message_array(pairs->residual_p, pairs->count, 1);
    message->rotation_distance = pairs->rotation_distance;
    hdr_doubles *const l[] = {&message->l_x, &message->l_y, &message->l_z};
    hdr_doubles *const p[] = {&message->p_x, &message->p_y, &message->p_z};
    hdr_doubles *const ratio[] = {&message->p_over_px, &message->p_over_py, &message->p_over_pz};
    for (int d = 0; d < HD_DIMENSION_MAX; d++) {
        *l[d] = moment_component(now, pairs->l, count, d);
        *p[d] = moment_component(now, pairs->p, count, d);
        *ratio[d] = moment_component(now, pairs->ratio, count, d);
    }
}

static hd_status publish_vector(const moment *now, int col)
{
    const hd_steps *steps = hd_run_parts(now->run).steps;
    const int s = hd_steps_of_vector(steps, col);
    const hd_step *step = s < 0 ? NULL : hd_steps_step(steps, s);
    const size_t particles = (size_t)now->set->def.number;
    const size_t length = (size_t)(HD_MODULATIONS_IN(moment_dimension(now)) *
                                   moment_coordinates(now)) *
                          particles;
    const double *q, *p;
    now->room->taken = 0; /* each message uses the buffers anew */
    pair_fields pairs = {.l = moment_take(now, 3 * length, sizeof *pairs.l)};
    if (!pairs.l || !moment_state(now, &q, &p)) return HD_OK;
    hdr_mode_field message = {.sim_time = hd_run_time(now->run), STATE_FIELDS(now, q, particles)};
    pairs.p = pairs.l + length;
    pairs.ratio = pairs.p + length;
    if (step && step->kind == HD_MODE_LP) reconstruct(&pairs, now->run, step, p);
    fill_vector(&message, now->run, col, particles);
    fill_step(&message, step);
    fill_pairs(&message, now, &pairs, particles);
    return topic_send_fields(now->out, &message);
}

hd_status topic_publish_fields(const moment *now)
{
    const hd_steps *steps = hd_run_parts(now->run).steps;
    const field_choice *choice = &now->set->fields;
    hd_status status = HD_OK;
    if (!hd_run_fields_due(now->run) || hd_run_vectors_now(now->run).count == 0) return HD_OK;
    for (int k = 0; k < choice->count && status == HD_OK; k++)
        status = publish_vector(now, choice->index[k] - 1);
    for (int s = 0; choice->count == 0 && s < hd_steps_count(steps) && status == HD_OK; s++)
        if (hd_steps_is_shown(steps, s)) status = publish_vector(now, hd_steps_example(steps, s));
    return status;
}
