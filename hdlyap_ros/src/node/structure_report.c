/** Structure factors -> Structure: rows without what pads them. */
#include "structure_report.h"

#include <stdlib.h>
#include <string.h>

enum { MODULATIONS = HD_MODULATIONS_MAX };

struct structure_report {
    const publishers *to;
    size_t waves, vectors;
    uint32_t *nodes;             /**< nx [waves], ny [waves] */
    double *wave_number;         /**< [waves] */
    double *mean[HD_DIRECTIONS]; /**< [waves][vectors], in one block at the first */
    double *now[HD_DIRECTIONS];  /**< [MODULATIONS][vectors], likewise */
    uint32_t *peak;              /**< [vectors] */
};

static bool arrays_create(structure_report *r)
{
    const size_t means = r->waves * r->vectors, amplitudes = MODULATIONS * r->vectors;
    r->nodes = malloc((2 * r->waves + 1) * sizeof *r->nodes);
    r->wave_number = malloc((r->waves + 1) * sizeof *r->wave_number);
    r->mean[0] = malloc((2 * means + 1) * sizeof *r->mean[0]);
    r->now[0] = malloc((2 * amplitudes + 1) * sizeof *r->now[0]);
    r->peak = malloc((r->vectors + 1) * sizeof *r->peak);
    if (!r->nodes || !r->wave_number || !r->mean[0] || !r->now[0] || !r->peak) return false;
    r->mean[1] = r->mean[0] + means;
    r->now[1] = r->now[0] + amplitudes;
    return true;
}

bool structure_report_create(structure_report **out, const publishers *to, const hd_run *run)
{
    const hd_structure *s = hd_run_structure(run);
    structure_report *r = *out = calloc(1, sizeof *r);
    if (!r) return false;
    r->to = to;
    r->waves = (size_t)hd_structure_waves(s);
    r->vectors = (size_t)hd_structure_vectors(s);
    if (!arrays_create(r)) {
        structure_report_free(r);
        *out = NULL;
        return false;
    }
    for (size_t w = 0; w < r->waves; w++) {
        const hd_wave *wave = hd_structure_wave(s, (int)w);
        r->nodes[w] = (uint32_t)wave->n[0];
        r->nodes[r->waves + w] = (uint32_t)wave->n[1];
        r->wave_number[w] = wave->number;
    }
    return true;
}

void structure_report_free(structure_report *r)
{
    if (!r) return;
    free(r->nodes);
    free(r->wave_number);
    free(r->mean[0]);
    free(r->now[0]);
    free(r->peak);
    free(r);
}

double structure_report_size(const structure_report *r)
{
    return (double)((2 * r->waves + 9) * r->vectors + 2 * r->waves);
}

static void gather(structure_report *r, const hd_structure *s, bool means)
{
    const size_t size = r->vectors * sizeof(double);
    for (hd_direction e = HD_ALONG; e < HD_DIRECTIONS; e++) {
        for (size_t w = 0; w < r->waves && means; w++)
            memcpy(r->mean[e] + w * r->vectors, hd_structure_mean(s, (int)w, e), size);
        for (unsigned bits = 0; bits < MODULATIONS; bits++)
            memcpy(r->now[e] + bits * r->vectors, hd_structure_amplitude(s, e, bits), size);
    }
    for (size_t col = 0; col < r->vectors; col++)
        r->peak[col] = (uint32_t)(hd_structure_peak(s, (int)col) + 1);
}

hd_status structure_report_publish(structure_report *r, const snapshot *now)
{
    const hd_structure *s = hd_run_structure(now->run);
    const bool means = hd_run_fields_due(now->run);
    const size_t numbers = means ? r->waves * r->vectors : 0, n = r->vectors;
    const uint32_t waves = (uint32_t)r->waves;
    if (hd_structure_samples(s) == 0) return HD_OK;
    gather(r, s, means);
    const hdr_structure message = {
        .header = message_header(),
        .run_id = r->to->run_id,
        .sim_time = hd_run_time(now->run),
        .samples = (uint32_t)hd_structure_samples(s),
        .nx = {r->nodes, waves},
        .ny = {r->nodes + r->waves, waves},
        .wave_number = message_array(r->wave_number, r->waves, 1),
        .along = message_array(r->mean[HD_ALONG], numbers, 1),
        .across = message_array(r->mean[HD_ACROSS], numbers, 1),
        .peak = {r->peak, (uint32_t)n},
        .amplitude_along = message_array(r->now[HD_ALONG], MODULATIONS * n, 1),
        .amplitude_across = message_array(r->now[HD_ACROSS], MODULATIONS * n, 1),
    };
    if (!message_finite(r->mean[0], 2 * numbers) || !message_finite(r->now[0], 2 * MODULATIONS * n))
        return HD_NOT_FINITE;
    return publishers_sent(hdr_structure_publish(r->to->publisher[TOPIC_STRUCTURE], &message),
                           TOPIC_STRUCTURE);
}
