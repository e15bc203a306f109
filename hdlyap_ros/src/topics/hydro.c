/** Hydrodynamic response of the vectors -> message Hydro. */
#include "hdlyap/hydro.h"
#include "topics/moment.h"

static hdr_hydro_mode mode_of(const hd_hydro_response *response, const hd_steps *steps)
{
    const hd_step *step = hd_steps_step(steps, response->step);
    return (hdr_hydro_mode){
        .step = (uint32_t)response->step,
        .index = (uint32_t)(response->col + 1),
        .kind = (uint8_t)step->kind,
        NODES(step->wave),
        .modulation = response->modulation,
        .density = response->density,
        .along = response->along,
        .across = response->across,
        .across_second = response->across_second,
        .energy = response->energy,
    };
}

hd_status topic_publish_hydro(const moment *now)
{
    const hd_parts parts = hd_run_parts(now->run);
    const hd_hydro *hydro = parts.hydro;
    const uint32_t count = (uint32_t)hd_hydro_count(hydro);
    hdr_hydro_mode *out = moment_take(now, count, sizeof *out);
    if (!out) return HD_OK;
    for (uint32_t k = 0; k < count; k++) out[k] = mode_of(hd_hydro_at(hydro, (int)k), parts.steps);
    hdr_hydro message = {.sim_time = hd_run_time(now->run), .responses = {out, count}};
    return topic_send_hydro(now->out, &message);
}
