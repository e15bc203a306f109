/** The step and the weights of each vector -> message Modes. */
#include "topics/moment.h"

#include <math.h>

_Static_assert((int)HD_MODE_LP == (int)HDR_MODE_LP, "kinds as in the core");

/** Fills the kind, the wave and the weights in the fields of a vector's step. */
static void fill_kind(hdr_mode *mode, const hd_modes *modes, const hd_step *step, int dimension)
{
    const int col = (int)mode->index - 1;
    mode->kind = (uint8_t)step->kind;
    PUT_NODES(mode, step->wave);
    mode->wave_number = step->wave.number;
    if (step->kind == HD_MODE_ZERO) {
        mode->weight = mode->null_x + mode->null_y + mode->null_z + mode->null_p;
        for (int k = 0; k <= dimension; k++)
            mode->weight_now += hd_modes_null_snapshot(modes, k)[col];
        return;
    }
    mode->weight = hd_modes_average(modes, step->subspace, HD_WEIGHT)[col];
    mode->weight_now = hd_modes_snapshot(modes, step->subspace, HD_WEIGHT)[col];
    if (step->kind != HD_MODE_LP) return;
    mode->weight_l = hd_modes_average(modes, step->subspace, HD_WEIGHT_L)[col];
    mode->weight_p = hd_modes_average(modes, step->subspace, HD_WEIGHT_P)[col];
}

static hdr_mode mode_of(const hd_parts *of, int col, int dimension)
{
    const hd_modes *modes = of->modes;
    const double *turning = hd_modes_share_average(modes, HD_SHARE_TURNING),
                 *second = hd_modes_share_average(modes, HD_SHARE_SECOND);
    const int s = hd_steps_of_vector(of->steps, col);
    hdr_mode mode = {
        .index = (uint32_t)col + 1,
        .exponent = hd_spectrum_exponent(of->spectrum, col),
        .null_x = hd_modes_null_average(modes, HD_NULL_X)[col],
        .null_y = hd_modes_null_average(modes, HD_NULL_Y)[col],
        .null_z = dimension > 2 ? hd_modes_null_average(modes, 2)[col] : 0.0,
        .null_p = hd_modes_null_average(modes, dimension)[col],
        .rotation = turning ? turning[col] : 0.0,
        .second_kind = second ? second[col] : NAN,
        .step = s,
    };
    if (s >= 0) fill_kind(&mode, modes, hd_steps_step(of->steps, s), dimension);
    return mode;
}

hd_status topic_publish_modes(const moment *now)
{
    const hd_run *run = now->run;
    const hd_parts of = hd_run_parts(run);
    const uint32_t vectors = (uint32_t)hd_run_vectors(run);
    hdr_mode *mode = moment_take(now, vectors, sizeof *mode);
    if (!mode) return HD_OK;
    for (uint32_t k = 0; k < vectors; k++) mode[k] = mode_of(&of, (int)k, moment_dimension(now));
    hdr_modes message = {
        .sim_time = hd_run_time(run),
        .averaged_time = hd_spectrum_time(of.spectrum),
        .samples = (uint32_t)hd_modes_samples(of.modes),
        .modes = {mode, vectors},
    };
    return topic_send_modes(now->out, &message);
}
