/** Fourth powers of momenta and of vectors -> message Momenta. */
#include "topics/moment.h"

hd_status topic_publish_momenta(const moment *now)
{
    enum { SAMPLES, PARTICLES, VECTORS, HEAD };
    const double *made = hd_run_parts(now->run).momenta;
    const size_t particles = (size_t)made[PARTICLES], n = (size_t)made[VECTORS];
    const size_t due = hd_run_fields_due(now->run) ? particles : 0;
    if (made[SAMPLES] == 0.0) return HD_OK;
    hdr_momenta message = {
        .sim_time = hd_run_time(now->run),
        .samples = (uint32_t)made[SAMPLES],
        .first_index = 1,
        .powers = message_array(made + HEAD + particles, n, 1),
        .momenta = message_array(made + HEAD, particles, 1),
        .momenta_now = message_array(made + HEAD + particles + n, due, 1),
    };
    return topic_send_momenta(now->out, &message);
}
