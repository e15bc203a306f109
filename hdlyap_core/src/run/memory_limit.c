/** Scene -> bytes that its run takes, which is the sum over its parts. */
#include "hdlyap/memory_limit.h"

#include <math.h>
#include <stdio.h>

#include "base/check.h"
#include "observe/observables.h"
#include "run/agenda.h"
#include "run/carrier.h"
#include "run/gathered.h"
#include "scene/scene.h"
#include "tangent/threads.h"
#include "dynamics/dynamics.h"

double hd_memory_needed(const hd_scene_def *def, int threads, int ranks)
{
    const int of_ranks = ranks > 1 ? ranks : 1;
    return hd_trajectory_bytes(def) + hd_carrier_bytes(def, threads, of_ranks) +
           hd_observables_bytes(def, of_ranks) + hd_gathered_bytes(def, of_ranks);
}

/* ---- what would fit ------------------------------------------------------------------------ */

static bool fits(const hd_scene_def *def, hd_memory_limit room)
{
    const int threads = hd_threads_most(def->threads, 2 * hd_scene_coordinates(def) * def->number,
                                        hd_scene_carried(def));
    return hd_memory_needed(def, threads, room.ranks) <= room.bytes;
}

/** The largest value, below its own, of a number of the scene with which the run fits into memory;
 * 0: none. `number` points into the copy. */
static int most_that_fits(const hd_scene_def *copy, hd_memory_limit room, int *number)
{
    int least = 0, most = *number;
    while (most - least > 1) {
        *number = least + (most - least) / 2;
        if (fits(copy, room))
            least = *number;
        else
            most = *number;
    }
    return least;
}

static int exponents_that_fit(const hd_scene_def *def, hd_memory_limit room)
{
    hd_scene_def copy = *def;
    copy.exponents = hd_scene_vectors(def);
    return most_that_fits(&copy, room, &copy.exponents);
}

static int particles_that_fit(const hd_scene_def *def, hd_memory_limit room)
{
    hd_scene_def copy = *def;
    return most_that_fits(&copy, room, &copy.number);
}

/** Rounds down to two digits, because it is an estimate. */
static int about(int number)
{
    int scale = 1;
    while (number / scale >= 100) scale *= 10;
    return number / scale * scale;
}

hd_status hd_memory_check(const hd_scene_def *def, hd_memory_limit room, char *message, size_t size)
{
    const int n = hd_scene_vectors(def);
    const int threads = hd_threads_most(def->threads, 2 * hd_scene_coordinates(def) * def->number,
                                        hd_scene_carried(def));
    char fitting[96] = "not even one particle would fit";
    if (fits(def, room)) return HD_OK;
    const int exponents = n > 0 ? about(exponents_that_fit(def, room)) : 0;
    const int particles = about(particles_that_fit(def, room));
    if (exponents > 0)
        snprintf(fitting, sizeof fitting, "exponents = %d would fit, or number = %d", exponents,
                 particles);
    else if (particles > 0)
        snprintf(fitting, sizeof fitting, "number = %d would fit", particles);
    (void)hd_refuse(
        message, size, "%s: number = %d with %d exponents need %.3g GB, there are %.3g GB (%s); %s",
        hd_status_text(HD_NO_MEMORY), def->number, n,
        1e-9 * hd_memory_needed(def, threads, room.ranks), 1e-9 * room.bytes, room.limit, fitting);
    return HD_NO_MEMORY;
}

hd_status hd_memory_check_windows(const hd_scene_def *def, char *message, size_t size)
{
    const hd_agenda agenda = hd_agenda_of(def, 1.0 / hd_scene_collision_time(def));
    const double apart = hd_observables_apart(def, hd_observables_with(def->observe));
    const double longest = fmin(hd_carrier_longest(def), hd_agenda_sample_most(&agenda));
    return hd_windows_check_memory(def, fmin(longest, apart), message, size);
}
