/** Coefficients of the LP steps' vectors -> phases and angular velocities [T13].
 *
 * With z = a + i b of one pair, the vectors of a step all turn at the same rate: z -> z exp(i
 * omega t). A rotor follows one step: its slots are vectors, which may change their columns; each
 * slot and pair is a track with a phase of its own. The sum over all tracks of conj(z) z' between
 * two samples turns by omega dt too, weighs each track with its strength and does not mind which
 * vector is which: it predicts the tracks' next phases. The velocity is the mean rate of the
 * tracks. */
#include "hdlyap/phases.h"

#include <complex.h>
#include <limits.h>
#include <math.h>

#include "averages/blocks.h"
#include "base/check.h"
#include "base/memory.h"
#include "modes/archived.h"
#include "modes/foresight.h"
#include "modes/sets.h"
#include "modes/track.h"

static const double PI = 3.14159265358979323846;
/** |omega| / lambda is at most about this: v / c_L is 1.14 at density 0.8, near 1 below 0.6. */
static const double RATE_PER_EXPONENT = 1.25;
/** Sampling is refined when a step may turn by more than this part of pi, unless it is foreseen. */
static const double SAFE = 0.75;
/** Of a velocity: rotation without any noise has a weight, too. */
static const double VARIANCE_MIN = 1e-100;

enum { PAIRS_MAX = HD_MODULATIONS_MAX, SLOTS_MAX = 2 * PAIRS_MAX, LEARN = 4 };

/** One LP step. */
typedef struct rotor {
    int step, column, pairs, slots; /**< column: of the first L field */
    double wave_number;
    hd_track *track; /**< [slots][pairs] */
    int col, count;  /**< the set followed; col -1: none */
    long samples;    /**< since the set was taken up */
    int slot_col[SLOTS_MAX];
    double sign[SLOTS_MAX]; /**< of the vector in a slot against the one it began with */
    double complex z[SLOTS_MAX][PAIRS_MAX]; /**< at the last sample, times sign */
    double time;
    hd_foresight ahead;     /**< what phases are unwrapped by */
    double turned, turning; /**< by the mean rate of the tracks, and for how long */
    hd_blocks *blocks;      /**< of all rotors */
    double *sample;         /**< [2], at column 2 number of their rows: turned and turning */
    int number;
} rotor;

struct hd_phases {
    int rotors, tracks, vectors;
    rotor *rotor;
    hd_track *track;
    hd_blocks blocks; /**< two series of each rotor; their weight is time */
    double *sample;   /**< [2 * rotors] */
};

/* ---- creation ------------------------------------------------------------------------------ */

static hd_status rotor_create(rotor *r, hd_track *tracks, const hd_step *step, int index,
                              int column)
{
    *r = (rotor){.step = index,
                 .column = column,
                 .pairs = step->expected / 2,
                 .slots = step->expected,
                 .wave_number = step->wave.number,
                 .track = tracks,
                 .col = -1};
    hd_foresight_clear(&r->ahead, r->pairs);
    for (int t = 0; t < r->slots * r->pairs; t++)
        HD_TRY(hd_blocks_create(&tracks[t].turns, 1, 0.0));
    return HD_OK;
}

static hd_status rotors_create(hd_phases *phases, const hd_steps *steps)
{
    const hd_fields *fields = hd_modes_fields(hd_steps_modes(steps));
    int t = 0;
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (step->kind != HD_MODE_LP) continue;
        const hd_subspace *s = hd_fields_subspace(fields, step->subspace);
        rotor *r = &phases->rotor[phases->rotors];
        HD_TRY(rotor_create(r, phases->track + t, step, k, s->column));
        r->number = phases->rotors++;
        r->blocks = &phases->blocks;
        r->sample = phases->sample + 2 * r->number;
        for (int v = 0; v < r->slots; v++)
            for (int c = 0; c < r->pairs; c++)
                phases->track[t++].out = (hd_phase){.step = k,
                                                    .modulation = s->modulations.bits[c],
                                                    .col = -1,
                                                    .omega_error = -1.0};
    }
    return HD_OK;
}

hd_status hd_phases_create(hd_phases **out, const hd_steps *steps)
{
    hd_phases *phases = hd_memory_alloc(1, sizeof *phases);
    *out = NULL;
    if (!phases) return HD_NO_MEMORY;
    phases->vectors = hd_modes_vectors(hd_steps_modes(steps));
    int rotors = 0;
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (step->kind != HD_MODE_LP) continue;
        rotors++;
        phases->tracks += step->expected * step->expected / 2;
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

/* ---- one rotor ----------------------------------------------------------------------------- */

static void rotor_restart(rotor *r, hd_phase_state state)
{
    r->col = -1;
    r->samples = 0;
    hd_foresight_clear(&r->ahead, r->pairs);
    r->turned = r->turning = 0.0;
    for (int k = 0; k < 2; k++) {
        r->sample[k] = 0.0;
        hd_blocks_forget(r->blocks, 2 * r->number + k);
    }
    for (int t = 0; t < r->slots * r->pairs; t++) hd_track_restart(&r->track[t], state);
}

static double complex coefficient(const rotor *r, const hd_modes *modes, int col, int c)
{
    return hd_modes_coefficients(modes, r->column + c)[col] +
           I * hd_modes_coefficients(modes, r->column + r->pairs + c)[col];
}

/** a^2 + b^2 of a vector over all pairs. */
static double strength_of(const rotor *r, const hd_modes *modes, int col)
{
    double sum = 0.0;
    for (int c = 0; c < r->pairs; c++) {
        const double complex z = coefficient(r, modes, col, c);
        sum += creal(z * conj(z));
    }
    return sum;
}

/** Each slot takes a vector of the set; of a set shared with other steps the ones most of this one.
 */
static void slots_fill(rotor *r, const hd_step *step, const hd_modes *modes)
{
    const double *weight = hd_modes_average(modes, step->subspace, HD_WEIGHT);
    bool taken[HD_SET_VECTORS_MAX] = {false};
    for (int v = 0; v < r->slots; v++) {
        int best = -1;
        for (int m = 0; m < step->count; m++) {
            const bool better = best < 0 || weight[step->col + m] > weight[step->col + best];
            if (!taken[m] && (step->count == r->slots ? best < 0 : better)) best = m;
        }
        taken[best] = true;
        r->slot_col[v] = step->col + best;
        r->sign[v] = 1.0;
    }
}

/** How well column col continues slot v: 1 for exactly, -1 for exactly with the other sign. */
static double continuation(const rotor *r, const hd_modes *modes, int v, int col, double dt)
{
    const double complex turn = cexp(-I * r->ahead.omega * dt);
    double product = 0.0, before = 0.0, now = 0.0;
    for (int c = 0; c < r->pairs; c++) {
        const double complex z = coefficient(r, modes, col, c);
        product += creal(conj(r->z[v][c]) * z * turn);
        before += creal(r->z[v][c] * conj(r->z[v][c]));
        now += creal(z * conj(z));
    }
    return product / fmax(sqrt(before * now), 1e-300);
}

/** Vectors of a degenerate step can change places: best continuations first; a vector that goes on
 * by itself is not asked. */
static void slots_match(rotor *r, const hd_step *step, const hd_modes *modes, double dt)
{
    const double GOES_ON = 0.7, PREFERENCE = 0.3; /* for staying */
    bool taken[HD_SET_VECTORS_MAX] = {false}, done[SLOTS_MAX] = {false};
    int left = r->slots;
    for (int v = 0; v < r->slots; v++) {
        const double s = continuation(r, modes, v, r->slot_col[v], dt);
        if (r->sign[v] * s < GOES_ON) continue;
        taken[r->slot_col[v] - step->col] = done[v] = true;
        left--;
    }
    while (left-- > 0) {
        double best = -1.0, sign = 1.0;
        int slot = -1, column = -1;
        for (int v = 0; v < r->slots; v++)
            for (int m = 0; m < step->count && !done[v]; m++) {
                if (taken[m]) continue;
                const double s = continuation(r, modes, v, step->col + m, dt);
                const bool stays = step->col + m == r->slot_col[v] && r->sign[v] * s > 0;
                const double score = fabs(s) + (stays ? PREFERENCE : 0.0);
                if (score > best) best = score, sign = s, slot = v, column = m;
            }
        taken[column] = done[slot] = true;
        r->slot_col[slot] = step->col + column;
        r->sign[slot] = sign < 0 ? -1.0 : 1.0;
    }
}

/** Turn of the whole step since the last sample; from the vectors that are there. */
static void rotor_turn(rotor *r, const hd_modes *modes, double dt)
{
    double complex sum = 0.0;
    for (int v = 0; v < r->slots; v++) {
        if (strength_of(r, modes, r->slot_col[v]) < HD_TRACK_WEAK) continue;
        for (int c = 0; c < r->pairs; c++)
            sum += conj(r->z[v][c]) * r->sign[v] * coefficient(r, modes, r->slot_col[v], c);
    }
    if (sum == 0.0) return;
    const double turn = carg(sum), predicted = r->ahead.omega * dt;
    hd_foresight_turn(&r->ahead, r->samples > LEARN ? hd_track_unwrapped(turn, predicted) : turn,
                      dt);
}

/** Longest time that unwraps a step whose rate is not known. */
static double unseen(const hd_step *step)
{
    return SAFE * PI / (RATE_PER_EXPONENT * fabs(step->exponent));
}

/** Mean rate of the tracks: unlike the turn of the whole, where longer vectors weigh more, it has
 * no bias if |z| depends on the phase. */
static void rotor_rate(rotor *r, double sum, int count, double dt)
{
    if (count == 0) return;
    r->sample[1] = dt;
    r->sample[0] = sum / count * dt;
    r->turned += r->sample[0];
    r->turning += dt;
}

/** Takes over the snapshot as the last sample; `foreseen` was its rate. A vector that is something
 * else for a while goes on as predicted: it is recognised when it comes back. */
static void rotor_store(rotor *r, const hd_modes *modes, double time, double foreseen, double gap)
{
    const double dt = time - r->time, omega = r->ahead.omega;
    const bool judged = r->samples > LEARN;
    const double complex turn = cexp(I * omega * dt);
    double sum = 0.0;
    int count = 0;
    for (int v = 0; v < r->slots; v++) {
        const int col = r->slot_col[v];
        const bool away = r->samples > 0 && strength_of(r, modes, col) < HD_TRACK_WEAK;
        for (int c = 0; c < r->pairs; c++) {
            hd_track *t = &r->track[v * r->pairs + c];
            const double complex z = coefficient(r, modes, col, c);
            r->z[v][c] = away ? r->z[v][c] * turn : r->sign[v] * z;
            if (hd_track_add(t, r->sign[v] * z, time, omega, gap)) {
                sum += t->rate_now, count++;
                if (judged && t->dt_now <= dt) /* it was not weak before */
                    hd_foresight_miss(&r->ahead, (t->rate_now - foreseen) * dt, dt,
                                      creal(z * conj(z)));
            }
            t->out.col = col;
            t->out.a = creal(z);
            t->out.b = cimag(z);
        }
    }
    rotor_rate(r, sum, count, dt);
    r->time = time;
    r->samples++;
}

/** Follows the vectors of the step from here on. */
static void rotor_take_up(rotor *r, const hd_step *step, const hd_modes *modes)
{
    rotor_restart(r, HD_PHASE_WEAK);
    r->col = step->col;
    r->count = step->count;
    slots_fill(r, step, modes);
}

/** Samples may come at any distance: only one that is too far away for the step's rate, or for how
 * well it is foreseen, begins anew. */
static void rotor_add(rotor *r, const hd_step *step, const hd_modes *modes, double time)
{
    const double dt = time - r->time, foreseen = r->ahead.omega;
    if (!step->resolved) {
        if (r->col >= 0) rotor_restart(r, HD_PHASE_UNRESOLVED);
        return;
    }
    const bool same = r->col == step->col && r->count == step->count;
    if (same && !(dt > 0)) return;
    const double gap = hd_foresight_gap(&r->ahead, unseen(step));
    bool coarse = same && dt * SAFE > hd_foresight_sampling(&r->ahead, unseen(step));
    if (same && !coarse) {
        if (r->samples > LEARN) slots_match(r, step, modes, dt);
        if (r->samples > LEARN) hd_foresight_sample(&r->ahead, dt);
        rotor_turn(r, modes, dt);
        coarse = hd_foresight_is_lost(&r->ahead);
    }
    if (!same || coarse) rotor_take_up(r, step, modes);
    rotor_store(r, modes, time, foreseen, gap);
    for (int t = 0; coarse && t < r->slots * r->pairs; t++) r->track[t].out.state = HD_PHASE_COARSE;
}

void hd_phases_add(hd_phases *phases, const hd_steps *steps, double time)
{
    const hd_modes *modes = hd_steps_modes(steps);
    double dt = 0.0;
    for (int k = 0; k < phases->rotors; k++) {
        rotor *r = &phases->rotor[k];
        r->sample[0] = r->sample[1] = 0.0;
        rotor_add(r, hd_steps_step(steps, r->step), modes, time);
        dt = fmax(dt, r->sample[1]);
    }
    if (dt > 0) hd_blocks_add(&phases->blocks, phases->sample, dt);
}

void hd_phases_clear(hd_phases *phases)
{
    for (int k = 0; k < phases->rotors; k++) rotor_restart(&phases->rotor[k], HD_PHASE_UNRESOLVED);
    hd_blocks_restart(&phases->blocks);
}

/* ---- what can be read ---------------------------------------------------------------------- */

int hd_phases_count(const hd_phases *phases) { return phases->tracks; }

const hd_phase *hd_phases_phase(const hd_phases *phases, int index)
{
    HD_ASSERT(index >= 0 && index < phases->tracks);
    return &phases->track[index].out;
}

static int tracked(const rotor *r)
{
    int count = 0;
    for (int t = 0; t < r->slots * r->pairs; t++)
        count += r->track[t].out.state == HD_PHASE_TRACKED;
    return count;
}

/** First block in which the rotor turned; their number if there is none. */
static int first_block(const rotor *r)
{
    int k = 0;
    while (k < r->blocks->count && hd_blocks_sum(r->blocks, k)[2 * r->number + 1] == 0) k++;
    return k;
}

/** Adds factor times what each block contributes to the deviation of the mean rate; returns the
 * size that rounding may have. */
static double add_deviations(const rotor *r, double factor, double *deviation)
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

/** Of the mean rate; negative if not yet known. */
static double rate_error(const rotor *r)
{
    double deviation[HD_BLOCKS_MAX] = {0.0};
    const int first = first_block(r);
    const double rounding = add_deviations(r, 1.0, deviation);
    return hd_deviations_error(deviation + first, r->blocks->count - first, rounding);
}

/** Mean over the steps, weighted with their errors; its own error knows how they turn together. */
hd_velocity hd_phases_velocity(const hd_phases *phases)
{
    hd_velocity out = {.v_error = -1.0, .misfit = -1.0};
    double weights = 0.0, squares = 0.0, rounding = 0.0, deviation[HD_BLOCKS_MAX] = {0.0};
    int first = HD_BLOCKS_MAX, steps = 0;
    for (int k = 0; k < phases->rotors; k++) {
        const rotor *r = &phases->rotor[k];
        const double error = rate_error(r) / r->wave_number;
        if (error < 0) continue;
        const double rate = r->turned / r->turning / r->wave_number;
        const double w = 1.0 / (error * error < VARIANCE_MIN ? VARIANCE_MIN : error * error);
        out.phases += tracked(r);
        out.k_min = steps == 0 ? r->wave_number : fmin(out.k_min, r->wave_number);
        out.k_max = fmax(out.k_max, r->wave_number);
        weights += w;
        steps++;
        out.v += w * fabs(rate);
        squares += w * rate * rate;
        rounding += add_deviations(r, copysign(w / r->wave_number, rate), deviation);
        if (first_block(r) < first) first = first_block(r);
    }
    if (weights == 0) return out;
    out.v /= weights;
    const double error = hd_deviations_error(deviation + first, phases->blocks.count - first,
                                             rounding);
    out.v_error = error < 0 ? error : error / weights;
    if (steps > 1) out.misfit = sqrt(fmax(squares - weights * out.v * out.v, 0.0) / (steps - 1));
    return out;
}

int hd_phases_vectors(const hd_steps *steps)
{
    const int vectors = hd_modes_vectors(hd_steps_modes(steps));
    int first = vectors;
    for (int k = 0; k < hd_steps_count(steps); k++) {
        const hd_step *step = hd_steps_step(steps, k);
        if (step->kind == HD_MODE_LP && step->resolved && step->col < first) first = step->col;
    }
    return vectors - first;
}

double hd_phases_sampling(const hd_phases *phases, const hd_steps *steps)
{
    double sampling = INFINITY;
    for (int k = 0; k < phases->rotors; k++) {
        const hd_step *step = hd_steps_step(steps, phases->rotor[k].step);
        if (!step->resolved) continue;
        sampling = fmin(sampling, hd_foresight_sampling(&phases->rotor[k].ahead, unseen(step)));
    }
    return sampling;
}

/* ---- file ---------------------------------------------------------------------------------- */

/** The vectors in the slots are those of the set. */
static void rotor_archive(rotor *r, hd_archive *archive, int vectors)
{
    hd_archive_int(archive, "rotor col", &r->col, -1, vectors - 1);
    hd_archive_int(archive, "rotor count", &r->count, 0, HD_SET_VECTORS_MAX);
    hd_archive_long(archive, "rotor samples", &r->samples, 0, LONG_MAX / 2);
    const int first = r->col < 0 ? 0 : r->col,
              last = r->col < 0 ? vectors - 1 : r->col + r->count - 1;
    hd_archive_expect(archive, first <= last && last < vectors, "rotor", "its vectors are none");
    hd_archive_of_ints(archive, "rotor slots", (size_t)r->slots);
    for (int v = 0; v < r->slots; v++) hd_archive_next_int(archive, &r->slot_col[v], first, last);
    hd_archive_doubles(archive, "rotor sign", r->sign, (size_t)r->slots);
    for (int v = 0; v < r->slots; v++)
        hd_archive_doubles(archive, "rotor z", (double *)r->z[v], 2 * (size_t)r->pairs);
    hd_archive_double(archive, "rotor time", &r->time);
    hd_foresight_archive(&r->ahead, archive);
    hd_archive_double(archive, "rotor turned", &r->turned);
    hd_archive_double(archive, "rotor turning", &r->turning);
}

void hd_phases_archive(hd_phases *phases, hd_archive *archive)
{
    for (int k = 0; k < phases->rotors; k++)
        rotor_archive(&phases->rotor[k], archive, phases->vectors);
    for (int t = 0; t < phases->tracks; t++)
        hd_track_archive(&phases->track[t], archive, phases->vectors);
    hd_blocks_archive(&phases->blocks, archive);
}
