/** Snapshots of one step's vectors -> phases of all its vectors, and the rate of the step [T13]. */
#include "modes/rotor.h"

#include <limits.h>
#include <math.h>

#include "base/check.h"

static const double PI = 3.14159265358979323846;
/** Largest |omega| / lambda, about: v / c_L is 1.14 at density 0.8, 1.26 for long waves. */
static const double RATE_PER_EXPONENT = 1.25;
/** Between samples a step may turn by at most this part of pi, unless its turn is predicted. */
static const double SAFE = 0.75;
enum { LEARN = 4 };

/** T fields of spheres between walls that have the same modulation are no cosine and sine, so they
 * have no phase. */
int hd_rotor_pairs(const hd_step *step, hd_mode_kind kind)
{
    const unsigned char *bits = step->wave.transverse.bits;
    if (step->kind != kind) return 0;
    if (kind == HD_MODE_T && (bits[0] ^ bits[1]) & HD_SECOND) return 0;
    return step->expected / 2;
}

/** In a subspace L fields come before P fields, and each T field of a sine follows that of its
 * cosine. */
hd_status hd_rotor_create(hd_rotor *r, hd_track *tracks, const hd_step *step, int index, int column)
{
    const int pairs = step->expected / 2;
    const bool lp = step->kind == HD_MODE_LP;
    *r = (hd_rotor){.step = index,
                    .pairs = pairs,
                    .slots = step->expected,
                    .column = column,
                    .next = lp ? 1 : 2,
                    .partner = lp ? pairs : 1,
                    .wave_number = step->wave.number,
                    .track = tracks,
                    .col = -1};
    hd_phase_predictor_clear(&r->ahead, r->pairs);
    for (int t = 0; t < r->slots * r->pairs; t++)
        HD_TRY(hd_blocks_create(&tracks[t].turns, 1, 0.0));
    return HD_OK;
}

/* ---- one sample after the other ------------------------------------------------------------- */

void hd_rotor_restart(hd_rotor *r, hd_phase_state state)
{
    r->col = -1;
    r->samples = 0;
    hd_phase_predictor_clear(&r->ahead, r->pairs);
    r->turned = r->turning = 0.0;
    for (int k = 0; k < 2; k++) {
        r->sample[k] = 0.0;
        hd_blocks_forget(r->blocks, 2 * r->number + k);
    }
    for (int t = 0; t < r->slots * r->pairs; t++) hd_track_restart(&r->track[t], state);
}

static double complex coefficient(const hd_rotor *r, const hd_modes *modes, int col, int c)
{
    const int column = r->column + c * r->next;
    return hd_modes_coefficients(modes, column)[col] +
           I * hd_modes_coefficients(modes, column + r->partner)[col];
}

/** a^2 + b^2 of a vector over all pairs. */
static double strength_of(const hd_rotor *r, const hd_modes *modes, int col)
{
    double sum = 0.0;
    for (int c = 0; c < r->pairs; c++) {
        const double complex z = coefficient(r, modes, col, c);
        sum += creal(z * conj(z));
    }
    return sum;
}

/** Gives each slot a vector of the set; if steps share the set, the vectors with most weight in
 * this step. */
static void slots_fill(hd_rotor *r, const hd_step *step, const hd_modes *modes)
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

/** How well column col continues slot v: 1 exactly, -1 exactly but with the other sign. */
static double continuation(const hd_rotor *r, const hd_modes *modes, int v, int col, double dt)
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

/** Assigns vectors to slots, the best continuations first, because vectors of a degenerate step can
 * change places. A vector that clearly continues its own slot stays there. */
static void slots_match(hd_rotor *r, const hd_step *step, const hd_modes *modes, double dt)
{
    const double GOES_ON = 0.7, PREFERENCE = 0.3; /* for staying */
    bool taken[HD_SET_VECTORS_MAX] = {false}, done[HD_SLOTS_MAX] = {false};
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
                if (!(score <= best)) best = score, sign = s, slot = v, column = m;
            }
        taken[column] = done[slot] = true;
        r->slot_col[slot] = step->col + column;
        r->sign[slot] = sign < 0 ? -1.0 : 1.0;
    }
}

/** Turn of the whole step since the last sample, from all of its vectors that are not weak. */
static void rotor_turn(hd_rotor *r, const hd_modes *modes, double dt)
{
    double complex sum = 0.0;
    for (int v = 0; v < r->slots; v++) {
        if (strength_of(r, modes, r->slot_col[v]) < HD_TRACK_WEAK) continue;
        for (int c = 0; c < r->pairs; c++)
            sum += conj(r->z[v][c]) * r->sign[v] * coefficient(r, modes, r->slot_col[v], c);
    }
    if (sum == 0.0) return;
    const double turn = carg(sum), predicted = r->ahead.omega * dt;
    hd_phase_predictor_turn(&r->ahead,
                            r->samples > LEARN ? hd_track_unwrapped(turn, predicted) : turn, dt);
}

/** Longest time that unwraps a step whose rate is not known. */
static double unseen(const hd_step *step)
{
    return SAFE * PI / (RATE_PER_EXPONENT * fabs(step->exponent));
}

/** Adds to the mean rate of the tracks. Unlike the turn of the whole, in which longer vectors weigh
 * more, it has no bias if |z| depends on the phase. */
static void rotor_rate(hd_rotor *r, double sum, int count, double dt)
{
    if (count == 0) return;
    r->sample[1] = dt;
    r->sample[0] = sum / count * dt;
    r->turned += r->sample[0];
    r->turning += dt;
}

/** Keeps the snapshot as the last sample; `foreseen` was the predicted rate. A vector that leaves
 * the step for a while goes on as predicted, so that it is recognised when it comes back. */
static void rotor_store(hd_rotor *r, const hd_modes *modes, double time, double foreseen,
                        double gap)
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
                if (judged && t->dt_now <= dt) /* the phase was not weak before */
                    hd_phase_predictor_miss(&r->ahead, (t->rate_now - foreseen) * dt, dt,
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

/** Starts to follow the vectors of the step. */
static void rotor_take_up(hd_rotor *r, const hd_step *step, const hd_modes *modes)
{
    hd_rotor_restart(r, HD_PHASE_WEAK);
    r->col = step->col;
    r->count = step->count;
    slots_fill(r, step, modes);
}

void hd_rotor_add(hd_rotor *r, const hd_step *step, const hd_modes *modes, double time)
{
    const double dt = time - r->time, foreseen = r->ahead.omega;
    if (!step->resolved) {
        if (r->col >= 0) hd_rotor_restart(r, HD_PHASE_UNRESOLVED);
        return;
    }
    const bool same = r->col == step->col && r->count == step->count;
    if (same && !(dt > 0)) return;
    const double gap = hd_phase_predictor_gap(&r->ahead, unseen(step));
    bool coarse = same && dt * HD_PHASE_PREDICTOR_PART >
                              hd_phase_predictor_sampling(&r->ahead, unseen(step));
    if (same && !coarse) {
        if (r->samples > LEARN) slots_match(r, step, modes, dt);
        if (r->samples > LEARN) hd_phase_predictor_sample(&r->ahead, dt);
        rotor_turn(r, modes, dt);
        coarse = hd_phase_predictor_is_lost(&r->ahead);
    }
    if (!same || coarse) rotor_take_up(r, step, modes);
    rotor_store(r, modes, time, foreseen, gap);
    for (int t = 0; coarse && t < r->slots * r->pairs; t++) r->track[t].out.state = HD_PHASE_COARSE;
}

/* ---- what can be read ---------------------------------------------------------------------- */

int hd_rotor_tracked(const hd_rotor *r)
{
    int count = 0;
    for (int t = 0; t < r->slots * r->pairs; t++)
        count += r->track[t].out.state == HD_PHASE_TRACKED;
    return count;
}

double hd_rotor_sampling(const hd_rotor *r, const hd_step *step)
{
    return hd_phase_predictor_sampling(&r->ahead, unseen(step));
}

/* ---- file ---------------------------------------------------------------------------------- */

/** Reads or writes a rotor; the vectors in its slots are those of the set. */
void hd_rotor_archive(hd_rotor *r, hd_archive *archive, int vectors, double now)
{
    hd_archive_int(archive, "rotor col", &r->col, -1, vectors - 1);
    hd_archive_int(archive, "rotor count", &r->count, 0, HD_SET_VECTORS_MAX);
    hd_archive_long(archive, "rotor samples", &r->samples, 0, LONG_MAX / 2);
    const int first = r->col < 0 ? 0 : r->col,
              last = r->col < 0 ? vectors - 1 : r->col + r->count - 1;
    hd_archive_expect(archive, first <= last && last < vectors, "rotor",
                      "it names vectors that are not carried");
    hd_archive_of_ints(archive, "rotor slots", (size_t)r->slots);
    for (int v = 0; v < r->slots; v++) hd_archive_next_int(archive, &r->slot_col[v], first, last);
    hd_archive_doubles(archive, "rotor sign", r->sign, (size_t)r->slots);
    for (int v = 0; v < r->slots; v++)
        hd_archive_doubles(archive, "rotor z", (double *)r->z[v], 2 * (size_t)r->pairs);
    hd_archive_double(archive, "rotor time", &r->time);
    hd_archive_expect(archive, r->time <= now, "rotor time", "it is later than the checkpoint");
    hd_phase_predictor_archive(&r->ahead, archive);
    hd_archive_double(archive, "rotor turned", &r->turned);
    hd_archive_double(archive, "rotor turning", &r->turning);
}
