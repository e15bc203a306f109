/** Coefficients of one vector on one pair of fields -> its phase [T13]. */
#include "modes/track.h"

#include <limits.h>
#include <math.h>

static const double PI = 3.14159265358979323846;

void hd_track_restart(hd_track *t, hd_phase_state state)
{
    const hd_phase out = t->out;
    t->out = (hd_phase){.step = out.step,
                        .modulation = out.modulation,
                        .col = -1,
                        .state = state,
                        .omega_error = -1.0};
    t->count = 0;
    hd_blocks_restart(&t->turns);
}

static void begin(hd_track *t, double time, double phase)
{
    t->begin = t->last = t->mean_t = time;
    t->out.phase = t->mean_phase = phase;
    t->square_t = t->product = 0.0;
    t->count = 1;
    hd_blocks_restart(&t->turns);
}

double hd_track_unwrapped(double phase, double predicted)
{
    return phase + 2.0 * PI * round((predicted - phase) / (2.0 * PI));
}

static void regress(hd_track *t, double time, double phase)
{
    const double off_t = time - t->mean_t, off = phase - t->mean_phase;
    t->count++;
    t->mean_t += off_t / (double)t->count;
    t->mean_phase += off / (double)t->count;
    t->square_t += off_t * (time - t->mean_t);
    t->product += off_t * (phase - t->mean_phase);
    t->out.omega = t->product / t->square_t;
}

/** The slope of a diffusing phase has 6/5 of the variance of its mean rate. */
static double slope_error(const hd_track *t)
{
    const double error = hd_blocks_error_of_turns(&t->turns);
    return error < 0 ? -1.0 : sqrt(1.2) * error;
}

bool hd_track_add(hd_track *t, double complex z, double time, double omega, double gap)
{
    const double strength = creal(z) * creal(z) + cimag(z) * cimag(z);
    if (t->count > 0 && time - t->last > gap) hd_track_restart(t, HD_PHASE_WEAK);
    t->out.state = strength < HD_TRACK_WEAK ? HD_PHASE_WEAK : HD_PHASE_TRACKED;
    if (strength < HD_TRACK_WEAK) return false;
    if (t->count == 0) {
        begin(t, time, carg(z));
        return false;
    }
    const double dt = time - t->last;
    const double phase = hd_track_unwrapped(carg(z), t->out.phase + omega * dt);
    t->rate_now = (phase - t->out.phase) / dt;
    t->dt_now = dt;
    hd_blocks_add(&t->turns, &(double){phase - t->out.phase}, dt);
    regress(t, time, phase);
    t->out.phase = phase;
    t->last = time;
    t->out.time = time - t->begin;
    t->out.omega_error = slope_error(t);
    return true;
}

void hd_track_archive(hd_track *t, hd_archive *archive, int vectors, double sampled)
{
    int state = (int)t->out.state;
    hd_archive_int(archive, "phase col", &t->out.col, -1, vectors - 1);
    hd_archive_int(archive, "phase state", &state, HD_PHASE_UNRESOLVED, HD_PHASE_TRACKED);
    t->out.state = (hd_phase_state)state;
    double *const of_out[] = {&t->out.a,     &t->out.b,           &t->out.phase,
                              &t->out.omega, &t->out.omega_error, &t->out.time};
    double *const sums[] = {&t->last,       &t->begin,    &t->mean_t,
                            &t->mean_phase, &t->square_t, &t->product};
    hd_archive_of_doubles(archive, "phase a b phase omega error time", 6);
    for (int k = 0; k < 6; k++) hd_archive_next_doubles(archive, of_out[k], 1);
    hd_archive_of_doubles(archive, "phase sums", 6);
    for (int k = 0; k < 6; k++) hd_archive_next_doubles(archive, sums[k], 1);
    hd_archive_expect(archive, t->begin <= t->last && t->last <= sampled, "phase sums",
                      "their times do not fit the time of the checkpoint");
    hd_archive_long(archive, "phase count", &t->count, 0, LONG_MAX / 2);
    hd_blocks_archive(&t->turns, archive);
}
