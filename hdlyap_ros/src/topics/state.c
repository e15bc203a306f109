/** Positions and momenta of all particles -> message State. */
#include "topics/moment.h"

hd_status topic_publish_state(const moment *now)
{
    const size_t particles = (size_t)now->set->def.number;
    const double *q, *p;
    if (!moment_state(now, &q, &p)) return HD_OK;
    hdr_state message = {
        .sim_time = hd_run_time(now->run),
        .kinetic_energy = hd_trajectory_examined(hd_run_parts(now->run).trajectory).kinetic_energy,
        STATE_FIELDS(now, q, p, particles),
    };
    return topic_send_state(now->out, &message);
}
