/** Steps of the spectrum, and the fits through them -> message Steps. */
#include "topics/moment.h"

#include <math.h>

_Static_assert((int)HD_MODE_LP == (int)HDR_STEP_LP &&
                   (int)HD_SHARING_COINCIDENT == (int)HDR_STEP_SHARING_COINCIDENT,
               "kinds and sharing as in the core");

static hdr_step step_of(const hd_steps *steps, int s)
{
    const hd_step *step = hd_steps_step(steps, s);
    hdr_step out = {
        .kind = (uint8_t)step->kind,
        NODES(step->wave),
        .wave_number = step->wave.number,
        .conjugate = step->conjugate,
        .resolved = step->resolved,
        .expected = (uint32_t)step->expected,
        .multiplicity = step->multiplicity,
        .set = step->set,
        .members = (uint32_t)step->members,
        .exponent = step->exponent,
        .std_error = step->std_error,
        .sharing = (uint8_t)step->sharing,
        .scatter = NAN,
        .set_time = step->set_time,
        .own_part = step->own_part,
        .gap = step->gap,
        .gap_error = step->gap_error,
        .omega = NAN,
        .omega_error = -1.0,
    };
    if (!step->resolved) return out;
    out.first_index = (uint32_t)step->col + 1;
    out.last_index = (uint32_t)(step->col + step->count);
    if (step->kind != HD_MODE_ZERO) out.scatter = hd_steps_scatter(steps, step);
    return out;
}

/** Fills the rate of a step's phases; phases is NULL if none are followed. Returns false if the
 * rate is not finite. */
static bool fill_rate(hdr_step *out, const hd_phases *phases, int step)
{
    double omega, error;
    if (!phases || !out->resolved || !hd_phases_rate(phases, step, &omega, &error)) return true;
    out->omega = omega;
    out->omega_error = error;
    return isfinite(omega);
}

/** The fields of a coefficient, and of the fit of one kind. */
#define COEFFICIENT(name, d, c) .name = d.c.value, .name##_error = d.c.error
#define FIT(x, d)                                                                                  \
    .x##_points = (uint32_t)d.points, .x##_k_min = d.k_min, .x##_k_max = d.k_max,                  \
    .x##_prior_share = d.prior_share, .c_##x##_sampling_error = d.c_sampling_error,                \
    COEFFICIENT(c_##x, d, c), COEFFICIENT(c_##x##2, d, c2), COEFFICIENT(c_##x##3, d, c3),          \
    .x##_misfit = d.misfit, .x##_long_c2 = d.in_long_boxes->c2,                                    \
    .x##_long_c2_error = d.in_long_boxes->c2_error, .x##_long_c3 = d.in_long_boxes->c3,            \
    .x##_long_c3_error = d.in_long_boxes->c3_error, .x##_box_error = d.in_long_boxes->box_error

hd_status topic_publish_steps(const moment *now)
{
    const hd_run *run = now->run;
    const hd_steps *steps = hd_run_parts(run).steps;
    const hd_phases *phases = hd_run_parts(run).phases;
    const hd_velocity none = {.v_error = -1.0, .v_sampling_error = -1.0, .misfit = -1.0},
                      v = phases ? hd_phases_velocity(phases) : none;
    const hd_dispersion of_t = hd_steps_dispersion(steps, hd_run_parts(run).spectrum, HD_MODE_T);
    const hd_dispersion of_l = hd_steps_dispersion(steps, hd_run_parts(run).spectrum, HD_MODE_LP);
    const uint32_t count = (uint32_t)hd_steps_count(steps);
    hdr_step *step = moment_take(now, count, sizeof *step);
    if (!step) return HD_OK;
    for (uint32_t k = 0; k < count; k++) {
        step[k] = step_of(steps, (int)k);
        if (!fill_rate(&step[k], phases, (int)k)) return HD_NOT_FINITE;
    }
    hdr_steps message = {
        .sim_time = hd_run_time(run),
        .averaged_time = hd_spectrum_time(hd_run_parts(run).spectrum),
        .threshold = HD_STEPS_THRESHOLD,
        .steps = {step, count},
        FIT(t, of_t),
        FIT(l, of_l),
        .v_phases = (uint32_t)v.phases,
        .v_k_min = v.k_min,
        .v_k_max = v.k_max,
        .v = v.v,
        .v_error = v.v_error,
        .v_sampling_error = v.v_sampling_error,
        .v_misfit = v.misfit,
    };
    return topic_send_steps(now->out, &message);
}
