/** Phases of LP steps -> message LpPhases. */
#include "topics/moment.h"
#include "topics/phase.h"

_Static_assert((int)HD_PHASE_TRACKED == (int)HDR_LP_PHASE_TRACKED, "states as in the core");

static hdr_lp_phase phase_of(const hd_phase *phase, const hd_step *step)
{
    return (hdr_lp_phase){
        PHASE_FIELDS(phase, step),
        .velocity = fabs(phase->omega) / step->wave.number,
    };
}

hd_status topic_publish_lp_phases(const moment *now)
{
    const hd_parts parts = hd_run_parts(now->run);
    const hd_phases *phases = parts.phases;
    const uint32_t count = (uint32_t)hd_phases_count(phases);
    hdr_lp_phase *out = moment_take(now, count, sizeof *out);
    if (!out) return HD_OK;
    for (uint32_t k = 0; k < count; k++) {
        const hd_phase *phase = hd_phases_phase(phases, (int)k);
        if (!phase_is_finite(phase)) return HD_NOT_FINITE;
        out[k] = phase_of(phase, hd_steps_step(parts.steps, phase->step));
    }
    hdr_lp_phases message = {.sim_time = hd_run_time(now->run),
                             .sample_time = hd_run_phase_time(now->run),
                             .phases = {out, count}};
    return message.sample_time >= 0.0 ? topic_send_lp_phases(now->out, &message) : HD_OK;
}
