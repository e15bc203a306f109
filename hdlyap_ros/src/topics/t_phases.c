/** Phases of T steps, and how these diffuse -> message TPhases. */
#include "topics/moment.h"
#include "topics/phase.h"

static hdr_t_phase phase_of(const hd_phases *phases, int index, const hd_steps *steps)
{
    const hd_phase *phase = hd_phases_phase(phases, index);
    const hd_step *step = hd_steps_step(steps, phase->step);
    double error;
    const double diffusion = hd_phases_diffusion(phases, index, &error);
    return (hdr_t_phase){
        PHASE_FIELDS(phase, step),
        .diffusion = diffusion,
        .diffusion_error = error,
    };
}

hd_status topic_publish_t_phases(const moment *now)
{
    const hd_parts parts = hd_run_parts(now->run);
    const hd_phases *phases = parts.t_phases;
    const uint32_t count = (uint32_t)hd_phases_count(phases);
    hdr_t_phase *out = moment_take(now, count, sizeof *out);
    if (!out) return HD_OK;
    for (uint32_t k = 0; k < count; k++) {
        if (!phase_is_finite(hd_phases_phase(phases, (int)k))) return HD_NOT_FINITE;
        out[k] = phase_of(phases, (int)k, parts.steps);
    }
    hdr_t_phases message = {.sim_time = hd_run_time(now->run),
                            .sample_time = hd_run_phase_time(now->run),
                            .phases = {out, count}};
    return message.sample_time >= 0.0 ? topic_send_t_phases(now->out, &message) : HD_OK;
}
