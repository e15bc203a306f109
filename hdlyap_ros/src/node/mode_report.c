/** Modes, steps, phases and responses of the core -> messages, element by element. */
#include "mode_report.h"

#include <math.h>
#include <stdlib.h>

#include "hdlyap/hydro.h"

_Static_assert((int)HD_MODE_LP == (int)HDR_MODE_LP, "kinds as in the core");
_Static_assert((int)HD_PHASE_TRACKED == (int)HDR_LP_PHASE_TRACKED, "states as in the core");

struct mode_report {
    const publishers *to;
    uint32_t vectors, steps, phases, t_phases, responses; /**< lengths of the arrays below */
    hdr_mode *mode;
    hdr_step *step;
    hdr_lp_phase *phase;
    hdr_t_phase *t_phase;
    hdr_hydro_mode *response;
};

static bool arrays_create(mode_report *m)
{
    m->mode = malloc((m->vectors + 1) * sizeof *m->mode);
    m->step = malloc((m->steps + 1) * sizeof *m->step);
    m->phase = malloc((m->phases + 1) * sizeof *m->phase);
    m->t_phase = malloc((m->t_phases + 1) * sizeof *m->t_phase);
    m->response = malloc((m->responses + 1) * sizeof *m->response);
    return m->mode && m->step && m->phase && m->t_phase && m->response;
}

static bool parts_create(mode_report *m, const hd_run *run)
{
    const hd_steps *steps = hd_run_steps(run);
    const hd_phases *phases = hd_run_phases(run), *of_t = hd_run_t_phases(run);
    const hd_hydro *hydro = hd_run_hydro(run);
    m->vectors = (uint32_t)hd_run_vectors(run);
    m->steps = (uint32_t)hd_steps_count(steps);
    m->phases = phases ? (uint32_t)hd_phases_count(phases) : 0;
    m->t_phases = of_t ? (uint32_t)hd_phases_count(of_t) : 0;
    m->responses = hydro ? (uint32_t)hd_hydro_count(hydro) : 0;
    return arrays_create(m);
}

bool mode_report_create(mode_report **out, const publishers *to, const hd_run *run)
{
    mode_report *m = *out = calloc(1, sizeof *m);
    if (!m) return false;
    m->to = to;
    if (parts_create(m, run)) return true;
    mode_report_free(m);
    *out = NULL;
    return false;
}

void mode_report_free(mode_report *m)
{
    if (!m) return;
    free(m->mode);
    free(m->step);
    free(m->phase);
    free(m->t_phase);
    free(m->response);
    free(m);
}

void mode_report_sizes(const mode_report *m, double *doubles)
{
    doubles[TOPIC_MODES] = 11.0 * m->vectors;
    doubles[TOPIC_STEPS] = 15.0 * m->steps;
    doubles[TOPIC_LP_PHASES] = 10.0 * m->phases;
    doubles[TOPIC_T_PHASES] = 11.0 * m->t_phases;
    doubles[TOPIC_HYDRO] = 7.0 * m->responses;
}

/** An error that is not known has one value. */
static double error_of(double error) { return error < 0.0 ? -1.0 : error; }

/** Weights in the fields of its step. */
static void fill_kind(hdr_mode *mode, const hd_modes *modes, const hd_step *step)
{
    const int col = (int)mode->index - 1;
    mode->kind = (uint8_t)step->kind;
    mode->nx = (uint32_t)step->wave.n[0];
    mode->ny = (uint32_t)step->wave.n[1];
    mode->wave_number = step->wave.number;
    if (step->kind == HD_MODE_ZERO) {
        mode->weight = mode->null_x + mode->null_y + mode->null_p;
        mode->weight_now = 0.0;
        for (int k = 0; k < HD_NULLS; k++)
            mode->weight_now += hd_modes_null_snapshot(modes, k)[col];
        return;
    }
    mode->weight = hd_modes_average(modes, step->subspace, HD_WEIGHT)[col];
    mode->weight_now = hd_modes_snapshot(modes, step->subspace, HD_WEIGHT)[col];
    if (step->kind != HD_MODE_LP) return; /* the two are NaN */
    mode->weight_l = hd_modes_average(modes, step->subspace, HD_WEIGHT_L)[col];
    mode->weight_p = hd_modes_average(modes, step->subspace, HD_WEIGHT_P)[col];
}

/* What is not measured is NaN. What is, and is not finite, stays so in a sum: these return false
 * then. */

static bool weights_finite(const hdr_mode *mode)
{
    const double of_any = mode->exponent + mode->null_x + mode->null_y + mode->null_p;
    const double of_step = mode->kind == HD_MODE_NONE ? 0.0 : mode->weight + mode->weight_now;
    const double of_lp = mode->kind == HD_MODE_LP ? mode->weight_l + mode->weight_p : 0.0;
    return isfinite(of_any + of_step + of_lp);
}

static bool fill_mode(hdr_mode *mode, const hd_run *run, int col)
{
    const hd_modes *modes = hd_run_modes(run);
    const int s = hd_steps_of_vector(hd_run_steps(run), col);
    *mode = (hdr_mode){
        .index = (uint32_t)col + 1,
        .wave_number = NAN,
        .weight = NAN,
        .weight_l = NAN,
        .weight_p = NAN,
        .weight_now = NAN,
        .exponent = hd_spectrum_exponent(hd_run_spectrum(run), col),
        .null_x = hd_modes_null_average(modes, HD_NULL_X)[col],
        .null_y = hd_modes_null_average(modes, HD_NULL_Y)[col],
        .null_p = hd_modes_null_average(modes, HD_NULL_P)[col],
        .step = s,
    };
    if (s >= 0) fill_kind(mode, modes, hd_steps_step(hd_run_steps(run), s));
    return weights_finite(mode);
}

/** NULL: no phases are followed. */
static bool fill_rate(hdr_step *out, const hd_phases *phases, int step)
{
    double omega, error;
    if (!phases || !out->resolved || !hd_phases_rate(phases, step, &omega, &error)) return true;
    out->omega = omega;
    out->omega_error = error_of(error);
    return isfinite(omega + error);
}

static bool fill_step(hdr_step *out, const hd_steps *steps, const hd_step *step)
{
    *out = (hdr_step){
        .kind = (uint8_t)step->kind,
        .nx = (uint32_t)step->wave.n[0],
        .ny = (uint32_t)step->wave.n[1],
        .wave_number = step->wave.number,
        .conjugate = step->conjugate,
        .resolved = step->resolved,
        .expected = (uint32_t)step->expected,
        .multiplicity = NAN,
        .set = -1,
        .exponent = NAN,
        .std_error = -1.0,
        .scatter = NAN,
        .set_time = NAN,
        .own_part = NAN,
        .gap = NAN,
        .gap_error = -1.0,
        .omega = NAN,
        .omega_error = -1.0,
    };
    if (!step->resolved) return true;
    out->first_index = (uint32_t)step->col + 1;
    out->last_index = (uint32_t)(step->col + step->count);
    out->multiplicity = step->multiplicity;
    out->set = step->set;
    out->members = (uint32_t)step->members;
    out->exponent = step->exponent;
    out->std_error = error_of(step->std_error);
    out->sharing = (uint8_t)step->sharing;
    if (step->kind != HD_MODE_ZERO) out->scatter = hd_steps_scatter(steps, step);
    out->set_time = step->set_time;
    out->own_part = step->own_part;
    if (step->sharing != HD_SHARING_ALONE) {
        out->gap = step->gap;
        out->gap_error = error_of(step->gap_error);
    }
    return isfinite(step->multiplicity + step->exponent + step->std_error + step->own_part +
                    step->gap + step->gap_error);
}

/** What is not known of a phase is NaN, of an error -1. */
static hd_phase said_of(const hd_phase *phase)
{
    const bool resolved = phase->state != HD_PHASE_UNRESOLVED, begun = phase->time > 0;
    hd_phase out = *phase;
    if (!resolved) out.col = -1;
    if (!resolved) out.a = out.b = NAN;
    if (!resolved || (!begun && phase->state != HD_PHASE_TRACKED)) out.phase = NAN;
    if (!resolved || !begun) out.omega = NAN;
    out.omega_error = resolved ? error_of(phase->omega_error) : -1.0;
    out.time = resolved ? phase->time : 0.0;
    return out;
}

static bool phase_finite(const hd_phase *phase)
{
    return phase->state == HD_PHASE_UNRESOLVED ||
           isfinite(phase->a + phase->b + phase->phase + phase->omega + phase->omega_error +
                    phase->time);
}

static bool fill_phase(hdr_lp_phase *out, const hd_phase *phase, const hd_steps *steps)
{
    const hd_step *step = hd_steps_step(steps, phase->step);
    const hd_phase said = said_of(phase);
    *out = (hdr_lp_phase){
        .step = (uint32_t)phase->step,
        .nx = (uint32_t)step->wave.n[0],
        .ny = (uint32_t)step->wave.n[1],
        .modulation = phase->modulation,
        .index = (uint32_t)(said.col + 1),
        .state = (uint8_t)phase->state,
        .a = said.a,
        .b = said.b,
        .phase = said.phase,
        .omega = said.omega,
        .omega_error = said.omega_error,
        .velocity = fabs(said.omega) / step->wave.number,
        .tracked_time = said.time,
    };
    return phase_finite(phase);
}

static bool fill_t_phase(hdr_t_phase *out, const hd_phases *phases, int index,
                         const hd_steps *steps)
{
    const hd_phase *phase = hd_phases_phase(phases, index), said = said_of(phase);
    const hd_step *step = hd_steps_step(steps, phase->step);
    double error;
    const double diffusion = hd_phases_diffusion(phases, index, &error);
    *out = (hdr_t_phase){
        .step = (uint32_t)phase->step,
        .nx = (uint32_t)step->wave.n[0],
        .ny = (uint32_t)step->wave.n[1],
        .modulation = phase->modulation,
        .index = (uint32_t)(said.col + 1),
        .state = (uint8_t)phase->state,
        .a = said.a,
        .b = said.b,
        .phase = said.phase,
        .omega = said.omega,
        .omega_error = said.omega_error,
        .diffusion = error < 0.0 ? NAN : diffusion,
        .diffusion_error = error_of(error),
        .tracked_time = said.time,
    };
    return phase_finite(phase) && isfinite(diffusion + error);
}

static bool fill_response(hdr_hydro_mode *out, const hd_hydro_response *response,
                          const hd_steps *steps)
{
    const hd_step *step = hd_steps_step(steps, response->step);
    *out = (hdr_hydro_mode){
        .step = (uint32_t)response->step,
        .index = (uint32_t)(response->col + 1),
        .kind = (uint8_t)step->kind,
        .nx = (uint32_t)step->wave.n[0],
        .ny = (uint32_t)step->wave.n[1],
        .modulation = response->modulation,
        .density = response->density,
        .along = response->along,
        .across = response->across,
        .energy = response->energy,
    };
    if (response->col < 0) out->density = out->along = out->across = out->energy = NAN;
    return response->col < 0 || isfinite(out->density + out->along + out->across + out->energy);
}

static bool is_finite(const hd_dispersion *fit)
{
    return isfinite(fit->c.value + fit->c.error + fit->c2.value + fit->c2.error + fit->c3.value +
                    fit->c3.error + fit->misfit);
}

static hd_status publish_modes(mode_report *m, const snapshot *now)
{
    const hd_run *run = now->run;
    const hdr_modes message = {
        .header = message_header(),
        .run_id = m->to->run_id,
        .sim_time = hd_run_time(run),
        .averaged_time = hd_spectrum_time(hd_run_spectrum(run)),
        .samples = (uint32_t)hd_modes_samples(hd_run_modes(run)),
        .modes = {m->mode, m->vectors},
    };
    for (uint32_t k = 0; k < m->vectors; k++)
        if (!fill_mode(&m->mode[k], run, (int)k)) return HD_NOT_FINITE;
    return publishers_sent(hdr_modes_publish(m->to->publisher[TOPIC_MODES], &message), TOPIC_MODES);
}

/** What a fit says, NaN where there was none. */
static double fitted(double value, int points) { return points > 0 ? value : NAN; }

/** The fields of a coefficient, and of the fit of one kind. */
#define COEFFICIENT(name, d, c)                                                                    \
    .name = fitted(d.c.value, d.points), .name##_error = error_of(d.c.error)
#define FIT(x, d)                                                                                  \
    .x##_points = (uint32_t)d.points, .x##_k_min = fitted(d.k_min, d.points),                      \
    .x##_k_max = fitted(d.k_max, d.points), .x##_prior_share = d.prior_share,                      \
    .c_##x##_sampling_error = error_of(d.c_sampling_error), COEFFICIENT(c_##x, d, c),              \
    COEFFICIENT(c_##x##2, d, c2), COEFFICIENT(c_##x##3, d, c3), .x##_misfit = error_of(d.misfit),  \
    .x##_long_c2 = d.in_long_boxes->c2, .x##_long_c2_error = d.in_long_boxes->c2_error,            \
    .x##_long_c3 = d.in_long_boxes->c3, .x##_long_c3_error = d.in_long_boxes->c3_error,            \
    .x##_box_error = d.in_long_boxes->box_error

static bool fill_steps(mode_report *m, hdr_steps *message, const hd_run *run)
{
    const hd_steps *steps = hd_run_steps(run);
    const hd_phases *phases = hd_run_phases(run);
    const hd_velocity none = {.v_error = -1.0, .misfit = -1.0},
                      v = phases ? hd_phases_velocity(phases) : none;
    const hd_dispersion of_t = hd_steps_dispersion(steps, hd_run_spectrum(run), HD_MODE_T);
    const hd_dispersion of_l = hd_steps_dispersion(steps, hd_run_spectrum(run), HD_MODE_LP);
    *message = (hdr_steps){
        .header = message_header(),
        .run_id = m->to->run_id,
        .sim_time = hd_run_time(run),
        .averaged_time = hd_spectrum_time(hd_run_spectrum(run)),
        .threshold = hd_steps_threshold(),
        .steps = {m->step, m->steps},
        FIT(t, of_t),
        FIT(l, of_l),
        .v_phases = (uint32_t)v.phases,
        .v_k_min = fitted(v.k_min, v.phases),
        .v_k_max = fitted(v.k_max, v.phases),
        .v = fitted(v.v, v.phases),
        .v_error = v.phases >= 1 ? error_of(v.v_error) : -1.0,
        .v_misfit = error_of(v.misfit),
    };
    bool finite = isfinite(v.v + v.v_error + v.misfit) && is_finite(&of_t) && is_finite(&of_l);
    for (uint32_t k = 0; k < m->steps && finite; k++)
        finite = fill_step(&m->step[k], steps, hd_steps_step(steps, (int)k)) &&
                 fill_rate(&m->step[k], phases, (int)k);
    return finite;
}

static hd_status publish_steps(mode_report *m, const snapshot *now)
{
    hdr_steps message;
    if (!fill_steps(m, &message, now->run)) return HD_NOT_FINITE;
    return publishers_sent(hdr_steps_publish(m->to->publisher[TOPIC_STEPS], &message), TOPIC_STEPS);
}

/** Of the phases. */
static double time_of_phases(const hd_run *run)
{
    const double followed = hd_run_followed(run);
    return followed >= 0 ? followed : hd_run_time(run);
}

static hd_status publish_phases(mode_report *m, const snapshot *now)
{
    const hd_run *run = now->run;
    const hdr_lp_phases message = {
        .header = message_header(),
        .run_id = m->to->run_id,
        .sim_time = time_of_phases(run),
        .phases = {m->phase, m->phases},
    };
    for (uint32_t k = 0; k < m->phases; k++) {
        const hd_phase *phase = hd_phases_phase(hd_run_phases(run), (int)k);
        if (!fill_phase(&m->phase[k], phase, hd_run_steps(run))) return HD_NOT_FINITE;
    }
    return publishers_sent(hdr_lp_phases_publish(m->to->publisher[TOPIC_LP_PHASES], &message),
                           TOPIC_LP_PHASES);
}

static hd_status publish_t_phases(mode_report *m, const snapshot *now)
{
    const hd_run *run = now->run;
    const hd_steps *steps = hd_run_steps(run);
    const hdr_t_phases message = {
        .header = message_header(),
        .run_id = m->to->run_id,
        .sim_time = time_of_phases(run),
        .phases = {m->t_phase, m->t_phases},
    };
    for (uint32_t k = 0; k < m->t_phases; k++)
        if (!fill_t_phase(&m->t_phase[k], hd_run_t_phases(run), (int)k, steps))
            return HD_NOT_FINITE;
    return publishers_sent(hdr_t_phases_publish(m->to->publisher[TOPIC_T_PHASES], &message),
                           TOPIC_T_PHASES);
}

static hd_status publish_hydro(mode_report *m, const snapshot *now)
{
    const hd_steps *steps = hd_run_steps(now->run);
    const hdr_hydro message = {
        .header = message_header(),
        .run_id = m->to->run_id,
        .sim_time = hd_run_time(now->run),
        .responses = {m->response, m->responses},
    };
    for (uint32_t k = 0; k < m->responses; k++)
        if (!fill_response(&m->response[k], hd_hydro_at(hd_run_hydro(now->run), (int)k), steps))
            return HD_NOT_FINITE;
    return publishers_sent(hdr_hydro_publish(m->to->publisher[TOPIC_HYDRO], &message), TOPIC_HYDRO);
}

hd_status mode_report_publish(mode_report *m, const snapshot *now, unsigned set)
{
    hd_status status = HD_OK;
    if (set & topic_bit(TOPIC_MODES)) status = publish_modes(m, now);
    if (status == HD_OK && (set & topic_bit(TOPIC_STEPS))) status = publish_steps(m, now);
    if (status == HD_OK && (set & topic_bit(TOPIC_LP_PHASES))) status = publish_phases(m, now);
    if (status == HD_OK && (set & topic_bit(TOPIC_T_PHASES))) status = publish_t_phases(m, now);
    if (status == HD_OK && (set & topic_bit(TOPIC_HYDRO))) status = publish_hydro(m, now);
    return status;
}
