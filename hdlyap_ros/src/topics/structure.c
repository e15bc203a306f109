/** Structure factors of the vectors -> message Structure. Rows lose their padding. */
#include "topics/moment.h"

#include <string.h>

static void gather_means(double *mean, const hd_structure *s, size_t waves, size_t vectors)
{
    for (hd_direction e = HD_ALONG; e < HD_DIRECTIONS; e++)
        for (size_t w = 0; w < waves; w++, mean += vectors)
            memcpy(mean, hd_structure_mean(s, (int)w, e), vectors * sizeof *mean);
}

static void gather_amplitudes(double *amplitude, const hd_structure *s, size_t vectors,
                              const size_t *modulations)
{
    for (hd_direction e = HD_ALONG; e < HD_DIRECTIONS; e++)
        for (unsigned bits = 0; bits < modulations[e]; bits++, amplitude += vectors)
            memcpy(amplitude, hd_structure_amplitude(s, e, bits), vectors * sizeof *amplitude);
}

static void gather_waves(double *number, uint32_t *nodes, const hd_structure *s, size_t waves)
{
    for (size_t w = 0; w < waves; w++) {
        const hd_wave *wave = hd_structure_wave(s, (int)w);
        for (size_t d = 0; d < HD_DIMENSION_MAX; d++) nodes[d * waves + w] = (uint32_t)wave->n[d];
        number[w] = wave->number;
    }
}

hd_status topic_publish_structure(const moment *now)
{
    const hd_structure *s = hd_run_parts(now->run).structure;
    const size_t waves = (size_t)hd_structure_waves(s), n = (size_t)hd_run_vectors(now->run);
    const int dimension = moment_dimension(now);
    const size_t modulations[HD_DIRECTIONS] = {(size_t)HD_MODULATIONS_IN(dimension),
                                               (size_t)HD_TRANSVERSE_IN(dimension)};
    const size_t along = modulations[HD_ALONG] * n, across = modulations[HD_ACROSS] * n;
    const size_t means = hd_run_fields_due(now->run) ? waves * n : 0;
    if (hd_structure_samples(s) == 0) return HD_OK;
    double *number = moment_take(now, waves, sizeof *number);
    double *mean = moment_take(now, 2 * means, sizeof *mean);
    double *amplitude = moment_take(now, along + across, sizeof *amplitude);
    uint32_t *nodes = moment_take(now, HD_DIMENSION_MAX * waves + n, sizeof *nodes);
    if (!number || !mean || !amplitude || !nodes) return HD_OK;
    uint32_t *peak = nodes + HD_DIMENSION_MAX * waves;
    gather_waves(number, nodes, s, waves);
    if (means > 0) gather_means(mean, s, waves, n);
    gather_amplitudes(amplitude, s, n, modulations);
    for (size_t col = 0; col < n; col++) peak[col] = (uint32_t)(hd_structure_peak(s, (int)col) + 1);
    hdr_structure message = {
        .sim_time = hd_run_time(now->run),
        .samples = (uint32_t)hd_structure_samples(s),
        .nx = {nodes, (uint32_t)waves},
        .ny = {nodes + waves, (uint32_t)waves},
        .nz = {nodes + 2 * waves, dimension > 2 ? (uint32_t)waves : 0},
        .wave_number = message_array(number, waves, 1),
        .along = message_array(mean, means, 1),
        .across = message_array(mean + means, means, 1),
        .peak = {peak, (uint32_t)n},
        .amplitude_along = message_array(amplitude, along, 1),
        .amplitude_across = message_array(amplitude + along, across, 1),
    };
    return topic_send_structure(now->out, &message);
}
