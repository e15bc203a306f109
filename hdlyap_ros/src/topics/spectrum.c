/** Exponents, their errors, and the halves of the vectors -> message Spectrum. */
#include "topics/moment.h"

hd_status topic_publish_spectrum(const moment *now)
{
    const hd_run *run = now->run;
    const hd_spectrum *spectrum = hd_run_parts(run).spectrum;
    const size_t n = (size_t)hd_run_vectors(run);
    if (!(hd_spectrum_time(spectrum) > 0.0)) return HD_OK;
    double *exponents = moment_take(now, 5 * n, sizeof *exponents);
    if (!exponents) return HD_OK;
    double *std_errors = exponents + n, *local_exponents = std_errors + n;
    double *cos_theta = local_exponents + n, *dp_dq_ratio = cos_theta + n;
    for (size_t k = 0; k < n; k++) {
        exponents[k] = hd_spectrum_exponent(spectrum, (int)k);
        std_errors[k] = hd_spectrum_std_error(spectrum, (int)k);
        local_exponents[k] = hd_spectrum_local(spectrum, (int)k);
    }
    hd_run_dq_dp(run, cos_theta, dp_dq_ratio);
    const hd_spectrum_sums sums = hd_spectrum_sum_up(spectrum);
    hdr_spectrum message = {
        .sim_time = hd_run_time(run),
        .averaged_time = hd_spectrum_time(spectrum),
        .collisions = hd_trajectory_totals(hd_run_parts(run).trajectory).collisions,
        .lambda_max = hd_spectrum_exponent(spectrum, 0),
        .lambda_max_error = hd_spectrum_std_error(spectrum, 0),
        .ks_entropy = sums.ks_entropy,
        .ks_entropy_error = sums.ks_entropy_error,
        .pairing_error = sums.pairing_error,
        .exponent_sum = sums.exponent_sum,
        .exponent_sum_error = sums.exponent_sum_error,
        .divergence = hd_run_divergence(run),
        .divergence_error = hd_run_divergence_error(run),
        .kaplan_yorke = sums.kaplan_yorke,
        .kaplan_yorke_error = sums.kaplan_yorke_error,
        .first_index = 1,
        .exponents = message_array(exponents, n, 1),
        .std_errors = message_array(std_errors, n, 1),
        .local_time = sums.local_time,
        .local_exponents = message_array(local_exponents, n, 1),
        .cos_theta = message_array(cos_theta, n, 1),
        .dp_dq_ratio = message_array(dp_dq_ratio, n, 1),
    };
    return topic_send_spectrum(now->out, &message);
}
