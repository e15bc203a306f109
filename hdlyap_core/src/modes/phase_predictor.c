/** Turns of a step and misses of its phases -> how far ahead its phases can be predicted [T13].
 *
 * A phase diffuses about omega t. Its mean square miss after dt is D dt, and omega, the mean over
 * a time T, is known to D / T: together D dt (1 + dt / T). Misses of all dt give one D, weighted
 * with dt: below a radian phases tremble, and short ones say little of long ones. */
#include "modes/phase_predictor.h"

#include <limits.h>
#include <math.h>

/** Phases are predicted as far ahead as their expected miss is below this [rad]. With one pair it
 * is a quarter of the radian at which two vectors that turn together seem to change places; with
 * several pairs another vector looks less like a turned one. */
static const double OFF_ONE_PAIR = 0.25, OFF = 0.4;
/** If the whole step is off by this, the next sample comes early, to check it; a phase may be weak
 * as long as its expected miss is below this [rad]. */
static const double FAR_OFF = 0.75;
/** The next sample is at most this many times as far away as the samples that have shown misses. */
static const double GROWTH = 2.0;
/** Longest time between samples, and longest time for which a phase may be weak, in units of the
 * time that needs no prediction. */
static const double MOST = 10.0, GAP_MAX = 21.0;
/** A sample may come later than planned by this part. */
static const double LATE = 1.0 / HD_PHASE_PREDICTOR_PART;
/** Misses are forgotten over this many samples of mean length. */
static const double MEMORY = 48.0;
/** Samples needed to know how large misses are; and how many turns of the whole, one after the
 * other, may be far off before the rate counts as lost. */
enum { SHOWN = 16, LOST = 2 };
/** Smallest diffusion, so that rotation without any noise can be divided by it. */
static const double DIFFUSION_MIN = 1e-100;

void hd_phase_predictor_clear(hd_phase_predictor *f, int pairs)
{
    *f = (hd_phase_predictor){.off = pairs > 1 ? OFF : OFF_ONE_PAIR};
}

/** Mean time between the samples of the misses, weighted with that time; 0 if there are none. */
static double span(const hd_phase_predictor *f) { return f->time > 0 ? f->times / f->time : 0.0; }

void hd_phase_predictor_sample(hd_phase_predictor *f, double dt)
{
    const double keep = 1.0 - dt / fmax(dt, span(f)) / MEMORY;
    f->time *= keep;
    f->times *= keep;
    f->squares *= keep;
    f->samples++;
}

void hd_phase_predictor_turn(hd_phase_predictor *f, double turn, double dt)
{
    const double miss = turn - f->omega * dt;
    f->far_off = f->samples > SHOWN && fabs(miss) > FAR_OFF ? f->far_off + 1 : 0;
    f->averaged += dt;
    f->omega += miss / f->averaged;
}

void hd_phase_predictor_miss(hd_phase_predictor *f, double miss, double dt, double strength)
{
    f->time += strength * dt;
    f->times += strength * dt * dt;
    f->squares += strength * dt * miss * miss;
}

/** Time ahead at which phases are expected to be off by `error`, from error^2 = D t (1 + t / T); 0
 * if there are no misses. */
static double reach(const hd_phase_predictor *f, double error)
{
    if (f->times == 0) return 0.0;
    const double alone = error * error / fmax(f->squares / f->times, DIFFUSION_MIN);
    return 2.0 * alone / (1.0 + sqrt(1.0 + 4.0 * alone / f->averaged));
}

double hd_phase_predictor_sampling(const hd_phase_predictor *f, double unseen)
{
    if (f->samples < SHOWN || f->far_off > 0) return unseen;
    const double seen = fmin(reach(f, f->off), GROWTH * span(f));
    return fmax(unseen, fmin(seen, MOST * unseen));
}

double hd_phase_predictor_gap(const hd_phase_predictor *f, double unseen)
{
    if (f->samples < SHOWN) return GAP_MAX * unseen;
    const double seen = fmax(reach(f, FAR_OFF), LATE * hd_phase_predictor_sampling(f, unseen));
    return fmin(seen, GAP_MAX * unseen);
}

bool hd_phase_predictor_is_lost(const hd_phase_predictor *f) { return f->far_off >= LOST; }

void hd_phase_predictor_archive(hd_phase_predictor *f, hd_archive *archive)
{
    double *const all[] = {&f->omega, &f->averaged, &f->time, &f->times, &f->squares};
    hd_archive_of_doubles(archive, "predictor omega averaged time times squares", 5);
    for (int k = 0; k < 5; k++) hd_archive_next_doubles(archive, all[k], 1);
    hd_archive_long(archive, "predictor samples", &f->samples, 0, LONG_MAX / 2);
    hd_archive_int(archive, "predictor far off", &f->far_off, 0, LOST);
    for (int k = 1; k < 5; k++)
        hd_archive_expect(archive, *all[k] >= 0, "predictor", "a time or a square is negative");
}
