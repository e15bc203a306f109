/** Scene and length of an interval -> what a window of covariant vectors and its transient keep,
 * and whether covariant_memory is enough for it. */
#include "covariant/window_room.h"

#include <math.h>
#include <stdio.h>

#include "base/check.h"
#include "scene/scene.h"

/** Room is made for this many times the expected intervals, because their length varies. */
static const double SPARE = 1.5;

/** What the history of a window keeps if intervals have this length [time units]. */
static hd_history_def history_of(const hd_scene_def *def, double interval, int threads)
{
    /* each ends with a look, and so does an interval where one is due */
    const double both = def->covariant_window + def->covariant_transient +
                        2.0 * def->covariant_sampling;
    const double of_look = fmax(1.0, ceil(def->covariant_sampling / interval));
    const double intervals = ceil(SPARE * both / def->covariant_sampling * of_look) + 8.0,
                 looks = ceil(both / def->covariant_sampling) + 4.0;
    const double most = 1e9; /* far beyond any room */
    return (hd_history_def){.of = hd_dynamics_of(def),
                            .particles = def->number,
                            .vectors = hd_scene_carried(def),
                            .threads = threads > 0 ? threads : 1,
                            .conjugate = hd_scene_carried(def) < hd_scene_vectors(def),
                            .intervals = (long)fmin(intervals, most),
                            .snapshots = (long)fmin(looks, most)};
}

static double gigabytes_of(const hd_history_def *past) { return 1e-9 * hd_history_bytes(past); }

/** The longest window that fits with this transient, rounded down to two digits; 0 if not even one
 * with a single sample does. */
static double longest_window(const hd_scene_def *def, double interval)
{
    enum { HALVINGS = 60 };
    hd_scene_def other = *def;
    double fits = 0.0, most = def->covariant_window;
    for (int k = 0; k < HALVINGS; k++) {
        other.covariant_window = 0.5 * (fits + most);
        const hd_history_def past = history_of(&other, interval, def->threads);
        *(gigabytes_of(&past) <= def->covariant_memory ? &fits : &most) = other.covariant_window;
    }
    if (!(fits >= def->covariant_sampling)) return 0.0;
    const double digit = pow(10.0, floor(log10(fits)) - 1.0);
    return fmax(floor(fits / digit) * digit, def->covariant_sampling);
}

hd_status hd_window_check_memory(const hd_scene_def *def, double interval, char *message,
                                 size_t size)
{
    const hd_history_def past = history_of(def, interval, def->threads);
    char fitting[64] = "no window would fit with this transient";
    if (gigabytes_of(&past) <= def->covariant_memory) return HD_OK;
    const double window = longest_window(def, interval);
    if (window > 0) snprintf(fitting, sizeof fitting, "covariant_window = %.15g would fit", window);
    return hd_refuse(message, size,
                     "covariant_window = %.15g with covariant_transient = %.15g: %ld triangles and "
                     "%ld frames of %d vectors need %.3g GB, must be at most covariant_memory = "
                     "%.3g GB, as orthonormalisations are at most %.3g time units apart; %s",
                     def->covariant_window, def->covariant_transient, past.intervals,
                     past.snapshots, past.vectors, gigabytes_of(&past), def->covariant_memory,
                     interval, fitting);
}

hd_history_def hd_window_that_fits(const hd_scene_def *def, double interval, int threads)
{
    hd_history_def past = history_of(def, interval, threads);
    long fits = 2, most = past.intervals;
    if (gigabytes_of(&past) <= def->covariant_memory) return past;
    while (most - fits > 1) {
        past.intervals = fits + (most - fits) / 2;
        *(gigabytes_of(&past) <= def->covariant_memory ? &fits : &most) = past.intervals;
    }
    past.intervals = fits;
    return past;
}
