/** Widths of the vectors -> Localization. */
#include "localization_report.h"

#include <stdlib.h>

struct localization_report {
    const publishers *to;
    uint32_t vectors;
    double *std_errors, *widths_now; /**< in one block at std_errors; [vectors] each */
};

bool localization_report_create(localization_report **out, const publishers *to, const hd_run *run)
{
    localization_report *r = *out = calloc(1, sizeof *r);
    if (!r) return false;
    r->to = to;
    r->vectors = (uint32_t)hd_run_vectors(run);
    r->std_errors = malloc(2 * (size_t)r->vectors * sizeof *r->std_errors);
    if (r->std_errors) {
        r->widths_now = r->std_errors + r->vectors;
        return true;
    }
    localization_report_free(r);
    *out = NULL;
    return false;
}

void localization_report_free(localization_report *r)
{
    if (!r) return;
    free(r->std_errors);
    free(r);
}

double localization_report_size(const localization_report *r) { return 3.0 * r->vectors; }

static void gather(localization_report *r, const hd_localization *shape)
{
    for (uint32_t k = 0; k < r->vectors; k++) {
        const double error = hd_localization_width_error(shape, (int)k);
        r->std_errors[k] = error < 0.0 ? -1.0 : error;
        r->widths_now[k] = hd_localization_width_now(shape, (int)k);
    }
}

hd_status localization_report_publish(localization_report *r, const hd_run *run)
{
    hd_localization *shape = hd_run_localization(run);
    const uint32_t n = r->vectors;
    if (hd_localization_samples(shape) == 0) return HD_OK;
    gather(r, shape);
    const hdr_localization message = {
        .header = message_header(),
        .run_id = r->to->run_id,
        .sim_time = hd_run_time(run),
        .samples = (uint32_t)hd_localization_samples(shape),
        .first_index = 1,
        .widths = message_array(hd_localization_widths(shape), n, 1),
        .std_errors = message_array(r->std_errors, n, 1),
        .widths_now = message_array(r->widths_now, n, 1),
    };
    if (!message_finite(message.widths.data, n) || !message_finite(r->std_errors, 2 * (size_t)n))
        return HD_NOT_FINITE;
    return publishers_sent(hdr_localization_publish(r->to->publisher[TOPIC_LOCALIZATION], &message),
                           TOPIC_LOCALIZATION);
}
