/** Turns of a step and misses of its phases -> how far ahead they are foreseen [T13].
 *
 * A phase diffuses about omega t. Its mean square miss after dt is D dt, and omega, the mean over
 * a time T, is known to D / T: together D dt (1 + dt / T). Misses of all dt give one D, weighted
 * with dt: below a radian phases tremble, and short ones say little of long ones. */
#include "modes/foresight.h"

#include <limits.h>
#include <math.h>

/** Foreseen as far as the whole is expected to be off by a quarter of the radian at which two
 * vectors that turn seem to change places, and its phases by the scatter below which that has not
 * been seen [rad]. */
static const double OFF_WHOLE = 0.25, OFF_PHASE = 0.4;
/** A whole that is off by three times as much is asked once more [rad]. */
static const double FAR_OFF_WHOLE = 0.75;
/** A phase may be weak as long as it is expected to be off by a third of pi [rad]. */
static const double FAR_OFF_PHASE = 1.0;
/** The next sample is at most so many times as far away as those that have shown the misses. */
static const double GROWTH = 2.0;
/** In times that need no foresight: longest between samples, and of a phase that is weak. */
static const double MOST = 10.0, GAP_MAX = 21.0;
/** A sample may come later than foreseen by this. */
static const double LATE = 4.0 / 3.0;
/** Misses are forgotten within so many samples of mean length. */
static const double MEMORY = 48.0;
/** Samples that show how large misses are; turns of the whole far off, one after the other, that no
 * scatter explains. */
enum { SHOWN = 16, LOST = 2 };
/** Rotation without any noise has misses, too. */
static const double DIFFUSION_MIN = 1e-100;

/* ---- misses -------------------------------------------------------------------------------- */

/** Mean time that they are of, longer ones counting more; 0 if there is none. */
static double span(const hd_misses *m) { return m->time > 0 ? m->times / m->time : 0.0; }

static void forget(hd_misses *m, double dt)
{
    const double keep = 1.0 - dt / fmax(dt, span(m)) / MEMORY;
    m->time *= keep;
    m->times *= keep;
    m->squares *= keep;
}

static void add(hd_misses *m, double miss, double dt)
{
    m->time += dt;
    m->times += dt * dt;
    m->squares += dt * miss * miss;
}

/** Time ahead at which `error` is expected, from error^2 = D t (1 + t / averaged); 0 if there are
 * none. */
static double reach(const hd_misses *m, double error, double averaged)
{
    if (m->times == 0) return 0.0;
    const double alone = error * error / fmax(m->squares / m->times, DIFFUSION_MIN);
    return 2.0 * alone / (1.0 + sqrt(1.0 + 4.0 * alone / averaged));
}

/* ---- foresight ----------------------------------------------------------------------------- */

void hd_foresight_clear(hd_foresight *f) { *f = (hd_foresight){0}; }

void hd_foresight_sample(hd_foresight *f, double dt)
{
    forget(&f->whole, dt);
    forget(&f->phases, dt);
    f->samples++;
}

void hd_foresight_turn(hd_foresight *f, double turn, double dt)
{
    const double miss = turn - f->omega * dt;
    const bool far = f->samples > SHOWN && fabs(miss) > FAR_OFF_WHOLE;
    if (f->samples > 0) add(&f->whole, miss, dt);
    f->far_off = far ? f->far_off + 1 : 0;
    f->averaged += dt;
    f->omega += miss / f->averaged;
}

void hd_foresight_miss(hd_foresight *f, double miss, double dt) { add(&f->phases, miss, dt); }

double hd_foresight_sampling(const hd_foresight *f, double unseen)
{
    if (f->samples < SHOWN || f->far_off > 0) return unseen;
    const double whole = reach(&f->whole, OFF_WHOLE, f->averaged);
    const double phases = reach(&f->phases, OFF_PHASE, f->averaged);
    const double seen = fmin(fmin(whole, phases), GROWTH * span(&f->phases));
    return fmax(unseen, fmin(seen, MOST * unseen));
}

double hd_foresight_gap(const hd_foresight *f, double unseen)
{
    if (f->samples < SHOWN) return GAP_MAX * unseen;
    const double seen = reach(&f->phases, FAR_OFF_PHASE, f->averaged);
    return fmin(fmax(seen, LATE * hd_foresight_sampling(f, unseen)), GAP_MAX * unseen);
}

bool hd_foresight_is_lost(const hd_foresight *f) { return f->far_off >= LOST; }

/* ---- file ---------------------------------------------------------------------------------- */

static void archive_misses(hd_misses *m, hd_archive *archive)
{
    hd_archive_of_doubles(archive, "misses time times squares", 3);
    hd_archive_next_doubles(archive, &m->time, 1);
    hd_archive_next_doubles(archive, &m->times, 1);
    hd_archive_next_doubles(archive, &m->squares, 1);
    const bool positive = m->time >= 0 && m->times >= 0 && m->squares >= 0;
    hd_archive_expect(archive, positive, "misses", "a time or a square is negative");
}

void hd_foresight_archive(hd_foresight *f, hd_archive *archive)
{
    hd_archive_double(archive, "foresight omega", &f->omega);
    hd_archive_double(archive, "foresight averaged", &f->averaged);
    hd_archive_expect(archive, f->averaged >= 0, "foresight averaged", "it is negative");
    archive_misses(&f->whole, archive);
    archive_misses(&f->phases, archive);
    hd_archive_long(archive, "foresight samples", &f->samples, 0, LONG_MAX / 2);
    hd_archive_int(archive, "foresight far off", &f->far_off, 0, LOST);
}
