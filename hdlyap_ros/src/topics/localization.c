/** Localisation widths of the vectors -> message Localization. */
#include "topics/moment.h"

hd_status topic_publish_localization(const moment *now)
{
    hd_localization *shape = hd_run_parts(now->run).localization;
    const size_t n = (size_t)hd_run_vectors(now->run);
    if (hd_localization_samples(shape) == 0) return HD_OK;
    double *std_errors = moment_take(now, 2 * n, sizeof *std_errors);
    if (!std_errors) return HD_OK;
    double *widths_now = std_errors + n;
    for (size_t k = 0; k < n; k++) {
        std_errors[k] = hd_localization_width_error(shape, (int)k);
        widths_now[k] = hd_localization_width_now(shape, (int)k);
    }
    hdr_localization message = {
        .sim_time = hd_run_time(now->run),
        .samples = (uint32_t)hd_localization_samples(shape),
        .first_index = 1,
        .widths = message_array(hd_localization_widths(shape), n, 1),
        .std_errors = message_array(std_errors, n, 1),
        .widths_now = message_array(widths_now, n, 1),
    };
    return topic_send_localization(now->out, &message);
}
