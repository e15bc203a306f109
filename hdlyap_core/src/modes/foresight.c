/** Turns of a step and misses of its phases -> how far ahead they are foreseen [T13].
 *
 * A phase diffuses about omega t. Its mean square miss after dt is D dt, and omega, the mean over
 * a time T, is known to D / T: together D dt (1 + dt / T). Misses of all dt give one D, weighted
 * with dt: below a radian phases tremble, and short ones say little of long ones. */
#include "modes/foresight.h"

#include <limits.h>
#include <math.h>

/** Misses are forgotten within so many samples of mean length. */
static const double MEMORY = 16.0;
/** Samples that show how large misses are. */
enum { SHOWN = 8 };
/** Rotation without any noise has misses, too. */
static const double DIFFUSION_MIN = 1e-100;

void hd_foresight_clear(hd_foresight *f) { *f = (hd_foresight){0}; }

void hd_foresight_turn(hd_foresight *f, double turn, double dt)
{
    f->averaged += dt;
    f->omega += (turn - f->omega * dt) / f->averaged;
}

void hd_foresight_sample(hd_foresight *f, double dt)
{
    const double keep = 1.0 - dt / fmax(dt, hd_foresight_span(f)) / MEMORY;
    f->time *= keep;
    f->spans *= keep;
    f->misses *= keep;
    f->samples++;
}

void hd_foresight_miss(hd_foresight *f, double miss, double dt)
{
    f->time += dt;
    f->spans += dt * dt;
    f->misses += dt * miss * miss;
}

/** error^2 = D t (1 + t / T), solved for t. */
double hd_foresight_reach(const hd_foresight *f, double error)
{
    if (f->samples < SHOWN || f->spans == 0) return 0.0;
    const double alone = error * error / fmax(f->misses / f->spans, DIFFUSION_MIN);
    return 2.0 * alone / (1.0 + sqrt(1.0 + 4.0 * alone / f->averaged));
}

double hd_foresight_span(const hd_foresight *f) { return f->time > 0 ? f->spans / f->time : 0.0; }

double hd_foresight_scatter(const hd_foresight *f)
{
    return f->time > 0 ? sqrt(f->misses / f->time) : 0.0;
}

void hd_foresight_archive(hd_foresight *f, hd_archive *archive)
{
    hd_archive_of_doubles(archive, "foresight omega averaged time spans misses", 5);
    double *const all[] = {&f->omega, &f->averaged, &f->time, &f->spans, &f->misses};
    for (int k = 0; k < 5; k++) hd_archive_next_doubles(archive, all[k], 1);
    hd_archive_long(archive, "foresight samples", &f->samples, 0, LONG_MAX / 2);
    hd_archive_expect(archive, f->averaged >= 0 && f->time >= 0 && f->spans >= 0 && f->misses >= 0,
                      "foresight", "a time or a square is negative");
}
