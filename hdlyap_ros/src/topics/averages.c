/** Means of what the row of the particles tells of their states -> message Averages. */
#include "topics/moment.h"

hd_status topic_publish_averages(const moment *now)
{
    const hd_averages *of = hd_run_parts(now->run).averages;
    const int count = hd_averages_count(of);
    hdr_average average[HD_AVERAGES_MAX];
    for (int k = 0; k < count; k++) {
        const hd_mean m = hd_averages_read(of, k);
        average[k] = (hdr_average){m.name, m.unit, m.mean, m.std_error};
    }
    hdr_averages message = {
        .sim_time = hd_run_time(now->run),
        .averaged_time = hd_averages_time(of),
        .averages = {average, (uint32_t)count},
    };
    return message.averaged_time > 0.0 ? topic_send_averages(now->out, &message) : HD_OK;
}
