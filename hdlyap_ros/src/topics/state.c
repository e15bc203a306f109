/** Positions and momenta of all particles -> message State. */
#include "topics/moment.h"

hd_status topic_publish_state(const moment *now)
{
    const size_t particles = (size_t)now->set->def.number,
                 coordinates = (size_t)moment_coordinates(now);
    const double *q, *p; /* [particle][coordinates], momenta of turning, too */
    const bool others = moment_has_others(now);
    double twice = 0.0;
    if (!moment_state(now, &q, &p)) return HD_OK;
    for (size_t k = 0; k < particles * coordinates; k++) twice += p[k] * p[k];
    hdr_state message = {
        .sim_time = hd_run_time(now->run),
        .kinetic_energy = 0.5 * twice,
        STATE_FIELDS(now, q, particles),
        .q = message_array(q, others ? particles * coordinates : 0, 1),
        .p = message_array(p, others ? particles * coordinates : 0, 1),
    };
    return topic_send_state(now->out, &message);
}
