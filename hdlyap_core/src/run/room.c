/** Scene -> bytes that its run takes: the sizes of what its parts allocate, in their order. */
#include "hdlyap/room.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

#include "averages/blocks.h"
#include "base/check.h"
#include "hdlyap/blas.h"
#include "hdlyap/modes.h"
#include "hdlyap/structure.h"
#include "hdlyap/trajectory.h"
#include "hdlyap/wave.h"
#include "modes/track.h"
#include "run/factorise.h"
#include "tangent/threads.h"

/** Bytes of each disk in trajectory, cells and queue. */
static const double OF_A_DISK = 255.0;
/** Events between two orthonormalisations: of each disk, and in all; bytes of one in the log, which
 * doubles, and as a map. */
static const double EVENTS_OF_A_DISK = 30.0, EVENTS_MAX = 2e5, OF_AN_EVENT = 130.0;
/** Columns that a thread has in its cache at most, and their bytes. */
static const double CACHED = 512.0 * 1024.0;
/** Of an orthonormalisation: a panel, and what is projected on it. */
static const double PANEL = 160.0, LATER = 640.0, PROBES = 8.0;

static const double WORD = sizeof(double);

static double frame_bytes(double rows, double n, double threads)
{
    double width = fmin(n, 8.0);
    while (width < 64.0 && 2.0 * width <= n && 2.0 * WORD * rows * width <= CACHED) width *= 2.0;
    return WORD * rows * (2.0 * (n + 4.0) + threads * width);
}

static double ortho_bytes(double rows, double n, double ranks)
{
    const double width = fmin(n, fmin(fmax(n / 8.0, 8.0), PANEL)), later = fmin(n, LATER);
    const double copied = ranks > 1 ? width * (width + rows / ranks) : 0.0;
    return WORD * (width * width + later * width + (PROBES + 40.0) * n + copied);
}

static double spectrum_bytes(double n) { return WORD * (HD_BLOCKS_MAX + 6.0) * n; }

static double localization_bytes(double n) { return WORD * (HD_BLOCKS_MAX + 6.0) * n; }

/** What is counted of the fields of a scene. */
typedef struct counted {
    double columns, subspaces, tracks;
} counted;

static counted fields_of(const hd_scene_def *def)
{
    enum { WAVES = 4096 };
    static const double OF_ONE = 12.0; /* columns of a wave vector at most */
    hd_wave wave[WAVES];
    const int count = hd_waves(def, wave, WAVES);
    counted all = {.subspaces = 2.0 * count};
    for (int k = 0; k < count && k < WAVES; k++) {
        const double pairs = hd_wave_pairs(&wave[k], def->boundary).count;
        const double t = hd_wave_transverse(&wave[k], def->boundary).count;
        all.columns += t + 2.0 * pairs;
        if (def->observe & HD_OBSERVE_PHASES) all.tracks += 2.0 * pairs * pairs;
        if (def->observe & HD_OBSERVE_T_PHASES) all.tracks += 2.0 * floor(t / 2.0) * floor(t / 2.0);
    }
    if (count > WAVES) all.columns = OF_ONE * count;
    return all;
}

static double modes_bytes(const counted *of, double disks, double n)
{
    const double columns = of->columns + HD_NULLS, rows = of->subspaces * HD_WEIGHTS + HD_NULLS;
    const double weights = 2.0 * rows * n, work = (columns + HD_NULLS + 9.0) * n;
    return WORD * (2.0 * disks * (columns + 4.0) + columns * columns + weights + work);
}

/** What makes all vectors of half of them: of those of a rank, and of all that it gathers. */
static double conjugate_bytes(const hd_scene_def *def, double ranks)
{
    const double rows = 4.0 * def->disks, signs = 8.0;
    const bool whole = def->observe & HD_OBSERVE_OF_MODES;
    const bool gathered = ranks > 1 && def->observe & (HD_OBSERVE_HYDRO | HD_OBSERVE_FIELDS);
    if (hd_scene_carried(def) == hd_scene_vectors(def)) return 0.0;
    return WORD * rows *
           (1.0 + 1.5 * signs + (whole ? rows / ranks : 0.0) + (gathered ? 1.5 * rows : 0.0));
}

/** Waves at once: 4 functions and 2 components each. */
static double structure_bytes(const hd_scene_def *def, double n)
{
    const double waves = hd_structure_waves_of(def), at_once = 16.0;
    const double longer = hd_wave_limits_of(def).node + 1.0, shorter = waves / longer + 1.0;
    const double harmonics = 2.0 * (longer + shorter);
    return WORD *
           (4.0 * waves * n + (9.0 * at_once + 9.0) * n + def->disks * (4.0 * at_once + harmonics));
}

static double observer_bytes(const hd_scene_def *def, const counted *of, double n)
{
    const double track = sizeof(hd_track) + WORD * (HD_BLOCKS_MAX + 1.0);
    const bool phases = def->observe & HD_OBSERVE_OF_PHASES;
    const double structure = def->observe & HD_OBSERVE_STRUCTURE ? structure_bytes(def, n) : 0.0;
    return modes_bytes(of, def->disks, n) + structure + (phases ? of->tracks * track : 0.0);
}

/** Beside the windows. */
static double covariant_bytes(const hd_scene_def *def, const counted *of, double n)
{
    const double rows = 4.0 * def->disks, carried = hd_scene_carried(def);
    const double factors = 2.0 * carried * carried, ways = (carried < n ? 8.25 : 5.0) * n * n;
    return WORD * (factors + ways + rows * n) + 3.0 * modes_bytes(of, def->disks, n) +
           spectrum_bytes(n) + localization_bytes(n);
}

double hd_room_needed(const hd_scene_def *def, int threads, int ranks)
{
    const double disks = def->disks, n = hd_scene_vectors(def), carried = hd_scene_carried(def);
    const double of_ranks = fmax(ranks, 1.0);
    const counted none = {0};
    double bytes = OF_A_DISK * disks;
    if (n == 0) return bytes;
    const counted of = def->observe & HD_OBSERVE_WAVES ? fields_of(def) : none;
    bytes += OF_AN_EVENT * fmin(EVENTS_MAX, EVENTS_OF_A_DISK * disks);
    bytes += frame_bytes(4.0 * disks, carried / of_ranks, threads);
    bytes += ortho_bytes(4.0 * disks, carried, of_ranks);
    bytes += conjugate_bytes(def, of_ranks) + spectrum_bytes(n);
    if (def->observe & HD_OBSERVE_LOCALIZATION) bytes += localization_bytes(n);
    if (def->observe & HD_OBSERVE_OF_MODES) bytes += observer_bytes(def, &of, n);
    if (def->observe & HD_OBSERVE_COVARIANT) bytes += covariant_bytes(def, &of, n);
    if (def->observe & HD_OBSERVE_COVARIANT && ranks > 1) bytes += WORD * 4.0 * disks * n;
    return bytes;
}

/* ---- what would fit ------------------------------------------------------------------------ */

static bool fits(const hd_scene_def *def, hd_room room)
{
    const int threads = hd_threads_most(def->threads, 4 * def->disks, hd_scene_carried(def));
    return hd_room_needed(def, threads, room.ranks) <= room.bytes;
}

/** Largest value of a number of the scene, below the one it has, with which it fits; 0: none. The
 * number is within the scene. */
static int most_that_fits(const hd_scene_def *copy, hd_room room, int *number)
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

static int exponents_that_fit(const hd_scene_def *def, hd_room room)
{
    hd_scene_def copy = *def;
    copy.exponents = hd_scene_vectors(def);
    return most_that_fits(&copy, room, &copy.exponents);
}

static int disks_that_fit(const hd_scene_def *def, hd_room room)
{
    hd_scene_def copy = *def;
    return most_that_fits(&copy, room, &copy.disks);
}

/** Rounded down to two digits: it is an estimate. */
static int about(int number)
{
    int scale = 1;
    while (number / scale >= 100) scale *= 10;
    return number / scale * scale;
}

hd_status hd_room_check(const hd_scene_def *def, hd_room room, char *message, size_t size)
{
    const int n = hd_scene_vectors(def);
    const int threads = hd_threads_most(def->threads, 4 * def->disks, hd_scene_carried(def));
    char fitting[96] = "nothing of it would fit";
    if (fits(def, room)) return HD_OK;
    const int exponents = n > 0 ? about(exponents_that_fit(def, room)) : 0;
    const int disks = about(disks_that_fit(def, room));
    if (exponents > 0)
        snprintf(fitting, sizeof fitting, "exponents = %d would fit, or disks = %d", exponents,
                 disks);
    else if (disks > 0)
        snprintf(fitting, sizeof fitting, "disks = %d would fit", disks);
    (void)hd_refuse(
        message, size, "%s: disks = %d with %d exponents need %.3g GB, there are %.3g GB (%s); %s",
        hd_status_text(HD_NO_MEMORY), def->disks, n,
        1e-9 * hd_room_needed(def, threads, room.ranks), 1e-9 * room.bytes, room.limit, fitting);
    return HD_NO_MEMORY;
}
