/** Scene and length of an interval -> what a window of covariant vectors and its transient keep,
 * and whether covariant_memory is enough for it. */
#include "covariant/window_room.h"

#include <math.h>
#include <stdio.h>

#include "base/check.h"
#include "scene/scene.h"

/** Room is made for this many times the expected intervals, because their length varies. */
static const double SPARE = 1.5;

hd_history_def hd_window_history(const hd_scene_def *def, double interval, double rate, int threads)
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
                            .snapshots = (long)fmin(looks, most),
                            .recompute = def->covariant_storage == HD_STORAGE_RECOMPUTE,
                            .events = SPARE * both * rate};
}

/** Says that the other covariant_storage would fit, if it would. */
static void say_other(const hd_scene_def *def, const hd_history_def *past, char *text, size_t size)
{
    hd_history_def other = *past;
    other.recompute = !past->recompute;
    const double gigabytes = 1e-9 * hd_history_bytes(&other);
    if (gigabytes <= def->covariant_memory)
        snprintf(text, size, "; covariant_storage = %s needs %.3g GB",
                 other.recompute ? "recompute" : "memory", gigabytes);
}

hd_status hd_window_check_room(const hd_scene_def *def, double interval, char *message, size_t size)
{
    const hd_history_def past = hd_window_history(def, interval, hd_dynamics_of(def)->entries(def),
                                                  def->threads);
    const double gigabytes = 1e-9 * hd_history_bytes(&past);
    char events[40] = "", other[80] = "";
    if (gigabytes <= def->covariant_memory) return HD_OK;
    if (past.recompute) snprintf(events, sizeof events, " and %.3g events", past.events);
    say_other(def, &past, other, sizeof other);
    return hd_refuse(message, size,
                     "covariant_window = %.15g with covariant_transient = %.15g: %ld triangles and "
                     "%ld frames of %d vectors%s need %.3g GB, must be at most covariant_memory = "
                     "%.3g GB, as orthonormalisations are at most %.3g time units apart%s",
                     def->covariant_window, def->covariant_transient, past.intervals,
                     past.snapshots, past.vectors, events, gigabytes, def->covariant_memory,
                     interval, other);
}

/** This part of the intervals and events. */
static hd_history_def part_of(const hd_history_def *wanted, double part)
{
    hd_history_def past = *wanted;
    past.intervals = (long)fmax(2.0, part * (double)wanted->intervals);
    past.events = part * wanted->events;
    return past;
}

hd_history_def hd_window_that_fits(const hd_scene_def *def, const hd_history_def *wanted)
{
    enum { BISECTIONS = 40 };
    double fits = 0.0, most = 1.0;
    if (1e-9 * hd_history_bytes(wanted) <= def->covariant_memory) return *wanted;
    for (int k = 0; k < BISECTIONS; k++) {
        const double middle = 0.5 * (fits + most);
        const hd_history_def past = part_of(wanted, middle);
        *(1e-9 * hd_history_bytes(&past) <= def->covariant_memory ? &fits : &most) = middle;
    }
    return part_of(wanted, fits);
}
