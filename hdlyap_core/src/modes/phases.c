/** Coefficients of the vectors of LP or T steps -> phases and angular velocities [T13].
 *
 * With z = a + i b of one pair of fields (L and P; or T of a cosine and T of a sine), the vectors
 * of an LP step all turn at the same rate, z -> z exp(i omega t); those of a T step do not turn. A
 * rotor follows one step; its rate is the mean rate of its tracks. */
#include "modes/phases.h"

#include <math.h>

#include "averages/blocks.h"
#include "base/check.h"
#include "base/memory.h"
#include "modes/modes.h"
#include "modes/rotor.h"
#include "modes/steps.h"

/** Smallest variance of a velocity, so that rotation without any noise has a weight. */
static const double VARIANCE_MIN = 1e-100;

struct hd_phases {
    hd_mode_kind kind;
    int rotors, tracks, vectors;
    double box_error; /**< relative error of the velocity because of edges and walls */
    hd_rotor *rotor;
    hd_track *track;
    hd_blocks blocks; /**< two series for each rotor: angle turned, and time for it; their weight is
                         time */
    double *sample;   /**< [2 * rotors]: these series in one sample */
};

/* ---- creation ------------------------------------------------------------------------------ */

static hd_status rotors_create(hd_phases *phases, const hd_steps *steps)
{
    const hd_fields *fields = hd_modes_fields(hd_steps_modes(steps));
    int t = 0;
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (hd_rotor_pairs(step, phases->kind) == 0) continue;
        const hd_subspace *s = hd_fields_subspace(fields, step->subspace);
        hd_rotor *r = &phases->rotor[phases->rotors];
        HD_TRY(hd_rotor_create(r, phases->track + t, step, k, s->column));
        r->number = phases->rotors++;
        r->blocks = &phases->blocks;
        r->sample = phases->sample + 2 * r->number;
        for (int v = 0; v < r->slots; v++)
            for (int c = 0; c < r->pairs; c++)
                phases->track[t++].out = (hd_phase){.step = k,
                                                    .modulation = s->modulations.bits[c * r->next],
                                                    .col = -1,
                                                    .omega_error = -1.0};
    }
    return HD_OK;
}

double hd_phases_bytes(double phases) { return phases * (sizeof(hd_track) + hd_blocks_bytes(1.0)); }

hd_status hd_phases_create(hd_phases **out, const hd_steps *steps, hd_mode_kind kind)
{
    hd_phases *phases = hd_memory_alloc(1, sizeof *phases);
    *out = NULL;
    if (!phases) return HD_NO_MEMORY;
    phases->kind = kind;
    phases->vectors = hd_modes_vectors(hd_steps_modes(steps));
    phases->box_error = fmax(hd_steps_relation(steps, HD_MODE_LP)->box_error, 0.0); /* NaN: none */
    int rotors = 0;
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const int pairs = hd_rotor_pairs(hd_steps_step(steps, k), kind);
        rotors += pairs > 0;
        phases->tracks += 2 * pairs * pairs;
    }
    phases->rotor = hd_memory_alloc((size_t)rotors + 1, sizeof *phases->rotor);
    phases->track = hd_memory_alloc((size_t)phases->tracks + 1, sizeof *phases->track);
    phases->sample = hd_memory_alloc(2 * (size_t)rotors + 1, sizeof *phases->sample);
    hd_status status = phases->rotor && phases->track && phases->sample
                           ? hd_blocks_create(&phases->blocks, 2 * rotors + 1, 0.0)
                           : HD_NO_MEMORY;
    if (status == HD_OK) status = rotors_create(phases, steps);
    if (status == HD_OK)
        *out = phases;
    else
        hd_phases_free(phases);
    return status;
}

void hd_phases_free(hd_phases *phases)
{
    if (!phases) return;
    for (int t = 0; phases->track && t < phases->tracks; t++)
        hd_blocks_clear(&phases->track[t].turns);
    hd_blocks_clear(&phases->blocks);
    hd_memory_free(phases->sample);
    hd_memory_free(phases->rotor);
    hd_memory_free(phases->track);
    hd_memory_free(phases);
}

/* ---- following ------------------------------------------------------------------------------ */

void hd_phases_add(hd_phases *phases, const hd_steps *steps, double time)
{
    const hd_modes *modes = hd_steps_modes(steps);
    double dt = 0.0;
    for (int k = 0; k < phases->rotors; k++) {
        hd_rotor *r = &phases->rotor[k];
        r->sample[0] = r->sample[1] = 0.0;
        hd_rotor_add(r, hd_steps_step(steps, r->step), modes, time);
        dt = fmax(dt, r->sample[1]);
    }
    if (dt > 0) hd_blocks_add(&phases->blocks, phases->sample, dt);
}

void hd_phases_clear(hd_phases *phases)
{
    for (int k = 0; k < phases->rotors; k++)
        hd_rotor_restart(&phases->rotor[k], HD_PHASE_UNRESOLVED);
    hd_blocks_restart(&phases->blocks);
}

/* ---- what can be read ---------------------------------------------------------------------- */

int hd_phases_count(const hd_phases *phases) { return phases->tracks; }

const hd_phase *hd_phases_phase(const hd_phases *phases, int index)
{
    HD_ASSERT(index >= 0 && index < phases->tracks);
    return &phases->track[index].out;
}

double hd_phases_diffusion(const hd_phases *phases, int index, double *error)
{
    HD_ASSERT(index >= 0 && index < phases->tracks);
    return hd_blocks_diffusion(&phases->track[index].turns, error);
}

/** The first block in which the rotor turned; the number of blocks if there is none. */
static int first_block(const hd_rotor *r)
{
    int k = 0;
    while (k < r->blocks->count && hd_blocks_sum(r->blocks, k)[2 * r->number + 1] == 0) k++;
    return k;
}

/** Adds factor times what each block contributes to the deviation of the mean rate; returns the
 * size that rounding may have. */
static double add_deviations(const hd_rotor *r, double factor, double *deviation)
{
    double turned = 0.0, turning = 0.0, size = 0.0;
    for (int k = first_block(r); k < r->blocks->count; k++) {
        turned += hd_blocks_sum(r->blocks, k)[2 * r->number];
        size += fabs(hd_blocks_sum(r->blocks, k)[2 * r->number]);
        turning += hd_blocks_sum(r->blocks, k)[2 * r->number + 1];
    }
    for (int k = first_block(r); k < r->blocks->count; k++) {
        const double *of = hd_blocks_sum(r->blocks, k) + 2 * r->number;
        deviation[k] += factor * (of[0] - turned / turning * of[1]) / turning;
    }
    return turning > 0 ? HD_BLOCKS_ROUNDING * fabs(factor) * size / turning : 0.0;
}

/** Standard error of the mean rate; negative if it is not yet known. */
static double rate_error(const hd_rotor *r)
{
    double deviation[HD_BLOCKS_MAX] = {0.0};
    const int first = first_block(r);
    const double rounding = add_deviations(r, 1.0, deviation);
    return hd_deviations_error(deviation + first, r->blocks->count - first, rounding);
}

bool hd_phases_rate(const hd_phases *phases, int step, double *omega, double *error)
{
    for (int k = 0; k < phases->rotors; k++) {
        const hd_rotor *r = &phases->rotor[k];
        if (r->step != step || !(r->turning > 0)) continue;
        *omega = r->turned / r->turning;
        *error = rate_error(r);
        return true;
    }
    return false;
}

/** omega / k of a rotor that has turned. */
static double velocity_of(const hd_rotor *r) { return r->turned / r->turning / r->wave_number; }

/** 1 / error^2 of the rotor's velocity; 0 while the error is not known. */
static double weight_of(const hd_rotor *r)
{
    const double error = rate_error(r) / r->wave_number;
    return error < 0 ? 0.0 : 1.0 / fmax(error * error, VARIANCE_MIN);
}

/** sqrt(chi^2 / freedom) of the steps about one velocity; negative of a single step. */
static double misfit_of(const hd_phases *phases, double v)
{
    double chi2 = 0.0;
    int steps = 0;
    for (int k = 0; k < phases->rotors; k++) {
        const hd_rotor *r = &phases->rotor[k];
        const double w = weight_of(r);
        chi2 += w > 0 ? w * pow(fabs(velocity_of(r)) - v, 2.0) : 0.0;
        steps += w > 0;
    }
    return steps > 1 ? sqrt(chi2 / (steps - 1)) : -1.0;
}

/** The mean over the steps, weighted with their errors. Its error accounts for how steps turn
 * together, and grows with the misfit. */
hd_velocity hd_phases_velocity(const hd_phases *phases)
{
    hd_velocity out = {.v_error = -1.0, .v_sampling_error = -1.0, .misfit = -1.0};
    double weights = 0.0, rounding = 0.0, deviation[HD_BLOCKS_MAX] = {0.0};
    int first = HD_BLOCKS_MAX;
    for (int k = 0; k < phases->rotors; k++) {
        const hd_rotor *r = &phases->rotor[k];
        const double w = weight_of(r);
        if (w == 0) continue;
        out.phases += hd_rotor_tracked(r);
        out.k_min = weights == 0 ? r->wave_number : fmin(out.k_min, r->wave_number);
        out.k_max = fmax(out.k_max, r->wave_number);
        weights += w;
        out.v += w * fabs(velocity_of(r));
        rounding += add_deviations(r, copysign(w / r->wave_number, velocity_of(r)), deviation);
        if (first_block(r) < first) first = first_block(r);
    }
    if (weights == 0) return out;
    out.v /= weights;
    const double error = hd_deviations_error(deviation + first, phases->blocks.count - first,
                                             rounding);
    out.misfit = misfit_of(phases, out.v);
    if (error < 0) return out;
    out.v_sampling_error = error / weights;
    out.v_error = hypot(fmax(1.0, out.misfit) * out.v_sampling_error, phases->box_error * out.v);
    return out;
}

double hd_phases_sampling(const hd_phases *phases, const hd_steps *steps)
{
    double sampling = INFINITY;
    for (int k = 0; k < phases->rotors; k++) {
        const hd_step *step = hd_steps_step(steps, phases->rotor[k].step);
        if (!step->resolved) continue;
        sampling = fmin(sampling, hd_rotor_sampling(&phases->rotor[k], step));
    }
    return sampling;
}

/* ---- file ---------------------------------------------------------------------------------- */

void hd_phases_archive(hd_phases *phases, hd_archive *archive, double now)
{
    for (int k = 0; k < phases->rotors; k++)
        hd_rotor_archive(&phases->rotor[k], archive, phases->vectors, now);
    for (int k = 0; k < phases->rotors; k++) {
        const hd_rotor *r = &phases->rotor[k];
        for (int t = 0; t < r->slots * r->pairs; t++)
            hd_track_archive(&r->track[t], archive, phases->vectors, r->time);
    }
    hd_blocks_archive(&phases->blocks, archive);
}
